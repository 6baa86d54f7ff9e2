// SPDX-License-Identifier: BSD-3-Clause
import { expect, test } from "vitest";
import { boxOf, byHand, lengthOf, mostPoints, prepared, smoothed, studyOf } from "../src/workbench/path";
import { svgPath } from "../src/workbench/path_svg";
import { readPath } from "../src/workbench/path_text";
import { refusal, rounded } from "./path_checks";

const last = (d: string) => rounded(svgPath(d).points).pop();

test("lines of SVG, absolute and relative, with the y axis upwards", () => {
  const square = [[1, -1], [5, -1], [5, -4], [1, -4]];
  for (const d of ["M1 1 L5 1 L5 4 L1 4 Z", "m1,1 4,0 0,3 -4,0z", "M1 1H5V4H1Z", "M1 1h4v3h-4z", "M1 1 5 1 5 4 1 4z", "M1 1L5,1 5,4l-4 0z"])
    expect(svgPath(d), d).toEqual({ points: square.map(([x, y]) => ({ x, y })), closed: true });
  expect(svgPath("M0 0L1.5.5").points).toEqual([{ x: 0, y: 0 }, { x: 1.5, y: -0.5 }]);
  expect(svgPath("M0 0L1e1-2E-1").points[1]).toEqual({ x: 10, y: 0.2 });
  expect(svgPath("M0 0L4 0").closed).toBe(false);
});

test("curves of Bézier pass through the places of their formula", () => {
  const { points } = svgPath("M0 0C0 6 6 6 6 0");
  expect(points).toHaveLength(25);
  expect(rounded(points)[12]).toEqual([3, -4.5]); // (P0 + 3 P1 + 3 P2 + P3) / 8
  expect(rounded(svgPath("M0 0Q4 8 8 0").points)[12]).toEqual([4, -4]); // (P0 + 2 P1 + P2) / 4
  expect(svgPath("M1 1c0 6 6 6 6 0").points[12]).toEqual({ x: 4, y: -5.5 });
  expect(rounded(svgPath("m1 1q4 8 8 0").points)[12]).toEqual([5, -5]);
});

test("S and T mirror the last control point of their own kind", () => {
  const whole = svgPath("M0 0C0 6 6 6 6 0C6 -6 12 -6 12 0").points;
  expect(svgPath("M0 0C0 6 6 6 6 0S12 -6 12 0").points).toEqual(whole);
  expect(svgPath("M0 0c0 6 6 6 6 0s6 -6 6 0").points).toEqual(whole);
  expect(svgPath("M0 0Q2 4 4 0T8 0").points).toEqual(svgPath("M0 0Q2 4 4 0Q6 -4 8 0").points);
  expect(svgPath("M0 0q2 4 4 0t4 0").points).toEqual(svgPath("M0 0Q2 4 4 0Q6 -4 8 0").points);
  // After another command the control point is the present place.
  expect(svgPath("M0 0L4 0S8 4 8 0").points).toEqual(svgPath("M0 0L4 0C4 0 8 4 8 0").points);
  expect(rounded(svgPath("M0 0L4 0T8 0").points).pop()).toEqual([8, 0]);
});

test("arcs go the way of their flags, and small radii grow", () => {
  // With the sweep flag the angle grows in a plane whose y axis points down.
  for (const [flags, y] of [["0 0", -5], ["0 1", 5]] as const) expect(rounded(svgPath(`M-5 0A5 5 0 ${flags} 5 0`).points)[12], flags).toEqual([0, y]);
  for (const p of svgPath("M3 0A3 3 0 1 0 0 3").points) expect(Math.hypot(p.x, p.y)).toBeLessThan(9);
  expect(rounded(svgPath("M0 0a1 1 0 0110 0").points)[12]).toEqual([5, 5]); // flags that touch, and a radius of 5
  const turned = svgPath("M0 -4A2 4 90 0 1 0 4").points;
  expect(Math.max(...turned.map((p) => Math.abs(p.x)))).toBeCloseTo(8, 6);
  expect(last("M0 0A0 3 0 0 1 4 4")).toEqual([4, -4]);
});

test("a large arc is the longer one", () => {
  const long = (d: string) => lengthOf(svgPath(d));
  expect(long("M3 0A3 3 0 0 1 0 3")).toBeCloseTo((3 * Math.PI) / 2, 2);
  expect(long("M3 0A3 3 0 1 1 0 3")).toBeCloseTo((9 * Math.PI) / 2, 1);
});

test("path data that are wrong are refused with the way out", () => {
  expect(refusal(() => svgPath("L0 0"))).toMatch(/do not begin with M/);
  expect(refusal(() => svgPath("M0 0K4 4"))).toMatch(/no path command K/);
  expect(refusal(() => svgPath("M0 0L4"))).toMatch(/command L has 1 number; it takes 2/);
  expect(refusal(() => svgPath("M0 0A1 1 0 2 0 4 4"))).toMatch(/flag \(0 or 1\)/);
  expect(refusal(() => svgPath("M0 0L3 4M5 5L6 5"))).toMatch(/2 separate lines: part 1 \(5 mm long\), part 2 \(1 mm long\)/);
  expect(refusal(() => svgPath("M0 0L4 4 4 0ZL6 6"))).toMatch(/2 separate lines/);
  expect(refusal(() => svgPath("M3 3Z"))).toMatch(/at the same place/);
  expect(refusal(() => svgPath("M0 0L1e999 4"))).toMatch(/1e999 after the command L is too large/);
  expect(refusal(() => svgPath("M0 0L4 4Z5"))).toMatch(/follow the command Z/);
  expect(refusal(() => svgPath("M0 0L4 #"))).toMatch(/“#” after the command L/);
});

test("the form of a text is recognised", () => {
  expect(readPath("M0 0 L40 0 L40 30 Z").closed).toBe(true);
  expect(readPath('<?xml version="1.0"?><svg><path d="M0 0L40 0"/></svg>').closed).toBe(false);
  expect(readPath("0\nLINE\n10\n0\n20\n0\n11\n9\n21\n0\n").points.length).toBe(121);
  expect(readPath("0;0\n4;0\n4;3\n0;0")).toMatchObject({ closed: true });
  expect(readPath("\ufeff\ufeff1 1\n2 2").closed).toBe(false);
  expect(refusal(() => readPath("5 5\n5 5"))).toMatch(/same place/);
  for (const text of ["", " \n\t\n", "\ufeff"]) expect(refusal(() => readPath(text))).toMatch(/is empty/);
  expect(refusal(() => readPath("1;2\0\n3;4"))).toMatch(/zero bytes/);
});

test("a path that is read keeps its corners and has points between them", () => {
  const square = prepared({ points: [{ x: 0, y: 0 }, { x: 40, y: 0 }, { x: 40, y: 20 }, { x: 0, y: 20 }], closed: true });
  for (const corner of [[0, 0], [40, 0], [40, 20], [0, 20]]) expect(rounded(square.points)).toContainEqual(corner);
  expect(square.points).toHaveLength(120);
  const many = prepared({ points: Array.from({ length: 5000 }, (_, k) => ({ x: 50 * Math.cos(k / 800), y: 50 * Math.sin(k / 800) })), closed: false });
  expect(many.points).toHaveLength(mostPoints);
});

test("paths that are too large or too small for a machine are refused", () => {
  for (const text of ["-1e308;0\n1e308;0", "1e13;0\n0;0", "M0 0L2e12 4"]) expect(refusal(() => readPath(text)), text).toMatch(/more than 1e9 m from the origin/);
  for (const text of ["0;0\n1e-320;0", "0;0\n1e-7;0"]) expect(refusal(() => readPath(text)), text).toMatch(/smaller than a nanometre/);
  expect(readPath("-1e12;0\n1e12;0").points).toHaveLength(121);
  expect(readPath("0;0\n1e-6;0").points).toHaveLength(121);
});

test("a stroke that comes back is closed, and has points at equal steps", () => {
  const circle = (turn: number) => Array.from({ length: 90 }, (_, k) => ({ x: 50 * Math.cos((turn * k) / 89), y: 50 * Math.sin((turn * k) / 89) }));
  const ring = byHand(circle(2 * Math.PI - 0.05), 6)!;
  expect(ring.closed).toBe(true);
  const steps = ring.points.map((p, i, all) => Math.hypot(p.x - all[(i + 1) % all.length].x, p.y - all[(i + 1) % all.length].y));
  expect(Math.max(...steps) / Math.min(...steps)).toBeLessThan(1.05);
  // What goes beyond the beginning is left out.
  expect(lengthOf(byHand(circle(2 * Math.PI + 0.08), 6)!)).toBeCloseTo(100 * Math.PI, -0.5);
  expect(byHand(circle(5), 6)!.closed).toBe(false);
  expect(byHand([{ x: 0, y: 0 }, { x: 1, y: 0 }], 6)).toBeNull();
  expect(byHand(circle(5), 6)!.points.length).toBeLessThanOrEqual(mostPoints);
});

test("smoothing is for the eye: it begins and ends where the path does", () => {
  const open = { points: [{ x: 0, y: 0 }, { x: 4, y: 4 }, { x: 8, y: 0 }], closed: false };
  expect(smoothed(open)).toBe("M0.00 0.00Q4.00 -4.00 8.00 0.00L8.00 0.00".replaceAll("-0.00", "0.00"));
  expect(smoothed({ ...open, closed: true })).toMatch(/^M4\.00 -?0\.00Q.*Z$/);
});

test("the study holds the path in mm and what is wished", () => {
  const text = studyOf(prepared({ points: [{ x: 0, y: 0 }, { x: 40, y: 0 }, { x: 40, y: 30 }], closed: true }), { mostLinks: 6, leastPairAngle: 25, longestLink: 4, rocks: true }, 0.7);
  for (const line of ['type       = "planar.any"', "most_links = 6", "closed    = true", "least_pair_angle_deg = 25", "longest_link         = 4", "seconds       = 0.7"]) expect(text).toContain(line);
  expect(text).not.toContain("crank_turns"); // a closed path has no ends to turn back at
  expect(studyOf(prepared({ points: [{ x: 0, y: 0 }, { x: 40, y: 0 }, { x: 40, y: 30 }], closed: false }), { mostLinks: 6, leastPairAngle: 25, longestLink: 4, rocks: true }, 0.7)).toContain("crank_turns          = false");
  expect(text.match(/\[-?[\d.]+, -?[\d.]+\]/g)!.length).toBe(120);
  expect(boxOf([{ x: 1, y: 2 }, { x: 4, y: 8 }])).toEqual({ x: 1, y: 2, width: 3, height: 6 });
});
