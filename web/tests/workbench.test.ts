// SPDX-License-Identifier: BSD-3-Clause
import { beforeEach, expect, test } from "vitest";
import example from "../../examples/cpp/any_study.cpp?raw";
import type { JsonObject, Scene } from "../src/data";
import { asCommand, asCpp, asFragment, begin, canRedo, canUndo, change, document_, fromFragment, redo, undo } from "../src/workbench/document";
import { withNumbers } from "../src/workbench/engine";
import { sortOut } from "../src/workbench/files";
import { gripPoint, gripTarget, guided, moveTo, valueOf, within } from "../src/workbench/handles";
import { places, possible, withLoad } from "../src/workbench/loads";
import { numbersOf, unitKey } from "../src/workbench/numbers";
import { along, listOf, pastedRows, tidy, withoutPoint, withPoint, withPose } from "../src/workbench/points";
import { absent, nodeAt, ruleAt, ruleOf } from "../src/workbench/schema";

const paper = { name: "a.toml", text: "one", files: {} };

beforeEach(() => begin(paper));

test("undo goes back to the exact document, gesture by gesture, and redo forward", () => {
  const drag = Symbol();
  change("two", drag);
  change("three", drag);
  change("four");
  expect(document_.value.text).toBe("four");
  undo();
  expect(document_.value.text).toBe("three");
  undo();
  expect(document_.value).toEqual(paper);
  expect(canUndo.value).toBe(false);
  redo();
  redo();
  expect(document_.value.text).toBe("four");
  expect(canRedo.value).toBe(false);
});

test("a change after an undo ends what could be done again", () => {
  change("two");
  undo();
  change("other");
  expect(canRedo.value).toBe(false);
  undo();
  expect(document_.value.text).toBe("one");
});

test("two gestures are two entries, and the same text is none", () => {
  change("two", 1);
  change("two", 2);
  change("three", 2);
  undo();
  expect(document_.value.text).toBe("two");
});

test("a link holds the whole document", async () => {
  const document = { name: "leg.toml", text: "title = \"Jansen \u2013 \u00fcber\"\n".repeat(400), files: { "a.csv": "x,y\n1,2\n" } };
  const hash = await asFragment(document);
  expect(hash.length).toBeLessThan(600);
  expect(await fromFragment(hash)).toEqual(document);
  for (const other of ["", "#scene=motion", "#study=%%%", "#study=AAAA", "#study=x"]) expect(await fromFragment(other)).toBeNull();
});

test("a study is a command of a terminal, whatever stands in it", () => {
  expect(asCommand({ name: "a.toml", text: "title = \"$HOME `x`\"", files: {} })).toBe("linkwright run - <<'END'\ntitle = \"$HOME `x`\"\nEND\n");
  expect(asCommand({ name: "a.toml", text: "a\nEND\n", files: { "o'ne.csv": "1,2\n" } }))
    .toBe("cat > 'o'\\''ne.csv' <<'END'\n1,2\nEND\nlinkwright run - <<'END_'\na\nEND\nEND_\n");
});

test("lists of numbers come back into their document", () => {
  const numbers = Float64Array.of(9, 1, NaN, 3);
  expect(withNumbers('{"a": {"": [1, 3]}, "b": [{"x": {"": [0, 1]}}], "c": []}', numbers)).toEqual({ a: [1, null, 3], b: [{ x: [9] }], c: [] });
});

test("lists of the tables of a result are made when they are asked for, and once", () => {
  const numbers = new Float64Array([1, 2, NaN, 4]);
  const read = withNumbers('{"result": {"tables": [{"name": "t", "data": [{"": [0, 2]}, ["done", "done"], {"": [2, 2]}]}]}}', numbers);
  const [table] = (read.result as JsonObject).tables as JsonObject[];
  numbers[0] = 7;  // numbers read later than this have it
  expect(table.data).toEqual([[7, 2], ["done", "done"], [null, 4]]);
  expect(table.data).toBe(table.data);
  expect(Object.keys(table)).toEqual(["name", "data"]);
});

// A link of 2 m on the ground's pivot at (1, 1), upright at the second sample.
const scene = {
  input: [0, 1],
  points: [
    { name: "O", x: [1], y: [1] },
    { name: "O", x: [1, 1], y: [1, 1] },
    { name: "A", x: [3, 1], y: [1, 3] },
    { name: "A", x: [3, 1], y: [1, 3] },
  ],
  frames: [
    { x: [0], y: [0], angle: [0] },
    { x: [1, 1], y: [1, 1], angle: [0, Math.PI / 2] },
    { x: [3, 1], y: [1, 3], angle: [0.5, 0.5] },
  ],
  handles: [
    { key: "ground.O", measure: "place", frame: 0, point: 0, target: -1, index: 0, from: -1, held: false },
    { key: "crank.O", measure: "place", frame: 1, point: 1, target: -1, index: 0, from: -1, held: false },
    { key: "crank.A", measure: "place", frame: 1, point: 2, target: -1, index: 0, from: -1, held: false },
    { key: "rod.A", measure: "place", frame: 2, point: 3, target: -1, index: 0, from: -1, held: false },
    { key: "target.points_m[4]", measure: "place", frame: -1, point: -1, target: 0, index: 4, from: -1, held: false },
  ],
} as unknown as Scene;

const close = (edits: { key: string; value: unknown }[]) => edits.map(({ key, value }) => [key, (value as number[]).map((v) => Math.round(v * 1e9) / 1e9 + 0)]);

test("a pin is held with all bodies on it, each in its own frame", () => {
  const grip = gripPoint(scene, 3, 1, 4)!;
  expect(grip.handles.map((h) => h.key)).toEqual(["crank.A", "rod.A"]);
  expect(grip.fixed).toBe(false);
  const edits = moveTo(scene, grip, { x: 1.5, y: 4 });
  const turn = [0.5 * Math.cos(0.5) + Math.sin(0.5), -0.5 * Math.sin(0.5) + Math.cos(0.5)].map((v) => Math.round(v * 1e9) / 1e9);
  expect(close(edits)).toEqual([["crank.A", [3, -0.5]], ["rod.A", turn]]);
});

test("a pivot moves with the link on it, or alone, and then the link keeps its length", () => {
  const grip = gripPoint(scene, 0, 0, 4)!;
  expect(grip.fixed).toBe(true);
  expect(close(moveTo(scene, grip, { x: 0, y: 2 }))).toEqual([["ground.O", [0, 2]], ["crank.O", [-1, 1]]]);
  expect(close(moveTo(scene, grip, { x: 0, y: 2 }, true))).toEqual([["ground.O", [0, 2]]]);
});

test("a target is held by its place in the list", () => {
  expect(moveTo(scene, gripTarget(scene, 0, 4, 0)!, { x: 7, y: 8 })).toEqual([{ key: "target.points_m[4]", value: [7, 8] }]);
  expect(gripTarget(scene, 0, 3, 0)).toBeNull();
});

// A four-bar by its lengths: pivots (0, 0) and (4, 0), pins (0, 1) and (3, 2), a coupler point.
const point = (name: string, x: number, y: number) => ({ name, x: [x], y: [y] });
const number = (key: string, measure: string, at: number, from = -1, held = false, frame = -1) => ({ key, measure, frame, point: at, target: -1, index: 0, from, held });
const fourBar = {
  input: [0],
  points: [point("O1", 0, 0), point("O4", 4, 0), point("O1", 0, 0), point("O2", 0, 1), point("O2", 0, 1), point("O3", 3, 2), point("C", 1, 3), point("O4", 4, 0), point("O3", 3, 2)],
  frames: [{ x: [0], y: [1], angle: [Math.PI / 2] }],
  handles: [
    number("crank", "length", 3, 2, true), number("coupler", "length", 5, 4), number("rocker", "length", 8, 7), number("ground", "length", 1, 0),
    number("frame_angle", "angle", 1, 0), number("pivot_x", "x", 0), number("pivot_y", "y", 0),
    number("u", "x", 6, 4, false, 0), number("v", "y", 6, 4, false, 0),
  ],
} as unknown as Scene;
const drag = (at: number, x: number, y: number) =>
  Object.fromEntries(moveTo(fourBar, gripPoint(fourBar, at, 0, 4)!, { x, y }, false, { frame_angle: 0.25 }).map(({ key, value }) => [key, Math.round((value as number) * 1e9) / 1e9]));

test("a pin of a four-bar sets the links on it, and all other pins stay", () => {
  expect(drag(5, 4, 2)).toEqual({ coupler: Math.round(Math.hypot(4, 1) * 1e9) / 1e9, rocker: 2 });
  // The crank has the direction of the input, so that the pin stays on its line and the coupler fits.
  expect(drag(3, 5, 2)).toEqual({ crank: 2, coupler: 3 });
  expect(drag(3, 0, -9).crank).toBe(0.001);
});

test("the pivots of a four-bar turn and take it along", () => {
  expect(drag(1, 0, 3)).toEqual({ ground: 3, frame_angle: Math.round((0.25 + Math.PI / 2) * 1e9) / 1e9 });
  expect(drag(0, -1, 2)).toEqual({ pivot_x: -1, pivot_y: 2 });
  expect(drag(6, 2, 2)).toEqual({ u: 1, v: -2 });
});

test("what no number of the study makes cannot be held", () => {
  const lone = { ...fourBar, handles: [number("rod", "length", 3, 5)] } as unknown as Scene;
  expect(gripPoint(lone, 5, 0, 4)).toBeNull();
  expect(gripPoint(lone, 3, 0, 4)!.handles.length).toBe(1);
});

test("a hard point moves by what it is away from where it is drawn", () => {
  const space = {
    input: [0, 1], points: [{ name: "P", x: [1, 1.1], y: [2, 2], z: [0, 0.5] }], frames: [],
    handles: [number("link[0].body_m", "place", 0)],
  } as unknown as Scene;
  const grip = gripPoint(space, 0, 1, 1)!;
  const [edit] = moveTo(space, grip, { x: 1.2, y: 2, z: 0.4 }, false, { link: [{ body_m: [1, 2, 0] }] });
  expect(edit.key).toBe("link[0].body_m");
  expect((edit.value as number[]).map((v) => Math.round(v * 1e9) / 1e9)).toEqual([1.1, 2, -0.1]);
  expect(moveTo(space, grip, { x: 1.2, y: 2, z: 0.4 }, false, {})).toEqual([]);
});

test("values are found by their keys", () => {
  const study = { mechanism: { link: [{ body_m: [[1, 2], [3, 4]] }], arm_m: 0.5 } };
  expect(valueOf(study, "mechanism.link[0].body_m[1]")).toEqual([3, 4]);
  expect(valueOf(study, "mechanism.arm_m")).toBe(0.5);
  for (const none of ["mechanism.rod_m", "mechanism.arm_m.x", "mechanism.link[3].body_m"]) expect(valueOf(study, none)).toBeNull();
  expect(valueOf(null, "mechanism")).toBeNull();
});

test("the numbers of a study come in its groups, with their keys", () => {
  const study = {
    schema: 1, kind: "analysis",
    mechanism: { type: "planar.linkage", moment_centre_m: [0, 0], body: [{ name: "crank", points_m: { O: [0, 0], A: [0.1, 0] }, mass_kg: 2 }] },
    drive: [{ joint: "O", speed_rad_per_s: 6 }],
    output: { samples: 361 },
  };
  const groups = numbersOf(study);
  expect(groups.map((g) => g.title)).toEqual(["mechanism", "body crank", "drive 1"]);
  expect(groups[1].entries.map((e) => [e.key, e.value])).toEqual([
    ["mechanism.body[0].points_m.O[0]", 0], ["mechanism.body[0].points_m.O[1]", 0],
    ["mechanism.body[0].points_m.A[0]", 0.1], ["mechanism.body[0].points_m.A[1]", 0], ["mechanism.body[0].mass_kg", 2]]);
  expect(groups[2].entries[0].key).toBe("drive[0].speed_rad_per_s");
  expect(unitKey("mechanism.body[0].points_m.A[0]")).toBe("points_m");
  expect(unitKey("drive[0].speed_rad_per_s")).toBe("speed_rad_per_s");
});

const bounded = { type: "number", exclusiveMinimum: 0, maximum: 10, description: "length of the crank", unit: "m" };
const schema = {
  type: "object",
  properties: {
    mechanism: {
      type: "object",
      properties: {
        type: { const: "planar.four_bar" },
        branch: { oneOf: [{ const: "open", description: "B to the left" }, { const: "crossed", description: "B to the right" }], default: "open", description: "assembly branch" },
        parameters: { type: "object", properties: { crank_m: { anyOf: [bounded, { type: "object", properties: { min: bounded, max: bounded } }], description: "length of the crank" }, pivot_x_m: { type: "number", default: 0 } } },
        body: { type: "array", items: { type: "object", properties: { name: { type: "string" }, points_m: { type: "object", additionalProperties: { type: "array", items: { type: "number", minimum: -5 }, minItems: 2, maxItems: 2 } }, mass_kg: { type: "number", minimum: 0, description: "mass" }, at_m: { type: "array", items: { type: "number" }, minItems: 2, maxItems: 2 } } } },
      },
    },
    law: { oneOf: [{ type: "object", properties: { kind: { const: "a" }, rise_m: { type: "number", description: "of a" } } }, { type: "object", properties: { kind: { const: "b" }, rise_m: { type: "number", description: "of b" } } }] },
  },
} as unknown as JsonObject;

test("the schema tells what a number is for and between what it may lie", () => {
  const study = { mechanism: { type: "planar.four_bar", branch: "open", parameters: { crank_m: { min: 1, max: 2 } }, body: [{ name: "crank", points_m: { A: [0.1, 0] } }] }, law: { kind: "b", rise_m: 1 } };
  const rule = (key: string) => ruleOf(nodeAt(schema, study, key)!);
  expect(rule("mechanism.parameters.crank_m")).toMatchObject({ help: "length of the crank", least: 0, open: true, most: 10, free: true, count: 0 });
  expect(rule("mechanism.branch").choices).toEqual([{ value: "open", help: "B to the left" }, { value: "crossed", help: "B to the right" }]);
  expect(rule("mechanism.body[0].points_m.A[1]")).toMatchObject({ least: -5, open: false, free: false });
  expect(rule("law.rise_m").help).toBe("of b");
  for (const none of ["mechanism.rod_m", "mechanism.body[0].name.x"]) expect(nodeAt(schema, study, none)).toBeNull();
  const groups = numbersOf(study, schema);
  expect(groups.map((g) => [g.title, g.path])).toEqual([["mechanism", "mechanism"], ["parameters", "mechanism.parameters"], ["body crank", "mechanism.body[0]"], ["law", "law"]]);
  expect(groups[0].entries.map((e) => [e.key, e.value])).toEqual([["mechanism.branch", "open"]]);
  expect(groups[1].entries[0].value).toEqual({ min: 1, max: 2 });
});

test("rules are kept while numbers change, and found again when words do", () => {
  const study = (rise: number, kind: string) => ({ law: { kind, rise_m: rise } });
  const first = ruleAt(schema, study(1, "b"), "law.rise_m");
  expect(first?.help).toBe("of b");
  expect(ruleAt(schema, study(2, "b"), "law.rise_m")).toBe(first);
  expect(ruleAt(schema, study(2, "a"), "law.rise_m")?.help).toBe("of a");
  expect(ruleAt(null, study(2, "a"), "law.rise_m")).toBeNull();
});

test("what a table may have and has not can be added, with what it begins with", () => {
  const study = { mechanism: { type: "planar.four_bar", parameters: { crank_m: 1 }, body: [{ name: "crank", mass_kg: 2 }] } };
  expect(absent(schema, study, "mechanism").map((a) => [a.key, a.start])).toEqual([["mechanism.branch", "open"]]);
  expect(absent(schema, study, "mechanism.parameters").map((a) => [a.key, a.start])).toEqual([["mechanism.parameters.pivot_x_m", 0]]);
  expect(absent(schema, study, "mechanism.body[0]").map((a) => [a.key, a.start])).toEqual([["mechanism.body[0].at_m", [0, 0]]]);
  expect(absent(null, study, "mechanism")).toEqual([]);
});

test("what is locked stays while its neighbours are dragged", () => {
  const grip = gripPoint(fourBar, 5, 0, 4, new Set(["coupler"]))!;
  expect(moveTo(fourBar, grip, { x: 4, y: 2 }).map((e) => e.key)).toEqual(["rocker"]);
  expect(gripPoint(fourBar, 5, 0, 4, new Set(["coupler", "rocker"]))).toBeNull();
});

test("target points are set by hand", () => {
  const study = { target: { points_m: [[0, 0], [1, 0], [1, 1]] } };
  const scene = { handles: [{ key: "target.points_m[0]", point: -1, frame: -1, target: 0, index: 0 }] } as unknown as Scene;
  expect([listOf(scene), listOf(undefined), listOf({ handles: [] } as unknown as Scene)]).toEqual(["target.points_m", "", ""]);
  expect(withPoint(study, "target.points_m", { x: 0.123456, y: -2 / 3 }, 2)).toEqual({ key: "target.points_m", value: [[0, 0], [1, 0], [1, 1], [0.1235, -0.6667]] });
  expect(withoutPoint(study, "target.points_m", 1)).toEqual([{ key: "target.points_m", value: [[0, 0], [1, 1]] }]);
  expect(withoutPoint({ target: { points_m: [[0, 0], [1, 0]] } }, "target.points_m", 1)).toEqual([]);
  expect([tidy(12.34567, 100), tidy(0.000123456, 1e-3), tidy(1234.5, 1e6)]).toEqual([12.35, 0.0001235, 1235]);
});

test("points at equal steps lie on what was drawn", () => {
  const line = along([{ x: 0, y: 0 }, { x: 1, y: 0 }, { x: 1, y: 0 }, { x: 4, y: 0 }], 5, 10);
  expect(line).toEqual({ points: [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0]], closed: false });
  const ring = along([{ x: 0, y: 0 }, { x: 2, y: 0 }, { x: 2, y: 2 }, { x: 0, y: 2 }, { x: 0, y: 0.1 }], 8, 10);
  expect(ring.closed).toBe(true);
  expect(ring.points).toHaveLength(8);
  expect(ring.points.slice(0, 3)).toEqual([[0, 0], [1, 0], [2, 0]]);
  expect(ring.points[7]).toEqual([0, 1]);
});

test("a pin on a guide is dragged along it", () => {
  const study: JsonObject = { mechanism: { type: "planar.linkage",
    body: [{ name: "ground", points_m: { G: [0, 1] } }, { name: "rod", points_m: { B: [2, 0] } }, { name: "slider", points_m: { B: [0, 0] } }],
    joint: [{ type: "revolute", first: "rod.B", second: "slider.B", direction_rad: 0 }, { type: "prismatic", first: "ground.G", second: "slider.B", direction_rad: Math.PI / 6 }] } };
  const scene = { handles: [] } as unknown as Scene;
  const handles = (key: string) => [{ key, measure: "place", point: 0, from: -1, frame: -1, target: -1, index: -1, held: false }] as NonNullable<Scene["handles"]>;
  const grip = { handles: handles("mechanism.body[2].points_m.B"), points: [0], at: { x: 1, y: 1 }, sample: 0, fixed: false, bound: false };
  const to = within(scene, guided(scene, grip, study), { x: 3, y: 1 })!;
  expect(to.x).toBeCloseTo(1 + 2 * Math.cos(Math.PI / 6) ** 2, 12);
  expect(to.y).toBeCloseTo(1 + 2 * Math.cos(Math.PI / 6) * Math.sin(Math.PI / 6), 12);
  // The guide itself is put where one likes, and so is a pin on none.
  for (const key of ["mechanism.body[0].points_m.G", "mechanism.body[1].points_m.A"]) expect(guided(scene, { ...grip, handles: handles(key) }, study).along).toBeUndefined();
});

test("of files that are dropped the study is found, and the tables beside it", async () => {
  const [toml, table] = [{ name: "a.toml", text: "schema = 1" }, { name: "path.csv", text: "x_m,y_m\n0,0" }];
  expect(await sortOut([table, toml])).toEqual({ study: toml, tables: { "path.csv": table.text } });
  expect(await sortOut([table])).toEqual({ study: null, tables: { "path.csv": table.text } });
  // A result holds its study; a study in JSON is one.
  const study = { schema: 1, kind: "analysis" };
  const of = async (text: string) => (await sortOut([{ name: "result.json", text }])).study!.text;
  expect(JSON.parse(await of(JSON.stringify({ study, tables: [] })))).toEqual(study);
  expect(await of(JSON.stringify(study))).toBe(JSON.stringify(study));
  expect(await of("{ broken")).toBe("{ broken");
});

test("the program in C++ is the example that the tests of the library build", () => {
  const text = /R"\(([^]*?)\)"/.exec(example)![1];
  expect(asCpp({ name: "hoeken.toml", text, files: {} })).toBe(example);
  // Texts do not end the literal.
  expect(asCpp({ name: "a", text: 'title = ")"', files: {} })).toContain('R"_(title = ")")_"');
  expect(asCpp({ name: "a", text: "", files: { "t.csv": "1,2" } })).toContain('std::ofstream("t.csv") << R"(1,2)";');
});

test("poses are a list of tables: one more, one less, moved by their origin and turned by their body", () => {
  const handle = { measure: "x", frame: -1, point: -1, target: 0, index: 1, from: -1, held: false };
  const posed = {
    input: [0],
    points: [{ name: "A", x: [2], y: [1] }, { name: "P", x: [1], y: [1] }],
    targets: [{ x: [0, 1], y: [0, 1] }],
    handles: [{ ...handle, key: "target.pose[1].x_m" }, { ...handle, key: "target.pose[1].y_m", measure: "y" }, { ...handle, key: "target.pose[1].angle_rad", measure: "angle", point: 0, from: 1 }],
  } as unknown as Scene;
  const study = { target: { pose: [{ x_m: 0, y_m: 0, angle_rad: 0 }, { x_m: 1, y_m: 1, angle_rad: 6 }, { x_m: 2, y_m: 0, angle_rad: 0.5 }] } };
  expect(listOf(posed)).toBe("target.pose");
  expect(moveTo(posed, gripTarget(posed, 0, 1, 0)!, { x: 3, y: 4 }, false, study)).toEqual([{ key: "target.pose[1].x_m", value: 3 }, { key: "target.pose[1].y_m", value: 4 }]);
  // The angle goes on from where it was, beyond a turn.
  expect(moveTo(posed, gripPoint(posed, 0, 0, 4)!, { x: 1, y: 9 }, false, study)).toEqual([{ key: "target.pose[1].angle_rad", value: 6 + Math.PI / 2 }]);
  expect(withPose(study, "target.pose", [{ x: 1, y: 2 }], 4)).toEqual({ key: "target.pose[3]", value: { x_m: 1, y_m: 2, angle_rad: 0.5 } });
  expect(withPose(study, "target.pose", [{ x: 1, y: 2 }, { x: 1, y: 3 }], 4).value).toEqual({ x_m: 1, y_m: 2, angle_rad: Math.PI / 2 });
  expect(withoutPoint(study, "target.pose", 1)).toEqual([{ key: "target.pose[1]", value: null }]);
  expect(withoutPoint({ target: { pose: study.target.pose.slice(1) } }, "target.pose", 1)).toEqual([]);
});

test("rows are pasted as spreadsheets of any country write them", () => {
  for (const text of ["1\t2.5\n3\t4\n", "1;2,5\r\n3;4\r\n", "1 2.5\n\n3 4", "1, 2.5\n3, 4", "1,2.5\n3,4"]) expect(pastedRows(text, 1), text).toEqual([[1, 2.5], [3, 4]]);
  expect(pastedRows("\u22121\t2", 1000)).toEqual([[-0.001, 0.002]]);
  for (const text of ["", "7", "x\ty", "1\t2\t3"]) expect(pastedRows(text, 1), text).toBeNull();
});

test("loads go to the picked moving point, under names that are free", () => {
  const study = {
    mechanism: {
      type: "planar.linkage",
      body: [{ name: "ground", points_m: { O: [0, 0] } }, { name: "crank", points_m: { O: [0, 0], A: [0.1, 0] } }],
      force: [{ name: "force", point: "crank.A", force_N: [1, 0] }],
    },
  } as unknown as JsonObject;
  const list = (key: string) => ({ type: "array", items: { type: "object", properties: { [key]: { type: "string" } } } });
  const schema = { properties: { mechanism: { properties: { force: list("point"), torque: list("body") } } } } as unknown as JsonObject;
  expect(possible(study, schema)).toEqual(["force", "torque"]);
  expect(possible({ mechanism: { type: "planar.four_bar" } }, schema)).toEqual([]);
  expect(withLoad(study, "force", new Set(["mechanism.body[0].points_m.O", "mechanism.body[1].points_m.O"]))).toEqual({ key: "mechanism.force[1]", value: { name: "force 2", point: "crank.O", force_N: [0, -10] } });
  expect(withLoad(study, "torque", new Set())).toEqual({ key: "mechanism.torque[0]", value: { name: "torque", body: "crank", torque_N_m: 1 } });
  expect(withLoad(study, "trace", new Set())).toEqual({ key: "trace[0]", value: { point: "crank.A" } });
  expect(places(study, "mechanism.force[0].point")).toEqual(["ground.O", "crank.O", "crank.A"]);
  expect(places(study, "mechanism.torque[0].body")).toEqual(["ground", "crank"]);
  expect(places(study, "mechanism.force[0].name")).toEqual([]);
  expect(places(study, "mechanism.joint[0].first")).toEqual([]);
});
