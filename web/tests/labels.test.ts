// SPDX-License-Identifier: BSD-3-Clause
import { describe, expect, it } from "vitest";
import type { Scene, Vector } from "../src/data";
import { placeLabels, symbolOf } from "../src/labels";

describe("names beside places", () => {
  it("stand at the upper right where there is room", () => {
    expect(placeLabels([{ x: 0, y: 0, text: "A" }, null, { x: 200, y: 0, text: "B" }, { x: 400, y: 0, text: "" }])).toMatchObject([{ x: 11, y: -9, slot: 0, far: false }, null, { slot: 0 }, null]);
  });
  it("do not cover each other, nor other places", () => {
    const near = ["G upper", "G lower", "A lower", "K lower"].map((text, i) => ({ x: 100 + 3 * i, y: 100 + 4 * i, text }));
    const placed = placeLabels(near).map((p, i) => ({ ...p!, px: near[i].x, py: near[i].y, width: 7.2 * near[i].text.length }));
    const left = (p: (typeof placed)[number]) => p.px + p.x - (p.anchor === "start" ? 0 : p.anchor === "end" ? p.width : p.width / 2);
    placed.forEach((a, i) =>
      placed.slice(i + 1).forEach((b) => {
        const apart = left(a) + a.width <= left(b) || left(b) + b.width <= left(a) || Math.abs(a.py + a.y - b.py - b.y) >= 15;
        expect(apart, `${near[i].text}`).toBe(true);
      }),
    );
    expect(placed.some((p) => p.slot !== 0)).toBe(true);
  });
  it("stay where they were as long as that is free", () => {
    const alone = [{ x: 0, y: 0, text: "A" }];
    expect(placeLabels(alone, [3])[0]!.slot).toBe(3);
    expect(placeLabels([{ x: -30, y: 14, text: "A" }, ...alone], [0, 3])[1]!.slot).not.toBe(3);
  });
  it("are written once at a joint and its arrow", () => {
    const scene = { joints: [{ name: "K lower", point: 2, style: "pivot" }] } as unknown as Scene;
    expect(symbolOf(scene, { point: 2, symbol: "K lower" } as Vector)).toBe("");
    expect(symbolOf(scene, { point: 2, symbol: "F" } as Vector)).toBe("F");
  });
});
