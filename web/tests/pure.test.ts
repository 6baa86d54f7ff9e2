// SPDX-License-Identifier: BSD-3-Clause

/// <reference types="vite/client" />
import { describe, expect, it } from "vitest";
import { readTable, type Scene } from "../src/data";
import { dxf } from "../src/dxf";
import { csv, slug } from "../src/exports";
import { histogram, readLog, stackDots } from "../src/log";
import { nearestRow, sortedRows } from "../src/rows";
import { format, labelWith, nameOf, quantity, unitOf } from "../src/units";
import { bodyColours, fit, niceStep, pathOf, targetErrors, ticks, toScreen, toWorld, whiskerScale, zoom } from "../src/view";

describe("units", () => {
  it("writes numbers for people", () => {
    expect(format(0.1 + 0.2)).toBe("0.3");
    expect(format(-1.5)).toBe("−1.5");
    expect(format(1.25e-7)).toBe("1.25×10⁻⁷");
    expect(format(3e12)).toBe("3×10¹²");
    expect(format(240000)).toBe("240000");
    expect(format(null)).toBe("–");
  });
  it("shows radians as degrees and short lengths as millimetres", () => {
    expect(quantity("crank_angle_rad", Math.PI)).toBe("180°");
    expect(quantity("crank_m", 0.25)).toBe("250\u202fmm");
    expect(quantity("crank_m", 2.5)).toBe("2.5\u202fm");
    expect(unitOf("speed_m_per_s").symbol).toBe("m/s");
    expect(unitOf("drive_torque_N_m", 0.5).symbol).toBe("N\u202fm");
    expect(unitOf("power_W").symbol).toBe("W");
    expect(unitOf("stress_Pa", 3e7)).toEqual({ factor: 1e-6, symbol: "MPa" });
    expect(unitOf("stress_Pa", 3e3)).toEqual({ factor: 1, symbol: "Pa" });
    // Not the angle that it ends with.
    expect(unitOf("stiffness_N_m_per_rad", 1e3)).toEqual({ factor: 1, symbol: "N\u202fm/rad" });
    expect(unitOf("spin_bend_above_rad_per_m2").symbol).toBe("°/m²");
    expect(quantity("kinetic_energy_J", 2.5)).toBe("2.5\u202fJ");
    expect(unitOf("coupler_acceleration_rad_per_s2").symbol).toBe("rad/s²");
    expect(nameOf("path_error_sum_sq_m2")).toBe("path error sum sq");
    expect(labelWith("crank angle (rad)", "crank_angle_rad", unitOf("crank_angle_rad"))).toBe("crank angle (°)");
  });
});

describe("view", () => {
  const size = { width: 800, height: 500 };
  const camera = fit({ left: -1, right: 3, bottom: 0, top: 1 }, size);
  it("fits and converts both ways", () => {
    expect(toScreen(camera, size, { x: 1, y: 0.5 })).toEqual({ x: 400, y: 250 });
    const back = toWorld(camera, size, toScreen(camera, size, { x: 2.2, y: 0.1 }));
    expect(back.x).toBeCloseTo(2.2, 12);
    expect(back.y).toBeCloseTo(0.1, 12);
  });
  it("zooms about a place", () => {
    const about = { x: 100, y: 120 };
    const before = toWorld(camera, size, about);
    const after = toWorld(zoom(camera, size, about, 3), size, about);
    expect(after.x).toBeCloseTo(before.x, 12);
    expect(after.y).toBeCloseTo(before.y, 12);
  });
  it("finds round steps", () => {
    expect(niceStep(0.3)).toBeCloseTo(0.2, 12);
    expect(niceStep(1000)).toBe(1000);
    expect(niceStep(NaN)).toBe(1);
    expect(ticks(-0.1, 0.45, 0.2)).toEqual([-0, 0.2, 0.4]);
  });
  it("breaks paths at missing places", () => {
    expect(pathOf([{ x: 0, y: 0 }, { x: 1, y: 1 }], true)).toBe("M0.00 0.00L1.00 1.00Z");
    expect(pathOf([{ x: 0, y: 0 }, null, { x: 1, y: 1 }], true)).toBe("M0.00 0.00M1.00 1.00");
  });
  it("measures errors and magnifies them to be seen", () => {
    const errors = targetErrors({ x: [0, 0, 0], y: [0, 0, 0], achieved_x: [3, null, 1], achieved_y: [4, null, 1] });
    expect(errors.distance).toEqual([5, null, Math.SQRT2]);
    expect(errors.worst).toBe(0);
    expect(whiskerScale(0.0001, 1)).toBe(500);
    expect(whiskerScale(0.5, 1)).toBe(1);
    expect(whiskerScale(0, 1)).toBe(1);
    expect(whiskerScale(1e-15, 1)).toBe(1);
  });
});

describe("table plots", () => {
  it("sorts rows by x and wraps inputs into the turn that is shown", () => {
    const { xs, order } = sortedRows([3, 1, null, 2 * Math.PI + 0.5], { first: 0, length: 2 * Math.PI });
    expect(order).toEqual([3, 1, 0]);
    expect(xs[0]).toBeCloseTo(0.5, 12);
    expect(xs.slice(1)).toEqual([1, 3]);
  });
  it("finds the nearest row", () => {
    expect([-1, 0.4, 0.6, 9].map((x) => nearestRow([0, 1, 2], x))).toEqual([0, 0, 1, 2]);
    expect(nearestRow([], 1)).toBe(-1);
  });
});

describe("log", () => {
  it("reads numbers, objects and entries without history", () => {
    const runs = readLog([
      { seed: 3, best: 0.1, evaluations: 50, status: "done", history: [5, 1, 0.1] },
      { seed: 4, best: 0.2, history: [{ evaluations: 10, cost: 7 }, { evaluations: 20, cost: 0.2 }] },
      { seed: 5, status: "cancelled" },
      { seed: 6, violation: 0, path_error_sum_sq_m2: 0.5 },
    ]);
    expect(runs[0]).toMatchObject({ seed: "3", final: 0.1, x: [1, 2, 3], y: [5, 1, 0.1], counts: "steps" });
    expect(runs[1]).toMatchObject({ final: 0.2, x: [10, 20], y: [7, 0.2], counts: "evaluations" });
    expect(runs[2]).toMatchObject({ final: null, x: [] });
    expect(runs[3].final).toBe(0.5);
    expect(readLog(null)).toEqual([]);
  });
  it("stacks equal values", () => {
    const { dots, logarithmic } = stackDots([2, 2, null, 2 + 1e-12], 10);
    expect(dots.map((d) => d.level)).toEqual([0, 1, 2]);
    expect(logarithmic).toBe(false);
    expect(stackDots([1, 1000], 10).logarithmic).toBe(true);
    // The axis shows a part, which is as long as the whole.
    const part = stackDots([1, 10, 100, 1000], 10, [1 / 3, 1]);
    expect([part.low, part.high].map(Math.round)).toEqual([10, 1000]);
    expect(part.dots.map((d) => [d.index, d.share])).toEqual([[1, 0], [2, 0.5], [3, 1]]);
  });
  it("counts in bins", () => {
    const { counts: [counts], middles } = histogram([[0, 0.1, null, 1]]);
    expect(counts.reduce((a, b) => a + b)).toBe(3);
    expect(middles).toHaveLength(counts.length);
    expect(histogram([[2, 2]]).counts).toEqual([[2]]);
    // Lists side by side have the same bins.
    expect(histogram([[0, 1], [1, 1, 5]]).counts).toEqual([[1, 1, 0, 0, 0], [0, 2, 0, 0, 1]]);
  });
});

describe("exports", () => {
  const table = readTable({
    name: "t",
    columns: [{ key: "a_rad", label: "" }, { key: "b,c", label: "" }, { key: "status", label: "" }],
    data: [[0.1, 1e-300], [null, 2], ["done", 'no "assembly"']],
  });
  it("writes CSV as the program does", () => {
    expect(csv(table)).toBe('a_rad,"b,c",status\r\n0.1,,done\r\n1e-300,2,"no ""assembly"""\r\n');
  });
  it("makes file names", () => {
    expect(slug("Four-bar: 18 points / Bošković")).toBe("four-bar-18-points-bos-kovic");
    expect(slug("…")).toBe("report");
  });
  it("writes DXF for an empty scene", () => {
    const scene: Scene = { name: "", title: "", input_key: "", input_label: "", input: [], status: [], points: [], bodies: [], joints: [], traces: [], targets: [], circles: [], vectors: [], moments: [] };
    expect(dxf(scene, 0)).toMatch(/ENTITIES\n0\nENDSEC\n0\nEOF\n$/);
  });
});

describe("colours of bodies", () => {
  it("go by their names", () => {
    const bodies = ["base", "arm", "rod", "rod", "", "", "arm"].map((name) => ({ name, style: name === "base" ? "ground" : "bar" }));
    expect(bodyColours(bodies)).toEqual([0, 0, 1, 1, 2, 3, 0]);
  });
  it("are those of their roles: both sides of an axle and all legs alike", () => {
    const colours = (names: string[]) => bodyColours(names.map((name) => ({ name, style: name.endsWith("spring") ? "spring" : "bar" })));
    expect(colours(["right wishbone", "right spring", "right tie rod", "left wishbone", "left spring", "left tie rod"])).toEqual([0, 0, 1, 0, 0, 1]);
    expect(colours(["arm 1", "rod 1", "arm 2", "rod 2", "platform"])).toEqual([0, 1, 0, 1, 2]);
    // Numbers of one name alone are no legs.
    expect(colours(["link 1", "link 2", "link 3"])).toEqual([0, 1, 2]);
  });
  it("do not come again before the nineteenth role", () => {
    const colours = bodyColours(Array.from({ length: 19 }, (_, i) => ({ name: `${"abcdefghijklmnopqrs"[i]} body`, style: "bar" })));
    expect(colours).toEqual([...Array.from({ length: 18 }, (_, i) => i), 0]);
  });
});
