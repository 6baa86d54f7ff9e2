// SPDX-License-Identifier: BSD-3-Clause

// Motion of a scene: positions are fractional sample numbers, 0 to samples - 1.
import type { Num, Scene } from "./data";
import type { Turn } from "./rows";
import { unitOf } from "./units";

export interface Motion {
  samples: number;
  input: number[];
  ok: boolean[]; // assembled, one a sample
  runs: [number, number][]; // first and last sample of each assembled stretch
  timed: boolean; // the input is time in seconds
  fullTurn: boolean; // the input goes round once and the mechanism with it: the last sample is followed by the first
}

export interface Place {
  x: number;
  y: number;
  z?: number; // only of points in space
}

const known = (value: Num | undefined): value is number => typeof value === "number" && Number.isFinite(value);

export function placeAt(scene: Scene, point: number, sample: number): Place | null {
  const p = scene.points[point];
  if (!p) return null;
  const x = p.x.length === 1 ? p.x[0] : p.x[sample];
  const y = p.y.length === 1 ? p.y[0] : p.y[sample];
  if (!p.z) return known(x) && known(y) ? { x, y } : null;
  const z = p.z.length === 1 ? p.z[0] : p.z[sample];
  return known(x) && known(y) && known(z) ? { x, y, z } : null;
}

export function analyse(scene: Scene): Motion {
  const samples = scene.input.length;
  // A mark such as a roll centre or a gap may be without a place while the mechanism stands.
  const byStatus = scene.status.length > 0;
  const ok = scene.input.map(
    (_, i) =>
      (scene.status[i] === undefined || scene.status[i] === "done") &&
      (byStatus || scene.points.every((_, point) => placeAt(scene, point, i) !== null)),
  );
  const runs: [number, number][] = [];
  ok.forEach((good, i) => {
    if (!good) return;
    if (i > 0 && ok[i - 1]) runs[runs.length - 1][1] = i;
    else runs.push([i, i]);
  });
  const timed = unitOf(scene.input_key).symbol === "s";
  const span = samples > 1 ? Math.abs(scene.input[samples - 1] - scene.input[0]) : 0;
  const fullTurn = scene.input_key.endsWith("_rad") && Math.abs(span - 2 * Math.PI) < 1e-6 && runs.length === 1 && ok.every(Boolean);
  return { samples, input: scene.input, ok, runs, timed, fullTurn };
}

/** Length of the input range. */
export const spanOf = (motion: Motion) => Math.abs(motion.input[motion.samples - 1] - motion.input[0]);

/** Between two samples the drawing is interpolated; where one of them is missing the nearer one decides. */
export function placeNear(scene: Scene, point: number, position: number): Place | null {
  const i = Math.floor(position);
  const share = position - i;
  const a = placeAt(scene, point, i);
  if (share === 0) return a;
  const b = placeAt(scene, point, i + 1);
  if (a && b) {
    const flat = { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) };
    return a.z === undefined || b.z === undefined ? flat : { ...flat, z: a.z + share * (b.z - a.z) };
  }
  return share < 0.5 ? a : b;
}

export const isAssembled = (motion: Motion, position: number) => motion.ok[Math.round(position)] ?? false;

export function inputAt(motion: Motion, position: number): number {
  const i = Math.min(Math.floor(position), motion.samples - 2);
  if (i < 0) return motion.input[0] ?? 0;
  return motion.input[i] + (position - i) * (motion.input[i + 1] - motion.input[i]);
}

/** Position of an input value, held within the samples; the input may rise or fall. */
export function positionOf(motion: Motion, input: number): number {
  const { input: values, samples } = motion;
  if (samples < 2) return 0;
  const rising = values[samples - 1] >= values[0];
  let low = 0;
  let high = samples - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle] <= input === rising) low = middle;
    else high = middle;
  }
  const step = values[high] - values[low];
  const share = step === 0 ? 0 : (input - values[low]) / step;
  return low + Math.min(1, Math.max(0, share));
}

/** Position of an input angle on the turn that the samples cover; other inputs as positionOf. */
export function positionOfTurn(motion: Motion, input: number): number {
  if (!motion.fullTurn) return positionOf(motion, input);
  const first = Math.min(motion.input[0], motion.input[motion.samples - 1]);
  const turn = 2 * Math.PI;
  return positionOf(motion, first + ((((input - first) % turn) + turn) % turn));
}

/** The turn that the samples cover, for a column whose numbers times the factor are those of the input; undefined when they cover none. */
export function turnOf(motion: Motion, factor = 1): Turn | undefined {
  if (!motion.fullTurn) return undefined;
  return { first: Math.min(motion.input[0], motion.input[motion.samples - 1]) / factor, length: (2 * Math.PI) / factor };
}

export interface Play {
  position: number;
  direction: 1 | -1;
}

const runOf = (motion: Motion, position: number) =>
  motion.runs.find(([a, b]) => position >= a - 0.5 && position <= b + 0.5);

/** Moves on by a share of the whole input range. Bouncing turns round at the ends of the assembled stretch; otherwise the
 *  motion starts again from the other end and leaves out what does not assemble. */
export function advance(motion: Motion, play: Play, share: number, bounce: boolean): Play {
  if (motion.samples < 2 || motion.runs.length === 0) return play;
  const ends = [motion.input[0], motion.input[motion.samples - 1]];
  const rising = ends[1] >= ends[0] ? 1 : -1;
  const step = Math.abs(ends[1] - ends[0]) * share;
  const target = inputAt(motion, play.position) + rising * play.direction * step;
  const outside = rising * (target - ends[0]) < 0 || rising * (target - ends[1]) > 0;
  const position = positionOf(motion, target);
  if (bounce) {
    const [a, b] = runOf(motion, play.position) ?? motion.runs[0];
    if (position >= b || (outside && play.direction > 0)) return { position: b, direction: -1 };
    if (position <= a) return { position: a, direction: 1 };
    return { position, direction: play.direction };
  }
  const { runs } = motion;
  if (play.direction > 0) {
    if (!outside && runOf(motion, position)) return { position, direction: 1 };
    const next = outside ? undefined : runs.find(([a]) => a > position);
    return { position: (next ?? runs[0])[0], direction: 1 };
  }
  if (!outside && runOf(motion, position)) return { position, direction: -1 };
  const next = outside ? undefined : [...runs].reverse().find(([, b]) => b < position);
  return { position: (next ?? runs[runs.length - 1])[1], direction: -1 };
}

/** Whole samples forward or back; a full turn goes on at its other end. */
export function step(motion: Motion, position: number, count: number): number {
  const last = motion.samples - 1;
  if (last < 1) return 0;
  const from = count > 0 ? Math.floor(position + 1e-9) : Math.ceil(position - 1e-9);
  const to = from + count;
  if (motion.fullTurn) return ((to % last) + last) % last;
  return Math.min(last, Math.max(0, to));
}

/** Stretches of samples that do not assemble, as shares of the input range from 0 to 1. */
export function gaps(motion: Motion): [number, number][] {
  const last = motion.samples - 1;
  if (last < 1) return [];
  const share = (i: number) => (motion.input[i] - motion.input[0]) / (motion.input[last] - motion.input[0]);
  const out: [number, number][] = [];
  let from = 0;
  for (const [a, b] of [...motion.runs, [last, last] as [number, number]]) {
    if (a > from && !motion.ok[Math.min(from + 1, a - 1)]) out.push([share(from), share(a)]);
    from = b;
  }
  return out;
}

/** Speed of a point per unit of the input at each sample (central differences); null where it has no neighbours. */
export function speeds(scene: Scene, motion: Motion, point: number): Num[] {
  const last = motion.samples - 1;
  return motion.input.map((_, i) => {
    let before = i - 1;
    let after = i + 1;
    let turn = 0;
    if (motion.fullTurn && (i === 0 || i === last)) {
      before = last - 1;
      after = 1;
      turn = motion.input[last] - motion.input[0];
    }
    const a = placeAt(scene, point, Math.max(0, before));
    const b = placeAt(scene, point, Math.min(last, after));
    if (!a || !b) return null;
    const step = motion.input[Math.min(last, after)] - motion.input[Math.max(0, before)] + turn;
    return step === 0 ? null : Math.hypot(b.x - a.x, b.y - a.y) / Math.abs(step);
  });
}

/** The sample near `position` at which a point comes closest to a place: dragging follows the motion and does not jump. */
export function nearestSample(scene: Scene, motion: Motion, point: number, position: number, to: Place): number {
  const reach = Math.max(2, Math.round(motion.samples / 8));
  const last = motion.samples - 1;
  let best = position;
  let least = Infinity;
  for (let d = -reach; d <= reach; ++d) {
    let i = Math.round(position) + d;
    if (motion.fullTurn) i = ((i % last) + last) % last;
    if (i < 0 || i > last || !motion.ok[i]) continue;
    const p = placeAt(scene, point, i);
    if (!p) continue;
    const distance = Math.hypot(p.x - to.x, p.y - to.y);
    if (distance < least) [least, best] = [distance, i];
  }
  return best;
}

export const isFixed = (scene: Scene, point: number) =>
  scene.points[point] !== undefined && scene.points[point].x.length === 1 && scene.points[point].y.length === 1 && (scene.points[point].z?.length ?? 1) === 1;
