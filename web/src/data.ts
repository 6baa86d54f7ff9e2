// SPDX-License-Identifier: BSD-3-Clause

// The data that the report file carries; null = missing (NaN or no bound).
import type { Num } from "./packed";
import { useUnits } from "./units";
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
  runs?: string[]; // names of the mechanisms that are drawn over each other; the first is the mechanism itself
  bodies: { name: string; points: number[]; style: BodyStyle; run?: number }[];
  joints: { name: string; point: number; style: "ground_pivot" | "pivot" | "tracer" }[];
  traces: { point: number; name: string; closed: boolean; run?: number }[];
  targets: Target[];
  circles: { name: string; centre: number; rim: number }[];
  discs?: Disc[];
  vectors: Vector[];
  moments: Moment[];
  /** Only in pages with the program behind them: the numbers of the study that points and targets show, and the frames these are in. */
  frames?: { x: Num[]; y: Num[]; angle: Num[] }[];
  handles?: { key: string; measure: "place" | "x" | "y" | "length" | "angle"; frame: number; point: number; target: number; index: number; from: number; held: boolean }[];
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
  group_names?: string[];  // names of its values 1, 2, ...
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

/** The unit of numbers whose keys end in a suffix; longer suffixes come first. */
export interface ShownSuffix {
  suffix: string; // "_rad_per_s"
  symbol: string; // "rpm"
  factor: number; // from the number of the data to the one that is shown
  key: string; // in files: "_rpm", and the number times and by these, by turns
  steps: number[];
  by_size: boolean;  // true if the size of the numbers decides
}

/** A solution as a study of its own. */
/** A file for another program: a list of points for CAD. */
export interface ResultFile {
  name: string;
  text: string;
}

export interface Design {
  solution: number;
  name: string;  // name of its file, without ending
  toml: string;
}

export interface Fact {
  label: string;
  text: string; // its value, or all of it
  rest?: string; // goes on from there
  long?: boolean; // does not stand beside its name
  verdict: "plain" | "good" | "bad";
}

export interface View {
  title: string;
  source: string;
  tool: string;
  command: string;
  study_toml: string;
  status: string;
  headline: string;
  units: ShownSuffix[];
  verdict: "passed" | "doubtful" | "incomplete" | "failed";
  facts: Fact[];
  /** Diagnostics of the result, in their order. */
  remarks: { message: string; hint?: string }[];
  parameters: Parameter[][]; // one list a solution
  solution_scenes: string[];
  /** Labels and defects of the solutions, in the order of the result. */
  solutions: { label: string; defects: string[] }[];
  designs: Design[];
  files: ResultFile[];
  scenes: Scene[];
  plots: Plot[];
  comparisons: Comparison[];
  changes: Change[];
}

/** The text of the study that a report is of; "" when it compares several. */
export const oneStudy = ({ study_toml }: Pick<View, "study_toml">) => (study_toml.startsWith("[[compare]]") ? "" : study_toml);

export interface Table {
  name: string;
  names?: string[];  // names of the rows, if they have any
  columns: { key: string; label: string }[];
  data: Num[][];
  status: string[];
}

export interface Solution {
  label: string;
  parameters: JsonObject;
  objectives: JsonObject | null;
  classification: JsonObject | null;
  defects: string[];
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

/** The contents of a report, unpacked by boot.ts, or of the engine's answer in the workbench; a result of null = there is none. */
export interface Carried {
  view: View;
  result: (Partial<Omit<Result, "tables">> & { tables?: RawTable[] }) | null;
  resultText: () => string;
}
let carries: Carried;
/** The text of result.json as the program writes it. */
export const resultText = () => carries.resultText();
export const hasResult = () => carries.result !== null;
export function readView(carried: Carried): View {
  carries = carried;
  useUnits(carried.view.units);
  return carried.view;
}

/** A property whose value is made when it is first asked for. */
export function once<T>(make: () => T): PropertyDescriptor {
  let made: { value: T } | undefined;
  return { enumerable: true, get: () => (made ??= { value: make() }).value };
}

type RawTable = { name: string; names?: string[]; columns: { key: string; label: string }[]; data: (Num | string)[][] };

/** A table of result.json has the status as its last column, which holds text. Its lists are asked for when they are needed: the
 *  workbench makes them only then. */
export function readTable(raw: RawTable): Table {
  const at = raw.columns.findIndex((c) => c.key === "status");
  const numbers = (_: unknown, i: number) => i !== at;
  const status = () => (at < 0 ? [] : (raw.data[at] as string[]));
  return Object.defineProperties({ name: raw.name, names: raw.names, columns: raw.columns.filter(numbers) }, {
    data: once(() => raw.data.filter(numbers) as Num[][]),
    status: once(() => (status().some((s) => s !== "done") ? status() : [])),
  }) as Table;
}

export const readResult = (carried: Carried): Result => {
  const result = carried.result ?? {};
  return {
    checks: result.checks ?? [],
    // Labels and defects are taken as the program has typeset them.
    solutions: (result.solutions ?? []).map((s, i) => ({ ...s, ...carried.view.solutions[i] })),
    statistics: result.statistics ?? null,
    log: result.log ?? null,
    tables: (result.tables ?? []).map(readTable),
    diagnostics: (result.diagnostics ?? []).map((d, i) => ({ ...d, ...carried.view.remarks[i] })),
  };
};

export const isObject = (value: Json | undefined): value is JsonObject =>
  typeof value === "object" && value !== null && !Array.isArray(value);
