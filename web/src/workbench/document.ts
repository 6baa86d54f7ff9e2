// SPDX-License-Identifier: BSD-3-Clause

// The study that is being worked on: its text is the document, and every change of it can be undone.
import { batch, computed, signal } from "@preact/signals";
import { pack, unpack } from "../packed";

export interface Document {
  name: string;  // name of the file
  text: string;
  files: Record<string, string>;  // files that the study reads
  stroke?: { points_mm: number[][]; closed: boolean }; // path that is drawn behind its mechanism
}

const empty: Document = { name: "study.toml", text: "", files: {} };
export const document_ = signal<Document>(empty);
const past = signal<Document[]>([]);
const future = signal<Document[]>([]);
export const canUndo = computed(() => past.value.length > 0);
export const canRedo = computed(() => future.value.length > 0);
/** The gesture that made the last entry; a gesture is one entry, however many changes it makes. */
let gesture: unknown;

/** Another text for the study. Changes of one gesture are undone together. */
export function change(text: string, by: unknown = Symbol()): void {
  if (text === document_.peek().text) return;
  replace({ ...document_.peek(), text }, by);
}

export function replace(next: Document, by: unknown = Symbol()): void {
  batch(() => {
    if (by !== gesture || past.peek().length === 0) past.value = [...past.peek(), document_.peek()];
    gesture = by;
    future.value = [];
    document_.value = next;
  });
}

function step(from: typeof past, to: typeof past): void {
  const next = from.peek()[from.peek().length - 1];
  if (!next) return;
  batch(() => {
    to.value = [...to.peek(), document_.peek()];
    from.value = from.peek().slice(0, -1);
    document_.value = next;
    gesture = undefined;
  });
}
export const undo = () => step(past, future);
export const redo = () => step(future, past);

/** Begins with a document; what was before cannot be undone. */
export function begin(next: Document): void {
  batch(() => {
    document_.value = next;
    past.value = [];
    future.value = [];
    gesture = undefined;
  });
}

/** A document that was kept or came with a link; a stroke that is none is left out. */
function asDocument(read: Partial<Document> | null): Document | null {
  if (typeof read?.text !== "string") return null;
  const points: unknown = read.stroke?.points_mm;
  const drawn = Array.isArray(points) && points.every((p) => Array.isArray(p) && p.length === 2 && p.every(Number.isFinite));
  return { ...empty, ...read, stroke: drawn ? read.stroke : undefined };
}

// Pages opened from disk may have no storage, and then nothing is kept.
const place = "linkwright.workbench";
export function keep(document: Document): void {
  try {
    localStorage.setItem(place, JSON.stringify(document));
  } catch {
    // nowhere to keep it
  }
}
export function kept(): Document | null {
  try {
    const read = asDocument(JSON.parse(localStorage.getItem(place) ?? "null"));
    return read?.text ? read : null;
  } catch {
    return null;
  }
}

/** Forms in which a study can be taken along, and what makes each. */
export const copies = { "command line": asCommand, Python: asPython, "C++": asCpp };

/** The command that runs a study in a terminal: the files that it reads are written first, and nothing in them is taken for anything
 *  but text. */
export function asCommand({ text, files }: Document): string {
  const here = (command: string, content: string) => {
    const lines = content.split("\n");
    let mark = "END";
    while (lines.includes(mark)) mark += "_";
    return `${command} <<'${mark}'\n${content}${content.endsWith("\n") ? "" : "\n"}${mark}\n`;
  };
  const quoted = (name: string) => `'${name.replace(/'/g, "'\\''")}'`;
  return Object.entries(files).map(([name, content]) => here(`cat > ${quoted(name)}`, content)).join("") + here("linkwright run -", text);
}

export function asPython({ text, files }: Document): string {
  const quoted = (content: string) => `"""\\\n${content.replace(/\\/g, "\\\\").replace(/"""/g, '\\"""').replace(/"$/, '\\"')}"""`;
  const written = Object.entries(files).map(([name, content]) => `pathlib.Path(${JSON.stringify(name)}).write_text(${quoted(content)})\n`);
  return `${written.length ? "import pathlib\n\n" : ""}import linkwright

${written.join("")}study = linkwright.Study(${quoted(text)})
result = study.run()
print(result.headline)
`;
}

/** A program against the library: c++ -std=c++20 study.cpp $(pkg-config --cflags --libs linkwright) */
export function asCpp({ text, files }: Document): string {
  const quoted = (content: string) => {
    let mark = "";
    while (content.includes(`)${mark}"`)) mark += "_";
    return `R"${mark}(${content})${mark}"`;
  };
  const written = Object.entries(files).map(([name, content]) => `  std::ofstream(${JSON.stringify(name)}) << ${quoted(content)};\n`);
  return `#include <cstdio>
${written.length ? "#include <fstream>\n" : ""}#include <optional>

#include "linkwright/studies.h"

constexpr const char* text = ${quoted(text)};

int main() {
  using namespace linkwright;
${written.join("")}  Diagnostics problems;
  const Value document = study::read_text(text, study::syntax_of({}, text), "study", problems);
  std::optional<study::Study> study;
  if (!has_errors(problems)) study = study::prepare(document, "study", {}, app::catalogue(), problems);
  for (const Diagnostic& problem : problems) std::printf("%s\\n", to_string(problem).c_str());
  if (!study) return 2;
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  std::printf("%s\\n", to_string(result.headline).c_str());
  for (const Table& table : result.tables)
    std::printf("%s: %zu columns\\n", table.name.c_str(), table.columns.size());
}
`;
}

/** The document as the fragment of an address: the link is the study, and no server sees it. */
export async function asFragment(document: Document): Promise<string> {
  return `#study=${await pack(JSON.stringify(document))}`;
}
export async function fromFragment(hash: string): Promise<Document | null> {
  const packed = /^#study=([\w-]+)$/.exec(hash)?.[1];
  if (!packed) return null;
  try {
    return asDocument(JSON.parse(await unpack(packed)));
  } catch {
    return null;
  }
}
