// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the readers of paths share.
import { expect } from "vitest";
import { PathError } from "../src/workbench/path";

/** The coordinates with six decimals, without a negative zero. */
export const rounded = (points: { x: number; y: number }[]) => points.map(({ x, y }) => [x, y].map((v) => Number(v.toFixed(6)) + 0));

/** What is wrong with a path. The error says how to correct it, too. */
export function refusal(run: () => unknown): string {
  try {
    run();
  } catch (error) {
    expect(error).toBeInstanceOf(PathError);
    expect((error as PathError).hint).toMatch(/\.$/);
    return (error as PathError).message;
  }
  throw new Error("it was taken");
}
