// SPDX-License-Identifier: BSD-3-Clause

// The lines of a drawing, joined end to end where they meet: a traced point follows one line.
import type { Place } from "../motion";
import { format } from "../units";
import { boxOf, lengthOf, PathError, type Path } from "./path";

/** A line of a drawing, in mm, with the name that messages give it. */
export interface Part extends Path {
  name: string;
}

const reach = 1e-4; // sizes of the drawing within which ends meet
const mostPoints = 500_000; // of all curves of a drawing

/** Points of each curve of a drawing: at most `most`, and fewer where there are very many curves. */
export const stepsFor = (curves: number, most: number): number => Math.max(2, Math.min(most, Math.floor(mostPoints / Math.max(1, curves))));

const sizeOf = (points: Place[]): number => Math.max(boxOf(points).width, boxOf(points).height);

/** The numbers of the places that the ends are at; ends within `tolerance` of a place are at it. */
function placesOf(ends: Place[], tolerance: number): number[] {
  const { x, y, width } = boxOf(ends);
  const columns = Math.ceil(width / tolerance) + 3;
  const cells = new Map<number, number[]>(); // places by the square of the plane that they are in
  const places: Place[] = [];
  return ends.map((p) => {
    const [i, k] = [Math.floor((p.x - x) / tolerance) + 1, Math.floor((p.y - y) / tolerance) + 1];
    for (const column of [i - 1, i, i + 1])
      for (const row of [k - 1, k, k + 1])
        for (const n of cells.get(row * columns + column) ?? []) if (Math.hypot(p.x - places[n].x, p.y - places[n].y) <= tolerance) return n;
    const cell = k * columns + i;
    const here = cells.get(cell);
    if (here) here.push(places.length);
    else cells.set(cell, [places.length]);
    return places.push(p) - 1;
  });
}

/** The distance within which ends meet: small beside the drawing, and beside the lengths of its parts. */
function toleranceOf(parts: Part[]): number {
  const lengths = parts.map(lengthOf).sort((a, b) => a - b);
  return Math.min(reach * sizeOf(parts.flatMap((p) => p.points)), lengths[lengths.length >> 1] / 10);
}

/** The points of parts that follow each other; each is given by the end at which it is entered: 2 k at its first point, 2 k + 1 at its last. */
function chained(parts: Part[], entered: number[]): Place[] {
  const points: Place[] = [];
  for (const end of entered) {
    const own = end & 1 ? [...parts[end >> 1].points].reverse() : parts[end >> 1].points;
    for (let i = points.length ? 1 : 0; i < own.length; ++i) points.push(own[i]);
  }
  return points;
}

/** Open parts as the chains that they make, whatever their order and direction. */
function chainsOf(all: Part[]): Part[] {
  const tolerance = toleranceOf(all);
  const parts = all.filter((part) => lengthOf(part) > tolerance); // shorter ones are within a place
  const place = placesOf(parts.flatMap(({ points }) => [points[0], points[points.length - 1]]), tolerance);
  const free: number[][] = []; // ends at each place
  const used = parts.map((_, k) => place[2 * k] === place[2 * k + 1]);
  place.forEach((at, end) => (free[at] ??= []).push(end));
  const follow = (from: number): number[] => {
    const entered: number[] = [];
    for (let at = from; ; at = place[entered[entered.length - 1] ^ 1]) {
      let end = free[at].pop();
      while (end !== undefined && used[end >> 1]) end = free[at].pop();
      if (end === undefined) return entered;
      used[end >> 1] = true;
      entered.push(end);
    }
  };
  return parts.flatMap((part, k): Part[] => {
    if (place[2 * k] === place[2 * k + 1]) return [ring(part)];
    if (used[k]) return [];
    used[k] = true;
    const after = follow(place[2 * k + 1]);
    const before = follow(place[2 * k]).reverse().map((end) => end ^ 1);
    const entered = [...before, 2 * k, ...after];
    const chain = { points: chained(parts, entered), closed: false, name: entered.length > 1 ? `the chain with ${part.name}` : part.name };
    return [place[entered[0]] === place[entered[entered.length - 1] ^ 1] ? ring(chain) : chain];
  });
}

/** A line whose ends meet is closed; one that only goes there and back is not. */
const ring = (part: Part): Part => (part.points.length > 3 ? { ...part, points: part.points.slice(0, -1), closed: true } : part);

/** The one line that the parts of a drawing make; `where` names the drawing, `hint` says how to keep one line of several. */
export function onePath(all: Part[], where: string, hint: string): Path {
  const wrong = all.find(({ points }) => points.some((p) => !Number.isFinite(p.x) || !Number.isFinite(p.y)));
  if (wrong) throw new PathError(`A coordinate of ${wrong.name} is not a finite number.`, "Save the drawing again: the file is damaged, or a number in it is too large.");
  const parts = all.filter((part) => lengthOf(part) > 0);
  if (!parts.length) throw new PathError(`${where} draws no line: all its points are at the same place.`, "Give at least two different points; three for a closed path.");
  const open = parts.filter((p) => !p.closed);
  const lines = [...parts.filter((p) => p.closed), ...(open.length ? chainsOf(open) : [])];
  if (lines.length > 1) {
    const longest = lines.map(({ name, ...path }) => ({ name, length: lengthOf(path) })).sort((a, b) => b.length - a.length).slice(0, 3);
    const listed = longest.map(({ name, length }) => `${name} (${format(length, 3)} mm long)`).join(", ");
    throw new PathError(`${where} has ${lines.length} separate lines: ${listed}${lines.length > 3 ? ", …" : ""}; a traced point can follow only one.`, hint);
  }
  return { points: lines[0].points, closed: lines[0].closed };
}
