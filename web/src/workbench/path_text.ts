// SPDX-License-Identifier: BSD-3-Clause

// A path from text that is pasted or read from a file: SVG, DXF, or rows of coordinates.
import type { Place } from "../motion";
import { PathError, prepared, type Path } from "./path";
import { dxfPath } from "./path_dxf";
import { svgPath } from "./path_svg";
import { svgFile } from "./path_svg_file";
import { numbersOf } from "./points";

const units: Record<string, number> = { mm: 1, cm: 10, m: 1000, in: 25.4, inch: 25.4 };

/** mm for a unit of the table: its header may name one, as in "x_mm; y_mm" or "x (cm), y (cm)". */
function unitOf(header: string): number {
  const [, name] = /_(mm|cm|m|in)\b/i.exec(header) ?? /[([]\s*([a-z]+)\s*[)\]]/i.exec(header) ?? [];
  const factor = units[name?.toLowerCase() ?? "mm"];
  if (!factor) throw new PathError(`The header of the table names the unit “${name}”.`, "Lengths are in mm, cm, m or in; without a unit they are in mm.");
  return factor;
}

/** Rows of two coordinates, divided by tabs, semicolons, spaces or commas; decimals may have commas. */
export function csvPath(text: string): Path {
  const lines = text.split(/\r\n|\n|\r/).map((line, i) => ({ line: line.trim(), number: i + 1 })).filter(({ line }) => line !== "" && !line.startsWith("#"));
  const header = lines.length && !/\d/.test(lines[0].line.replace(/[a-z]\w*/gi, "")) ? lines.shift()!.line : "";
  const factor = unitOf(header);
  const points = lines.map(({ line, number }): Place => {
    const row = numbersOf(line);
    const shown = line.length > 30 ? `${line.slice(0, 30)} …` : line;
    if (row.length < 2) throw new PathError(`Line ${number}, “${shown}”, has only one number.`, "Each line holds the two coordinates of one point, for example 12.5; 40.");
    if (row.length > 2) throw new PathError(`Line ${number}, “${shown}”, has ${row.length} numbers instead of two.`, "Keep the columns x and y. If your decimals have commas, divide the columns by semicolons.");
    if (!row.every(Number.isFinite)) throw new PathError(`Line ${number}, “${shown}”, is not a pair of numbers.`, "Write one point in each line, for example 12.5; 40. SVG path data begin with M.");
    return { x: factor * row[0], y: factor * row[1] };
  });
  if (points.length < 2) throw new PathError(points.length ? "There is only one point." : "There are no points.", "Paste at least two lines of two numbers, the path data of an SVG, or an ASCII DXF.");
  return { points, closed: false };
}

/** The path in a text, whichever of the forms it has. */
export function readPath(text: string): Path {
  const read = /^\s*</.test(text) ? svgFile(text)
    : /^\s*[mM]\s*[-+.\d]/.test(text) ? svgPath(text)
      : /^AutoCAD Binary DXF|^\s*(?:0\s*[\r\n]+\s*(?:SECTION|LWPOLYLINE|POLYLINE|LINE|ARC|CIRCLE|ELLIPSE|SPLINE|EOF)\b|999\s*[\r\n])/.test(text) ? dxfPath(text)
        : csvPath(text);
  return prepared(read);
}
