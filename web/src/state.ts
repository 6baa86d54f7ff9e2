// SPDX-License-Identifier: BSD-3-Clause

// The state of the page: shown results, and choices of the reader.
import { batch, computed, effect, signal, type Signal } from "@preact/signals";
import { extentOf } from "./arrows";
import { readResult, readView, type Carried, type Quantity, type Result, type Scene, type View } from "./data";
import { isSpatial, middleRow, rowOf, rowsOf } from "./grid";
import { advance, analyse, isAssembled, spanOf, type Motion, type Place } from "./motion";
import { readLog, type Run } from "./log";

export let view: View;
export let result: Result;
export let runs: Run[];
/** Counts the subjects that there have been: what is of one is not gone on with for another. */
export let subject = 0;
/** There are scenes, and nothing of them exists: the mechanism assembles nowhere. */
export let nowhere = false;
export let reason: Result["diagnostics"][number] | undefined;
/** Changes whenever these do; a report has one set of data for ever. */
export const revision = signal(0);
/** Follows `revision`, for what is read and compared: while the study is changed by hand, only some times a second. A component that
 *  reads any signals is drawn anew only when these change, so one that shows `view` or `result` reads this as well. */
export const paced = signal(0);

export const sceneIndex = signal(0);
/** Index of the value of the second input that is shown. */
export const row = signal(0);
/** All samples of the scene that is shown. */
export const whole = computed<Scene | undefined>(() => (revision.value ? view.scenes[sceneIndex.value] : undefined));
export const sceneName = computed(() => whole.value?.name);
/** The scene at the second input that is shown. */
export const scene = computed<Scene | undefined>(() => whole.value && rowOf(whole.value, row.value));
const none: Motion = { samples: 0, input: [], ok: [], runs: [], fullTurn: false, timed: false };
export const motion = computed<Motion>(() => (scene.value ? analyse(scene.value) : none));
/** There is a mechanism to look at. */
export const drawn = computed(() => scene.value !== undefined && !nowhere);
export const spatial = computed(() => whole.value !== undefined && isSpatial(whole.value));

const calm = matchMedia("(prefers-reduced-motion: reduce)");
export const position = signal(0);
export const direction = signal<1 | -1>(1);
export const playing = signal(false);
export const held = signal(false); // a pointer scrubs: the motion waits
export const speed = signal(1);
export const bounce = signal(false);

export const showTrace = signal(true);
export const showRoad = signal(true);
export const parallel = signal(false);
export const showSpeed = signal(false);
export const showTargets = signal(true);
export const showGhosts = signal(false);
let crowded = 24; // more joints than this have no room for their names
export const showLabels = signal(true);
export const showArrows: Record<Quantity, Signal<boolean>> = { force: signal(true), velocity: signal(true), acceleration: signal(true) };
/** Times the scale at which the largest arrow is a quarter of the scene. */
export const magnify: Record<Quantity, Signal<number>> = { force: signal(1), velocity: signal(1), acceleration: signal(1) };
/** The object under the pointer, and the chosen one: "vector 3", "moment 0", "joint 2"; empty = nothing. */
export const hovered = signal("");
export const picked = signal("");
export const whisker = signal<number | "auto">("auto");

/** Takes new data. Of another subject everything starts afresh; of the same one, what the reader has chosen stays as far as it can. */
export function load(carried: Carried, same = false): void {
  view = readView(carried);
  result = readResult(carried);
  runs = readLog(result.log);
  nowhere = view.scenes.length > 0 && view.scenes.every((s) => extentOf(s) === null);
  reason = nowhere ? result.diagnostics[0] : undefined;
  batch(() => {
    const before = whole.peek();
    revision.value++;
    if (!same) {
      ++subject;
      crowded = view.scenes.some((s) => isSpatial(s)) ? 12 : 24;
      showLabels.value = (view.scenes[0]?.joints.length ?? 0) <= crowded;
      const forces = view.scenes.some((s) => s.moments.length > 0 || s.vectors.some((v) => v.quantity === "force"));
      const velocities = view.scenes.some((s) => s.vectors.some((v) => v.quantity === "velocity"));
      showArrows.velocity.value = !forces;
      showArrows.acceleration.value = !forces && !velocities;
    }
    const there = same && before ? view.scenes.findIndex((s) => s.name === before.name) : -1;
    const [place, line, pick] = [position.peek(), row.peek(), picked.peek()];
    showScene(Math.max(0, there));
    if (there < 0) return;
    if (whole.peek()!.joints.length === before!.joints.length) picked.value = pick;
    showRow(line);
    position.value = Math.min(place, Math.max(0, motion.peek().samples - 1));
  });
}

// Changes whenever the colours on the page do: plots are painted, not styled.
export const theme = signal(0);
for (const query of ["(prefers-color-scheme: dark)", "print"])
  matchMedia(query).addEventListener("change", () => theme.value++);
/** Paper has no controls: what can be unfolded is, but for tables of a thousand rows. */
export const printing = signal(false);
const unfolded: HTMLDetailsElement[] = [];
const print = (now: boolean) => {
  printing.value = now;
  if (now) unfolded.push(...document.querySelectorAll<HTMLDetailsElement>("#app details:not([open], .menu, .data-table details)"));
  for (const details of unfolded) details.open = now;
  if (!now) unfolded.length = 0;
  if (now) document.documentElement.dataset.theme = "light";
  else delete document.documentElement.dataset.theme;
  theme.value++;
};
addEventListener("beforeprint", () => print(true));
addEventListener("afterprint", () => print(false));

/** The study of a solution, if there is one. */
export const designOf = (solution: number) => view.designs.find((d) => d.solution === solution);
/** Index of the scene of a solution; -1 = it has none. */
export const sceneOf = (solution: number) => view.scenes.findIndex((s) => s.name === view.solution_scenes[solution]);
/** The study of the solution that is drawn. */
export const designShown = computed(() => (revision.value ? view.designs.find((d) => sceneOf(d.solution) === sceneIndex.value) : undefined));

export function showScene(index: number): void {
  if (index < 0 || index >= view.scenes.length) return;
  const next = view.scenes[index];
  // The same place of the same grid where there is one.
  const kept = whole.value?.second?.length === next.second?.length && sceneIndex.value !== index;
  batch(() => {
    sceneIndex.value = index;
    if (!kept) row.value = middleRow(next);
  });
  const m = motion.value;
  picked.value = hovered.value = "";
  if (next.joints.length > crowded) showLabels.value = false;
  bounce.value = !m.fullTurn && !m.timed;
  if (!isAssembled(m, position.value)) position.value = m.runs[0]?.[0] ?? 0;
}

/** The gestures that come before the drawing's own ones: there the study itself is changed by hand. */
export interface Hand {
  /** A press at a place; true = it has taken hold of something within reach (m). */
  down(scene: Scene, at: Place, reach: number, alone: boolean): boolean;
  /** A press on a point, in space; true = it has taken hold of it. */
  hold(scene: Scene, point: number): boolean;
  move(at: Place, alone: boolean): void;
  up(): void;
}
export const hand: { now: Hand | null } = { now: null };
/** The study is being changed by hand: the drawing follows at once, words, tables and diagrams some times a second. */
export const changing = signal(false);

const leastTime = 100; // ms between two states of what follows some times a second
let pacedAt = -leastTime;
let pending = 0;
effect(() => {
  const now = revision.value;
  const rest = changing.value ? pacedAt + leastTime - performance.now() : 0;
  clearTimeout(pending);
  const follow = () => {
    pacedAt = performance.now();
    paced.value = now;
  };
  if (rest > 0) pending = window.setTimeout(follow, rest);
  else follow();
});
/** The scene as words, tables and diagrams have it. */
export const pacedScene = computed(() => {
  paced.value;
  sceneIndex.value;
  row.value;
  return scene.peek();
});

/** The curves that the diagrams draw behind their own curves, to compare with. */
export const behind = signal<{ name: string; tables: Result["tables"] } | null>(null);

/** The path that is drawn behind the mechanism (m). */
export const backdrop = signal<{ places: Place[]; closed: boolean } | null>(null);

/** The stroke that is being drawn by hand. */
export const stroke = signal<Place[]>([]);

/** The function that continues with a study on the page itself, where that is possible. */
export const goOn: { now: ((name: string, text: string) => void) | null } = { now: null };

/** Shows a place of the motion; the animation stops. */
export function scrub(to: number): void {
  playing.value = false;
  position.value = to;
}

/** Shows another value of the second input. */
export function showRow(to: number): void {
  if (whole.value) row.value = Math.min(rowsOf(whole.value) - 1, Math.max(0, to));
}

export function start(): void {
  playing.value = motion.value.runs.length > 0 && !calm.matches;
  let frame = 0;
  effect(() => {
    cancelAnimationFrame(frame);
    if (!playing.value || held.value) return;
    let before = performance.now();
    const turn = (now: number) => {
      // A tab that slept does not leap. At normal speed time runs as it does and any other input takes five seconds.
      const seconds = Math.min(0.1, Math.max(0, now - before) / 1000);
      before = now;
      const whole = motion.peek().timed ? spanOf(motion.peek()) || 1 : 5;
      const next = advance(motion.peek(), { position: position.peek(), direction: direction.peek() }, (seconds * speed.peek()) / whole, bounce.peek());
      position.value = next.position;
      direction.value = next.direction;
      frame = requestAnimationFrame(turn);
    };
    frame = requestAnimationFrame(turn);
  });
}
