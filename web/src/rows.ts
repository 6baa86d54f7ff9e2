// Rows of tables as plots need them.
import type { Num } from "./data";

/** Rows with an x in rising order, as plots want them; `map` may move an x, for example into one turn. */
export function sortedRows(xs: Num[], map: (x: number) => number = (x) => x): { xs: number[]; order: number[] } {
  const rows = xs.flatMap((x, row) => (x === null ? [] : [{ x: map(x), row }]));
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
