// SPDX-License-Identifier: BSD-3-Clause

// Colours and strokes that distinguish the curves of one diagram.
export const strokes = ["--c0", "--c5", "--c2", "--c3", "--c1", "--c4"]; // variables of the page
const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [5, 2], [1, 2]];

/** Colour and dash of a curve, as in the printed form (plot_svg.cpp): the first 36 differ in one of them. */
export const lookOf = (index: number): { stroke: string; dash: number[] } => ({
  stroke: strokes[index % strokes.length],
  dash: dashes[(index + Math.floor(index / strokes.length)) % dashes.length],
});

/** More curves than this are a bundle: those that are chosen have a look and a name of their own, the others are pale. */
export const mostNamed = 6;

/** The look of each chosen curve. */
export type Choice = ReadonlyMap<number, number>;

/** All curves when there are few, or else the first; of a bundle that is one family none. */
export const firstChoice = (count: number, family: boolean): Choice =>
  new Map(Array.from({ length: count <= mostNamed ? count : family ? 0 : mostNamed }, (_, i) => [i, i]));

/** A choice with or without a curve. The others keep their looks, and the new one gets the first that is free. */
export function chosen(before: Choice, curve: number, on: boolean): Choice {
  const after = new Map(before);
  after.delete(curve);
  if (!on) return after;
  const used = new Set(after.values());
  let look = 0;
  while (used.has(look)) ++look;
  return after.set(curve, look);
}
