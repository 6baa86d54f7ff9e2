// SPDX-License-Identifier: BSD-3-Clause
import { expect, test } from "vitest";
import drawings from "../../tests/published/drawings.json";
import { boxOf, lengthOf } from "../src/workbench/path";
import { readPath } from "../src/workbench/path_text";
import { refusal } from "./path_checks";

interface Case {
  id: string;
  text: string;
  diagnostic?: string; // of the program, for a text that is refused
  closed?: boolean;
  length_mm?: number;
  box_mm?: number[];
  first_mm?: number[];
}

const cases: Case[] = drawings.cases;

// The program reads the same texts, and its test compares them with the same numbers.
test.each(cases.map((c): [string, Case] => [c.id, c]))("the board and the program read a drawing alike: %s", (_, c) => {
  if (c.diagnostic !== undefined) {
    expect(refusal(() => readPath(c.text))).not.toBe("");
    return;
  }
  const path = readPath(c.text);
  expect(path.closed).toBe(c.closed);
  const { x, y, width, height } = boxOf(path.points);
  const [length, box, first] = [c.length_mm!, c.box_mm!, c.first_mm!];
  const near = 8e-3 * length; // the board keeps 200 points at most
  expect(Math.abs(lengthOf(path) - length)).toBeLessThan(near);
  [x, y, width, height].forEach((v, i) => expect(Math.abs(v - box[i])).toBeLessThan(near));
  expect(Math.hypot(path.points[0].x - first[0], path.points[0].y - first[1])).toBeLessThan(near);
});
