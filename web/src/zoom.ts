// SPDX-License-Identifier: BSD-3-Clause

// The part of a diagram that is shown.
import type { Box } from "./view";

export type Range = [number, number];

const closest = 1e-7;  // share of the whole range: no nearer than this

/** A part of the whole, as long as it should be and inside of it; null when that is the whole. */
function inside([low, high]: Range, [from, to]: Range): Range | null {
  const length = Math.max(high - low, closest * (to - from));
  if (!(length < (to - from) * (1 - 1e-9))) return null;
  const start = Math.min(Math.max((low + high - length) / 2, from), to - length);
  return [start, start + length];
}

/** A range `factor` times nearer, about a place that keeps its place. */
export const nearer = ([low, high]: Range, whole: Range, about: number, factor: number): Range | null =>
  inside([about + (low - about) / factor, about + (high - about) / factor], whole);

/** A range moved by a share of its length. */
export function shifted([low, high]: Range, whole: Range, share: number): Range | null {
  const by = share * (high - low);
  return inside([low + by, high + by], whole);
}

/** The part of a range between two places, in whichever order. */
export const between = (a: number, b: number, whole: Range): Range | null => inside([Math.min(a, b), Math.max(a, b)], whole);

/** The least part of the whole that holds a box and has the whole's proportions, so that equal axes stay equal. */
export function boxAbout(box: Box, whole: Box): { x: Range | null; y: Range | null } {
  const share = Math.max((box.right - box.left) / (whole.right - whole.left), (box.top - box.bottom) / (whole.top - whole.bottom));
  const about = (from: number, to: number, [low, high]: Range) => inside([(from + to - share * (high - low)) / 2, (from + to + share * (high - low)) / 2], [low, high]);
  return { x: about(box.left, box.right, [whole.left, whole.right]), y: about(box.bottom, box.top, [whole.bottom, whole.top]) };
}

/** Along which axes a drag zooms: a flat box chooses one of them. */
export function boxed(width: number, height: number): { x: boolean; y: boolean } {
  const [w, h] = [Math.abs(width), Math.abs(height)];
  const flat = 16; // px
  return { x: w > flat || w >= h, y: h > flat || h > w };
}

export interface Peak {
  low: number; // the range without the peaks
  high: number;
  value: number; // the largest of them
  list: number;
  row: number;
}

/** The range without rare peaks, when the largest value is more than eight times the 98th percentile of the sizes. Where almost all
 *  values are nothing beside the peaks, the peaks are what there is to see. */
export function peakOf(lists: (number | null | undefined)[][]): Peak | null {
  const sizes: number[] = [];
  const top = { size: -1, list: 0, row: 0 };
  lists.forEach((values, list) =>
    values.forEach((v, row) => {
      if (v === null || v === undefined) return;
      sizes.push(Math.abs(v));
      if (Math.abs(v) > top.size) Object.assign(top, { size: Math.abs(v), list, row });
    }),
  );
  if (sizes.length < 50) return null;
  const usual = Float64Array.from(sizes).sort()[Math.floor(0.98 * (sizes.length - 1))];
  if (!(top.size > 8 * usual) || !(usual > 1e-4 * top.size)) return null;
  let [low, high] = [Infinity, -Infinity];
  for (const values of lists)
    for (const v of values)
      if (v !== null && v !== undefined && Math.abs(v) <= 2 * usual) [low, high] = [Math.min(low, v), Math.max(high, v)];
  return { low, high, value: lists[top.list][top.row]!, list: top.list, row: top.row };
}

/** Steps of an axis in degrees: parts of a turn from 15 degrees on, decimal ones below and for many turns. */
export const degreeSteps: number[] = [
  ...[-9, -8, -7, -6, -5, -4, -3, -2, -1].flatMap((power) => [1, 2, 5].map((m) => Number(`${m}e${power}`))),
  1, 2, 5, 10, 15, 30, 45, 90, 180, 360, 720, 1800, 3600, 7200, 18000, 36000, 72000, 180000, 360000, 3600000,
];

/** The smallest step in degrees that is not below the least. */
export const degreeStep = (least: number): number => degreeSteps.find((step) => step >= least * (1 - 1e-12)) ?? least;
