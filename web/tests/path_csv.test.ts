// SPDX-License-Identifier: BSD-3-Clause
import { expect, test } from "vitest";
import { csvPath } from "../src/workbench/path_csv";
import { refusal, rounded } from "./path_checks";

const points = (text: string) => rounded(csvPath(text).points);
const said = (text: string) => refusal(() => csvPath(text));

test("rows of coordinates with every separator and decimal commas", () => {
  const points = [{ x: 1.5, y: 2 }, { x: -3, y: 4.25 }];
  for (const text of ["1.5,2\n-3,4.25", "1,5;2\n-3;4,25", "1,5\t2\n-3\t4,25", "1.5 2\r\n\u22123 4.25\r\n", "x; y\n1,5; 2\n# a remark\n\n-3; 4,25", "x_mm,y_mm\n1.5,2\n-3,4.25", "x (cm); y (cm)\n0,15; 0,2\n-0,3; 0,425"])
    expect(rounded(csvPath(text).points), text).toEqual(rounded(points));
  expect(csvPath("x_m,y_m\n0.001,0.002\n0,0").points[0]).toEqual({ x: 1, y: 2 });
  expect(refusal(() => csvPath("1,5,2,5\n3,1,4,2"))).toMatch(/Line 1, “1,5,2,5”, has 4 numbers/);
  expect(refusal(() => csvPath("1;2\n3;a"))).toMatch(/Line 2, “3;a”, is not a pair/);
  expect(refusal(() => csvPath("1;2\n7"))).toMatch(/Line 2, “7”, has only one number/);
  expect(refusal(() => csvPath("1;2"))).toMatch(/only one point/);
  expect(refusal(() => csvPath(""))).toMatch(/no points/);
  expect(refusal(() => csvPath("x (furlong)\n1 2\n3 4"))).toMatch(/unit “furlong”/);
});

test("tables as spreadsheets write them", () => {
  const taken = [[1.5, 2], [-3, 4.25]];
  for (const text of [
    '\ufeffx_mm;y_mm\r\n1,5;2\r\n-3;4,25\r\n', 'sep=;\nx;y\n1,5;2\n-3;4,25', "sep=\t\nx\ty\n1,5\t2\n-3\t4,25", '"x","y"\n"1,5","2"\n"-3","4,25"', '"X [mm]";"Y [mm]"\n"1.5";"2"\n-3;"4.25"',
    "1.5, 2\n-3, 4.25", "1,5  2\n-3  4,25", '"1,5" "2"\n"-3" "4,25"', "+1.5;+2\n-3;+4.25e0", "1.5;2;;\n;;\n-3;4.25;\n", "# measured\n1.5;2\n  # more\n-3;4.25", "Measured curve\nx;y\n1.5;2\n-3;4.25", "Point A; Point 2\n1.5;2\n-3;4.25",
    "x (mm) y (mm)\n1.5 2\n-3 4.25", "\u00a01.5;2\n\u22123;4.25", "1.5;2\r-3;4.25",
  ]) expect(points(text), text).toEqual(taken);
});

test("of more columns, those that are named x and y are taken", () => {
  for (const text of ["name;x_mm;y_mm;status\na;1.5;2;ok\nb;-3;4.25;ok", "t [s];Y [cm];X [mm]\n0;0.2;1.5\n1;0.425;-3", "t,x,y\n0,1.5,2\n1,-3,4.25", "t x y\n0 1.5 2\n1 -3 4.25", "t;x;y\ns;mm;cm\n0;1.5;0.2\n1;-3;0.425"])
    expect(points(text), text).toEqual([[1.5, 2], [-3, 4.25]]);
  expect(points("y;x\n1;2\n3;4")).toEqual([[2, 1], [4, 3]]);
  expect(said("a;b;c\n1;2;3\n4;5;6")).toMatch(/names 3 columns, but not x and y/);
  expect(said("1;2;3\n4;5;6")).toMatch(/Line 1, “1;2;3”, has 3 numbers instead of two/);
});

test("units come from the header, for each column", () => {
  for (const [header, x, y] of [["x_m;y_m", 2000, 3000], ["X [cm];Y [in]", 20, 76.2], ["x (um);y (µm)", 0.002, 0.003], ["x mm;y cm", 2, 30], ["x/cm;y/cm", 20, 30], ["x_cm;y", 20, 30], ["x;y [inch]", 50.8, 76.2], ["Coordinates in [cm]", 20, 30], ["width;height", 2, 3], ["X_MM;Y_MM", 2, 3]] as const)
    expect(points(`${header}\n2;3\n0;0`)[0], header).toEqual([x, y]);
  expect(said("x (furlong);y (mm)\n1;2\n3;4")).toMatch(/unit “furlong”/);
  expect(said("x (constructor);y (mm)\n1;2\n3;4")).toMatch(/unit “constructor”/);
});

test("what is wrong is said with its line and what was found", () => {
  expect(said("x;y\n\n1;2\n3;\n")).toMatch(/^Line 4, “3;”, is not a pair of numbers: column 2 is empty\.$/);
  expect(said("x;y\n1;2\n1.000,5;3")).toMatch(/Line 3, “1.000,5;3”, is not a pair of numbers: “1.000,5”/);
  expect(said("1,5;2\n3.5;4")).toMatch(/Line 2, “3.5;4”, has “3.5” with a decimal point, but numbers before it have a decimal comma/);
  expect(said("1;2\n3;4;5")).toMatch(/Line 2, “3;4;5”, has 3 numbers instead of two/);
  for (const word of ["NaN", "inf", "-Infinity", "0x10", "1e999", "#N/A", "1 2", "--3", "."]) expect(said(`x;y\n1;2\n${word};4`), word).toMatch(/^Line 3, /);
  expect(said("NaN;NaN\n1;2\n3;4")).toMatch(/Line 1, “NaN;NaN”, is not a pair/);
  expect(said('x;y\n1;2\n"3;4')).toMatch(/Line 3, “"3;4”, has a quote that is not closed/);
  expect(said('x;y\n1;2\n"3"a;4')).toMatch(/text beside a quoted number/);
  expect(said("some words\nand more")).toMatch(/There are no points: Line 1, “some words”, has no numbers/);
  expect(said(`1;2\n${"9".repeat(100)}x;3`)).toMatch(/Line 2, “9{30} …”, is not a pair/);
  expect(said(`1;2\n${'"'.repeat(20000)}`)).toMatch(/has 20000 characters and quotes/);
});
