// The data that the report file carries; null = missing (NaN or no bound).
import type { Num } from "./packed";
export type { Num };

export interface Scene {
  name: string;
  title: string;
  input_key: string;
  input_label: string;
  input: number[];
  /** A second input: samples are then all of `input` with its first value, then with the next one. */
  second_key?: string;
  second_label?: string;
  second?: number[];
  status: string[];
  points: { name: string; x: Num[]; y: Num[]; z?: Num[] }[]; // a scene with any z is spatial
  bodies: { name: string; points: number[]; style: BodyStyle }[];
  joints: { name: string; point: number; style: "ground_pivot" | "pivot" | "tracer" }[];
  traces: { point: number; name: string; closed: boolean }[];
  targets: Target[];
  circles: { name: string; centre: number; rim: number }[];
  discs?: Disc[];
  vectors: Vector[];
  moments: Moment[];
}

export type BodyStyle = "ground" | "bar" | "plate" | "spring" | "damper" | "guide" | "axis" | "gap";

/** A wheel about the line from its centre to another point. */
export interface Disc {
  name: string;
  centre: number;
  axis: number;
  radius: number;
  width: number;
}

export type Quantity = "force" | "velocity" | "acceleration";

export interface Vector {
  name: string;
  quantity: Quantity;
  unit: string;
  point: number;
  x: Num[];
  y: Num[];
  z?: Num[];
  symbol: string;
}

export interface Moment {
  name: string;
  unit: string;
  point: number;
  value: Num[];
  symbol: string;
}

export interface Target {
  name: string;
  x: Num[];
  y: Num[];
  achieved_x: Num[];
  achieved_y: Num[];
  achieved_input: Num[];
  closed: boolean;
}

export interface Parameter {
  key: string;
  label: string;
  value: Num;
  lower: Num;
  upper: Num;
}

export interface Plot {
  name: string;
  title: string;
  table: string;
  x: string;
  y: string[];
  style: "line" | "points" | "histogram" | "polar" | "map";
  logarithmic_y: boolean;
  scene: string;
  group?: string; // column whose values split the rows into curves
  bands?: { lower: string; upper: string; label: string }[];
  baseline?: string; // table drawn pale behind
  upright?: boolean; // x points up
}

export interface Change {
  quantity: string;
  label: string;
  measure: string;
  before: Num;
  after: Num;
  percent: Num;
  wanted: boolean;
}

export interface Comparison {
  item: string;
  source: string;
  published: Num;
  ours: Num;
  verdict: string;
  note: string;
}

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type JsonObject = { [key: string]: Json };

export interface View {
  title: string;
  source: string;
  tool: string;
  command: string;
  study_toml: string;
  status: string;
  headline: string;
  verdict: "passed" | "doubtful" | "incomplete" | "failed";
  facts: { label: string; text: string; verdict: "plain" | "good" | "bad" }[];
  parameters: Parameter[][]; // one list a solution
  solution_scenes: string[];
  scenes: Scene[];
  plots: Plot[];
  comparisons: Comparison[];
  changes: Change[];
}

export interface Table {
  name: string;
  names?: string[]; // of the rows, if they have any
  columns: { key: string; label: string }[];
  data: Num[][];
  status: string[];
}

export interface Solution {
  label: string;
  parameters: JsonObject;
  objectives: JsonObject | null;
  classification: JsonObject | null;
  defects: Json[] | null;
}

export interface Result {
  checks: { quantity: string; at?: string; value: Num; limit: string; passed: boolean; message?: string }[];
  solutions: Solution[];
  statistics: JsonObject | null;
  log: Json[] | null;
  tables: Table[];
  diagnostics: {
    severity: string;
    file?: string;
    line?: number;
    column?: number;
    key?: string;
    message: string;
    hint?: string;
  }[];
}

// What the report carries, unpacked by boot.ts; a result of null = it carries none.
declare const linkwright: { view: View; result: Partial<Omit<Result, "tables">> & { tables?: RawTable[] } | null; resultText: () => string };
/** The text of result.json as the program writes it. */
export const resultText = () => linkwright.resultText();
export const hasResult = () => linkwright.result !== null;
export const readView = () => linkwright.view;

type RawTable = { name: string; names?: string[]; columns: { key: string; label: string }[]; data: (Num | string)[][] };

/** A table of result.json has the status as its last column, which holds text. */
export function readTable({ name, names, columns, data }: RawTable): Table {
  const at = columns.findIndex((c) => c.key === "status");
  const numbers = (_: unknown, i: number) => i !== at;
  const status = at < 0 ? [] : (data[at] as string[]);
  return {
    name,
    names,
    columns: columns.filter(numbers),
    data: data.filter(numbers) as Num[][],
    status: status.some((s) => s !== "done") ? status : [],
  };
}

export const readResult = (): Result => {
  const result = linkwright.result ?? {};
  return {
    checks: result.checks ?? [],
    solutions: result.solutions ?? [],
    statistics: result.statistics ?? null,
    log: result.log ?? null,
    tables: (result.tables ?? []).map(readTable),
    diagnostics: result.diagnostics ?? [],
  };
};

export const isObject = (value: Json | undefined): value is JsonObject =>
  typeof value === "object" && value !== null && !Array.isArray(value);
