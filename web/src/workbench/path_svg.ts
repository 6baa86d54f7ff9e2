// SPDX-License-Identifier: BSD-3-Clause

// Path data of SVG as points: M L H V C S Q T A Z, absolute and relative. The y axis of SVG points down, that of a board up.
import type { Place } from "../motion";
import { PathError, type Path } from "./path";
import { onePath, stepsFor } from "./path_join";

/** How many numbers each command takes. */
const counts: Record<string, number> = { M: 2, L: 2, H: 1, V: 1, C: 6, S: 4, Q: 4, T: 2, A: 7, Z: 0 };

export interface Command {
  letter: string;
  numbers: number[];
}

/** The numbers in a text that follows `after`. Flags of arcs are single digits that may touch what follows. */
export function numbersIn(text: string, after: string, isArc = false): number[] {
  const out: number[] = [];
  const [gap, flag, number] = [/[\s,]*/y, /[01]/y, /[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?/iy];
  for (let at = 0; ; ) {
    gap.lastIndex = at;
    at += gap.exec(text)![0].length;
    if (at === text.length) return out;
    const isFlag = isArc && [3, 4].includes(out.length % 7);
    const form = isFlag ? flag : number;
    form.lastIndex = at;
    const found = form.exec(text);
    if (!found) throw new PathError(`“${text.slice(at, at + 12)}” after ${after} is not a ${isFlag ? "flag (0 or 1) of an arc" : "number"}.`, "Copy the whole attribute once more, without the quotation marks.");
    const value = Number(found[0]);
    if (!Number.isFinite(value)) throw new PathError(`The number ${found[0].slice(0, 12)} after ${after} is too large.`, "Coordinates are less than 1e300.");
    out.push(value);
    at += found[0].length;
  }
}

/** The commands, one for each set of numbers; further pairs after M are lines. */
export function commandsOf(data: string): Command[] {
  const parts = [...data.matchAll(/([a-df-z])([^a-df-z]*)/gi)];
  if (!/^\s*m/i.test(data)) throw new PathError("The path data do not begin with M or m.", "Copy the attribute d of the path from its first letter on, for example “M 0 0 L 40 0 C 60 0 60 30 40 30 Z”.");
  return parts.flatMap(([, letter, text]) => {
    const count = counts[letter.toUpperCase()];
    if (count === undefined) throw new PathError(`SVG has no path command ${letter}.`, "The commands are M L H V C S Q T A Z, in capital or small letters.");
    const numbers = numbersIn(text, `the command ${letter}`, letter.toUpperCase() === "A");
    if (count === 0) {
      if (numbers.length) throw new PathError(`Numbers follow the command ${letter}, which takes none.`, "Put a command such as L before them, or remove them.");
      return [{ letter, numbers }];
    }
    if (!numbers.length || numbers.length % count) throw new PathError(`The command ${letter} has ${numbers.length || "no"} number${numbers.length === 1 ? "" : "s"}; it takes ${count} at a time.`, "Copy the path once more: a number is missing, or there is one too many.");
    return Array.from({ length: numbers.length / count }, (_, k) => ({
      letter: k > 0 && letter === "M" ? "L" : k > 0 && letter === "m" ? "l" : letter,
      numbers: numbers.slice(k * count, (k + 1) * count),
    }));
  });
}

/** A curve of Bézier through its control points, without its first point. */
function bezier(control: Place[], steps: number): Place[] {
  return Array.from({ length: steps }, (_, k) => {
    const t = (k + 1) / steps;
    let row = control;
    while (row.length > 1) row = row.slice(1).map((p, i) => ({ x: row[i].x + t * (p.x - row[i].x), y: row[i].y + t * (p.y - row[i].y) }));
    return row[0];
  });
}

/** An elliptical arc between two points, without the first (SVG 1.1, appendix F.6.5). */
function arc(from: Place, to: Place, [rx, ry, turn, large, sweep]: number[], steps: number): Place[] {
  if (rx === 0 || ry === 0 || (from.x === to.x && from.y === to.y)) return [to];
  const [cos, sin] = [Math.cos((turn * Math.PI) / 180), Math.sin((turn * Math.PI) / 180)];
  const half = { x: (from.x - to.x) / 2, y: (from.y - to.y) / 2 };
  const p = { x: cos * half.x + sin * half.y, y: -sin * half.x + cos * half.y };
  // Radii that are too small for the distance grow until they reach.
  const grow = Math.sqrt(Math.max(1, (p.x / rx) ** 2 + (p.y / ry) ** 2));
  const [a, b] = [Math.abs(rx) * grow, Math.abs(ry) * grow];
  const below = (a * p.y) ** 2 + (b * p.x) ** 2;
  const size = (large === sweep ? -1 : 1) * Math.sqrt(Math.max(0, ((a * b) ** 2 - below) / below));
  const c = { x: (size * a * p.y) / b, y: (-size * b * p.x) / a };
  const centre = { x: cos * c.x - sin * c.y + (from.x + to.x) / 2, y: sin * c.x + cos * c.y + (from.y + to.y) / 2 };
  const first = Math.atan2((p.y - c.y) / b, (p.x - c.x) / a);
  let span = Math.atan2((-p.y - c.y) / b, (-p.x - c.x) / a) - first;
  if (sweep && span < 0) span += 2 * Math.PI;
  if (!sweep && span > 0) span -= 2 * Math.PI;
  return Array.from({ length: steps }, (_, k) => {
    const angle = first + (span * (k + 1)) / steps;
    const [x, y] = [a * Math.cos(angle), b * Math.sin(angle)];
    return k + 1 === steps ? to : { x: centre.x + cos * x - sin * y, y: centre.y + sin * x + cos * y };
  });
}

/** The pen that follows the commands: its place, and the last control point, which S and T mirror. */
interface Pen {
  at: Place;
  control: Place | null;
  curve: string; // "C" or "Q" for the curve that the control point is of
}

/** The points of one command, and the pen after it. */
function follow({ at, control, curve }: Pen, { letter, numbers: n }: Command, steps: number): { points: Place[]; pen: Pen } {
  const name = letter.toUpperCase();
  const from = letter === name ? { x: 0, y: 0 } : at;
  const place = (i: number): Place => ({ x: from.x + n[i], y: from.y + n[i + 1] });
  const mirrored = (kind: string): Place => (control && curve === kind ? { x: 2 * at.x - control.x, y: 2 * at.y - control.y } : at);
  const line = (to: Place) => ({ points: [to], pen: { at: to, control: null, curve: "" } });
  const curved = (kind: string, controls: Place[], to: Place) => ({ points: bezier([at, ...controls, to], steps), pen: { at: to, control: controls[controls.length - 1], curve: kind } });
  switch (name) {
    case "H": return line({ x: from.x + n[0], y: at.y });
    case "V": return line({ x: at.x, y: from.y + n[0] });
    case "C": return curved("C", [place(0), place(2)], place(4));
    case "S": return curved("C", [mirrored("C"), place(0)], place(2));
    case "Q": return curved("Q", [place(0)], place(2));
    case "T": return curved("Q", [mirrored("Q")], place(0));
    case "A": return { points: arc(at, place(5), n, steps), pen: { at: place(5), control: null, curve: "" } };
    default: return line(place(0));
  }
}

/** Points of each curve of a drawing with these commands. */
export const stepsOf = (commands: Command[][]): number => stepsFor(commands.reduce((sum, list) => sum + list.filter((c) => /[csqta]/i.test(c.letter)).length, 0), 24);

/** The parts of path data, each from its M on, with the y axis of SVG; curves have `steps` points. */
export function svgParts(commands: Command[], steps: number): Path[] {
  const parts: Path[] = [];
  let pen: Pen = { at: { x: 0, y: 0 }, control: null, curve: "" };
  let points: Place[] = [];
  const end = (closed: boolean) => {
    if (points.length > 1) parts.push({ points, closed });
    points = [];
  };
  let start = pen.at;
  for (const command of commands) {
    const name = command.letter.toUpperCase();
    if (name === "Z") {
      end(true);
      pen = { at: start, control: null, curve: "" };
      continue;
    }
    if (name === "M") end(false);
    else if (!points.length) points.push(pen.at); // after Z
    const next = follow(pen, command, steps);
    for (const p of next.points) points.push(p);
    pen = next.pen;
    if (name === "M") start = pen.at;
  }
  end(false);
  return parts;
}

/** The path of an attribute d alone, in mm. */
export function svgPath(data: string): Path {
  const commands = commandsOf(data);
  const parts = svgParts(commands, stepsOf([commands])).map(({ points, closed }, k) => ({ points: points.map(({ x, y }) => ({ x, y: y === 0 ? 0 : -y })), closed, name: `part ${k + 1}` }));
  return onePath(parts, "The path", "Keep one part, from its M to the next M, or let each part begin where another one ends. Drawing programs call this “break apart”.");
}
