// SPDX-License-Identifier: BSD-3-Clause
import { expect, test } from "vitest";
import type { Scene } from "../src/data";
import { pathOf, small, thinned, thumbnail } from "../src/workbench/thumbnail";

test("a line keeps what is seen of it", () => {
  const arc = Array.from({ length: 361 }, (_, i) => ({ x: 100 * Math.cos((i * Math.PI) / 180), y: 100 * Math.sin((i * Math.PI) / 180) }));
  const few = thinned(arc, 0.5);
  expect(few.length).toBeGreaterThan(16);
  expect(few.length).toBeLessThan(60);
  for (const p of few) expect(Math.hypot(p.x, p.y)).toBeCloseTo(100, 9);
  expect(thinned(Array.from({ length: 50 }, (_, i) => ({ x: i, y: 2 * i })), 0.5)).toEqual([{ x: 0, y: 0 }, { x: 49, y: 98 }]);
});

test("a path is written in whole pixels, from point to point", () => {
  expect(pathOf([{ x: 1.2, y: 2 }, { x: 11, y: -3.6 }, { x: 11.2, y: 30 }], true)).toBe("M1 2l10-6 0 34z");
  expect(pathOf([{ x: 1, y: 2 }, null, null, { x: 3, y: 4 }, { x: 9, y: 4 }], true)).toBe("M1 2h0M3 4l6 0");
  expect(pathOf([null, null])).toBe("");
});

const bar: Scene = {
  name: "bar", title: "", input_key: "crank_rad", input_label: "", input: [0, 1, 2], status: [],
  points: [{ name: "O", x: [0], y: [0] }, { name: "A", x: [1, 0, -1], y: [0, 1, 0] }],
  bodies: [{ name: "ground", points: [0], style: "ground" }, { name: "crank", points: [0, 1], style: "bar" }],
  joints: [{ name: "O", point: 0, style: "ground_pivot" }, { name: "A", point: 1, style: "tracer" }],
  traces: [{ point: 1, name: "A", closed: false }], targets: [], circles: [], vectors: [], moments: [],
};

test("a picture has the path, one pose and the joints, within its frame", () => {
  const drawn = thumbnail(bar, small);
  expect(drawn.match(/<path /g)).toHaveLength(2);
  expect(drawn).toContain('class="stroke" stroke="var(--c0)"');
  expect(drawn.match(/<circle /g)).toHaveLength(2);
  for (const [, x, y] of drawn.matchAll(/cx="(\d+)" cy="(\d+)"/g)) {
    expect(Number(x)).toBeLessThanOrEqual(small.width);
    expect(Number(y)).toBeLessThanOrEqual(small.height);
  }
  expect(thumbnail({ ...bar, points: [], bodies: [], joints: [], traces: [] }, small)).toBe("");
});
