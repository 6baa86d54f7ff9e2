// SPDX-License-Identifier: BSD-3-Clause

// The search for machines along the path: runs that take longer and longer, each of which replaces the list of the one before.
import { effect, signal } from "@preact/signals";
import { readResult, type Carried, type JsonObject, type Scene } from "../data";
import { format, quantity } from "../units";
import { Stopped, type Answer, type Diagnostic, type Engine } from "./engine";
import { studyOf, type Path, type Wishes } from "./path";
import { sheet, wishes } from "./path_sheet";

/** One machine of the list. */
export interface Machine {
  place: number; // from 1
  label: string;
  name: string; // of its study's file
  study: string;
  scene: Scene;
  numbers: { label: string; text: string }[];
  defects: string[];
}

/** s of the runs, one after the other. */
export const rounds = [0.7, 2, 5, 10];

export const machines = signal<Machine[]>([]);
export const problems = signal<Diagnostic[]>([]);
/** The run of now, from 0; null = there is none. */
export const round = signal<number | null>(null);
/** The share of it that has passed, as far as the engine says. */
export const share = signal(0);
/** Runs that have ended since the path or a wish was changed. */
export const ended = signal(0);

const measures = [
  { key: "path_error_rms_m", label: "rms error" },
  { key: "largest_deviation_m", label: "largest deviation" },
  { key: "chamfer_distance_share", label: "chamfer distance" },
  { key: "least_pair_angle_rad", label: "least pair angle" },
  { key: "size_m", label: "size" },
];

function numbersOf(objectives: JsonObject | null, classification: JsonObject | null): Machine["numbers"] {
  const links = classification?.links;
  return [
    ...(typeof links === "number" ? [{ label: "links", text: String(links) }] : []),
    ...measures.flatMap(({ key, label }) => {
      const value = objectives?.[key];
      if (typeof value !== "number") return [];
      return [{ label, text: key.endsWith("_share") ? `${format(100 * value, 3)}\u202f%` : quantity(key, value, 3) }];
    }),
  ];
}

const families: Record<string, string> = {
  four_bar: "Four-bar", slider_crank: "Slider-crank", inverted_slider: "Inverted slider-crank", geared_five_bar: "Geared five-bar",
  watt_1: "Watt I six-bar", stephenson_1: "Stephenson I six-bar", stephenson_2: "Stephenson II six-bar",
  stephenson_3: "Stephenson III six-bar", eight_bar: "Eight-bar", ten_bar: "Ten-bar",
};

/** The name of a type, and what tells it from others of its family: "Eight-bar 1324b". */
function titleOf(classification: JsonObject | null, label: string): string {
  const { family, program } = classification ?? {};
  if (typeof family !== "string") return label;
  const [, variant] = typeof program === "string" ? program.split(":") : [];
  return [families[family] ?? family.replace(/_/g, " "), ...(variant ? [variant] : [])].join(" ");
}

/** The machines of a result that can be drawn and opened, best first. */
export function machinesOf(carried: Carried): Machine[] {
  const { view } = carried;
  return readResult(carried).solutions.flatMap((solution, i) => {
    const scene = view.scenes.find((s) => s.name === view.solution_scenes[i]);
    const design = view.designs.find((d) => d.solution === i);
    const label = titleOf(solution.classification, solution.label);
    return scene && design ? [{
      place: i + 1, label, name: `${label.toLowerCase().replace(/[^a-z0-9]+/g, "-")}.toml`, study: design.toml, scene,
      numbers: numbersOf(solution.objectives, solution.classification), defects: solution.defects ?? [],
    }] : [];
  });
}

/** What the engine says about the study and about what it has found. */
function problemsOf({ diagnostics, carried }: Answer): Diagnostic[] {
  if (!carried) return diagnostics;
  const said = readResult(carried).diagnostics.map(({ severity, key, message, hint }): Diagnostic => ({ severity: severity === "error" ? "error" : "warning", key, message, hint }));
  const { headline, solutions } = carried.view;
  return [...diagnostics, ...(solutions.length || !headline ? [] : [{ severity: "warning" as const, message: headline, hint: "Allow more or longer links, or smaller pair angles." }]), ...said];
}

let make: () => Engine;
let engine: Engine | null = null; // an engine of its own, made when it is first needed
let current = 0;

/** Ends the search; the list stays. */
export function stopSearch(): void {
  ++current;
  if (round.peek() !== null) engine?.stop();
  round.value = null;
}

async function search(path: Path, wanted: Wishes): Promise<void> {
  stopSearch();
  const own = current;
  ended.value = 0;
  const by = (engine ??= make());
  for (const [number, seconds] of rounds.entries()) {
    round.value = number;
    share.value = 0;
    try {
      const answer = await by.run({ text: studyOf(path, wanted, seconds) }, ({ fraction }) => {
        if (own === current && fraction > 0 && fraction <= 1) share.value = fraction;
      });
      if (own !== current) return;
      problems.value = problemsOf(answer);
      machines.value = answer.carried ? machinesOf(answer.carried) : [];
      if (!answer.carried) break;
      ended.value = number + 1;
    } catch (error) {
      if (own !== current || error instanceof Stopped) return;
      problems.value = [{ severity: "error", message: error instanceof Error ? error.message : String(error) }];
      break;
    }
  }
  round.value = null;
}

/** Begins with the path that is on the board, unless there is none. */
export function startSearch(): void {
  const { path } = sheet.peek();
  if (path) void search(path, wishes.peek());
}

/** From now on each change of the path or of a wish starts the search again; gives back what ends that. */
export function connectSearch(makeEngine: () => Engine): () => void {
  [make, engine] = [makeEngine, null];
  return effect(() => {
    const { path } = sheet.value;
    const wanted = wishes.value;
    problems.value = [];
    if (path) return void search(path, wanted);
    stopSearch();
    machines.value = [];
  });
}
