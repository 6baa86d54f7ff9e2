// SPDX-License-Identifier: BSD-3-Clause

// The board of the path: what is on it, the part of the plane that it shows, and the steps back and forth.
import { computed, signal } from "@preact/signals";
import type { Place } from "../motion";
import { niceStep } from "../view";
import { boxOf, byHand, type Path, type Wishes } from "./path";

/** The part of the plane that is shown (mm), from its lower left corner. */
export interface Frame {
  x: number;
  y: number;
  width: number;
  height: number;
}
export interface Sheet {
  path: Path | null;
  frame: Frame;
}

const home: Frame = { x: -100, y: -80, width: 200, height: 160 };
export const blankSheet: Sheet = { path: null, frame: home };

/** The board is on the screen. */
export const showPath = signal(false);
export const sheet = signal<Sheet>(blankSheet);
const past = signal<Sheet[]>([]);
const future = signal<Sheet[]>([]);
export const canUndoPath = computed(() => past.value.length > 0);
export const canRedoPath = computed(() => future.value.length > 0);
export const wishes = signal<Wishes>({ mostLinks: 8, leastPairAngle: 20, longestLink: 10, rocks: false });

export function put(next: Sheet): void {
  past.value = [...past.value, sheet.value];
  future.value = [];
  sheet.value = next;
}
function step(from: typeof past, to: typeof past): void {
  const next = from.value[from.value.length - 1];
  if (!next) return;
  to.value = [...to.value, sheet.value];
  from.value = from.value.slice(0, -1);
  sheet.value = next;
}
export const undoPath = () => step(past, future);
export const redoPath = () => step(future, past);
export const clearPath = () => put(blankSheet);

/** The frame that shows a path: the board as it is at first where that is large enough, and a larger or a smaller one elsewhere. */
export function frameFor(path: Path): Frame {
  const box = boxOf(path.points);
  const inside = box.x > home.x && box.y > home.y && box.x + box.width < home.x + home.width && box.y + box.height < home.y + home.height;
  const wanted = 1.25 * Math.max(box.width, (box.height * home.width) / home.height);
  if (inside && wanted > home.width / 5) return home;
  const unit = niceStep(wanted / 5);
  const width = unit * Math.ceil(wanted / unit);
  const height = (width * home.height) / home.width;
  return { x: box.x + box.width / 2 - width / 2, y: box.y + box.height / 2 - height / 2, width, height };
}

/** Takes a path that was read. */
export const takePath = (path: Path) => put({ path, frame: frameFor(path) });

/** mm within which the ends of a path meet: fingers are broader than pointers. */
export const reachOf = (frame: Frame, pointer: string) => ((pointer === "touch" ? 10 : 6) * frame.width) / home.width;

/** Takes what the pen has drawn. A stroke that begins at the end of an open path continues it, any other one replaces it. */
export function takeStroke(stroke: Place[], reach: number): void {
  const { path, frame } = sheet.value;
  const end = path && !path.closed ? path.points[path.points.length - 1] : null;
  const continues = end !== null && Math.hypot(end.x - stroke[0].x, end.y - stroke[0].y) < reach;
  const drawn = byHand(continues ? [...path!.points, ...stroke] : stroke, reach);
  if (drawn) put({ path: drawn, frame });
}

export function closePath(closed: boolean): void {
  const { path, frame } = sheet.value;
  if (path && path.points.length > 2) put({ path: { ...path, closed }, frame });
}
