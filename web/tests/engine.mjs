// SPDX-License-Identifier: BSD-3-Clause

// The engine of the workbench against the program: every example study, number by number.
//   node engine.mjs ENGINE_FOLDER LINKWRIGHT [NAMES]
// Sine and cosine are not the same code in both, so that last digits differ. An analysis agrees to 1e-9 of the largest number of a
// column; a simulation to what its integrator is asked for; of a search, which ends within a tolerance and may end at another of many
// equal designs, the cost of the best design. What is otherwise is in engine_apart.json, with the reason.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

const [folder, named, names] = process.argv.slice(2);
const program = resolve(named);

/** Examples that a page does not run, or not to the same numbers, and why. */
const apart = JSON.parse(readFileSync(new URL("engine_apart.json", import.meta.url), "utf8"));

const createEngine = createRequire(import.meta.url)(resolve(folder, "engine.js"));
const engine = await createEngine({ wasmBinary: readFileSync(join(folder, "engine.wasm")) });
engine.FS.mkdirTree("/study");
const bytes = (text) => {
  const all = new TextEncoder().encode(text);
  const at = engine._malloc(all.length + 1);
  engine.HEAPU8.set(all, at);
  return [at, all.length];
};
const answer = () => {
  const at = engine._engine_json();
  const json = new TextDecoder().decode(engine.HEAPU8.subarray(at, at + engine._engine_json_size()));
  const first = engine._engine_numbers() / 8;
  const numbers = engine.HEAPF64.slice(first, first + engine._engine_numbers_count());
  return JSON.parse(json, (_, v) => (Array.isArray(v?.[""]) ? [...numbers.subarray(v[""][0], v[""][0] + v[""][1])].map((n) => (Number.isNaN(n) ? null : n)) : v));
};
const ask = (text) => {
  const [at, size] = bytes(text);
  engine._engine_run(at, size, 0, 0, 0, 0, 0);
  engine._free(at);
  return answer();
};

/** The first difference of two lists of numbers that is larger than rounding; "" = none. */
function difference(ours, theirs, where, near) {
  if (ours.length !== theirs.length) return `${where}: ${ours.length} numbers, ${theirs.length} of the program`;
  const size = theirs.reduce((m, v) => (typeof v === "number" ? Math.max(m, Math.abs(v)) : m), 0);
  for (let i = 0; i < ours.length; ++i) {
    const [a, b] = [ours[i], theirs[i]];
    if (typeof a !== "number" || typeof b !== "number") {
      if (a !== b) return `${where}[${i}]: ${a}, ${b} of the program`;
    } else if (Math.abs(a - b) > near * Math.max(size, 1)) return `${where}[${i}]: ${a}, ${b} of the program`;
  }
  return "";
}

const cost = (result) => Object.values(result.solutions[0]?.objectives ?? {})[0] ?? 0;

function compare(ours, theirs) {
  if (ours.status !== theirs.status) return `status ${ours.status}, ${theirs.status} of the program`;
  const { kind } = theirs.study;
  if (kind === "synthesis" || kind === "balancing") {
    const [a, b] = [cost(ours), cost(theirs)];
    return Math.abs(a - b) <= 1e-6 * Math.max(Math.abs(a), Math.abs(b)) + 1e-12 ? "" : `the best design costs ${a}, ${b} of the program`;
  }
  for (const [k, table] of theirs.tables.entries())
    for (const [c, column] of table.columns.entries()) {
      const found = difference(ours.tables[k]?.data[c] ?? [], table.data[c], `${table.name}.${column.key}`, kind === "analysis" ? 1e-9 : 1e-6);
      if (found) return found;
    }
  return "";
}

engine._engine_catalogue();
const { examples } = answer();
const out = mkdtempSync(join(tmpdir(), "linkwright-engine-"));
let wrong = 0;
let same = 0;
const asked = names?.split(",");
for (const example of examples) {
  if (asked ? !asked.includes(example.name) : apart[example.name]) continue;
  for (const [name, text] of Object.entries(example.beside)) engine.FS.writeFile(`/study/${name}`, text);
  // A seed does all that many do.
  const text = example.text.replace(/(^seeds\s*=\s*\{.*count\s*=\s*)\d+/m, "$11");
  const begin = performance.now();
  const ours = ask(text);
  const middle = performance.now();
  for (const [name, content] of Object.entries({ ...example.beside, [`${example.name}.toml`]: text })) writeFileSync(join(out, name), content);
  const run = spawnSync(program, ["run", `${example.name}.toml`, "--json"], { cwd: out, encoding: "utf8", maxBuffer: 1 << 30 });
  const end = performance.now();
  let problem = ours.failure ?? (ours.view ? "" : ours.diagnostics.map((d) => d.message).join("; "));
  if (!problem) problem = run.stdout ? compare(ours.result, JSON.parse(run.stdout)) : `the program: ${run.error ?? run.stderr}`;
  if (problem) {
    ++wrong;
    console.log(`${example.name}: ${problem}`);
  } else {
    ++same;
    console.log(`${example.name}: as the program; ${Math.round(middle - begin)} ms, the program ${Math.round(end - middle)} ms with its start`);
  }
}
rmSync(out, { recursive: true });
console.log(`${same} studies give the numbers of the program, ${wrong} do not, ${Object.keys(apart).length} are told apart`);
process.exit(wrong ? 1 : 0);
