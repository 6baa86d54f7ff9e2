// SPDX-License-Identifier: BSD-3-Clause

// Maps: places of a regular grid coloured by a value, one map for each value of the group column.
import type { Num, Plot, Table } from "./data";
import { groupsOf } from "./groups";
import { labelWith, unitOf, type Unit } from "./units";

/** Classes of colour, as in the printed form (colour_scale.h): even steps from dark blue to light yellow that grow lighter all the way. */
export const classes = 24;
const anchors = [[46, 27, 103], [32, 60, 129], [16, 91, 136], [26, 119, 142], [35, 147, 148], [60, 175, 145], [111, 199, 129], [176, 218, 103], [246, 229, 79]];

export function classColour(k: number): string {
  const at = ((k + 0.5) / classes) * (anchors.length - 1);
  const i = Math.min(anchors.length - 2, Math.floor(at));
  return `#${anchors[i].map((c, n) => Math.round(c + (anchors[i + 1][n] - c) * (at - i)).toString(16).padStart(2, "0")).join("")}`;
}

/** Class of a value from low to high; the last whenever the two are the same. */
export const classOf = (value: number, low: number, high: number): number =>
  high > low ? Math.min(classes - 1, Math.floor(Math.min(1, Math.max(0, (value - low) / (high - low))) * classes)) : classes - 1;

/** One coordinate of the grid, in the unit in which it is shown. */
export interface Axis {
  low: number;
  high: number;
  pitch: number; // 0 = all places are the same
}

export const sizeOf = (a: Axis) => a.high - a.low + a.pitch;
export const indexOf = (a: Axis, value: number) => Math.round((value - a.low) / a.pitch);
export const countOf = (a: Axis) => indexOf(a, a.high) + 1;
/** Coordinate of a column or row of places; 0 is not missed by rounding. */
export function at(a: Axis, index: number): number {
  const value = a.low + index * a.pitch;
  return Math.abs(value) < 1e-6 * a.pitch ? 0 : value;
}

/** Smallest distance of two values that are not the same up to rounding. */
function axisOf(values: number[]): Axis {
  const sorted = [...values].sort((a, b) => a - b);
  const [low, high] = [sorted[0], sorted[sorted.length - 1]];
  const least = 1e-6 * (high - low);
  const pitch = sorted.reduce((best, v, i) => (i > 0 && v - sorted[i - 1] > least ? Math.min(best, v - sorted[i - 1]) : best), Infinity);
  return { low, high, pitch: pitch === Infinity ? 0 : pitch };
}

export interface Cell {
  i: number;
  j: number;
  value: Num; // null = looked at, but there is no value
}

export interface Level {
  label: string;
  cells: Cell[]; // row by row
  find: (i: number, j: number) => Cell | undefined;
}

export interface Maps {
  x: Axis;
  y: Axis;
  unit: Unit;  // unit of both coordinates
  xLabel: string;
  yLabel: string;
  valueUnit: Unit;
  valueLabel: string;
  levels: Level[];
  low: number;
  high: number;
  missing: boolean;  // true if a place has no value
  logarithmic: boolean; // low and high are logarithms then, values are not
}

/** The maps of a diagram; null when no place has a value. */
export function mapsOf(plot: Plot, table: Table): Maps | null {
  const [x, y, v] = [plot.x, plot.y[0], plot.y[1]].map((key) => table.columns.findIndex((c) => c.key === key));
  if (x < 0 || y < 0 || v < 0) return null;
  const [xs, ys, values] = [table.data[x], table.data[y], table.data[v]];
  const rows = xs.flatMap((_, row) => (xs[row] !== null && ys[row] != null ? [row] : []));
  if (rows.length === 0) return null;
  const most = (list: Num[]) => list.reduce<number>((a, n) => Math.max(a, Math.abs(n ?? 0)), 0);
  const unit = unitOf(plot.x, Math.max(most(xs), most(ys)));
  const valueUnit = unitOf(plot.y[1], most(values));
  const [xAxis, yAxis] = [xs, ys].map((list) => axisOf(rows.map((row) => list[row]! * unit.factor)));
  // A single line of places has square cells; a single place, one of some size.
  const some = Math.max(xAxis.pitch, yAxis.pitch) || Math.max(Math.abs(xAxis.low), Math.abs(yAxis.low), 1e-3) / 10;
  for (const axis of [xAxis, yAxis]) axis.pitch ||= some;
  const log = plot.logarithmic_y;
  const stands = new Set(rows);
  const levels = groupsOf(plot, table).map(({ label, rows }) => {
    const found = new Map<string, Cell>();
    for (const row of rows) {
      if (!stands.has(row)) continue;
      const [i, j] = [indexOf(xAxis, xs[row]! * unit.factor), indexOf(yAxis, ys[row]! * unit.factor)];
      const value = values[row] ?? null;
      found.set(`${i} ${j}`, { i, j, value: value === null || (log && value <= 0) ? null : value * valueUnit.factor });
    }
    const cells = [...found.values()].sort((a, b) => a.j - b.j || a.i - b.i);
    return { label, cells, find: (i: number, j: number) => found.get(`${i} ${j}`) };
  });
  const maps = {
    x: xAxis, y: yAxis, unit, valueUnit, levels, logarithmic: log, low: Infinity, high: -Infinity, missing: false,
    xLabel: labelWith(table.columns[x].label, plot.x, unit), yLabel: labelWith(table.columns[y].label, plot.y[0], unit),
    valueLabel: labelWith(table.columns[v].label, plot.y[1], valueUnit),
  };
  for (const { cells } of levels)
    for (const { value } of cells) {
      if (value === null) {
        maps.missing = true;
        continue;
      }
      const scaled = scaledOf(maps, value);
      maps.low = Math.min(maps.low, scaled);
      maps.high = Math.max(maps.high, scaled);
    }
  return maps.low <= maps.high ? maps : null;
}

/** A value as the scale of colours counts. */
export const scaledOf = (maps: { logarithmic: boolean }, value: number) => (maps.logarithmic ? Math.log10(value) : value);

/** Path data for each class, places without a value last; cells of a class side by side are one rectangle. In pixels from the upper left corner. */
export function pathsOf(maps: Maps, { cells }: Level, scale: number): string[] {
  const paths: string[] = Array.from({ length: classes + 1 }, () => "");
  const look = (c: Cell) => (c.value === null ? classes : classOf(scaledOf(maps, c.value), maps.low, maps.high));
  const [w, h] = [maps.x.pitch * scale, maps.y.pitch * scale];
  const bottom = sizeOf(maps.y) * scale;
  for (let k = 0; k < cells.length; ++k) {
    const first = cells[k];
    const colour = look(first);
    while (k + 1 < cells.length && cells[k + 1].j === first.j && cells[k + 1].i === cells[k].i + 1 && look(cells[k + 1]) === colour) ++k;
    const [from, to] = [(first.i * w).toFixed(2), ((cells[k].i + 1) * w).toFixed(2)];
    paths[colour] += `M${from} ${(bottom - first.j * h).toFixed(2)}H${to}v${(-h).toFixed(2)}H${from}z`;
  }
  return paths;
}
