// SPDX-License-Identifier: BSD-3-Clause

// Runs beside the page: the engine, one question at a time. Before this script stands the one that emscripten makes (engine.js).
interface Module {
  HEAPU8: Uint8Array;
  HEAPF64: Float64Array;
  FS: { mkdirTree(path: string): void; writeFile(path: string, text: string): void; unlink(path: string): void };
  _malloc(size: number): number;
  _free(at: number): void;
  _engine_json(): number;
  _engine_json_size(): number;
  _engine_numbers(): number;
  _engine_numbers_count(): number;
  _engine_catalogue(): void;
  _engine_schema(kind: number, size: number): void;
  _engine_run(text: number, size: number, edits: number, editsSize: number, sharing: number, sharingSize: number, seconds: number): void;
}
declare function createEngine(options: object): Promise<Module>;
/** The part of a worker's own scope that is used; the types of the page do not know it. */
interface Scope {
  onmessage: ((event: MessageEvent<Question>) => void) | null;
  postMessage(message: Reply, transfer?: Transferable[]): void;
}

export type Question =
  | { id: number; ask: "start"; module: WebAssembly.Module }
  | { id: number; ask: "catalogue" }
  | { id: number; ask: "schema"; kind: string }
  | { id: number; ask: "run"; text: string; edits: string; files: Record<string, string>; sharing: string; seconds: number };
export type Reply =
  | { id: number; json: string; numbers: Float64Array }
  | { id: number; progress: { stage: string; fraction: number; best: number } }
  | { id: number; kept: string }  // checkpoint with which other runs of the same study can begin
  | { id: number; leaves: true } // the run leaves something to others that share it
  | { id: number; problem: string };

const scope = globalThis as unknown as Scope;
let engine: Module;
let beside: string[] = []; // files of the study of now
let asked = 0;
let said = 0;

function bytesOf(text: string): [number, number] {
  const bytes = new TextEncoder().encode(text);
  const at = engine._malloc(bytes.length + 1);
  engine.HEAPU8.set(bytes, at);
  engine.HEAPU8[at + bytes.length] = 0;
  return [at, bytes.length];
}

function answer(id: number): void {
  const at = engine._engine_json();
  const json = new TextDecoder().decode(engine.HEAPU8.subarray(at, at + engine._engine_json_size()));
  const first = engine._engine_numbers() / 8;
  const numbers = engine.HEAPF64.slice(first, first + engine._engine_numbers_count());
  scope.postMessage({ id, json, numbers }, [numbers.buffer]);
}

async function start(module: WebAssembly.Module): Promise<void> {
  engine = await createEngine({
    instantiateWasm: (imports: WebAssembly.Imports, ready: (instance: WebAssembly.Instance) => void) => {
      void WebAssembly.instantiate(module, imports).then(ready);
      return {};
    },
    onProgress: (stage: string, fraction: number, best: number) => {
      if (performance.now() - said < 100) return;
      said = performance.now();
      scope.postMessage({ id: asked, progress: { stage, fraction, best } });
    },
    onKept: (kept: string) => scope.postMessage({ id: asked, kept }),
    onLeaves: () => scope.postMessage({ id: asked, leaves: true }),
  });
  engine.FS.mkdirTree("/study");
}

async function reply(question: Question): Promise<void> {
  asked = question.id;
  if (question.ask === "start") {
    await start(question.module);
    scope.postMessage({ id: question.id, json: "{}", numbers: new Float64Array() });
    return;
  }
  if (question.ask === "catalogue") engine._engine_catalogue();
  else if (question.ask === "schema") {
    const [kind, size] = bytesOf(question.kind);
    engine._engine_schema(kind, size);
    engine._free(kind);
  } else {
    for (const name of beside) engine.FS.unlink(`/study/${name}`);
    beside = Object.keys(question.files);
    for (const [name, text] of Object.entries(question.files)) engine.FS.writeFile(`/study/${name}`, text);
    const [text, size] = bytesOf(question.text);
    const [edits, editsSize] = bytesOf(question.edits);
    const [sharing, sharingSize] = bytesOf(question.sharing);
    engine._engine_run(text, size, edits, editsSize, sharing, sharingSize, question.seconds);
    for (const at of [text, edits, sharing]) engine._free(at);
  }
  answer(question.id);
}

scope.onmessage = ({ data }) => {
  reply(data).catch((error: unknown) => scope.postMessage({ id: data.id, problem: String(error) }));
};
