// SPDX-License-Identifier: BSD-3-Clause

// The path that a machine is wanted for, in mm on a board whose y axis points up: made by hand or read, thinned out, and written as a study.
import type { Place } from "../motion";
import { evenly, tidy } from "./points";

export interface Path {
  points: Place[];
  closed: boolean;
}

/** The reason why something is not a path, and the way out. */
export class PathError extends Error {
  constructor(message: string, readonly hint: string) {
    super(message);
  }
}

export const mostPoints = 200;
const farthest = 1e12; // mm from the origin
const smallest = 1e-6; // mm
const evenPoints = 120; // a path with corners has some as well along its long sides

const distance = (a: Place, b: Place) => Math.hypot(a.x - b.x, a.y - b.y);
const withEnd = ({ points, closed }: Path) => (closed && points.length ? [...points, points[0]] : points);
export const lengthOf = (path: Path): number => withEnd(path).reduce((sum, p, i, all) => sum + (i ? distance(p, all[i - 1]) : 0), 0);

export function boxOf(points: readonly Place[]): { x: number; y: number; width: number; height: number } {
  let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const { x, y } of points) {
    [left, right] = [Math.min(left, x), Math.max(right, x)];
    [bottom, top] = [Math.min(bottom, y), Math.max(top, y)];
  }
  return { x: left, y: bottom, width: right - left, height: top - bottom };
}

/** The path without its end, if that comes back to within `reach` of its beginning: up to where it is nearest. */
function snapped(stroke: Place[], reach: number): Path {
  const start = stroke[0];
  let tail = stroke.length;
  while (tail > 0 && distance(stroke[tail - 1], start) <= reach) --tail;
  const open = { points: stroke, closed: false };
  if (tail === stroke.length || lengthOf({ points: stroke.slice(0, tail + 1), closed: false }) < 4 * reach) return open;
  const near = stroke.slice(tail).reduce((best, p, i, all) => (distance(p, start) < distance(all[best], start) ? i : best), 0);
  return { points: stroke.slice(0, tail + near), closed: true };
}

/** The corners of a path, with points between them. */
function filled(path: Path): Place[] {
  const ring = withEnd(path);
  const step = lengthOf(path) / evenPoints;
  const points = ring.slice(1).flatMap((b, i) => {
    const a = ring[i];
    const count = Math.max(1, Math.round(distance(a, b) / step));
    return Array.from({ length: count }, (_, k) => ({ x: a.x + (k / count) * (b.x - a.x), y: a.y + (k / count) * (b.y - a.y) }));
  });
  return path.closed ? points : [...points, ring[ring.length - 1]];
}

/** A path drawn by hand, closed if it ends within `reach` mm of its beginning; null = a press, no path. Its points are at equal steps, but
 *  the few of a pen that the keyboard moves are corners. */
export function byHand(stroke: Place[], reach: number): Path | null {
  const path = snapped(stroke, reach);
  const length = lengthOf(path);
  if (path.points.length < 2 || length < reach) return null;
  const count = Math.min(mostPoints, Math.max(24, Math.round(length)));
  const coarse = path.points.length < count / 4;
  if (coarse) return { points: filled(path), closed: path.closed };
  return { points: evenly(path.points, path.closed, count), closed: path.closed };
}

/** A path that was read, with its corners kept where there are not too many, and with points between them. */
export function prepared(read: Path): Path {
  if (!read.points.every(({ x, y }) => Math.abs(x) <= farthest && Math.abs(y) <= farthest)) throw new PathError("A point of the path lies more than 1e9 m from the origin.", "Check the number and the unit.");
  const points = read.points.filter((p, i, all) => i === 0 || distance(p, all[i - 1]) > 0);
  const size = Math.max(boxOf(points).width, boxOf(points).height);
  if (size > 0 && size < smallest) throw new PathError("The path is smaller than a nanometre.", "Check the unit.");
  if (!(size > 0)) throw new PathError("All points of the path are at the same place.", "Give at least two different points; three for a closed path.");
  const gap = distance(points[0], points[points.length - 1]);
  const closed = read.closed || (points.length > 3 && gap <= 1e-6 * size);
  if (closed && gap <= 1e-6 * size) points.pop();
  const all = points.length > mostPoints ? points : filled({ points, closed });
  return { points: all.length > mostPoints ? evenly(points, closed, mostPoints) : all, closed };
}

/** Path data with the corners of the hand rounded off, for the eye alone; y points down on the screen. */
export function smoothed({ points, closed }: Path): string {
  const written = (p: Place) => `${p.x.toFixed(2)} ${(-p.y).toFixed(2)}`;
  const middle = (a: Place, b: Place) => ({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 });
  if (points.length < 3) return points.length ? `M${points.map(written).join("L")}` : "";
  const [first, last] = [points[0], points[points.length - 1]];
  const curve = (list: Place[]) => list.map((p, i, all) => `Q${written(p)} ${written(i + 1 < all.length ? middle(p, all[i + 1]) : closed ? middle(p, first) : last)}`).join("");
  return closed ? `M${written(middle(last, first))}${curve(points)}Z` : `M${written(first)}${curve(points.slice(1, -1))}L${written(last)}`;
}

/** The wishes that go into the study beside the path. */
export interface Wishes {
  mostLinks: number;
  leastPairAngle: number; // degrees
  longestLink: number; // sizes of the path
  rocks: boolean; // the drive of an open path, which need not turn
}

/** The study that asks for machines of every type along a path, with so many seconds for the search. */
export function studyOf({ points, closed }: Path, { mostLinks, leastPairAngle, longestLink, rocks }: Wishes, seconds: number): string {
  const size = Math.max(boxOf(points).width, boxOf(points).height);
  const rows = points.map((p) => `[${tidy(p.x, size)}, ${tidy(p.y, size)}]`);
  const lines = Array.from({ length: Math.ceil(rows.length / 6) }, (_, k) => `  ${rows.slice(6 * k, 6 * k + 6).join(", ")},`);
  return `schema = 1
kind   = "synthesis"
title  = "Drawn motion"

[mechanism]
type       = "planar.any"
most_links = ${mostLinks}

[target]
type      = "path_points"
closed    = ${closed}
points_mm = [
${lines.join("\n")}
]

[limits]
least_pair_angle_deg = ${leastPairAngle}
longest_link         = ${longestLink}${rocks && !closed ? "\ncrank_turns          = false" : ""}

[optimiser]
seconds       = ${seconds}
seeds         = { first = 1, count = 1 }
max_solutions = 12
`;
}
