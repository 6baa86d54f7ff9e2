// What the workbench asks of the program, wherever that runs.
import { jsonNumber } from "../decimal";
import type { Carried, JsonObject, Num } from "../data";
import type { Question, Reply } from "./worker";

export interface Diagnostic {
  severity: "error" | "warning";
  line?: number;
  column?: number;
  key?: string;
  message: string;
  hint?: string;
}

export interface Edit {
  key: string;
  value: number | number[] | number[][] | boolean | string | { min: number; max: number } | null; // null = left out
}

/** A study that the program has read and, if it is without errors, run. */
export interface Answer {
  text: string; // with the edits in it
  diagnostics: Diagnostic[];
  canonical?: JsonObject;
  carried?: Carried;
  seconds: number;
}

export interface Example {
  name: string;
  title: string;
  group: string;
  text: string;
  beside: Record<string, string>;
}

export interface Catalogue {
  version: string;
  kinds: { name: string; summary: string; group: string; template: string }[];
  examples: Example[];
  samples: { name: string; summary: string; group: string; mechanisms: string[] }[];
}

export interface Progress {
  stage: string;
  fraction: number;
  best: number;
}

export interface Task {
  text: string;
  edits?: Edit[];
  files?: Record<string, string>; // that the study reads, by name
  seconds?: number; // after which the best so far is good enough; 0 = never
}

export interface Engine {
  catalogue(): Promise<Catalogue>;
  /** JSON Schema of the studies of a kind; null if there is no such kind. */
  schema(kind: string): Promise<JsonObject | null>;
  run(task: Task, progress?: (p: Progress) => void): Promise<Answer>;
  /** Asks the run to end: its answer is then the best so far. */
  finish(): void;
  /** Ends what is being asked, which is then rejected with `Stopped`; the next question finds a fresh engine. */
  stop(): void;
}

export class Stopped extends Error {}
class Finished extends Error {}

/** A document whose lists of numbers stand apart: {"": [first, count]} is one of them. */
export function withNumbers(json: string, numbers: Float64Array): JsonObject {
  return JSON.parse(json, (_, value) => {
    const place = value?.[""];
    if (!Array.isArray(place)) return value;
    const out: Num[] = new Array(place[1]);
    for (let i = 0; i < out.length; ++i) {
      const v = numbers[place[0] + i];
      out[i] = Number.isNaN(v) ? null : v;
    }
    return out;
  });
}

const written = (value: unknown): string =>
  typeof value === "number" ? jsonNumber(value)
    : Array.isArray(value) ? `[${value.map(written).join(", ")}]`
      : value !== null && typeof value === "object" ? `{${Object.entries(value).map(([k, v]) => `${JSON.stringify(k)}: ${written(v)}`).join(", ")}}`
        : JSON.stringify(value);

export function readAnswer(json: string, numbers: Float64Array): Answer {
  const read = withNumbers(json, numbers) as unknown as Answer & { failure?: string } & Carried;
  if (read.failure) throw new Error(read.failure);
  const { text, diagnostics, canonical, view, result, seconds } = read;
  return { text, diagnostics, canonical, seconds: seconds ?? 0, carried: view && { view, result, resultText: () => written(result) } };
}

/** The engine in a worker of its own, so that the page never waits. `script`: engine.js and worker.js. */
export function workerEngine(module: WebAssembly.Module, script: string): Engine {
  const source = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
  let worker: Worker | null = null;
  let count = 0;
  const waiting = new Map<number, { done: (reply: { json: string; numbers: Float64Array }) => void; failed: (error: Error) => void; progress?: (p: Progress) => void }>();
  const give_up = (error: Error) => {
    worker?.terminate();
    worker = null;
    const all = [...waiting.values()];
    waiting.clear();
    for (const { failed } of all) failed(error);
  };
  const send = (question: { ask: "start"; module: WebAssembly.Module } | { ask: "catalogue" } | { ask: "schema"; kind: string } | Omit<Extract<Question, { ask: "run" }>, "id">, progress?: (p: Progress) => void) =>
    new Promise<{ json: string; numbers: Float64Array }>((done, failed) => {
      const id = ++count;
      waiting.set(id, { done, failed, progress });
      worker!.postMessage({ id, ...question });
    });
  const ask: typeof send = (question, progress) => {
    if (!worker) {
      worker = new Worker(source);
      worker.onmessage = ({ data }: MessageEvent<Reply>) => {
        const who = waiting.get(data.id);
        if ("progress" in data) return who?.progress?.(data.progress);
        waiting.delete(data.id);
        if ("problem" in data) {
          // What has thrown past its own answers may have lost its memory: the next question gets a new one.
          give_up(new Error(data.problem));
          who?.failed(new Error(data.problem));
        } else who?.done(data);
      };
      worker.onerror = (event) => give_up(new Error(event.message || "the engine has stopped"));
      void send({ ask: "start", module }).catch(() => {});
    }
    return send(question, progress);
  };
  return {
    catalogue: async () => {
      const { json, numbers } = await ask({ ask: "catalogue" });
      return withNumbers(json, numbers) as unknown as Catalogue;
    },
    schema: async (kind) => JSON.parse((await ask({ ask: "schema", kind })).json) as JsonObject | null,
    run: async ({ text, edits = [], files = {}, seconds = 0 }, progress) => {
      const asked = performance.now();
      const within = (limit: number) => ask({ ask: "run", text, edits: edits.length ? JSON.stringify({ edits }) : "", files, seconds: limit }, progress);
      const { json, numbers } = await within(seconds).catch((error: unknown) => {
        if (!(error instanceof Finished)) throw error;
        return within(Math.max(0.05, (performance.now() - asked) / 1000));
      });
      return readAnswer(json, numbers);
    },
    // A worker hears nothing while it runs: what it has found by now is found again, within the same time.
    finish: () => give_up(new Finished("finished")),
    stop: () => give_up(new Stopped("stopped")),
  };
}
