// SPDX-License-Identifier: BSD-3-Clause

// From a drawn point to the numbers of the study that made it, and back.
import type { Json, JsonObject, Num, Scene } from "../data";
import { placeAt, type Place } from "../motion";
import type { Edit } from "./engine";

export type Handle = NonNullable<Scene["handles"]>[number];

/** A grip of the pointer: the numbers of the study behind a drawn place. */
export interface Grip {
  handles: Handle[];
  points: number[]; // all that are one with the point that is held
  at: Place;
  sample: number;
  fixed: boolean; // stands on the ground
  bound: boolean; // some of its numbers are locked, so that it does not follow wherever it is dragged
  along?: Place; // the direction of the slide that keeps it on a line
}

const entry = (list: Num[], i: number) => (list.length === 1 ? list[0] : list[i]) ?? null;

const distance = (a: Place, b: Place) => Math.hypot(a.x - b.x, a.y - b.y, (a.z ?? 0) - (b.z ?? 0));

/** True if two points of a scene are one wherever it is assembled, as the ends of two links on a pin are. */
function joined(scene: Scene, a: number, b: number, size: number): boolean {
  if (a === b) return true;
  let any = false;
  for (let i = 0; i < Math.max(1, scene.input.length); ++i) {
    const [p, q] = [placeAt(scene, a, i), placeAt(scene, b, i)];
    if (!p || !q || (scene.status?.[i] ?? "done") !== "done") continue;
    if (distance(p, q) > 1e-9 * size) return false;
    any = true;
  }
  return any;
}

/** All numbers that move with a drawn point at a sample, but for those that are locked; null if the study has none of it. */
export function gripPoint(scene: Scene, point: number, sample: number, size: number, locked: ReadonlySet<string> = new Set()): Grip | null {
  const at = placeAt(scene, point, sample);
  // If two points of one body coincide, such as a pivot on a guide, the pin is meant. A point that no number of the
  // study places, such as a centre of mass, coincides by chance.
  const pins = new Set(scene.joints?.map((j) => j.point));
  const told = new Set([point, ...pins, ...(scene.handles ?? []).flatMap((h) => [h.point, h.from])]);
  const one = at ? scene.points.flatMap((_, i) => (told.has(i) && joined(scene, i, point, size) ? [i] : [])) : [];
  one.sort((a, b) => Number(pins.has(b)) - Number(pins.has(a)) || a - b);
  const placed = (scene.handles ?? []).filter((h) => h.measure === "place" && h.frame >= 0 && one.includes(h.point)).sort((a, b) => one.indexOf(a.point) - one.indexOf(b.point));
  const second = placed.filter((h, i) => placed.findIndex((o) => o.frame === h.frame) !== i);
  const points = one.filter((p) => !second.some((h) => h.point === p));
  const all = (scene.handles ?? []).filter((h) => !locked.has(h.key));
  const own = all.filter((h) => h.point >= 0 && points.includes(h.point));
  if (!at || own.length === 0) return null;
  // A pivot by its coordinates takes everything along.
  const whole = own.filter((h) => h.frame < 0 && (h.measure === "x" || h.measure === "y"));
  // One that turns the frame leaves the links as they are; else what ends at the point is measured anew from where its other end
  // stands, unless an input gives its direction.
  const ends = own.some((h) => h.measure === "angle") ? []
    : all.filter((h) => h.measure === "length" && !h.held && points.includes(h.from) && !points.includes(h.point));
  const handles = whole.length ? whole : [...own, ...ends];
  const fixed = handles.some((h) => h.measure === "place" && h.frame >= 0 && scene.frames![h.frame].x.length === 1);
  const bound = (scene.handles ?? []).some((h) => locked.has(h.key) && (points.includes(h.point) || points.includes(h.from)));
  return { handles, points, at, sample, fixed, bound };
}

export function gripTarget(scene: Scene, target: number, index: number, sample: number): Grip | null {
  const handles = (scene.handles ?? []).filter((h) => h.target === target && h.index === index && h.point < 0);
  const [x, y] = [scene.targets?.[target]?.x[index] ?? 0, scene.targets?.[target]?.y[index] ?? 0];
  return handles.length ? { handles, points: [], at: { x, y }, sample, fixed: false, bound: false } : null;
}

/** The grip on the line that it can only be moved on, where a slide keeps it there. `study` is the one that is drawn. */
export function guided(scene: Scene, grip: Grip, study: JsonObject | null): Grip {
  const mechanism = study?.mechanism as JsonObject | undefined;
  if (mechanism?.type !== "planar.linkage") return grip;
  const [bodies, joints] = [mechanism.body, mechanism.joint] as [JsonObject[], JsonObject[]];
  const held = grip.handles.flatMap(({ key }) => {
    const [, body, point] = /^mechanism\.body\[(\d+)\]\.points_m\.(\w+)$/.exec(key) ?? [];
    return body ? [`${String(bodies[Number(body)].name)}.${point}`] : [];
  });
  for (const { type, first, second, direction_rad } of joints) {
    const line = (first as string).slice(0, (first as string).indexOf("."));
    // The line of the ground is where it is put; that of a link turns with the link.
    const on = (type === "prismatic" && held.includes(second as string)) || ((type === "prismatic" || type === "pin_in_slot") && line !== bodies[0].name && held.includes(first as string));
    if (!on) continue;
    const index = bodies.findIndex((b) => b.name === line);
    const frame = scene.handles?.find((h) => h.key.startsWith(`mechanism.body[${index}].`))?.frame ?? -1;
    const turn = (frame < 0 ? 0 : entry(scene.frames![frame].angle, grip.sample) ?? 0) + (direction_rad as number);
    return { ...grip, along: { x: Math.cos(turn), y: Math.sin(turn) } };
  }
  return grip;
}

/** The number or list of a study at a key; null if it has none. */
export function valueOf(study: JsonObject | null, key: string): Json | null {
  let at: Json | undefined = study ?? undefined;
  for (const step of key.match(/[^.[\]]+/g) ?? []) {
    if (at === null || typeof at !== "object") return null;
    at = (at as Record<string, Json>)[step];
  }
  return at ?? null;
}

const shortest = 1e-3;  // shortest link, as a share of its length when it was taken hold of

const origin: Place = { x: 0, y: 0, z: 0 };
const endOf = (scene: Scene, grip: Grip, point: number) => (point < 0 ? origin : placeAt(scene, point, grip.sample));

/** The position of a held point when it is dragged to a place: what an input turns, or a slide guides, stays on its line. */
export function within(scene: Scene, grip: Grip, to: Place): Place | null {
  if (grip.along) {
    const way = (to.x - grip.at.x) * grip.along.x + (to.y - grip.at.y) * grip.along.y;
    return { x: grip.at.x + way * grip.along.x, y: grip.at.y + way * grip.along.y };
  }
  const held = grip.handles.find((h) => h.measure === "length" && h.held && grip.points.includes(h.point));
  if (!held) return to;
  const from = endOf(scene, grip, held.from);
  if (!from) return null;
  const way = [grip.at.x - from.x, grip.at.y - from.y, (grip.at.z ?? 0) - (from.z ?? 0)];
  const size = Math.hypot(...way);
  const wish = [to.x - from.x, to.y - from.y, (to.z ?? 0) - (from.z ?? 0)];
  const along = Math.max(shortest * size, way.reduce((sum, v, k) => sum + (v / size) * wish[k], 0));
  const [x, y, z] = way.map((v, k) => [from.x, from.y, from.z ?? 0][k] + (v / size) * along);
  return grip.at.z === undefined ? { x, y } : { x, y, z };
}

export const isRobot = (study: JsonObject | null) => String((study?.mechanism as JsonObject | undefined)?.type).startsWith("parallel.");

const pinned = ["planar.four_bar", "planar.slider_crank", "parallel.five_bar", "parallel.constant_orientation"];

/** True if all other joints stay where they are while a point is dragged: where they are while a point is dragged: where nothing
 *  slides on what moves, and no frame is turned. */
function othersStay(study: JsonObject | null, grip: Grip): boolean {
  const mechanism = study?.mechanism as JsonObject | undefined;
  const joints = mechanism?.type === "planar.linkage" ? (mechanism.joint as JsonObject[] | undefined) : undefined;
  if (!(joints ? joints.every((j) => j.type === "revolute") : pinned.includes(String(mechanism?.type)))) return false;
  return grip.handles.every((h) => h.measure !== "angle" && !(h.frame < 0 && (h.measure === "x" || h.measure === "y")));
}

/** True if a drag has done what it should: the held point is drawn at its place, and the rest is unchanged. Past a dead point it would
 *  be elsewhere, on the other branch. `study` is the one before. */
export function reached(before: Scene, after: Scene, grip: Grip, at: Place, size: number, study: JsonObject | null): boolean {
  const near = (point: number, place: Place | null) => {
    const p = placeAt(after, point, grip.sample);
    return p !== null && place !== null && distance(p, place) <= 1e-5 * size;
  };
  // The tool of a robot is given, and its arms turn to it; whether they reach it the study says.
  if (isRobot(study) && grip.handles.some((h) => h.held || !h.key.startsWith("mechanism."))) return true;
  if (!grip.points.every((point) => near(point, at))) return false;
  return !othersStay(study, grip) || before.joints.every(({ point, style }) => style === "tracer" || grip.points.includes(point) || near(point, placeAt(before, point, grip.sample)));
}

/** The edits that put what is held to a place. All other points stay where they are at this input; with `alone`, only the ground's own
 *  number changes, so that the links keep their lengths. `study` is the one that is drawn. */
export function moveTo(scene: Scene, grip: Grip, wish: Place, alone = false, study: JsonObject | null = null): Edit[] {
  const to = within(scene, grip, wish);
  if (!to) return [];
  const end = (point: number) => endOf(scene, grip, point);
  return grip.handles.flatMap((h): Edit[] => {
    const { key, measure, frame } = h;
    if (measure === "length") {
      const other = end(grip.points.includes(h.point) ? h.from : h.point);
      return other ? [{ key, value: distance(to, other) }] : [];
    }
    if (measure === "angle") {
      const [other, old] = [end(h.from), valueOf(study, key)];
      if (!other || typeof old !== "number") return [];
      const direction = (p: Place) => Math.atan2(p.y - other.y, p.x - other.x);
      const now = placeAt(scene, h.point, grip.sample) ?? grip.at;
      const turn = direction(to) - direction(now);
      return [{ key, value: old + Math.atan2(Math.sin(turn), Math.cos(turn)) }];
    }
    if (to.z !== undefined) {
      // A hard point is told where the suspension stands, and drawn where it is now: it follows step by step.
      const [old, now] = [valueOf(study, key), placeAt(scene, h.point, grip.sample)];
      if (!Array.isArray(old) || old.length !== 3 || !now) return [];
      const by = [to.x - now.x, to.y - now.y, to.z - (now.z ?? 0)];
      return [{ key, value: (old as number[]).map((v, k) => v + by[k]) }];
    }
    let local = [to.x, to.y];
    if (frame >= 0) {
      const { x, y, angle } = scene.frames![frame];
      if (alone && grip.fixed && x.length > 1) return [];
      const [ox, oy, turn] = [x, y, angle].map((list) => entry(list, grip.sample));
      if (ox === null || oy === null || turn === null) return [];
      const [dx, dy, c, s] = [to.x - ox, to.y - oy, Math.cos(turn), Math.sin(turn)];
      local = [c * dx + s * dy, -s * dx + c * dy];
    }
    if (measure !== "place") return [{ key, value: local[measure === "x" ? 0 : 1] }];
    // A place in the plane of a robot has a third coordinate.
    const third = valueOf(study, key);
    return [{ key, value: [...local, ...(Array.isArray(third) ? (third.slice(2) as number[]) : [])] }];
  });
}
