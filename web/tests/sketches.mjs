// SPDX-License-Identifier: BSD-3-Clause

// Random sketches of the drawing board: what it lets move, the program accepts and computes. Linkages are put together from a crank and
// dyads, then whatever tool presses anywhere; of each that lacks nothing the study is run.
//   vite-node tests/sketches.mjs LINKWRIGHT [COUNT [SEED]]
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { missing } from "../src/workbench/mobility.ts";
import { bodiesAt, kinds, studyOf } from "../src/workbench/sketch.ts";
import { tools } from "../src/workbench/tools.ts";

const [program, count = "300", seed = "1"] = process.argv.slice(2);
// mulberry32
let state = Number(seed);
const random = () => {
  state = (state + 0x6d2b79f5) | 0;
  let t = Math.imul(state ^ (state >>> 15), 1 | state);
  t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
  return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
};
const below = (n) => Math.floor(random() * n);
const pick = (list) => list[below(list.length)];
const somewhere = () => ({ x: 10 * (below(41) - 20), y: 10 * (below(31) - 15) });

/** A board, and presses on it as a hand makes them. */
function board() {
  let now = { sketch: { pins: [], links: [], elements: [] }, from: null };
  const press = (name, place, drag) => {
    const at = (p) => ({ ...p, reach: 6, grid: 10, more: false });
    const done = tools.find((t) => t.name === name).press(now.sketch, at(place), now.from);
    if (!done) return;
    now = { sketch: drag && done.drag ? done.drag(done.sketch, at(drag)) : done.sketch, from: done.from === undefined ? now.from : done.from };
  };
  return {
    get sketch() { return now.sketch; },
    press,
    lift: () => (now = { ...now, from: null }),
    /** A place that is drawn already: a pin, or one on a link. */
    drawn() {
      const { pins, links } = now.sketch;
      if (!links.length || random() < 0.6) return pick(pins);
      const [a, b] = pick(links).map((i) => pins[i]);
      const share = 0.3 + 0.4 * random();
      return { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) };
    },
  };
}
function chain(b, ...places) {
  b.lift();
  for (const place of places) b.press("link", place);
  b.lift();
}
function linkage() {
  const b = board();
  const [o, a] = [somewhere(), somewhere()];
  chain(b, o, a);
  b.press("ground", o);
  for (let dyads = below(4); dyads > 0; --dyads) {
    const from = b.drawn();
    if (random() < 0.5) b.press("trace", from); // a point on a link, from which the next one goes
    const [m, to] = [somewhere(), random() < 0.6 ? somewhere() : b.drawn()];
    if (random() < 0.3) {
      chain(b, from, m);
      b.press("guide", m, random() < 0.7 ? somewhere() : undefined);
    } else {
      const held = b.sketch.pins.length;
      chain(b, from, m, to);
      if (b.sketch.pins.length > held + 1 || random() < 0.3) b.press("ground", to);
    }
  }
  if (random() < 0.25) { // one more freedom, for gears
    const [p, q] = [somewhere(), somewhere()];
    chain(b, p, q);
    b.press("ground", p);
    b.press("gear", o);
    b.press("gear", p);
  }
  b.press("drive", random() < 0.5 ? o : pick(b.sketch.pins));
  for (let more = below(6); more > 0; --more) {
    const tool = pick(tools).name;
    if (tool === "link") b.lift();
    b.press(tool, random() < 0.8 ? b.drawn() : somewhere(), somewhere());
    if (["spring", "damper", "gear", "link"].includes(tool)) b.press(tool, b.drawn());
    b.lift();
  }
  // Numbers as they may be typed.
  const typed = (least) => pick([0, 1, 1e-3, 20 * random(), least < 0 ? -20 * random() : 1000 * random(), 1e6]);
  return { ...b.sketch, elements: b.sketch.elements.map((e) => ({ ...e, values: { ...e.values, ...Object.fromEntries(kinds[e.kind].numbers(b.sketch, e).filter(() => random() < 0.3).map(({ key, least }) => [key, typed(least)])) } })) };
}

const folder = mkdtempSync(join(tmpdir(), "linkwright-sketches-"));
process.on("exit", () => rmSync(folder, { recursive: true }));
const reasons = new Map();
const statuses = new Map();
const seen = { elements: new Map(), moving: 0, gears: 0 };
const note = (map, word) => map.set(word, (map.get(word) ?? 0) + 1);
let run = 0;
for (let i = 0; i < Number(count); ++i) {
  const sketch = linkage();
  const lacks = missing(sketch);
  note(reasons, lacks.replace(/\b[A-Z]\d*\b|\d+/g, "*") || "moves");
  if (lacks) continue;
  ++run;
  for (const e of sketch.elements) note(seen.elements, e.kind);
  const drive = sketch.elements.find((e) => e.kind === "drive");
  if (!sketch.pins[drive.pins[0]].ground && sketch.pins[drive.pins[0]].guide === null) ++seen.moving;
  assert.ok(sketch.pins.every((_, k) => bodiesAt(sketch, k).length > 0));
  const text = studyOf(sketch);
  writeFileSync(join(folder, "sketch.toml"), text);
  const done = spawnSync(program, ["run", "sketch.toml", "--json"], { cwd: folder, encoding: "utf8", maxBuffer: 1 << 28 });
  assert.ok(done.stdout, `sketch ${i} of seed ${seed} is refused:\n${done.stderr}\n${text}`);
  const result = JSON.parse(done.stdout);
  note(statuses, result.status);
  assert.ok(!result.tables[0].columns.some((c) => c.key === "status") || result.tables[0].data.length > 0);
  if (process.env.SHOW?.split(",").includes(result.status)) console.log(`sketch ${i}: ${result.status}: ${result.answer?.headline}\n${process.env.TEXT ? text : ""}`);
}
for (const [words, map] of [["of all", reasons], ["of those that move", statuses], ["elements", seen.elements]]) console.log(`${words}: ${[...map].sort((a, b) => b[1] - a[1]).map(([word, n]) => `${n} ${word}`).join("; ")}`);
console.log(`${run} of ${count} move, ${seen.moving} of them driven between links`);
// A test of nothing proves nothing.
assert.ok(run > Number(count) / 10 && seen.moving > 0);
