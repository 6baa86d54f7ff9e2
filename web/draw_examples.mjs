// SPDX-License-Identifier: BSD-3-Clause

// Draws all examples small, and the first study large, for the pages of the workbench (workbench.mjs):
//   vite-node draw_examples.mjs OUT.json ENGINE_FOLDER     with the engine, engine.js and engine.wasm
//   vite-node draw_examples.mjs OUT.json EXAMPLE_SCENES    with the program of that name
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { first } from "./src/workbench/first.ts";
import { large, small, thumbnail, viewBox } from "./src/workbench/thumbnail.ts";

const [out, source] = process.argv.slice(2);

async function ofEngine(folder) {
  const engine = await createRequire(import.meta.url)(resolve(folder, "engine.js"))({ wasmBinary: readFileSync(join(folder, "engine.wasm")) });
  engine.FS.mkdirTree("/study");
  const documents = [];
  for (;;) {
    engine._engine_example_scene(documents.length);
    const at = engine._engine_json();
    const read = JSON.parse(new TextDecoder().decode(engine.HEAPU8.subarray(at, at + engine._engine_json_size())));
    if (!read) return documents;
    if (read.failure) throw new Error(read.failure);
    documents.push(read);
  }
}

function ofProgram(program) {
  const folder = mkdtempSync(join(tmpdir(), "linkwright-examples-"));
  try {
    return execFileSync(resolve(program), [folder], { encoding: "utf8", maxBuffer: 1 << 30 }).split("\n").filter(Boolean).map((line) => JSON.parse(line));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const documents = statSync(source).isDirectory() ? await ofEngine(source) : ofProgram(source);
const { name, title, text, scene } = documents.find((d) => d.name === first);
const drawn = {
  examples: Object.fromEntries(documents.filter((d) => d.scene).map((d) => [d.name, thumbnail(d.scene, small)]).filter(([, picture]) => picture)),
  first: { name, title, text, viewBox: viewBox(large(scene)), picture: thumbnail(scene, large(scene)) },
};
writeFileSync(out, JSON.stringify(drawn));
