// SPDX-License-Identifier: BSD-3-Clause

// The convex hull: the line of a thread around places in a plane.
import type { Spot } from "./gestures";

const turn = (o: Spot, a: Spot, b: Spot) => (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);

/** Corners of the convex hull of places, in order round it (Andrew's monotone chain); fewer than three places are all of them. */
export function hullOf(places: readonly Spot[]): Spot[] {
  const sorted = [...places].sort((a, b) => a.x - b.x || a.y - b.y);
  if (sorted.length < 3) return sorted;
  const half = (list: Spot[]) => {
    const chain: Spot[] = [];
    for (const p of list) {
      while (chain.length > 1 && turn(chain[chain.length - 2], chain[chain.length - 1], p) <= 0) chain.pop();
      chain.push(p);
    }
    chain.pop();
    return chain;
  };
  return [...half(sorted), ...half(sorted.reverse())];
}
