// SPDX-License-Identifier: BSD-3-Clause

// Logarithmic axes: diagrams draw decimal logarithms on an even scale, so that numbers may be as small as they like.
import type { Num } from "./data";
import { niceStep, ticks } from "./view";

/** Values below this share of the largest are zero up to rounding. */
export const rounding = 1e-16;

export interface Logarithms {
  lists: (Num | undefined)[][];
  clipped: boolean;  // true if a value was raised to the lower edge
}

/** Decimal logarithms of the values, none below that of `rounding` times the largest of all; zero is such a value when `zero` says so, or else missing as negative ones are. */
export function logarithms(lists: (Num | undefined)[][], zero = false): Logarithms {
  const largest = lists.reduce((most, list) => list.reduce<number>((a, v) => Math.max(a, v ?? 0), most), 0);
  // A product of the smallest numbers would be zero.
  const floor = Math.log10(largest) + Math.log10(rounding);
  let clipped = false;
  const raised = (v: Num | undefined) => {
    if (v === undefined) return undefined;
    if (v === null || v < 0 || (v === 0 && !(zero && largest > 0))) return null;
    const power = Math.log10(v);
    if (power >= floor) return power;
    clipped = true;
    return floor;
  };
  return { lists: lists.map((list) => list.map(raised)), clipped };
}

/** Range of an axis of logarithms with some room; at least a decade for values that are one. */
export function logRange(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 1];
  const room = high - low > 1e-9 ? 0.06 * (high - low) : 0.5;
  return [low - room, high + room];
}

/** Places of the numbers on an axis of logarithms: whole decades, or round numbers when there are few of these. */
export function logTicks(low: number, high: number): number[] {
  const most = 7;
  if (high - low >= 2) return ticks(low, high, Math.max(1, Math.ceil((high - low) / most)));
  const decades = ticks(Math.floor(low), high, 1);
  for (const mantissas of [[1, 2, 5], [1, 2, 3, 4, 5, 6, 7, 8, 9]]) {
    const found = decades.flatMap((d) => mantissas.map((m) => d + Math.log10(m))).filter((v) => v >= low && v <= high);
    if (found.length > 2) return found;
  }
  const [from, to] = [1, 10 ** (high - low)];  // relative to the lowest, so that neither is too small
  const scale = 10 ** (low - Math.floor(low));
  return ticks(from * scale, to * scale, niceStep(((to - from) * scale) / 4)).map((v) => Math.floor(low) + Math.log10(v));
}
