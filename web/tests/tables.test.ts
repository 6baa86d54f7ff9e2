// SPDX-License-Identifier: BSD-3-Clause

// Tables in the units of the study.
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { ShownSuffix } from "../src/data";
import { csv, tableInFile } from "../src/exports";
import { cellsOf, inFile, labelWith, unitOf, useUnits } from "../src/units";

const shown = (suffix: string, symbol = suffix.slice(1), key = suffix, steps = [1, 1, 1, 1]): ShownSuffix =>
  ({ suffix, symbol, factor: ((steps[0] / steps[1]) * steps[2]) / steps[3], key, steps, by_size: false });
// A study in mm, deg and rpm.
const chosen = [
  shown("_rad_per_m", "°/100 mm", "_deg_per_100mm", [1, 1, 18, Math.PI]), shown("_rad_per_s", "rpm", "_rpm", [1, 1, 30, Math.PI]), shown("_m_per_s2", "mm/s²", "_mm_per_s2", [1, 1, 1000, 1]),
  shown("_N_m", "N m"), shown("_rad", "°", "_deg", [1, 1, 180, Math.PI]), shown("_deg", "°"), shown("_rpm"), shown("_mm"), shown("_um", "µm"), shown("_in"), shown("_m3", "m³"),
  shown("_m2", "mm²", "_mm2", [1, 1, 1e6, 1]), shown("_m", "mm", "_mm", [1, 1, 1000, 1]), shown("_s"), shown("_N"), shown("_J"),
];
const before = [...(await import("./units")).units];
beforeAll(() => useUnits(chosen));
afterAll(() => useUnits(before));

describe("tables in the units of the study", () => {
  const table = {
    name: "t", status: [], columns: [{ key: "crank_angle_rad", label: "crank angle (rad)" }, { key: "P_x_m", label: "P x (m)" }, { key: "O_N", label: "force in O (N)" }, { key: "toe_by_travel_rad_per_m", label: "" }],
    data: [[0, Math.PI], [-0.0125, null], [1e-17, 3], [0.1, 0]],
  };
  it("have heads and cells in them", () => {
    expect(table.columns.map((c) => labelWith(c.label, c.key, unitOf(c.key)))).toEqual(["crank angle (°)", "P x (mm)", "force in O (N)", "toe by travel (°/100\u202fmm)"]);
    expect(table.columns.map((c, i) => [0, 1].map(cellsOf(c.key, table.data[i])))).toEqual([["0", "180"], ["−12.5", "–"], ["0", "3"], ["0.572958", "0"]]);
  });
  it("are given away in them, and as they are", () => {
    expect(csv(tableInFile(table)!)).toBe("crank_angle_deg,P_x_mm,O_N,toe_by_travel_deg_per_100mm,status\r\n0,-12.5,1e-17,0.5729577951308232,done\r\n180,,3,0,done\r\n");
    expect(csv(table)).toMatch(/^crank_angle_rad,P_x_m,O_N,toe_by_travel_rad_per_m,status\r\n0,-0.0125,1e-17,0.1,done/);
    expect(tableInFile({ ...table, columns: table.columns.slice(2, 3), data: table.data.slice(2, 3) })).toBeUndefined();
  });
  it("have the numbers of the program's own conversion", () => {
    expect(inFile("motor_rad_per_s", [7.3])).toEqual({ key: "motor_rpm", values: [(7.3 * 30) / Math.PI] });
  });
});
