// SPDX-License-Identifier: BSD-3-Clause

// Random drags of everything that the drawings of all samples can be held by: what is held is under the hand afterwards, the pins of a
// linkage of pins stay where they were at that input, no link changes its length while the mechanism moves, and no number changes that
// was not dragged. What would turn the linkage over to its other branch is refused, and it must be the smaller part. In space, hard points
// and joints are moved by small steps, as a pointer moves them, and no other joint goes further than such a step can take it: it would
// have turned over.
//   vite-node tests/drags.mjs ENGINE_FOLDER [COUNT [SEED]]
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { placeAt } from "../src/motion.ts";
import { gripPoint, guided, moveTo, reached, valueOf, within } from "../src/workbench/handles.ts";

const [folder, count = "2000", seed = "1"] = process.argv.slice(2);
const createEngine = createRequire(import.meta.url)(resolve(folder, "engine.js"));
const engine = await createEngine({ wasmBinary: readFileSync(join(folder, "engine.wasm")) });
engine.FS.mkdirTree("/study");
const bytes = (text) => {
  const all = new TextEncoder().encode(text);
  const at = engine._malloc(all.length + 1);
  engine.HEAPU8.set(all, at);
  return [at, all.length];
};
function answer() {
  const at = engine._engine_json();
  const json = new TextDecoder().decode(engine.HEAPU8.subarray(at, at + engine._engine_json_size()));
  const numbers = engine.HEAPF64;
  const first = engine._engine_numbers() / 8;
  return JSON.parse(json, (_, v) => (Array.isArray(v?.[""]) ? Array.from({ length: v[""][1] }, (_, i) => (Number.isNaN(numbers[first + v[""][0] + i]) ? null : numbers[first + v[""][0] + i])) : v));
}
function run(text, edits = []) {
  const [at, size] = bytes(text);
  const [made, length] = bytes(edits.length ? JSON.stringify({ edits }) : "");
  engine._engine_run(at, size, made, length, 0, 0, 0);
  engine._free(at);
  engine._free(made);
  return answer();
}
// mulberry32
let state = Number(seed);
const random = () => {
  state = (state + 0x6d2b79f5) | 0;
  let t = Math.imul(state ^ (state >>> 15), 1 | state);
  t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
  return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
};
const pick = (list) => list[Math.floor(random() * list.length)];

engine._engine_catalogue();
const { samples, kinds, examples } = answer();
/** Studies with several inputs need a sweep, which their examples have. */
const studyOf = (sample) => {
  const text = `schema = 1\nkind = "analysis"\n\n[mechanism]\ntype = "planar.linkage"\nsample = "${sample}"\n`;
  if (!run(text).diagnostics.some((d) => d.key === "sweep")) return text;
  return examples.find((e) => /kind *= *"analysis"/.test(e.text) && new RegExp(`sample *= *"${sample}"`).test(e.text))?.text;
};
const subjects = [
  ...samples.filter((s) => s.mechanisms.includes("planar.linkage")).map((s) => ({ name: s.name, text: studyOf(s.name) })).filter((s) => s.text),
  ...["planar.four_bar", "planar.slider_crank", "planar.serial_arm", "parallel.five_bar", "parallel.constant_orientation", "parallel.serial_pi_arm"]
    .map((type) => ({ name: type, text: kinds.find((k) => k.name === `analysis/${type}`).template })),
  // In space.
  ...samples.filter((s) => s.mechanisms.includes("suspension.corner")).map((s) => ({ name: s.name, space: true, text: `schema = 1\nkind = "analysis"\n\n[mechanism]\ntype = "suspension.corner"\nsample = "${s.name}"\n\n[sweep.travel]\ncoordinate = "wheel_centre_z"\nfrom_mm = -40.0\nto_mm = 40.0\nstep_mm = 10.0\n` })),
  ...["parallel.delta", "parallel.hexa"].map((type) => ({ name: type, space: true, text: kinds.find((k) => k.name === `analysis/${type}`).template })),
];

const count_ = (scene) => scene.input.length * (scene.second?.length || 1);
const place = (scene, point, sample) => placeAt(scene, point, sample);
const far = (a, b) => Math.hypot(a.x - b.x, a.y - b.y, (a.z ?? 0) - (b.z ?? 0));
function sizeOf(scene) {
  const all = scene.points.flatMap((_, k) => Array.from({ length: count_(scene) }, (_, i) => place(scene, k, i)).filter(Boolean));
  const span = (of) => Math.max(...all.map(of)) - Math.min(...all.map(of));
  return Math.max(span((p) => p.x), span((p) => p.y), span((p) => p.z ?? 0));
}

/** Bars and plates are as long at every sample. */
function lengthsHold(scene, size) {
  for (const body of scene.bodies.filter((b) => b.style === "bar" || b.style === "plate"))
    for (let k = 1; k < body.points.length; ++k) {
      const lengths = Array.from({ length: count_(scene) }, (_, i) => {
        const [p, q] = [place(scene, body.points[0], i), place(scene, body.points[k], i)];
        return p && q ? [far(p, q)] : [];
      }).flat();
      assert.ok(Math.max(0, ...lengths) - Math.min(Infinity, ...lengths) <= 1e-7 * size || !lengths.length, `${body.name} changes its length while it moves`);
    }
}
const step = 0.01;  // share of the size, for a drag in space
const lever = 30;  // largest ratio of the displacement of another joint to that of the dragged one

/** No joint goes further than a step of the drag can take it. */
function staysOnBranch(before, after, sample, size) {
  for (const { name, point } of before.joints) {
    const [p, q] = [place(before, point, sample), place(after, point, sample)];
    if (p && q) assert.ok(far(p, q) <= lever * step * size, `${name} goes ${far(p, q) / size} of the size`);
  }
}

/** What of the study is not among the edits, and not made from them: without their own numbers, masses follow the lengths. A
 *  sample that becomes text goes through the units of the text, which costs a last digit. */
function others(study, edits) {
  const copy = JSON.parse(JSON.stringify(study, (key, v) => (/^(inertia|centre)/.test(key) ? undefined : typeof v === "number" ? Number(v.toPrecision(12)) : v)));
  for (const { key } of edits) {
    const steps = key.match(/[^.[\]]+/g);
    const table = steps.slice(0, -1).reduce((at, step) => at[step], copy);
    delete table[steps.at(-1)];
  }
  return copy;
}

const fewer = (canonical) => (canonical.sweep?.input ?? []).map((_, i) => ({ key: `sweep.input[${i}].samples`, value: 25 }));
const begun = new Map();
const totals = { drags: 0, refused: 0, space: 0 };
for (let n = 0; n < Number(count); ++n) {
  const subject = subjects[n % subjects.length];
  if (!begun.has(subject.name)) {
    const first = run(subject.text);
    assert.deepEqual(first.diagnostics.filter((d) => d.severity === "error"), [], subject.name);
    const coarse = run(subject.text, fewer(first.canonical));
    assert.ok(coarse.view, `${subject.name}: ${JSON.stringify(coarse.diagnostics)}`);
    begun.set(subject.name, { start: coarse, now: coarse, steps: 0 });
  }
  const own = begun.get(subject.name);
  // A walk of twenty drags, then from the beginning.
  if (++own.steps % 20 === 0) own.now = own.start;
  const { text, canonical, view } = own.now;
  const scene = view.scenes[0];
  const size = sizeOf(scene);
  const points = [...new Set(scene.handles.map((h) => h.point))];
  const sample = Math.floor(random() * count_(scene));
  const free = gripPoint(scene, pick(points), sample, size);
  if (!free) continue; // not assembled there
  const grip = guided(scene, free, canonical);
  const off = () => (random() - 0.5) * (subject.space ? 2 * step / Math.sqrt(3) : 0.2) * size;
  const wish = { x: grip.at.x + off(), y: grip.at.y + off(), ...(grip.at.z === undefined ? {} : { z: grip.at.z + off() }) };
  const to = within(scene, grip, wish);
  const edits = moveTo(scene, grip, wish, false, canonical);
  const next = run(text, edits);
  ++totals.drags;
  const where = `${subject.name}, drag ${n}: ${JSON.stringify(edits)}`;
  try {
    const drawn = next.view?.scenes[0];
    assert.ok(drawn || next.diagnostics.length, "no view and no word why");
    if (!to || !drawn || (!subject.space && !reached(scene, drawn, grip, to, size, canonical))) {
      ++totals.refused;
      own.refused = (own.refused ?? 0) + 1;
      continue;
    }
    lengthsHold(drawn, size);
    if (subject.space) {
      staysOnBranch(scene, drawn, sample, size);
      ++totals.space;
    }
    assert.deepEqual(others(next.canonical, edits), others(canonical, edits));
    for (const { key, value } of edits) [valueOf(next.canonical, key)].flat().forEach((v, k) => assert.ok(Math.abs(v - [value].flat()[k]) <= 1e-6 * Math.max(size, Math.abs(v)), `${key} is ${v}`));
    own.now = next;
  } catch (error) {
    console.error(`${where}\nfrom\n${text}`);
    throw error;
  }
}
assert.ok(totals.refused < 0.15 * totals.drags, `${totals.refused} of ${totals.drags} drags are refused`);
console.log(`${totals.drags} drags of ${subjects.length} mechanisms (${totals.space} in space), ${totals.refused} of them refused at a dead point or another branch`);
