// SPDX-License-Identifier: BSD-3-Clause

// A path from what is pasted or read from a file: SVG, DXF, or rows of coordinates.
import { PathError, prepared, type Path } from "./path";
import { csvPath } from "./path_csv";
import { dxfPath } from "./path_dxf";
import { svgPath } from "./path_svg";
import { svgFile } from "./path_svg_file";

/** Bytes of a file, or characters of a text, at most. */
export const mostBytes = 50_000_000;

/** The first bytes of files that are not text, what they are, and the way to a file that is read. */
const signatures: [string, string, string][] = [
  ["PK\x03\x04", "an Excel workbook or another packed file", "Save the table as CSV, or unpack the drawing."],
  ["\xd0\xcf\x11\xe0", "an Excel workbook", "Save the table as CSV."],
  ["\x1f\x8b", "a packed file, such as SVGZ", "Save the drawing as plain SVG, or unpack it."],
  ["%PDF", "a PDF file", "Export the drawing as SVG or DXF."],
  ["AC10", "a DWG drawing", "Save the drawing as an ASCII DXF."],
  ["\x89PNG", "a picture of pixels", "Trace its line in a drawing program, and save it as SVG."],
  ["\xff\xd8\xff", "a picture of pixels", "Trace its line in a drawing program, and save it as SVG."],
];

/** Refuses a file or a text that is too large to be read in a moment. */
export function requireSize(size: number): void {
  if (size > mostBytes) throw new PathError(`The file has ${Math.ceil(size / 1e6)} MB; at most ${mostBytes / 1e6} MB are read.`, "Save the path alone, with fewer points: a few hundred are enough.");
}

/** UTF-16 by its mark or by the zero bytes of its first letters. */
function encodingOf(bytes: Uint8Array): string {
  const [a, b, c, d] = bytes;
  if ((a === 0xff && b === 0xfe) || (a && b === 0 && c && d === 0)) return "utf-16le";
  return (a === 0xfe && b === 0xff) || (a === 0 && b && c === 0 && d) ? "utf-16be" : "utf-8";
}

/** The text of a file in UTF-8, UTF-16 or, where the bytes are none of these, Windows-1252. */
export function textOf(bytes: Uint8Array): string {
  const head = Array.from(bytes.subarray(0, 8), (byte) => String.fromCharCode(byte)).join("");
  const [, kind, hint] = signatures.find(([mark]) => head.startsWith(mark)) ?? [];
  if (kind) throw new PathError(`This is ${kind}, not a text.`, hint!);
  try {
    return new TextDecoder(encodingOf(bytes), { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}

/** The path in a text, whichever of the forms it has. */
export function readPath(marked: string): Path {
  requireSize(marked.length);
  const text = marked.replace(/^\ufeff+/, "");
  if (!/\S/.test(text)) throw new PathError("The text or file is empty.", "Give at least two lines of two numbers, the path data of an SVG, an SVG file, or an ASCII DXF.");
  const read = /^\s*</.test(text) ? svgFile(text)
    : /^\s*[mM]\s*[-+.\d]/.test(text) ? svgPath(text)
      : /^AutoCAD Binary DXF|^\s*(?:0[ \t]*[\r\n]\s*(?:SECTION|LWPOLYLINE|POLYLINE|LINE|ARC|CIRCLE|ELLIPSE|SPLINE|EOF)\b|999\s*[\r\n])/.test(text) ? dxfPath(text)
        : csvPath(withoutZeros(text));
  return prepared(read);
}

function withoutZeros(text: string): string {
  if (text.includes("\0")) throw new PathError("This is not a text: it holds zero bytes.", "Save the path as SVG, CSV or ASCII DXF.");
  return text;
}
