// SPDX-License-Identifier: BSD-3-Clause
import { describe, expect, it } from "vitest";
import { at, classColour, classOf, classes, countOf, mapsOf, pathsOf } from "../src/cells";
import type { Plot, Table } from "../src/data";

const plot: Plot = { name: "p", title: "P", table: "t", x: "x_m", y: ["y_m", "index"], style: "map", logarithmic_y: false, scene: "" };
const keys = ["x_m", "y_m", "z_m", "index"];
const table = (...data: (number | null)[][]): Table => ({ name: "t", columns: keys.map((key) => ({ key, label: "" })), data, status: [] });
// 4 by 2 places; the coordinates carry the rounding of sums.
const grid = table([0, 0.1, 0.1 + 0.1, 0.1 + 0.2, 0, 0.1, 0.2, 0.3], [0, 0, 0, 0, 0.2, 0.2, 0.2, 0.2], Array(8).fill(0), [0, 0.01, 1, 0, null, 1, 1, 1]);

describe("maps", () => {
  it("have the colours of the printed form", () => {
    expect([0, 11, 23].map(classColour)).toEqual(["#2c216b", "#228e93", "#eae353"]);
    expect([0, 0.4999, 0.5001, 1, -5, 5].map((v) => classOf(v, 0, 1))).toEqual([0, 11, 12, 23, 0, 23]);
    expect(classOf(3, 3, 3)).toBe(classes - 1);
  });
  it("find the grid in millimetres, whatever the rounding", () => {
    const maps = mapsOf(plot, grid)!;
    expect([countOf(maps.x), countOf(maps.y)]).toEqual([4, 2]);
    expect(at(maps.x, 3)).toBeCloseTo(300, 9);
    expect(maps.xLabel).toBe("x (mm)");
    expect(maps.missing).toBe(true);
    expect([maps.low, maps.high]).toEqual([0, 1]);
    expect(maps.levels[0].find(2, 0)!.value).toBe(1);
    expect(maps.levels[0].find(0, 1)!.value).toBeNull();
    expect(maps.levels[0].find(4, 0)).toBeUndefined();
  });
  it("find zero in spite of rounding", () => {
    const maps = mapsOf(plot, table([-0.3, -0.2, 0.1 - 0.2, 0, 0.1], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [1, 2, 3, 4, 5]))!;
    expect(at(maps.x, 3)).toBe(0);
  });
  it("draw neighbours of one class as one rectangle", () => {
    const maps = mapsOf(plot, grid)!;
    const paths = pathsOf(maps, maps.levels[0], 0.1); // cells of 10 by 20 pixels
    expect(paths[0]).toBe("M0.00 40.00H20.00v-20.00H0.00zM30.00 40.00H40.00v-20.00H30.00z");
    expect(paths[classes - 1]).toBe("M20.00 40.00H30.00v-20.00H20.00zM10.00 20.00H40.00v-20.00H10.00z");
    expect(paths[classes]).toBe("M0.00 20.00H10.00v-20.00H0.00z");
    expect(paths.filter((p) => p).length).toBe(3);
  });
  it("share their axes and colours among the groups", () => {
    const maps = mapsOf({ ...plot, group: "z_m" }, table([0, 1, 0], [0, 0, 0], [-0.5, -0.5, -0.7], [2, 3, 4]))!;
    expect(maps.levels.map((l) => l.label)).toEqual(["z −700 mm", "z −500 mm"]);
    expect(maps.levels.map((l) => l.cells.length)).toEqual([1, 2]);
    expect([maps.low, maps.high]).toEqual([2, 4]);
  });
  it("count decades when logarithmic, and have nothing without a value", () => {
    const maps = mapsOf({ ...plot, logarithmic_y: true }, table([0, 1, 2], [0, 0, 0], [0, 0, 0], [1, 1e4, 0]))!;
    expect([maps.low, maps.high, maps.missing]).toEqual([0, 4, true]);
    expect(mapsOf(plot, table([0], [0], [0], [null]))).toBeNull();
    expect(mapsOf({ ...plot, y: ["y_m"] }, grid)).toBeNull();
  });
  it("take the last of several values, and square cells for one line of places", () => {
    const maps = mapsOf(plot, table([0, 0, 1], [0, 0, 0], [0, 0, 0], [null, 5, 3]))!;
    expect(maps.levels[0].cells.map((c) => c.value)).toEqual([5, 3]);
    expect(maps.y.pitch).toBe(maps.x.pitch);
  });
});
