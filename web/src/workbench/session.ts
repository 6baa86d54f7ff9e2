// SPDX-License-Identifier: BSD-3-Clause

// The study, the engine and what is shown of it, kept in step: the newest text wins, and an answer that comes too late is dropped.
import { computed, effect, signal, type ReadonlySignal } from "@preact/signals";
import type { JsonObject, Scene } from "../data";
import type { Place } from "../motion";
import { extent } from "../camera";
import * as state from "../state";
import { begin, change, document_, keep, replace, type Document } from "./document";
import { soFar, Stopped, type Answer, type Catalogue, type Diagnostic, type Edit, type Engine, type Progress, type Task } from "./engine";
import { gripPoint, gripTarget, guided, isRobot, moveTo, reached, valueOf, within, type Grip } from "./handles";
import { opened } from "./opened";
import { along, isPoses, listOf, withoutPoint, withPoint, withPose } from "./points";

export const catalogue = signal<Catalogue | null>(null);
export const diagnostics = signal<Diagnostic[]>([]);
export const canonical = signal<JsonObject | null>(null);
/** It, as words and numbers have it. */
export const pacedStudy = computed(() => (state.paced.value, canonical.peek()));
/** The schema of studies of the present kind. */
export const schema = signal<JsonObject | null>(null);
/** Keys of the study that the drawing shows, and those of them that are kept while it is dragged. */
export const handleKeys = signal<ReadonlySet<string>>(new Set());
export const locked = signal(new Set<string>());
const none: ReadonlySet<string> = new Set();
/** A set that is the same as before stays the very same, so that nothing is drawn again for it. */
const kept = (before: ReadonlySet<string>, now: ReadonlySet<string>) => (before.size === now.size && [...now].every((key) => before.has(key)) ? before : now);
const keysAt = (scene: Scene, joint: number) => new Set(gripPoint(scene, scene.joints[joint].point, Math.round(state.position.peek()), extent.peek())?.handles.map((h) => h.key));
let lastPicked = none;
/** Keys of the numbers behind the joint that is picked in the drawing. */
export const pickedKeys: ReadonlySignal<ReadonlySet<string>> = computed(() => {
  const joint = /^joint (\d+)$/.exec(state.picked.value)?.[1];
  const scene = shown.value ? state.pacedScene.value : undefined;
  const keys = joint !== undefined && scene?.joints[Number(joint)] ? keysAt(scene, Number(joint)) : none;
  return (lastPicked = kept(lastPicked, keys));
});
/** The joint of the drawing that a number is of, as state.picked has it; "" = none. */
function jointOf(key: string): string {
  const scene = state.scene.value;
  const joint = key && scene ? scene.joints.findIndex((_, i) => keysAt(scene, i).has(key)) : -1;
  return joint < 0 ? "" : `joint ${joint}`;
}
/** Points out in the drawing what a number is of, for a moment or until something else is picked; "" = nothing any longer. */
export const pointOut = (key: string) => (state.hovered.value = jointOf(key));
export const pickOut = (key: string) => (state.picked.value = jointOf(key));

export function toggleLock(key: string): void {
  const next = new Set(locked.value);
  if (!next.delete(key)) next.add(key);
  locked.value = next;
}
/** There is an answer to show. */
export const shown = signal(false);
/** True if the shown results belong to an earlier text: the present one has errors. */
export const stale = signal(false);
export const busy = signal(false);
/** It has been for so long that one wants to know. */
export const waiting = signal(false);
/** The run has been asked to end with the best so far. */
export const ending = signal(false);
export const progress = signal<Progress | null>(null);
export const trouble = signal("");
/** The reason why a change by hand is not taken; "" = it is taken. */
export const stopped = signal("");
/** ms of the last run in the engine, and from the question to the page. */
export const took = signal<{ engine: number; whole: number } | null>(null);
/** True if a press on the drawing changes the mechanism, false if it moves it. */
export const editing = signal(true);
/** True if a press on an empty place adds a point to the target, and a drag draws its path. */
export const adding = signal(false);
/** The key of the target's points, where the study has some that can be set by hand. */
export const targetKey = computed(() => (shown.value && canonical.value ? listOf(state.scene.value) : ""));

let engine: Engine;
let second: Engine; // for what is seen of a search before it ends
let looking = false; // the second engine is at work
interface Wanted {
  task: Task;
  gesture?: unknown;
  /** The reason why the answer is not what the gesture means, and is dropped; "" = it is right. */
  hinders?: (answer: Answer) => string;
}
let flying: { task: Task; since: number } | null = null;
let wanted: Wanted | null = null;
let answered = ""; // text and files of what is shown
let subject = "";
let kind = "";  // kind of the schema
const schemas = new Map<string, Promise<JsonObject | null>>();

async function learn(study: JsonObject): Promise<void> {
  const start = `${study.kind as string}/${(study.mechanism as JsonObject).type as string}`;
  const task = (study.target as JsonObject | undefined)?.type;
  if (!catalogue.peek()) return; // learnt when it is there
  const known = catalogue.peek()!.kinds.map((k) => k.name).filter((k) => k === start || k.startsWith(`${start}/`));
  const name = known.find((k) => k === `${start}/${String(task)}`) ?? known[0] ?? "";
  if (name === kind) return;
  kind = name;
  schema.value = null;
  if (!schemas.has(name)) schemas.set(name, engine.schema(name).catch(() => {
    schemas.delete(name); // the engine was stopped: asked again the next time
    return null;
  }));
  const found = await schemas.get(name)!;
  if (kind === name) schema.value = found;
}

const tellAfter = 150; // ms after which is said that the engine is at work
const patience = 300; // ms after which a run that nobody waits for any longer is ended
const timeLimit = 60; // s; the program itself has no limit
const quick = 0.2; // s for what is seen while something is dragged
let unfinished = false;  // true if the shown run was cut short by that
const print = (task: Task) => JSON.stringify([task.text, task.files]);

function accept(answer: Answer): void {
  diagnostics.value = answer.diagnostics;
  stale.value = !answer.carried && shown.value;
  if (!answer.carried) return;
  canonical.value = answer.canonical ?? null;
  if (answer.canonical) void learn(answer.canonical);
  const mechanism = answer.canonical?.mechanism as JsonObject | undefined;
  const now = `${document_.peek().name} ${mechanism?.type}`;
  state.load(answer.carried, now === subject);
  const { stroke } = document_.peek();
  state.backdrop.value = stroke ? { places: stroke.points_mm.map(([x, y]) => ({ x: x / 1000, y: y / 1000 })), closed: stroke.closed } : null;
  if (now !== subject) state.playing.value = state.motion.value.runs.length > 0 && !matchMedia("(prefers-reduced-motion: reduce)").matches;
  subject = now;
  const scenes = answer.carried.view.scenes;
  handleKeys.value = kept(handleKeys.peek(), new Set(scenes.flatMap((s) => (s.handles ?? []).map((h) => h.key))));
  shown.value = true;
}

/** The solution that a search has found by now is found again within the same time, and shown, while the search goes on. */
async function preview(of: NonNullable<typeof flying>): Promise<void> {
  const goesOn = () => flying === of && !held;
  for (;;) {
    await new Promise((resolve) => setTimeout(resolve, patience));
    if (!goesOn()) return;
    if (!Number.isFinite(progress.peek()?.best)) continue;
    looking = true;
    const kept = engine.kept();
    const answer = await second.run({ ...of.task, kept, seconds: soFar(kept, (performance.now() - of.since) / 1000) }).catch(() => null);
    looking = false;
    if (!answer || !goesOn()) return;
    if (answer.carried) accept(answer);
  }
}

async function pump(): Promise<void> {
  if (flying || !wanted) return;
  const { task, gesture, hinders } = wanted;
  wanted = null;
  const own = { task, since: performance.now() };
  flying = own;
  busy.value = true;
  void preview(own);
  const saying = setTimeout(() => (waiting.value = true), tellAfter);
  const landed = () => {
    if (flying !== own) return;
    clearTimeout(saying);
    waiting.value = false;
    flying = null;
  };
  try {
    const answer = await engine.run(task, (p) => (progress.value = p));
    trouble.value = "";
    stopped.value = hinders?.(answer) ?? "";
    if (stopped.value) return;
    // Before the text changes, or it would be asked for again, in the place of what is wanted next.
    answered = print({ text: answer.text, files: task.files });
    if (task.edits) change(answer.text, gesture);
    if (answer.carried) unfinished = task.seconds === quick && answer.carried.view.status === "deadline";
    // While more is wanted, a text with errors is only half typed.
    const shows = !wanted || answer.carried !== undefined;
    // The engine goes on with what is wanted next while this is drawn.
    landed();
    void pump();
    if (shows) accept(answer);
    took.value = { engine: 1000 * answer.seconds, whole: performance.now() - own.since };
  } catch (error) {
    if (!(error instanceof Stopped)) trouble.value = error instanceof Error ? error.message : String(error);
  } finally {
    landed();
    if (looking) second.stop();
    if (!flying) {
      ending.value = false;
      progress.value = null;
      complete();
    }
    busy.value = wanted !== null || flying !== null;
    void pump();
  }
}

function want(next: Wanted): void {
  wanted = next;
  if (flying && performance.now() - flying.since > patience) engine.stop();
  void pump();
}

/** Makes changes of the study and shows what comes of them. */
export function edit(edits: Edit[], gesture: unknown = Symbol(), hinders?: Wanted["hinders"], seconds = timeLimit): void {
  if (!edits.length) return;
  const { text, files } = document_.peek();
  want({ task: { text, files, edits, seconds }, gesture, hinders });
}

/** Runs to its end what was cut short while something was dragged. */
function complete(): void {
  if (!unfinished || held || flying || wanted) return;
  unfinished = false;
  const { text, files } = document_.peek();
  want({ task: { text, files, seconds: timeLimit } });
}

/** The parameter of the best solution, by its name. */
export const bestOf = (name: string) => {
  const value = state.result.solutions[0]?.parameters[name];
  return typeof value === "number" ? value : null;
};

/** Ends what is running: with the best so far for an answer, or, when that has been asked for already, without one. */
export function stop(): void {
  wanted = null;
  const asked = ending.value;
  ending.value = true;
  if (asked) engine.stop();
  else engine.finish();
}

/** Keeps the curves of now behind those to come, or lets them go. */
export function compareWithNow(): void {
  state.behind.value = state.behind.value ? null : { name: "before", tables: state.result.tables };
}

export function open(document: Document): void {
  subject = "";
  state.behind.value = null;
  locked.value = new Set();
  adding.value = false;
  opened.value = null;
  begin(document);
}

/** The held element of the study: a pin with all links on it, a pivot, a target point. */
let held: { grip: Grip; gesture: symbol; scene: Scene; study: JsonObject | null } | null = null;

function take(scene: Scene, grip: Grip): void {
  state.scrub(grip.sample);
  held = { grip: guided(scene, grip, canonical.value), gesture: Symbol(), scene, study: canonical.value };
  state.changing.value = true;
}

function nearest(scene: Scene, at: Place, reach: number): Grip | null {
  const sample = Math.round(state.position.value);
  const near = (p: Place | null) => (p ? Math.hypot(p.x - at.x, p.y - at.y) : Infinity);
  let best = reach;
  let grip: Grip | null = null;
  scene.targets.forEach((target, t) => target.x.forEach((x, i) => {
    const distance = near(x === null || target.y[i] === null ? null : { x, y: target.y[i]! });
    const found = distance < best ? gripTarget(scene, t, i, sample) : null;
    if (found) [best, grip] = [distance, found];
  }));
  for (const handle of scene.handles ?? []) {
    if (handle.point < 0) continue;
    const { x, y } = scene.points[handle.point];
    const i = x.length === 1 ? 0 : sample;
    const distance = near(x[i] == null || y[i] == null ? null : { x: x[i]!, y: y[i]! });
    const found = distance < best ? gripPoint(scene, handle.point, sample, extent.value, locked.value) : null;
    if (found) [best, grip] = [distance, found];
  }
  return grip;
}

const problemOf = (answer: Answer) => answer.diagnostics.find((d) => d.severity === "error")?.message ?? "";

/** Changes that are one step back and forth. What makes a study with errors is not taken. */
export const tryEdit = (edits: Edit[]) => edit(edits, Symbol(), (answer) => (answer.carried ? "" : `not taken: ${problemOf(answer)}`));

/** Target points from a table, read as the program reads it. */
export async function takePoints(name: string, text: string): Promise<void> {
  const key = targetKey.peek();
  const { text: study, files } = document_.peek();
  const edits: Edit[] = [{ key, value: null }, { key: `${key.slice(0, key.lastIndexOf("."))}.${isPoses(key) ? "file" : "points_file"}`, value: name }];
  // The request is for the study with the points in it, not for the result of a search.
  const answer = await engine.run({ text: study, files: { ...files, [name]: text }, edits, seconds: 0.05 });
  const points = valueOf(answer.canonical ?? null, key);
  if (!points) throw new Error(problemOf(answer));
  if (!isPoses(key)) return tryEdit([{ key, value: points as number[][] }]);
  const [old, poses] = [valueOf(canonical.peek(), key) as JsonObject[], points as Record<string, number>[]];
  // From the last on, those that there are go when the new ones stand behind them.
  tryEdit([...poses.map((value, i): Edit => ({ key: `${key}[${old.length + i}]`, value })), ...old.map((_, i): Edit => ({ key: `${key}[${old.length - 1 - i}]`, value: null }))]);
}

/** A press made a point, a drag a path of as many points as there were, or of some twenty. */
function drawPoints(stroke: Place[], scene: Scene): void {
  const key = targetKey.value;
  if (isPoses(key)) return tryEdit([withPose(canonical.value, key, stroke, extent.value)]);
  const long = stroke.reduce((sum, p, i) => sum + (i ? Math.hypot(p.x - stroke[i - 1].x, p.y - stroke[i - 1].y) : 0), 0);
  if (long < 0.05 * extent.value) return tryEdit([withPoint(canonical.value, key, stroke[0], extent.value)]);
  const { points, closed } = along(stroke, Math.max(20, scene.targets[0]?.x.length ?? 0), extent.value);
  const target = key.slice(0, key.lastIndexOf("."));
  const has = typeof valueOf(canonical.value, `${target}.closed`) === "boolean";
  tryEdit([{ key, value: points }, ...(has ? [{ key: `${target}.closed`, value: closed }] : [])]);
}

const hand: state.Hand = {
  down(scene, at, reach, alone) {
    if (!editing.value) return false;
    const grip = nearest(scene, at, reach);
    const target = grip?.handles.find((h) => h.target >= 0);
    if (target && alone) {
      tryEdit(withoutPoint(canonical.value, listOf(scene), target.index));
      return true;
    }
    if (grip) take(scene, grip);
    else if (adding.value && targetKey.value) {
      state.playing.value = false;
      state.stroke.value = [at];
    } else return false;
    return true;
  },
  hold(scene, point) {
    const grip = editing.value ? gripPoint(scene, point, Math.round(state.position.value), extent.value, locked.value) : null;
    if (grip) take(scene, grip);
    return grip !== null;
  },
  move(at, alone) {
    if (state.stroke.value.length) state.stroke.value = [...state.stroke.value, at];
    if (!held) return;
    const { grip, gesture } = held;
    // A hard point is moved step by step from where it is now.
    const [scene, study] = at.z === undefined ? [held.scene, held.study] : [state.scene.value ?? held.scene, canonical.value];
    const to = within(scene, grip, at);
    const index = state.sceneIndex.value;
    const exact = to !== null && at.z === undefined && study?.kind === "analysis" && !alone && !grip.bound;
    edit(moveTo(scene, grip, at, alone, study), gesture, (answer) => {
      const drawn = answer.carried?.view.scenes[index];
      if (!drawn) return `stops here: ${problemOf(answer)}`;
      return exact && !reached(scene, drawn, grip, to, extent.value, study) ? "stops here: further on the linkage would turn over to its other branch" : "";
    }, exact && !isRobot(study) ? timeLimit : quick); // the branch is told by the whole motion
  },
  up() {
    if (state.stroke.value.length && state.scene.value) drawPoints(state.stroke.value, state.scene.value);
    state.stroke.value = [];
    held = null;
    state.changing.value = false;
    stopped.value = "";
    complete();
  },
};

/** `other`: a second engine of the same kind. */
export function connect(to: Engine, other: Engine): void {
  [engine, second] = [to, other];
  state.hand.now = hand;
  state.goOn.now = (name, text) => replace({ name, text, files: {} });
  effect(() => {
    if (catalogue.value && canonical.peek()) void learn(canonical.peek()!);
  });
  effect(() => {
    const { text, files } = document_.value;
    if (text === "") return;
    keep(document_.value);
    const task = { text, files, seconds: timeLimit };
    if (print(task) !== answered) want({ task });
  });
}
