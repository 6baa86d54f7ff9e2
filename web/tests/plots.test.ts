// SPDX-License-Identifier: BSD-3-Clause
import { describe, expect, it } from "vitest";
import type { Scene } from "../src/data";
import { logarithms, logRange, logTicks } from "../src/logarithm";
import { lookOf, mostNamed } from "../src/look";
import { analyse, turnOf } from "../src/motion";
import { sortedRows } from "../src/rows";

const scene = (input: number[]): Scene => ({
  name: "s", title: "", input_key: "crank_angle_rad", input_label: "", input, status: [],
  points: [{ name: "A", x: input.map(Math.cos), y: input.map(Math.sin) }],
  bodies: [], joints: [], traces: [], targets: [], circles: [], vectors: [], moments: [],
});

describe("rows over a turn", () => {
  const angles = Array.from({ length: 361 }, (_, i) => (i * Math.PI) / 180);
  const turn = turnOf(analyse(scene(angles)))!;
  it("stay where they are, from 0 to 360 degrees", () => {
    expect(turn).toEqual({ first: 0, length: 2 * Math.PI });
    const { xs, order } = sortedRows(angles, turn);
    expect(order).toEqual(angles.map((_, i) => i));
    expect(xs).toEqual(angles);
  });
  it("come into it from outside, and the one at its ends is at both", () => {
    const quarter = Math.PI / 2;
    // 90 to 450 degrees in quarters: 360 is also 0, 450 is also 90.
    const { xs, order } = sortedRows([1, 2, 3, 4, 5].map((k) => k * quarter), turn);
    expect(xs[0]).toBe(0);
    expect(xs[xs.length - 1]).toBe(2 * Math.PI);
    expect([order[0], order[order.length - 1]]).toEqual([3, 3]);
    for (const step of xs.slice(1).map((x, i) => x - xs[i])) expect(step).toBeLessThan(quarter + 1e-9);
  });
  it("are counted in the unit of their column", () => {
    const degrees = turnOf(analyse(scene(angles)), Math.PI / 180)!;
    const { xs, order } = sortedRows([30, null, 750], degrees);
    expect(order).toEqual([0, 2]);
    expect(xs[0]).toBeCloseTo(30, 9);
    expect(xs[1]).toBeCloseTo(30, 9);
    // A motion that is no turn is not moved.
    expect(turnOf(analyse(scene([0, 1, 2])))).toBeUndefined();
  });
});

describe("logarithmic axes", () => {
  it("end where values are rounding, however small these are", () => {
    for (const largest of [1, 1e-28, 1e-300, 5e-324, 1e300]) {
      const { lists, clipped } = logarithms([[largest, largest * 1e-10, largest * 1e-20, 0, -largest, null, undefined]]);
      const [top, middle, bottom, ...rest] = lists[0];
      expect(top).toBeCloseTo(Math.log10(largest), 9);
      if (largest > 1e-290) {
        expect(middle).toBeCloseTo(Math.log10(largest) - 10, 9);
        expect(bottom).toBeCloseTo(Math.log10(largest) - 16, 9);
        expect(clipped).toBe(true);
      }
      expect(rest).toEqual([null, null, null, undefined]);
    }
    expect(logarithms([[3, 0]], true).lists[0][1]).toBeCloseTo(Math.log10(3) - 16, 9);
    expect(logarithms([[0, 0]], true).lists).toEqual([[null, null]]);
    expect(logarithms([[1, 1e-15]]).clipped).toBe(false);
  });
  it("have few numbers, and round ones", () => {
    for (const [low, high] of [[-30, 0], [-310, -290], [-2.1, 4], [-3.2, -1.1], [0.1, 1.4], [0.5, 0.6], [-30.001, -30], [2.0000001, 2.0000002], [-0.5, 0.5]]) {
      const places = logTicks(low, high);
      expect(places.length, `${low} to ${high}`).toBeGreaterThan(1);
      expect(places.length, `${low} to ${high}`).toBeLessThan(20);
      places.forEach((v, i) => {
        expect(v).toBeGreaterThanOrEqual(low - 1e-9);
        expect(v).toBeLessThanOrEqual(high + 1e-9);
        if (i) expect(v).toBeGreaterThan(places[i - 1]);
      });
    }
    expect(logTicks(-30, 0)).toEqual([-30, -25, -20, -15, -10, -5, 0]);
    expect(logTicks(0, 1).map((v) => Math.round(10 ** v))).toEqual([1, 2, 5, 10]);
  });
  it("have room for one value and for none", () => {
    expect(logRange(-30, -30)).toEqual([-30.5, -29.5]);
    expect(logRange(null, null)).toEqual([0, 1]);
    expect(logRange(0, 1)).toEqual([-0.06, 1.06]);
  });
});

describe("looks of curves", () => {
  it("are different in colour or dash", () => {
    const looks = Array.from({ length: 36 }, (_, i) => JSON.stringify(lookOf(i)));
    expect(new Set(looks).size).toBe(36);
    expect(mostNamed).toBeLessThanOrEqual(36);
  });
});
