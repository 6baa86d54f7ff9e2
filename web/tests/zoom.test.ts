// SPDX-License-Identifier: BSD-3-Clause
import { describe, expect, it } from "vitest";
import { boxWithin } from "../src/gestures";
import { chosen, firstChoice, lookOf } from "../src/look";
import { columnsOf } from "../src/masonry";
import { between, boxAbout, boxed, degreeStep, degreeSteps, nearer, peakOf, shifted } from "../src/zoom";

describe("the part of a diagram that is shown", () => {
  it("keeps the place about which it is zoomed", () => {
    expect(nearer([0, 360], [0, 360], 90, 2)).toEqual([45, 225]);
    expect(nearer([45, 225], [0, 360], 90, 0.5)).toBeNull(); // the whole again
    expect(nearer([300, 360], [0, 360], 360, 0.5)).toEqual([240, 360]);
  });
  it("keeps the proportions of a map", () => {
    const whole = { left: 0, right: 400, bottom: 0, top: 200 };
    expect(boxAbout({ left: 100, right: 140, bottom: 50, top: 90 }, whole)).toEqual({ x: [80, 160], y: [50, 90] });
    expect(boxAbout({ left: 0, right: 40, bottom: 180, top: 200 }, whole)).toEqual({ x: [0, 40], y: [180, 200] });
    expect(boxAbout({ left: 10, right: 20, bottom: 0, top: 200 }, whole)).toEqual({ x: null, y: null });
  });
  it("stays inside of the whole and does not become nothing", () => {
    expect(shifted([0, 90], [0, 360], -0.5)).toEqual([0, 90]);
    expect(shifted([0, 90], [0, 360], 0.5)).toEqual([45, 135]);
    expect(shifted([300, 350], [0, 360], 1)).toEqual([310, 360]);
    expect(between(200, 100, [0, 360])).toEqual([100, 200]);
    expect(between(0, 360, [0, 360])).toBeNull();
    const [low, high] = between(5, 5, [0, 10])!;
    expect(high - low).toBeGreaterThan(0);
    expect((low + high) / 2).toBeCloseTo(5, 6);
  });
  it("is chosen by a box, or along one axis when the box is flat", () => {
    expect(boxed(100, 5)).toEqual({ x: true, y: false });
    expect(boxed(-4, 80)).toEqual({ x: false, y: true });
    expect(boxed(-60, 40)).toEqual({ x: true, y: true });
    expect(boxWithin({ x: 80, y: 20 }, { x: 30, y: 22 }, 200, 100)).toMatchObject({ left: 30, right: 80, top: 0, bottom: 100 });
    expect(boxWithin({ x: 80, y: 20 }, { x: 300, y: 90 }, 200, 100)).toMatchObject({ left: 80, right: 200, top: 20, bottom: 90 });
  });
});

describe("peaks", () => {
  const wave = Array.from({ length: 400 }, (_, i) => 10 * Math.sin(i / 7));
  it("are left out when they are rare and far away", () => {
    const values = [...wave];
    values[123] = -1241;
    const peak = peakOf([wave, values])!;
    expect([peak.value, peak.list, peak.row]).toEqual([-1241, 1, 123]);
    expect(peak.low).toBeCloseTo(-10, 1);
    expect(peak.high).toBeCloseTo(10, 1);
  });
  it("are no peaks when they are near, many, or all there is", () => {
    expect(peakOf([wave])).toBeNull();
    expect(peakOf([wave.map((v, i) => (i === 5 ? 70 : v))])).toBeNull();
    expect(peakOf([wave.map((v, i) => (i % 20 === 0 ? 1000 : v))])).toBeNull();
    expect(peakOf([wave.map((_, i) => (i === 5 ? 1000 : 1e-9))])).toBeNull();
    expect(peakOf([[null, undefined, 1, 1000]])).toBeNull();
  });
});

describe("steps of angles", () => {
  it("are parts of a turn", () => {
    expect([360 / 7, 40, 20, 12, 8, 3, 0.3].map(degreeStep)).toEqual([90, 45, 30, 15, 10, 5, 0.5]);
    degreeSteps.slice(1).forEach((step, i) => expect(step).toBeGreaterThan(degreeSteps[i]));
  });
});

describe("a choice of curves", () => {
  it("begins with all of few, the first six of many, and none of a family", () => {
    expect([...firstChoice(6, true).keys()]).toEqual([0, 1, 2, 3, 4, 5]);
    expect([...firstChoice(9, false).keys()]).toEqual([0, 1, 2, 3, 4, 5]);
    expect(firstChoice(9, true).size).toBe(0);
  });
  it("gives a new one the first look that is free", () => {
    const without = chosen(firstChoice(9, false), 2, false);
    expect(without.has(2)).toBe(false);
    const after = chosen(without, 8, true);
    expect(after.get(8)).toBe(2);
    expect(after.get(3)).toBe(3);
    const looks = [...chosen(after, 7, true).values()].map((k) => JSON.stringify(lookOf(k)));
    expect(new Set(looks).size).toBe(7);
  });
});

describe("cards in columns", () => {
  const cards = (...heights: number[]) => heights.map((height) => ({ height, wide: false }));
  it("stand row by row when they are alike", () => {
    expect(columnsOf(cards(300, 310, 305, 300), 2)).toEqual([0, 1, 0, 1]);
  });
  it("follow the shortest column", () => {
    expect(columnsOf(cards(300, 600, 300, 300, 300), 2)).toEqual([0, 1, 0, 0, 1]);
    expect(columnsOf(cards(300, 600), 1)).toEqual([0, 0]);
  });
  it("begin anew below one that is as wide as all", () => {
    expect(columnsOf([...cards(300), { height: 500, wide: true }, ...cards(300, 300)], 2)).toEqual([0, -1, 0, 1]);
  });
});
