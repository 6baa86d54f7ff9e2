// SPDX-License-Identifier: BSD-3-Clause
import { expect, test } from "vitest";
import type { Carried, Scene } from "../src/data";
import { asFragment, fromFragment } from "../src/workbench/document";
import { Stopped, type Answer, type Engine, type Task } from "../src/workbench/engine";
import { connectSearch, ended, machines, problems, round, rounds, startSearch, stopSearch } from "../src/workbench/path_search";
import { blankSheet, canRedoPath, canUndoPath, clearPath, closePath, frameFor, redoPath, sheet, takePath, takeStroke, undoPath, wishes } from "../src/workbench/path_sheet";

const scene = (name: string) => ({ name, title: "", input: [], points: [], bodies: [], joints: [], traces: [], targets: [], circles: [] }) as unknown as Scene;
const carried = (count: number): Carried => ({
  view: {
    headline: "", remarks: [], scenes: [scene("solution-1"), scene("solution-2")].slice(0, count), solution_scenes: ["solution-1", "solution-2"].slice(0, count),
    solutions: [{ label: "eight_bar:1324b (8 links)", defects: [] }, { label: "a machine", defects: [] }].slice(0, count),
    files: [],
    designs: [0, 1].slice(0, count).map((solution) => ({ solution, name: `machine-${solution + 1}`, toml: `title = "${solution}"` })),
  } as unknown as Carried["view"],
  result: {
    solutions: [
      { label: "", parameters: {}, objectives: { path_error_rms_m: 0.0004, chamfer_distance_share: 0.0123, least_pair_angle_rad: Math.PI / 6 }, classification: { family: "eight_bar", program: "eight_bar:1324b", links: 8 }, defects: [] },
      { label: "", parameters: {}, objectives: null, classification: null, defects: [] },
    ].slice(0, count),
  },
  resultText: () => "",
});

/** An engine whose answers are given by hand. */
function engineOf() {
  const asked: { task: Task; answer: (answer: Partial<Answer>) => void; fail: (error: Error) => void }[] = [];
  let stops = 0;
  const engine = {
    run: (task: Task) => new Promise<Answer>((done, fail) => asked.push({ task, answer: (a) => done({ text: task.text, diagnostics: [], seconds: 1, ...a }), fail })),
    stop: () => {
      ++stops;
      asked[asked.length - 1].fail(new Stopped("stopped"));
    },
  } as unknown as Engine;
  return { engine, asked, stops: () => stops };
}
const settle = () => new Promise((resolve) => setTimeout(resolve));
const arc = Array.from({ length: 60 }, (_, k) => ({ x: 40 * Math.cos(k / 12), y: 40 * Math.sin(k / 12) }));

test("each change starts the search, whose runs grow and replace the list", async () => {
  const { engine, asked, stops } = engineOf();
  const end = connectSearch(() => engine);
  expect(asked).toHaveLength(0);
  takePath({ points: arc, closed: false });
  expect(asked).toHaveLength(1);
  expect(asked[0].task.text).toContain("seconds       = 0.7");
  asked[0].answer({ carried: carried(1) });
  await settle();
  expect(machines.value.map((m) => [m.place, m.label, m.name])).toEqual([[1, "Eight-bar 1324b", "eight-bar-1324b.toml"]]);
  expect(machines.value[0].numbers).toEqual([{ label: "links", text: "8" }, { label: "rms error", text: "0.4\u202fmm" }, { label: "chamfer distance", text: "1.23\u202f%" }, { label: "least pair angle", text: "30°" }]);
  expect(asked[1].task.text).toContain("seconds       = 2\n");
  asked[1].answer({ carried: carried(2) });
  await settle();
  expect(machines.value.map((m) => m.label)).toEqual(["Eight-bar 1324b", "a machine"]);
  wishes.value = { ...wishes.value, mostLinks: 6 };
  expect(stops()).toBe(1);
  await settle();
  expect(asked[3].task.text).toContain("most_links = 6");
  expect(asked[3].task.text).toContain("seconds       = 0.7");
  stopSearch();
  await settle();
  expect([round.value, stops(), machines.value.length]).toEqual([null, 2, 2]);
  startSearch();
  for (let k = 4; k < 4 + rounds.length; ++k) {
    asked[k].answer({ carried: carried(2) });
    await settle();
  }
  expect([round.value, ended.value, asked.length]).toEqual([null, rounds.length, 8]);
  end();
});

test("errors of the engine are shown, and end the search", async () => {
  const { engine, asked } = engineOf();
  const end = connectSearch(() => engine);
  takePath({ points: arc.slice(0, 30), closed: false });
  asked[asked.length - 1].answer({ diagnostics: [{ severity: "error", key: "target.points_mm", message: "too few points", hint: "draw more" }] });
  await settle();
  expect(problems.value.map((p) => [p.key, p.message, p.hint])).toEqual([["target.points_mm", "too few points", "draw more"]]);
  expect([round.value, machines.value.length]).toEqual([null, 0]);
  end();
});

test("the board goes back and forth, and a stroke at the end of the path continues it", () => {
  sheet.value = blankSheet;
  takeStroke(arc.slice(0, 30), 6);
  const first = sheet.value.path!;
  const end = first.points[first.points.length - 1];
  takeStroke([end, { x: end.x, y: end.y - 30 }, { x: end.x - 30, y: end.y - 30 }], 6);
  const second = sheet.value.path!;
  expect(second.points[0]).toEqual(first.points[0]);
  expect(second.points[second.points.length - 1].x).toBeCloseTo(end.x - 30, 9);
  takeStroke([{ x: 80, y: 70 }, { x: 40, y: 70 }], 6);
  expect(sheet.value.path!.points[0]).toEqual({ x: 80, y: 70 });
  undoPath();
  expect(sheet.value.path).toBe(second);
  undoPath();
  expect(sheet.value.path).toBe(first);
  redoPath();
  expect(sheet.value.path).toBe(second);
  closePath(true);
  expect(sheet.value.path!.closed).toBe(true);
  expect(canRedoPath.value).toBe(false);
  clearPath();
  expect(sheet.value).toBe(blankSheet);
  expect(canUndoPath.value).toBe(true);
});

test("the board shows paths of any size", () => {
  expect(frameFor({ points: arc, closed: false })).toBe(blankSheet.frame);
  const far = frameFor({ points: [{ x: 1000, y: 2000 }, { x: 3000, y: 2500 }], closed: false });
  expect(far.x).toBeLessThan(1000);
  expect(far.x + far.width).toBeGreaterThan(3000);
  expect(far.y + far.height / 2).toBeCloseTo(2250, 9);
  expect(frameFor({ points: [{ x: 0, y: 0 }, { x: 2, y: 1 }], closed: false }).width).toBeLessThan(5);
});

test("a link holds the path behind the mechanism, unless it is none", async () => {
  const stroke = { points_mm: [[0, 0], [10, 5]], closed: false };
  const document = { name: "a.toml", text: "schema = 1", files: {}, stroke };
  expect((await fromFragment(await asFragment(document)))?.stroke).toEqual(stroke);
  const wrong = { ...document, stroke: { points_mm: [[0, "x"]], closed: false } } as unknown as typeof document;
  expect((await fromFragment(await asFragment(wrong)))?.stroke).toBeUndefined();
});
