// SPDX-License-Identifier: BSD-3-Clause
import { describe, expect, it } from "vitest";
import { arcPaths, arcTurn, arrowPaths, arrowScale, boundsWith, componentsNear, headOf, keyValue, largestMoment, lineOf, readMoment, readVector, symbolLines, valueNear } from "../src/arrows";
import { boxOf, curvesOf, frameOf, nameOfPair, nearestPoint } from "../src/curves";
import type { Plot, Scene, Table, Vector } from "../src/data";
import { dxf } from "../src/dxf";
import { analyse } from "../src/motion";
import { bounds } from "../src/view";

const vector = (quantity: Vector["quantity"], point: number, x: (number | null)[], y: (number | null)[]): Vector =>
  ({ name: "pull", quantity, unit: quantity === "force" ? "N" : "m/s²", point, x, y, symbol: "F" });

// The same scene as in arrows_test.cpp: 2 m wide, a force that grows from 100 N to 400 N.
const pulled = (): Scene => ({
  name: "s", title: "s", input_key: "time_s", input_label: "time", input: [0, 1, 2, 3], status: [],
  points: [{ name: "A", x: [0], y: [0] }, { name: "B", x: [2], y: [1] }],
  bodies: [], joints: [], traces: [], targets: [], circles: [],
  vectors: [vector("force", 0, [60, 120, 180, 240], [80, 160, 240, 320]), vector("force", 1, [0], [-50])],
  moments: [{ name: "torque", unit: "N m", point: 0, value: [1, -4, null, 2], symbol: "M" }],
});

describe("arrows", () => {
  it("draws the largest a quarter as long as the scene", () => {
    expect(arrowScale(pulled(), "force") * 400).toBeCloseTo(0.5, 12);
    expect(arrowScale(pulled(), "velocity")).toBe(0);
  });
  it("does not let one sample make the others vanish", () => {
    const scene = pulled();
    scene.vectors[0] = vector("force", 0, [30, 30, 30, 1e9], [40, 40, 40, 0]);
    expect(arrowScale(scene, "force") * 150).toBeCloseTo(0.5, 12);
    const box = boundsWith(scene, [{ quantity: "force", scale: arrowScale(scene, "force") }])!;
    expect(box.right).toBe(2); // the long one is held to a third of the scene
  });
  it("keeps a flat scene flat", () => {
    const flat = bounds(pulled())!;
    const scene = { ...pulled(), points: pulled().points.map((p) => ({ ...p, y: p.y.map((y) => (y === null ? null : y / 100)) })), vectors: [vector("force", 0, [0], [1e9])] };
    const box = boundsWith(scene, [{ quantity: "force", scale: 1 }])!;
    expect(box.top - bounds(scene)!.top).toBeLessThanOrEqual((flat.right - flat.left) / 12);
    expect(box.top).toBeGreaterThan(bounds(scene)!.top);
  });
  it("takes in the tips", () => {
    const box = boundsWith(pulled(), [{ quantity: "force", scale: 0.01 / 8 }])!;
    expect(box.bottom).toBe(0);
    expect(box.top).toBe(1);
    expect(boundsWith(pulled(), [{ quantity: "force", scale: 0 }])).toEqual(bounds(pulled()));
    const down = pulled();
    down.vectors = [vector("force", 0, [0], [-100])];
    expect(boundsWith(down, [{ quantity: "force", scale: 0.002 }])!.bottom).toBeCloseTo(-0.2, 12);
  });
  it("interpolates between samples and leaves gaps", () => {
    const [force, weight] = pulled().vectors;
    expect(componentsNear(force, 0.5)).toEqual({ x: 90, y: 120 });
    expect(componentsNear(weight, 2.7)).toEqual({ x: 0, y: -50 });
    expect([1, 1.25, 1.75, 2].map((at) => valueNear([1, -4, null, 2], at))).toEqual([-4, -4, null, null]);
  });
  it("tells values as text that can be pasted", () => {
    expect(lineOf(readVector(pulled().vectors[0], 1))).toBe("pull: 200\u202fN (x 120\u202fN, y 160\u202fN, direction 53.13°)");
    expect(readVector(vector("acceleration", 0, [3], [4]), 0).size).toBe("5\u202fm/s²");
    expect(lineOf(readMoment(pulled().moments[0], 1))).toBe("torque: −4\u202fN\u202fm");
    expect(readMoment(pulled().moments[0], 2).size).toContain("–");
  });
  it("keeps the key within its room", () => {
    expect(keyValue(0.25, 110)).toBe(200);
    expect(keyValue(3, 110) * 3).toBeLessThanOrEqual(110);
  });
  it("tells the quantities apart by their heads", () => {
    const head = (q: Vector["quantity"]) => headOf(q, { x: 10, y: 0 }, 0, 5);
    expect(head("force")).toMatch(/^M[^M]*Z$/);
    expect(head("velocity")).toMatch(/^M[^MZ]*$/);
    expect(head("acceleration").match(/M/g)).toHaveLength(2);
    expect(arrowPaths("force", { x: 0, y: 0 }, { x: 0.1, y: 0 })).toBeNull();
  });
  it("turns arcs with the sign of the couple", () => {
    expect(largestMoment(pulled().moments)).toBe(4);
    expect(arcTurn(0)).toBe(0);
    expect(arcTurn(-1)).toBeCloseTo((-2 * Math.PI * 5) / 6, 12);
    // A quarter counter-clockwise from the top ends at the left.
    expect(arcPaths({ x: 0, y: 0 }, 10, Math.PI / 2).arc).toBe("M0.00 -10.00A10.00 10.00 0 0 0 -10.00 -0.00");
  });
  it("draws springs, dampers and guides from point to point", () => {
    const [a, b] = [{ x: 1, y: 0 }, { x: 1, y: 10 }];
    const [spring] = symbolLines("spring", a, b, 2);
    expect([spring[0], spring[spring.length - 1]]).toEqual([a, b]);
    expect(Math.max(...spring.map((p) => p.x)) - Math.min(...spring.map((p) => p.x))).toBeCloseTo(2, 12);
    expect(symbolLines("damper", a, b, 2)).toHaveLength(4);
    const guide = symbolLines("guide", a, b, 2);
    expect(guide).toHaveLength(6);
    expect(guide.slice(1).every((mark) => mark[1].x > 1)).toBe(true);
    expect(symbolLines("bar", a, b, 2)).toEqual([]);
    expect(symbolLines("spring", a, a, 2)).toEqual([]);
  });
});

describe("machine parts", () => {
  it("takes circles into the box and into DXF", () => {
    const scene = pulled();
    scene.circles = [{ name: "wheel", centre: 0, rim: 1 }];
    expect(bounds(scene)!.left).toBeCloseTo(-Math.sqrt(5), 12);
    scene.bodies = [{ name: "spring", points: [0, 1], style: "spring" }, { name: "guide", points: [0, 1], style: "guide" }];
    const text = dxf(scene, 0);
    expect(text).toMatch(/CIRCLE\n8\nLINKS/);
    expect(text).toMatch(/POLYLINE\n8\nLINKS/);
    expect(text).toMatch(/POLYLINE\n8\nGROUND/);
  });
  it("knows time from angles and speeds", () => {
    const timed = (input_key: string) => analyse({ ...pulled(), input_key }).timed;
    expect(["time_s", "crank_angle_rad", "speed_rad_per_s", "travel_m"].map(timed)).toEqual([true, false, false, false]);
    expect(analyse({ ...pulled(), input: [0, 1, 2, 2 * Math.PI] }).fullTurn).toBe(false);
  });
});

describe("polar diagrams", () => {
  const table: Table = {
    name: "t", status: [],
    columns: [{ key: "t_s", label: "" }, { key: "O1_x_N", label: "O1 x, ground on crank (N)" }, { key: "O1_y_N", label: "O1 y (N)" }],
    data: [[0, 1, 2], [0, 300, null], [-100, 50, 7]],
  };
  const plot: Plot = { name: "p", title: "P", table: "t", x: "t_s", y: ["O1_x_N", "O1_y_N", "gone_x_N", "gone_y_N"], style: "polar", logarithmic_y: false, scene: "" };
  it("names pairs after what they belong to", () => {
    expect(nameOfPair("O1 x, ground on crank (N)", "O1_x_N")).toBe("O1, ground on crank");
    expect(nameOfPair("shaking force x (N)", "f_x_N")).toBe("shaking force");
    expect(nameOfPair("", "O2_x_N")).toBe("O2");
  });
  it("has equal axes that hold the curves and the origin", () => {
    const { curves, unit } = curvesOf(plot, table);
    expect(unit.symbol).toBe("N");
    expect(curves).toHaveLength(1);
    for (const [w, h] of [[600, 300], [300, 600]]) {
      const frame = frameOf(boxOf(curves, true)!, w, h, { left: 40, right: 10, top: 10, bottom: 30 });
      expect(frame.x(100) - frame.x(0)).toBeCloseTo(frame.y(0) - frame.y(100), 9);
      for (const [x, y] of [[0, 0], [300, 50], [0, -100]]) {
        expect(frame.x(x)).toBeGreaterThan(40);
        expect(frame.x(x)).toBeLessThan(w - 10);
        expect(frame.y(y)).toBeGreaterThan(10);
        expect(frame.y(y)).toBeLessThan(h - 30);
      }
      expect(frame.xs.some((t) => t.text === "0")).toBe(true);
      expect(nearestPoint(curves, frame, frame.x(290), frame.y(40))).toBe(1);
    }
  });
  it("says when there is nothing", () => {
    expect(boxOf([{ label: "", x: [null], y: [1] }], true)).toBeNull();
  });
});
