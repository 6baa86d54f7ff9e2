// SPDX-License-Identifier: BSD-3-Clause
import { expect, test } from "vitest";
import { hullOf } from "../src/hull";

test("the hull has the corners alone, once and in order", () => {
  const square = [{ x: 1, y: 1 }, { x: 0, y: 0 }, { x: 0.5, y: 0.5 }, { x: 1, y: 0 }, { x: 0, y: 1 }, { x: 0.5, y: 0 }, { x: 1, y: 1 }];
  expect(hullOf(square)).toEqual([{ x: 0, y: 0 }, { x: 1, y: 0 }, { x: 1, y: 1 }, { x: 0, y: 1 }]);
});

test("every place is inside, whatever the places are", () => {
  let state = 1;
  const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
  for (let k = 0; k < 50; ++k) {
    const places = Array.from({ length: 3 + Math.floor(40 * random()) }, () => ({ x: random() - 0.5, y: 10 * random() }));
    const hull = hullOf(places);
    expect(hull.length).toBeGreaterThanOrEqual(3);
    for (const p of places)
      hull.forEach((a, i) => {
        const b = hull[(i + 1) % hull.length];
        expect((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)).toBeGreaterThan(-1e-12);
      });
  }
});

test("places on a line, and few places, are no area", () => {
  expect(hullOf([{ x: 2, y: 2 }, { x: 0, y: 0 }, { x: 1, y: 1 }])).toEqual([{ x: 0, y: 0 }, { x: 2, y: 2 }]);
  expect(hullOf([{ x: 2, y: 2 }])).toEqual([{ x: 2, y: 2 }]);
  expect(hullOf([])).toEqual([]);
});
