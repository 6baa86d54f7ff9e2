// SPDX-License-Identifier: BSD-3-Clause

// Names beside places, so that they do not cover each other.
import type { Scene, Vector } from "./data";

export interface Label {
  x: number; // px, of the place that has the name
  y: number;
  text: string;
}

export interface Placed {
  x: number; // px from the place: where the text begins, is in its middle, or ends, on its baseline
  y: number;
  anchor: "start" | "middle" | "end";
  slot: number;  // index of its position beside a place
  far: boolean; // a leader should go to the place
}

const slots: Omit<Placed, "slot">[] = [
  { x: 11, y: -9, anchor: "start", far: false },
  { x: -11, y: -9, anchor: "end", far: false },
  { x: 13, y: 19, anchor: "start", far: false },
  { x: -13, y: 19, anchor: "end", far: false },
  { x: 0, y: -15, anchor: "middle", far: false },
  { x: 24, y: -27, anchor: "start", far: true },
  { x: -24, y: -27, anchor: "end", far: true },
  { x: 26, y: 35, anchor: "start", far: true },
  { x: -26, y: 35, anchor: "end", far: true },
  { x: 40, y: -45, anchor: "start", far: true },
  { x: -40, y: -45, anchor: "end", far: true },
];
const [perLetter, above, below] = [7.2, 11, 4]; // px
const clear = 5; // px about a place

interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

function boxOf({ x, y, text }: Label, slot: number): Box {
  const { x: dx, y: dy, anchor } = slots[slot];
  const width = perLetter * text.length;
  const left = x + dx - (anchor === "start" ? 0 : anchor === "end" ? width : width / 2);
  return { left, right: left + width, top: y + dy - above, bottom: y + dy + below };
}

const overlap = (a: Box, b: Box) => Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left)) * Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));

/** Positions of the names, one after the other: the first that covers neither a name nor a place, or else the one that covers least. A name
 *  stays where it was `before` as long as it can, so that it does not jump as the mechanism moves. */
export function placeLabels(labels: readonly (Label | null)[], before: readonly number[] = []): (Placed | null)[] {
  const places = labels.map((l) => l && { left: l.x - clear, right: l.x + clear, top: l.y - clear, bottom: l.y + clear });
  const taken: Box[] = [];
  return labels.map((label, i) => {
    if (!label || !label.text) return null;
    let best = 0;
    let least = Infinity;
    const first = before[i] ?? 0;
    for (const slot of [first, ...slots.keys()]) {
      const box = boxOf(label, slot);
      const covered = taken.reduce((sum, t) => sum + overlap(box, t), 0) + places.reduce((sum, p, k) => (p && k !== i ? sum + overlap(box, p) : sum), 0);
      if (covered < least) [best, least] = [slot, covered];
      if (covered === 0) break;
    }
    taken.push(boxOf(label, best));
    return { ...slots[best], slot: best };
  });
}

/** The text at an arrow: nothing when a joint has that name already, for it begins there. */
export const symbolOf = (scene: Scene, vector: Vector): string =>
  scene.joints.some((j) => j.name === vector.symbol) ? "" : vector.symbol;
