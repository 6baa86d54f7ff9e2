// SPDX-License-Identifier: BSD-3-Clause
import { expect, test } from "vitest";
import { boxOf, lengthOf } from "../src/workbench/path";
import { dxfPath } from "../src/workbench/path_dxf";
import { refusal, rounded } from "./path_checks";

const group = (...values: (string | number)[]) => values.map((v) => `${v}\n`).join("");
const drawing = (entities: string, header = "") => `0\nSECTION\n2\nHEADER\n${header}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n${entities}0\nENDSEC\n0\nEOF\n`;
const read = (...values: (string | number)[]) => dxfPath(drawing(group(...values)));
const line = (...n: number[]) => group(0, "LINE", 8, 0, 10, n[0], 20, n[1], 11, n[2], 21, n[3]);
const polyline = group(0, "LWPOLYLINE", 90, 3, 70, 1, 10, 0, 20, 0, 10, 4, 20, 0, 10, 4, 20, 3);

test("polylines, light and old, are open or closed", () => {
  expect(dxfPath(drawing(polyline))).toEqual({ points: [{ x: 0, y: 0 }, { x: 4, y: 0 }, { x: 4, y: 3 }], closed: true });
  const old = ["POLYLINE", 66, 1, 70, 0, 10, 0, 20, 0, 30, 7, 0, "VERTEX", 10, 0, 20, 0, 30, 7, 0, "VERTEX", 10, 4, 20, 3, 30, 7, 0, "SEQEND"];
  expect(read(0, ...old)).toEqual({ points: [{ x: 0, y: 0 }, { x: 4, y: 3 }], closed: false });
  // The frame of a fitted spline is not on the curve.
  expect(read(0, "POLYLINE", 70, 4, 0, "VERTEX", 70, 16, 10, 9, 20, 9, 0, "VERTEX", 70, 8, 10, 0, 20, 0, 0, "VERTEX", 70, 8, 10, 4, 20, 3, 0, "SEQEND").points).toHaveLength(2);
});

test("a bulge is the tangent of a quarter of the angle of its arc", () => {
  const half = read(0, "LWPOLYLINE", 70, 0, 10, -2, 20, 0, 42, 1, 10, 2, 20, 0).points; // to the right of the chord, counterclockwise
  expect(half).toHaveLength(49);
  expect(rounded(half)[24]).toEqual([0, -2]);
  expect(rounded(read(0, "LWPOLYLINE", 10, -2, 20, 0, 42, -1, 10, 2, 20, 0).points)[24]).toEqual([0, 2]);
  const quarter = read(0, "LWPOLYLINE", 10, 2, 20, 0, 42, Math.tan(Math.PI / 8), 10, 0, 20, 2).points;
  for (const p of quarter) expect(Math.hypot(p.x, p.y)).toBeCloseTo(2, 9);
  const circle = read(0, "LWPOLYLINE", 70, 1, 10, -2, 20, 0, 42, 1, 10, 2, 20, 0, 42, 1);
  expect(circle.closed).toBe(true);
  expect(lengthOf(circle)).toBeCloseTo(4 * Math.PI, 2);
});

test("$INSUNITS gives the unit; a drawing without one is in mm", () => {
  for (const [unit, x] of [[0, 4], [1, 101.6], [2, 1219.2], [4, 4], [5, 40], [6, 4000], [13, 0.004]]) expect(dxfPath(drawing(polyline, group(9, "$INSUNITS", 70, unit))).points[1].x, `${unit}`).toBeCloseTo(x, 9);
  expect(refusal(() => dxfPath(drawing(polyline, group(9, "$INSUNITS", 70, 19))))).toMatch(/Line 8 of the DXF file has the unit \$INSUNITS “19”/);
});

test("lines are joined to a chain whatever their order and direction", () => {
  const chain = dxfPath(drawing(line(4, 0, 0, 0) + line(4, 3, 0, 3) + line(4, 0, 4, 3)));
  expect(chain.closed).toBe(false);
  expect(chain.points).toHaveLength(4);
  expect(lengthOf(chain)).toBe(11);
  const ring = dxfPath(drawing(line(4, 0, 0, 0) + line(4, 3, 0, 3) + line(4, 0, 4, 3) + line(0, 3, 0, 0)));
  expect(ring.closed).toBe(true);
  expect(lengthOf(ring)).toBe(14);
  expect(refusal(() => dxfPath(drawing(line(0, 0, 1, 0) + line(5, 5, 6, 5))))).toBe("The DXF drawing has 2 separate lines: LINE in line 12 (1 mm long), LINE in line 24 (1 mm long); a traced point can follow only one.");
});

test("arcs run counterclockwise, and join lines to an outline", () => {
  const arc = read(0, "ARC", 10, 1, 20, 2, 40, 5, 50, 270, 51, 90).points;
  expect([rounded(arc)[0], rounded(arc)[24], rounded(arc)[48]]).toEqual([[1, -3], [6, 2], [1, 7]]);
  // A slot: two half circles of radius 2, and two lines of 10.
  const slot = dxfPath(drawing(line(0, 2, 10, 2) + group(0, "ARC", 10, 10, 20, 0, 40, 2, 50, 270, 51, 90) + line(0, -2, 10, -2) + group(0, "ARC", 10, 0, 20, 0, 40, 2, 50, 90, 51, 270)));
  expect(slot.closed).toBe(true);
  expect(lengthOf(slot)).toBeCloseTo(20 + 4 * Math.PI, 2);
  expect(boxOf(slot.points)).toMatchObject({ x: expect.closeTo(-2, 9), width: expect.closeTo(14, 9), height: expect.closeTo(4, 9) });
  expect(read(0, "ARC", 10, 0, 20, 0, 40, 5, 50, 0, 51, 360).closed).toBe(true);
});

test("circles and ellipses are closed; an ellipse has a range of its parameter", () => {
  const circle = read(0, "CIRCLE", 10, 1, 20, 2, 40, 5);
  expect(circle.closed).toBe(true);
  for (const p of circle.points) expect(Math.hypot(p.x - 1, p.y - 2)).toBeCloseTo(5, 9);
  const turned = [0, "ELLIPSE", 10, 1, 20, 2, 11, 0, 21, 4, 40, 0.5]; // its long axis is along y
  for (const end of [[], [41, 0, 42, 2 * Math.PI], [41, 0, 42, 6.2832], [41, 0, 42, 6.28318]]) {
    const whole = read(...turned, ...end);
    expect(whole.closed).toBe(true);
    expect(whole.points).toHaveLength(96);
    for (const p of whole.points) expect(((p.x - 1) / 2) ** 2 + ((p.y - 2) / 4) ** 2).toBeCloseTo(1, 9);
  }
  const quarter = rounded(read(...turned, 41, 0, 42, Math.PI / 2).points);
  expect([quarter[0], quarter[quarter.length - 1]]).toEqual([[1, 6], [-1, 2]]);
});

test("entities that are seen from below are mirrored", () => {
  const below = [210, 0, 220, 0, 230, -1];
  expect(rounded(read(0, "LWPOLYLINE", 10, 1, 20, 2, 10, 4, 20, 6, ...below).points)).toEqual([[-1, 2], [-4, 6]]);
  const arc = rounded(read(0, "ARC", 10, 1, 20, 0, 40, 2, 50, 0, 51, 90, ...below).points);
  expect([arc[0], arc[arc.length - 1]]).toEqual([[-3, 0], [-1, 2]]);
  // The coordinates of an ellipse are those of the drawing, and only its sense changes.
  const ellipse = rounded(read(0, "ELLIPSE", 10, 1, 20, 0, 11, 2, 21, 0, 40, 0.5, 41, 0, 42, Math.PI / 2, ...below).points);
  expect([ellipse[0], ellipse[ellipse.length - 1]]).toEqual([[3, 0], [1, -1]]);
});

/** The groups of a spline. */
const spline = (degree: number, knots: number[], control: number[][], weights: number[] = []) =>
  [0, "SPLINE", 70, 8, 71, degree, 72, knots.length, 73, control.length, ...knots.flatMap((t) => [40, t]), ...weights.flatMap((w) => [41, w]), ...control.flatMap(([x, y]) => [10, x, 20, y, 30, 0])];

test("splines pass through the places of their formula", () => {
  const control = [[0, 0], [0, 6], [6, 6], [6, 0]];
  const curve = rounded(read(...spline(3, [0, 0, 0, 0, 1, 1, 1, 1], control)).points); // a curve of Bézier
  expect([curve[0], curve[12], curve[24]]).toEqual([[0, 0], [3, 4.5], [6, 0]]); // (P0 + 3 P1 + 3 P2 + P3) / 8 in the middle
  const even = rounded(read(...spline(3, [0, 1, 2, 3, 4, 5, 6, 7], control)).points);
  expect([even[0], even[even.length - 1]]).toEqual([[1, 5], [5, 5]]); // (P0 + 4 P1 + P2) / 6, (P1 + 4 P2 + P3) / 6
  const corner = rounded(read(...spline(1, [0, 0, 1, 2, 2], [[0, 0], [4, 0], [4, 3]])).points);
  expect(corner).toContainEqual([4, 0]);
  // Periodic: the first control points come again at the end.
  const square = [[1, 1], [-1, 1], [-1, -1], [1, -1]];
  expect(read(...spline(3, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10], [...square, ...square.slice(0, 3)])).closed).toBe(true);
});

test("rational splines are arcs of circles", () => {
  const quarter = read(...spline(2, [0, 0, 0, 1, 1, 1], [[5, 0], [5, 5], [0, 5]], [1, Math.SQRT1_2, 1])).points;
  for (const p of quarter) expect(Math.hypot(p.x, p.y)).toBeCloseTo(5, 9);
  // Degree 3: a half circle with the weights 1, 1/3, 1/3, 1.
  const half = read(...spline(3, [0, 0, 0, 0, 1, 1, 1, 1], [[5, 0], [5, 10], [-5, 10], [-5, 0]], [1, 1 / 3, 1 / 3, 1])).points;
  for (const p of half) expect(Math.hypot(p.x, p.y)).toBeCloseTo(5, 9);
});

test("splines that are damaged are refused with the reason", () => {
  const control = [[0, 0], [0, 6], [6, 6], [6, 0]];
  const said = (...values: (string | number)[]) => refusal(() => read(...values));
  expect(said(...spline(3, [0, 0, 0, 1, 1, 1], control))).toMatch(/^SPLINE in line 12 has 6 knots instead of 8/);
  expect(said(...spline(3, [0, 0, 0, 0, 1, 0, 1, 1], control))).toMatch(/knots that do not increase/);
  expect(said(...spline(3, [1, 1, 1, 1, 1, 1, 1, 1], control))).toMatch(/knots that are all equal/);
  expect(said(...spline(9, [0, 1], control))).toMatch(/4 control points, which are too few for the degree 9/);
  expect(said(...spline(1e9, [0, 1], control))).toMatch(/the degree 1000000000 instead/);
  expect(said(...spline(3, [0, 0, 0, 0, 1, 1, 1, 1], control, [1, 1]))).toMatch(/2 weights for 4/);
  expect(said(...spline(3, [0, 0, 0, 0, 1, 1, 1, 1], control, [1, 0, 1, 1]))).toMatch(/weight that is not positive/);
  expect(said(0, "SPLINE", 71, 3, 74, 2, 11, 0, 21, 0, 11, 4, 21, 4)).toMatch(/has no control points, only fit points/);
});

test("curves in space are refused; a plane that is not at z = 0 is not", () => {
  expect(read(0, "LINE", 10, 0, 20, 0, 30, 5, 11, 4, 21, 0, 31, 5).points).toHaveLength(2);
  expect(refusal(() => read(0, "LINE", 10, 0, 20, 0, 30, 5, 11, 4, 21, 0, 31, 6))).toMatch(/LINE in line 12 is in space: its z goes from 5 to 6/);
  expect(refusal(() => read(0, "CIRCLE", 10, 0, 20, 0, 40, 5, 210, 0, 220, 1, 230, 0))).toMatch(/CIRCLE in line 12 lies in an inclined plane, whose normal is 0, 1, 0/);
  expect(refusal(() => read(0, "POLYLINE", 70, 8, 0, "VERTEX", 10, 0, 20, 0, 30, 0, 0, "VERTEX", 10, 4, 20, 3, 30, 9, 0, "SEQEND"))).toMatch(/POLYLINE in line 12 is in space/);
  expect(refusal(() => read(0, "POLYLINE", 70, 64, 0, "SEQEND"))).toMatch(/is a mesh/);
  expect(refusal(() => read(0, "3DFACE", 10, 0, 20, 0, 0, "3DSOLID", 0, "3DFACE"))).toMatch(/only 3DFACE in line 12, 3DSOLID in line 18\.$/);
});

test("drawings that are damaged or hold no path are refused with the place", () => {
  expect(refusal(() => dxfPath("AutoCAD Binary DXF\r\n\x1a\0"))).toMatch(/binary/);
  expect(refusal(() => dxfPath(drawing("")))).toMatch(/ellipse or spline: it has no entities at all/);
  expect(refusal(() => dxfPath("0\nEOF\n"))).toMatch(/no entities at all/);
  expect(refusal(() => read(0, "TEXT", 1, "a", 0, "INSERT", 2, "b"))).toMatch(/only TEXT in line 12, INSERT in line 16/);
  expect(refusal(() => dxfPath("0\nSECTION\nhello\nENTITIES\n"))).toMatch(/Line 3 .*“hello”/);
  expect(refusal(() => read(0, "LWPOLYLINE", 10, "a", 20, 0, 10, 1, 20, 1))).toMatch(/Line 14 of the DXF file has “a”, which is not a number/);
  for (const wrong of ["", "1,5", "NaN", "Infinity", "1e999"]) expect(refusal(() => read(0, "ARC", 10, 0, 20, 0, 40, wrong, 50, 0, 51, 90)), wrong).toMatch(/Line 18 of the DXF file/);
  expect(refusal(() => read(0, "ARC", 10, 0, 20, 0, 50, 0, 51, 90))).toMatch(/ARC in line 12 has no group 40/);
  expect(refusal(() => read(0, "CIRCLE", 10, 0, 20, 0, 40, 0))).toMatch(/has the radius 0/);
  expect(refusal(() => read(0, "LINE", 10, 1, 20, 1, 11, 1, 21, 1))).toMatch(/at the same place/);
  expect(refusal(() => dxfPath("0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n0\n"))).toMatch(/ends in line 8, within its section ENTITIES/);
});

test("only the entities of the model are taken", () => {
  const sheet = group(0, "LINE", 67, 1, 10, 0, 20, 0, 11, 297, 21, 0);
  const hidden = group(0, "CIRCLE", 60, 1, 10, 0, 20, 0, 40, 9);
  expect(dxfPath(drawing(sheet + polyline + hidden + group(0, "POINT", 10, 1, 20, 1))).points).toHaveLength(3);
  expect(dxfPath(`999\na remark\n${drawing(polyline)}what follows the end of the drawing\n`).points).toHaveLength(3);
  expect(dxfPath(`\r\n${drawing(polyline).replaceAll("\n", "\r\n")}`).points).toHaveLength(3);
});
