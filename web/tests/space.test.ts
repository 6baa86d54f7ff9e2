// SPDX-License-Identifier: BSD-3-Clause
import { describe, expect, it } from "vitest";
import { arrowScale, componentsNear, extentOf, readVector } from "../src/arrows";
import type { Plot, Scene, Table } from "../src/data";
import { dxf } from "../src/dxf";
import { isSpatial, middleRow, rowOf, samplesOf } from "../src/grid";
import { aligned, groupsOf, inputOf, linesOf, presentGroup } from "../src/groups";
import { analyse, placeNear } from "../src/motion";
import { basisOf, beyond, bounds3, cloudOf, dashDots, fit3, lowestTyre, viewpoints, wheelCircle, type V3 } from "../src/space_view";

// Three travels by two racks; B rises with the travel and moves along y with the rack.
const scene: Scene = {
  name: "s", title: "s", input_key: "travel_m", input_label: "travel", input: [-0.1, 0, 0.1], second_key: "rack_m", second_label: "rack", second: [-0.02, 0.01],
  status: ["done", "done", "done", "done", "done", "no_assembly"],
  points: [
    { name: "A", x: [0], y: [0], z: [0] },
    { name: "B", x: [0.5], y: [1, 1, 1, 2, 2, 2], z: [-0.1, 0, 0.1, -0.1, 0, 0.1] },
    { name: "E", x: [0.5], y: [2, 2, 2, 3, 3, 3], z: [-0.1, 0, 0.1, -0.1, 0, 0.1] },
  ],
  bodies: [{ name: "bar", points: [0, 1], style: "bar" }, { name: "axis", points: [0, 1], style: "axis" }, { name: "spring", points: [0, 1], style: "spring" }],
  joints: [{ name: "A", point: 0, style: "ground_pivot" }], traces: [], targets: [], circles: [], moments: [],
  discs: [{ name: "wheel", centre: 1, axis: 2, radius: 0.3, width: 0.2 }],
  vectors: [{ name: "f", quantity: "force", unit: "N", point: 1, x: [0], y: [3], z: [0, 0, 0, 0, 0, 4], symbol: "F" }],
};

describe("grids of samples", () => {
  it("show one row at a time", () => {
    expect(samplesOf(scene)).toBe(6);
    expect(isSpatial(scene)).toBe(true);
    expect(middleRow(scene)).toBe(1);
    const row = rowOf(scene, 1);
    expect(row.points[1]).toEqual({ name: "B", x: [0.5], y: [2, 2, 2], z: [-0.1, 0, 0.1] });
    expect(row.vectors[0].z).toEqual([0, 0, 4]);
    expect(analyse(row).ok).toEqual([true, true, false]);
    const marked = { ...row, points: [...row.points, { name: "mark", x: [null], y: [0], z: [0] }] };
    expect(analyse(marked).ok).toEqual([true, true, false]);
    expect(analyse({ ...marked, status: [] }).ok).toEqual([false, false, false]);
    expect(analyse(rowOf(scene, 0)).ok).toEqual([true, true, true]);
    expect(placeNear(row, 1, 0.5)).toEqual({ x: 0.5, y: 2, z: expect.closeTo(-0.05, 12) });
    expect(rowOf(scene, 9).points[1].y).toEqual([2, 2, 2]);
    const single = { ...scene, second: undefined };
    expect(rowOf({ ...single, input: [1] }, 3).input).toEqual([1]);
  });

  it("give arrows one scale over all rows", () => {
    expect(extentOf(scene)).toBeCloseTo(3, 12);
    // The largest arrow is 5, but stands out: it counts as three times the median of 3.
    expect(arrowScale(scene, "force")).toBeCloseTo((0.25 * 3) / 5, 12);
    expect(componentsNear(scene.vectors[0], 5)).toEqual({ x: 0, y: 3, z: 4 });
    expect(readVector(scene.vectors[0], 5)).toMatchObject({ size: "5\u202fN", z: "4\u202fN", direction: "" });
  });
});

describe("views in space", () => {
  it("have what their names say right and up", () => {
    const named = (name: string) => basisOf(viewpoints.find((v) => v.name === name)!.eye);
    const close = (v: number[], w: number[]) => v.forEach((x, k) => expect(x).toBeCloseTo(w[k], 3));
    close(named("rear").right, [0, -1, 0]);
    close(named("rear").up, [0, 0, 1]);
    close(named("front").right, [0, 1, 0]);
    close(named("side").right, [-1, 0, 0]);
    close(named("top").right, [0, -1, 0]);
    close(named("top").up, [1, 0, 0]);
    close(basisOf([0, 0, 1]).right, [0, -1, 0]);
    expect(new Set(viewpoints.map((v) => v.key)).size).toBe(viewpoints.length);
  });

  it("fit what there is", () => {
    const places: V3[] = [[1, -2, 0], [1, 2, 0], [1, 0, 1]];
    const fit = fit3(places, [-1, 0, 0], Math.PI / 2, 2, 1);
    expect(fit.target).toEqual([1, expect.closeTo(0, 12), 0.5]);
    // 4 wide on a sheet twice as wide as high, seen at 45 degrees to each side of the height.
    expect(fit.halfHeight).toBeCloseTo(1, 12);
    expect(fit.distance).toBeCloseTo(1, 12);
    const box = bounds3(scene)!;
    expect(box.low.map((v) => +v.toFixed(9))).toEqual([0, 0, -0.4]);
    expect(box.high.map((v) => +v.toFixed(9))).toEqual([0.8, 3, 0.4]);
    for (const p of cloudOf(scene)) p.forEach((v, k) => expect(v >= box.low[k] - 1e-9 && v <= box.high[k] + 1e-9).toBe(true));
  });

  it("know wheels and axes", () => {
    const rim = wheelCircle(scene, scene.discs![0], 0, 0.1, 8);
    expect(rim.every((p) => Math.abs(p.y - 1.1) < 1e-12 && Math.abs(Math.hypot(p.x - 0.5, p.z! + 0.1) - 0.3) < 1e-12)).toBe(true);
    expect(lowestTyre([{ centre: [0, 0, 1], axis: [0, 1, 0], radius: 0.3, width: 0.2 }, { centre: [0, 0, 1], axis: [0, 0, 1], radius: 0.3, width: 0.2 }])).toBeCloseTo(0.7, 12);
    expect(lowestTyre([])).toBeNull();
    expect(beyond([{ x: 0, y: 0, z: 0 }, { x: 0, y: 0, z: 2 }])[1]).toEqual({ x: 0, y: 0, z: 2.3 });
    const line = dashDots(1, 0.2);
    expect(line[0][0]).toBe(0);
    expect(line[line.length - 1][1]).toBeCloseTo(1, 12);
    line.slice(1).forEach(([from], i) => expect(from).toBeGreaterThan(line[i][1]));
  });

  it("are written as DXF with their heights", () => {
    const text = dxf(rowOf(scene, 1), 0);
    expect(text).toContain("LINE\n8\nLINKS\n10\n0\n20\n0\n30\n0\n11\n500\n21\n2000\n31\n-100\n");
    expect(text).toContain("0\nLAYER\n2\nWHEELS\n");
    expect(text).toContain("POLYLINE\n8\nWHEELS\n66\n1\n10\n0\n20\n0\n30\n0\n70\n9\n");
    expect(text).not.toContain("CIRCLE");
  });
});

describe("groups of curves", () => {
  const table: Table = {
    name: "t", status: [],
    columns: [{ key: "travel_mm", label: "wheel travel (mm)" }, { key: "rack_m", label: "rack (m)" }, { key: "toe_deg", label: "toe (deg)" }, { key: "low_deg", label: "" }, { key: "high_deg", label: "" }],
    data: [[1, 0, 0, 1], [0.03, 0.03, -0.03, -0.03], [4, 3, 1, null], [null, null, -1, -1], [null, null, 0, 0]],
  };
  const plot: Plot = { name: "p", title: "P", table: "t", x: "travel_mm", y: ["toe_deg"], style: "line", logarithmic_y: false, scene: "s", group: "rack_m", bands: [{ lower: "low_deg", upper: "high_deg", label: "target" }] };

  it("split the rows and name them in the unit that is shown", () => {
    const groups = groupsOf(plot, table);
    expect(groups.map((g) => g.label)).toEqual(["rack −30 mm", "rack 30 mm"]);
    expect(groups.map((g) => g.rows)).toEqual([[2, 3], [0, 1]]);
    expect(groupsOf({ ...plot, group: "gone" }, table)).toHaveLength(1);
  });

  it("belong to the inputs of the scene, whatever their unit", () => {
    expect(inputOf(scene, "travel_mm")).toEqual({ input: 1, factor: 1e-3 });
    expect(inputOf(scene, "rack_m")).toEqual({ input: 2, factor: 1 });
    expect(inputOf(scene, "toe_deg").input).toBe(0);
    expect(inputOf(undefined, "rack_m").input).toBe(0);
    const groups = groupsOf(plot, table);
    expect(presentGroup(groups, 1, 0.01)).toBe(1);
    expect(presentGroup(groups, 1, -0.02)).toBe(0);
    expect(presentGroup(groups.slice(1), 1, 0)).toBe(-1);
  });

  it("come with bands and a baseline behind them", () => {
    const before = { ...table, name: "before", data: table.data.map((c, i) => (i === 2 ? c.map((v) => (v === null ? null : v + 10)) : c)) };
    const lines = linesOf(plot, table, before, 1);
    expect(lines.map((l) => l.kind)).toEqual(["lower", "upper", "baseline", "baseline", "curve", "curve"]);
    // The group that is present has no band: the first that has one lends it.
    expect(lines[0]).toMatchObject({ label: "target", xs: [0, 1], ys: [-1, -1], group: 0 });
    expect(lines[5]).toMatchObject({ label: "rack 30 mm", xs: [0, 1], ys: [3, 4], group: 1 });
    expect(lines[3].ys).toEqual([13, 14]);
    const data = aligned([lines[4], { ...lines[5], xs: [0.5, 1] }], 2, 3);
    expect(data).toEqual([[0, 1, 2], [3, undefined, null], [undefined, 9, 12]]);
  });
});
