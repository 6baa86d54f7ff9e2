// SPDX-License-Identifier: BSD-3-Clause

// The questions of the workbench to the program, wherever that runs.
import { once, type Carried, type Json, type JsonObject, type Num } from "../data";
import { jsonNumber } from "../decimal";
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
  value: number | number[] | number[][] | boolean | string | Record<string, number | string | number[]> | null; // null = left out; a table behind the last one of a list is put there
}

/** A study that the program has read and, if it is without errors, run. */
export interface Answer {
  text: string;  // text with the edits in it
  diagnostics: Diagnostic[];
  canonical?: JsonObject;
  carried?: Carried;
  seconds: number;
}

export interface Example {
  name: string;
  title: string;
  group: string;
  words: string; // further ones by which it is found
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
  files?: Record<string, string>;  // files that the study reads, by name
  seconds?: number; // after which the best so far is good enough; 0 = never
  kept?: string[];  // checkpoints of earlier runs of it
}

export interface Engine {
  catalogue(): Promise<Catalogue>;
  /** JSON Schema of the studies of a kind; null if there is no such kind. */
  schema(kind: string): Promise<JsonObject | null>;
  run(task: Task, progress?: (p: Progress) => void): Promise<Answer>;
  /** The checkpoints of the present or last run, for other runs of the same task. */
  kept(): string[];
  /** Asks the run to end: its answer is then the best so far. */
  finish(): void;
  /** Ends what is being asked, which is then rejected with `Stopped`; the next question finds a fresh engine. */
  stop(): void;
}

export class Stopped extends Error {}
class Finished extends Error {}

/** A document whose lists of numbers stand apart: {"": [first, count]} is one of them. The lists of a result's tables are made when
 *  they are asked for: most are not, while a mechanism is dragged. */
export function withNumbers(json: string, numbers: Float64Array): JsonObject {
  const list = (first: number, count: number) => {
    const out: Num[] = new Array(count);
    for (let i = 0; i < count; ++i) {
      const v = numbers[first + i];
      out[i] = Number.isNaN(v) ? null : v;
    }
    return out;
  };
  // In place, for JSON.parse is slow where it asks for every value.
  const filled = (value: Json): Json => {
    if (value === null || typeof value !== "object") return value;
    if (Array.isArray(value)) {
      for (let i = 0; i < value.length; ++i) value[i] = filled(value[i]);
      return value;
    }
    const place = value[""];
    if (Array.isArray(place)) return list(place[0] as number, place[1] as number);
    for (const key in value) value[key] = filled(value[key]);
    return value;
  };
  const document = JSON.parse(json) as JsonObject;
  const tables = ((document.result as JsonObject | undefined)?.tables ?? []) as JsonObject[];
  const later = tables.map((table) => table.data);
  for (const table of tables) table.data = null;
  filled(document);
  tables.forEach((table, i) => Object.defineProperty(table, "data", once(() => filled(later[i]))));
  return document;
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

type Asked = { ask: "start"; module: WebAssembly.Module } | { ask: "catalogue" } | { ask: "schema"; kind: string } | Omit<Extract<Question, { ask: "run" }>, "id">;
interface Told {
  json: string;
  numbers: Float64Array;
}
interface Hears {
  progress?: (p: Progress) => void;
  kept?: (text: string) => void;
  leaves?: () => void;
}

/** One worker with a program in it, begun when it is first asked, and again after it was ended. */
function workerOf(module: WebAssembly.Module, script: string) {
  let worker: Worker | null = null;
  let count = 0;
  const waiting = new Map<number, Hears & { done: (reply: Told) => void; failed: (error: Error) => void }>();
  const give_up = (error: Error) => {
    worker?.terminate();
    worker = null;
    const all = [...waiting.values()];
    waiting.clear();
    for (const { failed } of all) failed(error);
  };
  const send = (question: Asked, hears: Hears = {}) =>
    new Promise<Told>((done, failed) => {
      const id = ++count;
      waiting.set(id, { done, failed, ...hears });
      worker!.postMessage({ id, ...question });
    });
  const ask: typeof send = (question, hears) => {
    if (!worker) {
      worker = new Worker(script);
      worker.onmessage = ({ data }: MessageEvent<Reply>) => {
        const who = waiting.get(data.id);
        if ("progress" in data) return who?.progress?.(data.progress);
        if ("kept" in data) return who?.kept?.(data.kept);
        if ("leaves" in data) return who?.leaves?.();
        waiting.delete(data.id);
        if ("problem" in data) {
          // An engine that has thrown past its own answers may have lost its memory: the next question gets a new one.
          give_up(new Error(data.problem));
          who?.failed(new Error(data.problem));
        } else who?.done(data);
      };
      worker.onerror = (event) => give_up(new Error(event.message || "the engine has stopped"));
      void send({ ask: "start", module }).catch(() => {});
    }
    return send(question, hears);
  };
  return { ask, give_up };
}

const mostWorkers = 8;
const shortest = 1; // s: shorter runs are not shared
const hasEnded = (kept: string[]) => kept.some((text) => /^\{"name":"[^"/]*"/m.test(text)); // the states on the way have names below those of the ended

/** The engine in workers, so that the page never waits: one, and others that share searches with it. `script`: where engine.js with worker.js is. */
export function workerEngine(module: WebAssembly.Module, script: string, workers = Math.min(navigator.hardwareConcurrency || 1, mostWorkers)): Engine {
  const first = workerOf(module, script);
  const others = Array.from({ length: workers - 1 }, () => workerOf(module, script));
  let kept: string[] = []; // by all that share the run
  const end = (error: Error) => [first, ...others].forEach((w) => w.give_up(error));
  return {
    catalogue: async () => {
      const { json, numbers } = await first.ask({ ask: "catalogue" });
      return withNumbers(json, numbers) as unknown as Catalogue;
    },
    schema: async (kind) => JSON.parse((await first.ask({ ask: "schema", kind })).json) as JsonObject | null,
    run: async ({ text, edits = [], files = {}, seconds = 0, kept: before }, progress) => {
      const asked = performance.now();
      const passed = () => (performance.now() - asked) / 1000;
      const within = (limit: number, sharing?: object, hears?: Hears, by = first) =>
        by.ask({ ask: "run", text, edits: edits.length ? JSON.stringify({ edits }) : "", files, sharing: sharing ? JSON.stringify(sharing) : "", seconds: limit }, hears);
      const own: string[] = (kept = [...(before ?? [])]);
      const withKept = (limit: number) => within(limit, { index: 0, count: 1, kept: own }, { progress });
      const shared = async () => {
        const count = before || (seconds > 0 && seconds < shortest) ? 1 : workers;
        const all: Progress[] = [];
        const hears = (k: number): Hears => ({
          kept: (one) => own.push(one),
          progress: (p) => {
            all[k] = p;
            const told = Object.values(all);
            const best = told.map((t) => t.best).filter(Number.isFinite);
            const parts = all.length > 1 ? count : 1;
            progress?.({ stage: p.stage, fraction: told.reduce((sum, t) => sum + t.fraction, 0) / parts, best: best.length ? Math.min(...best) : NaN });
          },
        });
        if (count === 1) return own.length ? withKept(seconds) : within(seconds, undefined, { progress });
        const help: Promise<unknown>[] = [];
        const answer = await within(seconds, { index: 0, count, kept: [] }, {
          ...hears(0),
          // Pieces that another worker does not reach, because it has stopped, are done by the first in the end.
          leaves: () => others.forEach((other, k) => help.push(within(seconds, { index: k + 1, count, kept: [] }, hears(k + 1), other).catch(() => {}))),
        });
        if (!help.length) return answer;
        await Promise.all(help);
        return withKept(seconds && Math.max(shortest, seconds - passed()));
      };
      const { json, numbers } = await shared().catch((error: unknown) => {
        if (!(error instanceof Finished)) throw error;
        return withKept(soFar(own, passed()));
      });
      return readAnswer(json, numbers);
    },
    kept: () => kept,
    // A worker hears nothing while it runs: what it has found by now is found again, within the same time.
    finish: () => end(new Finished("finished")),
    stop: () => end(new Stopped("stopped")),
  };
}

/** s in which what a run has found by now, after so many, is found again: with what ended parts of it have kept there is nothing to find. */
export const soFar = (kept: string[], seconds: number): number => (hasEnded(kept) ? 0.05 : Math.max(0.05, seconds));
