// SPDX-License-Identifier: BSD-3-Clause
import { describe, expect, it } from "vitest";
import type { Scene } from "../src/data";
import { advance, analyse, gaps, inputAt, nearestSample, placeNear, positionOf, positionOfTurn, speeds, step } from "../src/motion";

// A point on the unit circle; samples listed in `missing` do not assemble.
function circle(samples: number, missing: number[] = []): Scene {
  const input = Array.from({ length: samples }, (_, i) => (2 * Math.PI * i) / (samples - 1));
  const at = (f: (a: number) => number) => input.map((a, i) => (missing.includes(i) ? null : f(a)));
  return {
    name: "s", title: "s", input_key: "crank_angle_rad", input_label: "crank angle", input, status: [],
    points: [{ name: "O", x: [0], y: [0] }, { name: "A", x: at(Math.cos), y: at(Math.sin) }],
    bodies: [], joints: [], traces: [], targets: [], circles: [], vectors: [], moments: [],
  };
}

describe("motion", () => {
  it("finds assembled runs and full turns", () => {
    expect(analyse(circle(361)).fullTurn).toBe(true);
    const broken = analyse(circle(361, [100, 101, 102]));
    expect(broken.fullTurn).toBe(false);
    expect(broken.runs).toEqual([[0, 99], [103, 360]]);
  });

  it("takes a mechanism for assembled as its status says, whatever marks have no place", () => {
    const marked = { ...circle(4, [1, 2]), status: ["done", "done", "no_assembly", "done"] };
    expect(analyse(marked).ok).toEqual([true, true, false, true]);
  });

  it("converts inputs and positions both ways, rising and falling", () => {
    const m = analyse(circle(361));
    expect(inputAt(m, positionOf(m, 1.2345))).toBeCloseTo(1.2345, 12);
    expect(positionOf(m, -1)).toBe(0);
    expect(positionOf(m, 100)).toBe(360);
    const falling = { ...m, input: [...m.input].reverse() };
    expect(inputAt(falling, positionOf(falling, 1.2345))).toBeCloseTo(1.2345, 12);
    expect(positionOfTurn(m, 1.2345 + 4 * Math.PI)).toBeCloseTo(positionOf(m, 1.2345), 9);
    expect(positionOfTurn(m, 1.2345 - 2 * Math.PI)).toBeCloseTo(positionOf(m, 1.2345), 9);
  });

  it("draws between samples and stops at missing ones", () => {
    const s = circle(5, [2]);
    expect(placeNear(s, 1, 0.5)).toEqual({ x: expect.closeTo(0.5, 12), y: expect.closeTo(0.5, 12) });
    expect(placeNear(s, 1, 1.4)).toEqual({ x: expect.closeTo(0, 12), y: 1 });
    expect(placeNear(s, 1, 1.6)).toBeNull();
    expect(placeNear(s, 0, 1.6)).toEqual({ x: 0, y: 0 });
  });

  it("goes round a full turn", () => {
    const m = analyse(circle(361));
    expect(advance(m, { position: 0, direction: 1 }, 0.25, false).position).toBeCloseTo(90, 9);
    expect(advance(m, { position: 359, direction: 1 }, 0.25, false).position).toBe(0);
  });

  it("bounces between the ends of the assembled stretch", () => {
    const m = analyse(circle(361, [100]));
    expect(advance(m, { position: 98, direction: 1 }, 0.1, true)).toEqual({ position: 99, direction: -1 });
    expect(advance(m, { position: 2, direction: -1 }, 0.1, true)).toEqual({ position: 0, direction: 1 });
    expect(advance(m, { position: 103, direction: -1 }, 0.1, true)).toEqual({ position: 101, direction: 1 });
  });

  it("leaves out what does not assemble", () => {
    const m = analyse(circle(361, [100, 101, 102]));
    expect(advance(m, { position: 99, direction: 1 }, 2 / 360, false).position).toBe(103);
  });

  it("stands still where nothing assembles", () => {
    const m = analyse(circle(3, [0, 1, 2]));
    expect(advance(m, { position: 1, direction: 1 }, 0.1, true)).toEqual({ position: 1, direction: 1 });
  });

  it("steps by whole samples", () => {
    const m = analyse(circle(361));
    expect(step(m, 10.4, 1)).toBe(11);
    expect(step(m, 10.4, -1)).toBe(10);
    expect(step(m, 0, -1)).toBe(359);
    expect(step(analyse(circle(361, [5])), 360, 1)).toBe(360);
  });

  it("lists gaps as shares of the range", () => {
    expect(gaps(analyse(circle(11)))).toEqual([]);
    const [[a, b]] = gaps(analyse(circle(11, [4, 5])));
    expect(a).toBeCloseTo(0.3, 12);
    expect(b).toBeCloseTo(0.6, 12);
    expect(gaps(analyse(circle(11, [9, 10])))).toHaveLength(1);
    expect(gaps(analyse(circle(11, [0, 1])))).toHaveLength(1);
    expect(gaps(analyse(circle(3, [0, 1, 2])))).toEqual([[0, 1]]);
  });

  it("knows the speed of a point, also across the end of the turn", () => {
    const s = circle(361);
    for (const v of speeds(s, analyse(s), 1)) expect(v).toBeCloseTo(1, 3); // unit circle: one metre a radian
  });

  it("follows a dragged point", () => {
    const s = circle(361);
    expect(nearestSample(s, analyse(s), 1, 350, { x: Math.cos(0.1), y: Math.sin(0.1) })).toBe(6);
  });
});
