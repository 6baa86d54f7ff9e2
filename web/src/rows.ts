// SPDX-License-Identifier: BSD-3-Clause

// Rows of tables as plots need them.
import type { Num } from "./data";

/** One turn of an input: where it begins and how long it is, in the unit of the column. */
export interface Turn {
  first: number;
  length: number;
}

const near = 1e-6;  // share of a turn: rows this close to its ends are there

/** Rows with an x in rising order, as plots want them. Those outside of the turn, if one is given, come into it; a row at its ends
 *  then stands at both, so that curves go from the one to the other. What lies within the turn stays where it is. */
export function sortedRows(xs: Num[], turn?: Turn): { xs: number[]; order: number[] } {
  const known = xs.flatMap((x, row) => (x === null ? [] : [{ x, row }]));
  const share = (x: number) => (x - turn!.first) / turn!.length;
  const outside = turn !== undefined && known.some(({ x }) => share(x) < -near || share(x) > 1 + near);
  const rows = !outside ? known : known.flatMap(({ x, row }) => {
    const s = share(x) - Math.floor(share(x));
    const ends = s < near || s > 1 - near ? [0, 1] : [s];
    return ends.map((at) => ({ x: turn.first + at * turn.length, row }));
  });
  rows.sort((a, b) => a.x - b.x);
  return { xs: rows.map((r) => r.x), order: rows.map((r) => r.row) };
}

/** Index of the value nearest to x in a rising list; -1 when it is empty. */
export function nearestRow(xs: ArrayLike<number>, x: number): number {
  let low = 0;
  let high = xs.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (xs[middle] <= x) low = middle;
    else high = middle;
  }
  return high > low && xs[high] - x < x - xs[low] ? high : low > high ? -1 : low;
}
