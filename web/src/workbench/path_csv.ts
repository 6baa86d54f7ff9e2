// SPDX-License-Identifier: BSD-3-Clause

// Rows of coordinates as a path in mm: as spreadsheets and measuring programs write them, or as they are typed.
import type { Place } from "../motion";
import { PathError, type Path } from "./path";

interface Line {
  text: string;
  number: number; // from 1
}
interface Cell {
  text: string;
  quoted: boolean;
}

/** mm for a unit of length; the program knows the same ones in its tables. */
const units = new Map([["mm", 1], ["cm", 10], ["m", 1000], ["um", 1e-3], ["µm", 1e-3], ["μm", 1e-3], ["in", 25.4], ["inch", 25.4], ["inches", 25.4]]);
const longestHeading = 1000; // characters that are looked at
const longestQuoted = 10_000; // characters of a line with quotes

/** Lines that hold something; those that begin with # are remarks, unless it is an error value of a spreadsheet. */
function* linesOf(text: string): Generator<Line> {
  const end = /\r\n|\n|\r|$/g;
  let from = 0;
  for (let number = 1; from <= text.length; ++number) {
    end.lastIndex = from;
    const found = end.exec(text)!;
    const line = text.slice(from, found.index).trim();
    if (/[^\s;,]/.test(line) && (!line.startsWith("#") || /^#(?:DIV\/0!|N\/A|REF!|VALUE!|NAME\?|NUM!|NULL!)/.test(line))) yield { text: line, number };
    from = found.index + Math.max(1, found[0].length);
  }
}

const shown = (text: string) => (text.length > 30 ? `${text.slice(0, 30)} …` : text);
const lineOf = ({ number, text }: Line) => `Line ${number}, “${shown(text)}”,`;

/** The separator of a line: a semicolon, a tab, blanks, or a comma where there are none of these. */
function separatorOf(text: string): string {
  const bare = text.replace(/"[^"]*"/g, "");
  return bare.includes(";") ? ";" : bare.includes("\t") ? "\t" : /\s/.test(bare) ? " " : ",";
}

/** The cells of a line; a quoted one may hold the separator. */
function cellsOf(line: Line, separator: string): Cell[] {
  if (!line.text.includes('"')) return (separator === " " ? line.text.split(/\s+|,(?=\s)/).filter(Boolean) : line.text.split(separator)).map((text) => ({ text: text.trim(), quoted: false }));
  if (line.text.length > longestQuoted) throw new PathError(`${lineOf(line)} has ${line.text.length} characters and quotes.`, "Write one point in each line, for example 12.5; 40.");
  const cells: Cell[] = [];
  const cell = separator === " " ? /(?:\s|,(?=\s))*(?:"((?:[^"]|"")*)"|((?:[^\s,]|,(?!\s))+))/y : new RegExp(`\\s*(?:"((?:[^"]|"")*)"\\s*|([^"${separator}]*))(?:${separator}|$)`, "y");
  for (let at = 0; at < line.text.length; at = cell.lastIndex) {
    cell.lastIndex = at;
    const found = cell.exec(line.text);
    if (!found) throw new PathError(`${lineOf(line)} has a quote that is not closed, or text beside a quoted number.`, "Write a quotation mark before and after the number, or none at all.");
    cells.push({ text: (found[1] ?? found[2]).trim(), quoted: found[1] !== undefined });
  }
  return cells;
}

/** A number with a decimal point or comma; NaN for what is none. */
function numberIn(text: string): number {
  const plain = text.replace("\u2212", "-").replace(",", ".");
  return /^[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
}

/** A line is a heading if none of its cells is a number, nor a word that stands for one. */
const isHeading = (line: Line, separator: string): boolean =>
  cellsOf({ ...line, text: line.text.slice(0, longestHeading) }, separator).every(({ text }) => Number.isNaN(numberIn(text)) && !/^(?:[-+]?(?:nan|inf(?:inity)?)|#.*)$/i.test(text));

/** The cells of a heading; where blanks separate the numbers, a unit in brackets belongs to the word before it. */
function headingCells(line: Line, separator: string): string[] {
  const text = line.text.slice(0, longestHeading);
  if (separator !== " ") return cellsOf({ ...line, text }, separator).map((cell) => cell.text);
  return text.includes(",") ? text.split(",").map((cell) => cell.trim()) : (text.match(/[^\s([]+(?:\s*[([][^)\]]*[)\]])?/g) ?? []);
}

/** The name and the unit of a heading such as x_mm, X [mm] or "x mm"; the unit is "" where it has none. */
function columnOf(heading: string): { base: string; unit: string } {
  const [, base, unit] = /^([^([]*)[([]\s*([^)\]]*?)\s*[)\]]$/.exec(heading) ?? /^(.*?)(?:_|[\s/]+)(mm|cm|m|um|µm|μm|in|inch|inches)$/i.exec(heading) ?? [null, heading, ""];
  return { base: base.trim().toLowerCase(), unit };
}

/** mm of a unit; undefined for none. */
function factorOf(unit: string): number | undefined {
  const factor = units.get(unit.toLowerCase());
  if (unit && factor === undefined) throw new PathError(`The header of the table names the unit “${shown(unit)}”.`, "Lengths are in mm, cm, m, um or in; without a unit they are in mm.");
  return factor;
}

/** A column of the table, from 0, with mm for its numbers. */
interface Column {
  index: number;
  factor: number;
}

/** The two columns of coordinates in a table whose rows have `width` cells. */
function columnsOf(headings: Line[], separator: string, width: number, first: Line): [Column, Column] {
  const rows = headings.map((line) => headingCells(line, separator)).filter((cells) => cells.length === width && width > 1);
  const columns = rows.length ? Array.from({ length: width }, (_, i) => columnOf(rows.map((cells) => cells[i]).join(" ").trim())) : [];
  const [x, y] = ["x", "y"].map((base) => columns.findIndex((column) => column.base === base));
  const named = x >= 0 && y >= 0;
  if (!named && width !== 2) {
    if (columns.length) throw new PathError(`The header of the table names ${columns.length} columns, but not x and y.`, "Name the two columns of the coordinates x and y, for example x_mm;y_mm.");
    const hint = width < 2 ? "Each line holds the two coordinates of one point, for example 12.5; 40." : "Keep the columns x and y, or name them so in a header. If your decimals have commas, divide the columns by semicolons.";
    throw new PathError(`${lineOf(first)} has ${width < 2 ? "only one number" : `${width} numbers instead of two`}.`, hint);
  }
  // A unit in a title is the unit of both.
  const title = columns.length ? "" : headings.map(({ text }) => /_(mm|cm|m|um|in)\b/i.exec(text.slice(0, longestHeading))?.[1] ?? /[([]\s*([a-zµμ]+)\s*[)\]]/i.exec(text.slice(0, longestHeading))?.[1]).find((unit) => unit) ?? "";
  const [a, b] = named ? [x, y] : [0, 1];
  const [own, other] = [a, b].map((index) => factorOf(columns[index]?.unit ?? title));
  return [{ index: a, factor: own ?? other ?? 1 }, { index: b, factor: other ?? own ?? 1 }];
}

/** Reads numbers that have either decimal points or decimal commas. */
class Numbers {
  private decimal = "";

  read(line: Line, cell: Cell, column: number): number {
    const { text } = cell;
    const value = numberIn(text);
    const mark = text.includes(",") ? "," : text.includes(".") ? "." : "";
    const sign = (m: string) => (m === "," ? "comma" : "point");
    if (mark && this.decimal && mark !== this.decimal && !Number.isNaN(value)) throw new PathError(`${lineOf(line)} has “${shown(text)}” with a decimal ${sign(mark)}, but numbers before it have a decimal ${sign(this.decimal)}.`, "Write all decimals with points, or all with commas.");
    this.decimal ||= mark;
    if (Number.isFinite(value)) return value;
    const found = text ? `“${shown(text)}”` : `column ${column + 1} is empty`;
    const hint = text.includes(",") && text.includes(".") ? "Write thousands without a separator, like 1000.5." : "Write one point in each line, for example 12.5; 40. SVG path data begin with M.";
    throw new PathError(`${lineOf(line)} is not a pair of numbers: ${found}.`, hint);
  }
}

/** Rows of two coordinates, divided by tabs, semicolons, blanks or commas; of a table with more columns those named x and y. */
export function csvPath(text: string): Path {
  const headings: Line[] = [];
  const points: Place[] = [];
  const numbers = new Numbers();
  let separator = "";
  let [width, columns]: [number, [Column, Column] | null] = [0, null];
  for (const line of linesOf(text)) {
    if (!columns && /^sep=[;,]?$/i.test(line.text)) {
      separator = line.text[4] ?? "\t"; // a tab at the end of a line is a blank
      continue;
    }
    if (!columns && isHeading(line, separator || separatorOf(line.text.slice(0, longestHeading)))) {
      headings.push(line);
      continue;
    }
    if (!columns) separator ||= separatorOf(line.text);
    const cells = cellsOf(line, separator);
    while (cells.length > Math.max(width, 2) && !cells[cells.length - 1].text) cells.pop();
    if (!columns) {
      width = cells.length;
      columns = columnsOf(headings, separator, width, line);
    }
    if (cells.length !== width) throw new PathError(`${lineOf(line)} has ${cells.length === 1 ? "only one number" : `${cells.length} numbers`} instead of ${width === 2 ? "two" : width}.`, "Each line holds the two coordinates of one point, for example 12.5; 40. If your decimals have commas, divide the columns by semicolons.");
    const [x, y] = columns.map(({ index, factor }) => factor * numbers.read(line, cells[index], index));
    points.push({ x, y });
  }
  if (points.length < 2) {
    const found = points.length ? "There is only one point" : headings.length ? `There are no points: ${lineOf(headings[0])} has no numbers, and none follow` : "There are no points";
    throw new PathError(`${found}.`, "Give at least two lines of two numbers, the path data of an SVG, or an ASCII DXF.");
  }
  return { points, closed: false };
}
