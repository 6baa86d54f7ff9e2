// SPDX-License-Identifier: BSD-3-Clause

// The log of a study: one entry a seed, read without knowing which optimiser wrote it.
import { isObject, type Json, type JsonObject } from "./data";

export interface Run {
  seed: string;
  status: string;
  evaluations: number | null;
  final: number | null;
  x: number[];
  y: number[];
  counts: "evaluations" | "steps";  // unit of x
}

const costNames = ["best", "error", "cost"];
const historyNames = ["history", "convergence", "trace"];

export function costKey(entry: JsonObject): string | undefined {
  const numeric = Object.keys(entry).filter((key) => typeof entry[key] === "number");
  return (
    costNames.find((name) => numeric.includes(name)) ??
    numeric.find((key) => key.split("_").some((word) => costNames.includes(word)))
  );
}

function history(entry: JsonObject): Pick<Run, "x" | "y" | "counts"> {
  const x: number[] = [];
  const y: number[] = [];
  let counts: Run["counts"] = "steps";
  const list = historyNames.map((name) => entry[name]).find((value): value is Json[] => Array.isArray(value)) ?? [];
  list.forEach((item, i) => {
    if (typeof item === "number") {
      x.push(i + 1);
      y.push(item);
    } else if (isObject(item)) {
      const key = costKey(item);
      if (key === undefined) return;
      const at = item.evaluations;
      if (typeof at === "number") counts = "evaluations";
      x.push(typeof at === "number" ? at : i + 1);
      y.push(item[key] as number);
    }
  });
  return { x, y, counts };
}

export function readLog(log: Json[] | null): Run[] {
  return (Array.isArray(log) ? log : []).filter(isObject).map((entry, i) => {
    const line = history(entry);
    const key = costKey(entry);
    return {
      seed: entry.seed === undefined ? String(i + 1) : String(entry.seed),
      status: typeof entry.status === "string" ? entry.status : "",
      evaluations: typeof entry.evaluations === "number" ? entry.evaluations : null,
      final: key !== undefined ? (entry[key] as number) : line.y.length ? line.y[line.y.length - 1] : null,
      ...line,
    };
  });
}

export interface Dots {
  logarithmic: boolean;
  low: number;
  high: number;
  dots: { index: number; share: number; level: number }[]; // share 0 to 1 along the axis, level = height in the stack
}

/** A dot a seed, stacked where they would cover each other. The axis is logarithmic when values differ more than tenfold. Of a part of the
 *  axis, from one share of its length to another, come the dots that lie on it. */
export function stackDots(values: (number | null)[], bins: number, [from, to]: [number, number] = [0, 1]): Dots {
  const known = values.filter((v): v is number => v !== null);
  let low = Math.min(...known);
  let high = Math.max(...known);
  const logarithmic = low > 0 && high / low > 10;
  // Values that agree to nine digits are one value; the axis then gets a width for the eye.
  if (!(high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high)))) {
    const middle = (low + high) / 2;
    const half = Math.abs(middle) * 0.01 || 1;
    [low, high] = [middle - half, middle + half];
  }
  const [scale, value] = logarithmic ? [Math.log, Math.exp] : [(v: number) => v, (v: number) => v];
  const along = (share: number) => (share === 0 ? low : share === 1 ? high : value(scale(low) + share * (scale(high) - scale(low))));
  [low, high] = [along(from), along(to)];
  const levels = new Map<number, number>();
  const dots: Dots["dots"] = [];
  values.forEach((v, index) => {
    if (v === null) return;
    const bin = Math.round(((scale(v) - scale(low)) / (scale(high) - scale(low))) * bins);
    if (bin < 0 || bin > bins) return;
    const level = levels.get(bin) ?? 0;
    levels.set(bin, level + 1);
    dots.push({ index, share: bin / bins, level });
  });
  return { logarithmic, low, high, dots };
}

/** Equal bins over the values of all lists: middles, and the counts of each list. */
export function histogram(lists: (number | null)[][]): { middles: number[]; counts: number[][] } {
  const known = lists.flat().filter((v): v is number => v !== null);
  if (known.length === 0) return { middles: [], counts: lists.map(() => []) };
  const low = known.reduce((a, b) => Math.min(a, b));
  const high = known.reduce((a, b) => Math.max(a, b));
  const most = lists.reduce((n, list) => Math.max(n, list.filter((v) => v !== null).length), 0);
  const bins = high > low ? Math.max(5, Math.ceil(Math.sqrt(most))) : 1;
  const width = high > low ? (high - low) / bins : 1;
  const counts = lists.map((list) => {
    const own = new Array<number>(bins).fill(0);
    for (const v of list) if (v !== null) own[Math.min(bins - 1, Math.floor((v - low) / width))]++;
    return own;
  });
  return { middles: Array.from({ length: bins }, (_, i) => (high > low ? low + (i + 0.5) * width : low)), counts };
}
