// SPDX-License-Identifier: BSD-3-Clause

// The tools of the drawing board: what a press does to a sketch, and what a drag from there does.
import { hullOf } from "../hull";
import { bodiesAt, driveOf, jointsAt, radiiOf, valueOf, withoutPin, type ElementKind, type Pin, type Place, type Sketch, type SketchElement } from "./sketch";

/** A press, or a place that is dragged to. */
export interface Press extends Place {
  reach: number; // mm within which something is meant
  grid: number; // mm that places snap to; 0 = none
  more: boolean;  // true with Shift
}
export type Drag = (sketch: Sketch, to: Press) => Sketch;
export interface Outcome {
  sketch: Sketch;
  /** The point that the next press goes on from. */
  from?: number | null;
  drag?: Drag;
}
type OnPress = (sketch: Sketch, at: Press, from: number | null) => Outcome | null;
export interface Tool {
  name: string;
  text: string;
  group: "Links" | "Motion" | "Loads";
  /** Its sign, 24 wide and 16 high about (0, 0). */
  sign: string;
  hint: string;
  press: OnPress;
}

const pin = (place: Place, more: Partial<Pin> = {}): Pin => ({ x: place.x, y: place.y, ground: false, guide: null, traced: false, ...more });
export const withPin = (s: Sketch, i: number, change: Partial<Pin>): Sketch => ({ ...s, pins: s.pins.map((p, k) => (k === i ? { ...p, ...change } : p)) });
export const withElement = (s: Sketch, k: number, change: Partial<SketchElement> | null): Sketch =>
  ({ ...s, elements: change ? s.elements.map((e, i) => (i === k ? { ...e, ...change } : e)) : s.elements.filter((_, i) => i !== k) });
const added = (s: Sketch, kind: ElementKind, pins: number[], values: Record<string, number> = {}, joint = 0): Sketch => ({ ...s, elements: [...s.elements, { kind, pins, joint, values }] });

const round = (value: number, step: number) => Number((Math.round(value / step) * step).toFixed(6));
const snapped = ({ x, y, grid }: Press): Place => ({ x: round(x, grid || 0.01), y: round(y, grid || 0.01) });
const distance = (a: Place, b: Place) => Math.hypot(a.x - b.x, a.y - b.y);

/** The one that is nearest within reach; -1 = none. */
function nearest<T>(all: readonly T[], reach: number, away: (one: T, index: number) => number): number {
  let [best, least] = [-1, reach];
  all.forEach((one, i) => {
    const now = away(one, i);
    if (now < least) [best, least] = [i, now];
  });
  return best;
}
export const pinAt = (s: Sketch, at: Press) => nearest(s.pins, at.reach, (p) => distance(p, at));

/** The place of a line between two others that is nearest to a third. */
function onLine(a: Place, b: Place, at: Place): Place {
  const [x, y] = [b.x - a.x, b.y - a.y];
  const share = Math.min(1, Math.max(0, ((at.x - a.x) * x + (at.y - a.y) * y) / (x * x + y * y || 1)));
  return { x: a.x + share * x, y: a.y + share * y };
}
export const cornersOf = (s: Sketch, link: number) => hullOf(s.links[link].map((i) => s.pins[i]));
/** The place of a link that is nearest: of a plate the place itself. */
function onLink(s: Sketch, link: number, at: Place): Place {
  const corners = cornersOf(s, link);
  const edges = corners.map((a, k): [Place, Place] => [a, corners[(k + 1) % corners.length]]);
  if (corners.length > 2 && edges.every(([a, b]) => (b.x - a.x) * (at.y - a.y) >= (b.y - a.y) * (at.x - a.x))) return { x: at.x, y: at.y };
  return edges.map(([a, b]) => onLine(a, b, at)).reduce((best, p) => (distance(p, at) < distance(best, at) ? p : best));
}
export const linkAt = (s: Sketch, at: Press) => nearest(s.links, at.reach, (_, k) => distance(onLink(s, k, at), at));

/** Drawn 1 mm long for each newton, and the largest forces no longer than this. */
const longest = 120;
export function tipOf(s: Sketch, force: SketchElement): Place {
  const [x, y] = [valueOf(s, force, "x_N"), valueOf(s, force, "y_N")];
  const scale = Math.min(1, longest / Math.hypot(x, y) || 1);
  const { x: x0, y: y0 } = s.pins[force.pins[0]];
  return { x: x0 + scale * x, y: y0 + scale * y };
}
/** The point where the pitch circles of a gear touch. */
export function pitchOf(s: Sketch, gear: SketchElement): Place {
  const [a, b] = gear.pins.map((i) => s.pins[i]);
  const share = radiiOf(s, gear)[0] / distance(a, b);
  return Number.isFinite(share) ? { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) } : { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
}
/** The line that an element is taken hold of by; what sits on its pin has none. */
function lineOf(s: Sketch, e: SketchElement): [Place, Place] | null {
  const [a, b] = e.pins.map((i) => s.pins[i]);
  if (e.kind === "force") return [a, tipOf(s, e)];
  return e.kind === "spring" ? [a, b] : e.kind === "gear" ? [pitchOf(s, e), pitchOf(s, e)] : null;
}
const elementAt = (s: Sketch, at: Press) => nearest(s.elements, at.reach, (e) => {
  const line = lineOf(s, e);
  return line ? distance(onLine(...line, at), at) : Infinity;
});

/** The point that is pressed: one that there is, or a new one, of the link there or, where `paper` says so, of the ground. */
function pointAt(s: Sketch, at: Press, paper: boolean, more: Partial<Pin> = {}): { sketch: Sketch; i: number } | null {
  const found = pinAt(s, at);
  if (found >= 0) return { sketch: s, i: found };
  const link = linkAt(s, at);
  if (link < 0 && !paper) return null;
  const i = s.pins.length;
  if (link < 0) return { sketch: { ...s, pins: [...s.pins, pin(snapped(at), { ground: true })] }, i };
  // On a bar it lies on its line; on a plate where the grid has it, if that is on the plate.
  const grid = { ...at, ...snapped(at) };
  const place = distance(onLink(s, link, grid), grid) < 1e-6 ? grid : snapped({ ...at, ...onLink(s, link, at), grid: 0 });
  return { sketch: { ...s, pins: [...s.pins, pin(place, more)], links: s.links.map((on, k) => (k === link ? [...on, i] : on)) }, i };
}

const dragPin = (i: number): Drag => (s, to) => withPin(s, i, snapped(to));
const aim = (k: number): Drag => (s, to) => {
  const { x, y } = s.pins[s.elements[k].pins[0]];
  const tip = snapped(to);
  return distance(tip, { x, y }) < to.reach ? s : withElement(s, k, { values: { x_N: round(tip.x - x, 0.01), y_N: round(tip.y - y, 0.01) } });
};
const turnGuide = (i: number): Drag => (s, to) => {
  const p = s.pins[i];
  if (distance(p, to) < to.reach) return s;
  return withPin(s, i, { guide: round((Math.atan2(to.y - p.y, to.x - p.x) * 180) / Math.PI, to.grid ? 15 : 0.1) });
};
/** The pitch point along the line of the centres sets the ratio. */
const slidePitch = (k: number): Drag => (s, to) => {
  const [a, b] = s.elements[k].pins.map((i) => s.pins[i]);
  const size = distance(a, b);
  const first = ((to.x - a.x) * (b.x - a.x) + (to.y - a.y) * (b.y - a.y)) / size;
  const ratio = round(first / (first - size), to.grid ? 0.05 : 0.001);
  return Math.abs(ratio) > 0.02 && Math.abs(ratio) < 50 ? withElement(s, k, { values: { ratio } }) : s;
};
/** The grip at a place. */
export function gripAt(s: Sketch, at: Press): Drag | null {
  const grips: [Place, Drag][] = [...s.pins.map((p, i): [Place, Drag] => [p, dragPin(i)]),
    ...s.elements.flatMap((e, k): [Place, Drag][] => (e.kind === "force" ? [[tipOf(s, e), aim(k)]] : e.kind === "gear" ? [[pitchOf(s, e), slidePitch(k)]] : []))];
  return grips[nearest(grips, at.reach, ([place]) => distance(place, at))]?.[1] ?? null;
}

/** On a point that there is. */
const onPin = (change: (s: Sketch, i: number) => Sketch | Outcome): OnPress => (s, at) => {
  const i = pinAt(s, at);
  if (i < 0) return null;
  const done = change(s, i);
  return "sketch" in done ? done : { sketch: done };
};
/** A press puts it on the first of the joints at a pin, the next ones on the others, and the last one takes it off. */
const onJoint = (kind: "drive" | "torsion_spring") => onPin((s, i) => {
  const joints = jointsAt(s, i);
  const fits = joints.flatMap(({ slides }, k) => (kind === "drive" || !slides ? [k] : []));
  const now = s.elements.findIndex((e) => e.kind === kind && e.pins[0] === i);
  const next = fits[now < 0 ? 0 : fits.indexOf(s.elements[now].joint) + 1];
  const without = withElement(s, kind === "drive" ? s.elements.indexOf(driveOf(s)!) : now, null);
  return next === undefined ? without : added(without, kind, [i], {}, next);
});
/** From one point to the next. */
const between = (kind: "spring" | "gear", values: Record<string, number>): OnPress => (s, at, from) => {
  const point = kind === "gear" ? { sketch: s, i: pinAt(s, at) } : pointAt(s, at, true);
  if (!point || point.i < 0 || point.i === from) return null;
  if (from === null) return { sketch: point.sketch, from: point.i };
  const pins = [from, point.i];
  const same = s.elements.findIndex((e) => e.kind === kind && pins.every((i) => e.pins.includes(i)));
  if (same < 0) return { sketch: added(point.sketch, kind, pins, values), from: null };
  const { joint, values: before } = s.elements[same];
  return { sketch: withElement(s, same, { joint: kind === "gear" ? joint + 1 : joint, values: { ...before, ...values } }), from: null };
};
/** Points of a link go with it where nothing else holds them. */
function withoutLink(s: Sketch, k: number): Sketch {
  const left = { ...s, links: s.links.filter((_, i) => i !== k) };
  return [...s.links[k]].sort((a, b) => b - a).reduce((now, i) => (bodiesAt(now, i).length ? now : withoutPin(now, i)), left);
}

const pressLink: OnPress = (s, at, from) => {
  const found = pinAt(s, at);
  const pins = found < 0 ? [...s.pins, pin(snapped(at))] : s.pins;
  const i = found < 0 ? s.pins.length : found;
  const links = [...s.links];
  const end = links.length - 1;
  if (from !== null && from !== i) {
    if (at.more && end >= 0 && !links[end].includes(i)) links[end] = [...links[end], i];
    else if (!links.some((on) => on.includes(from) && on.includes(i))) links.push([from, i]);
  }
  return { sketch: { ...s, pins, links }, from: i };
};
const pressGuide = onPin((s, i) => (s.pins[i].guide === null ? { sketch: withPin(s, i, { guide: 0, ground: false }), drag: turnGuide(i) } : withPin(s, i, { guide: null })));
const pressTrace: OnPress = (s, at) => {
  const found = pinAt(s, at);
  if (found < 0) {
    const point = pointAt(s, at, false, { traced: true });
    return point && { sketch: point.sketch, drag: dragPin(point.i) };
  }
  // A point that was there to be traced alone goes again.
  const { traced, ground, guide } = s.pins[found];
  const alone = traced && !ground && guide === null && bodiesAt(s, found).length === 1 && s.links.some((on) => on.length > 2 && on.includes(found)) && !s.elements.some((e) => e.pins.includes(found));
  return { sketch: alone ? withoutPin(s, found) : withPin(s, found, { traced: !traced }) };
};
const pressForce: OnPress = (s, at) => {
  const point = pointAt(s, at, false);
  if (!point) return null;
  const now = s.elements.findIndex((e) => e.kind === "force" && e.pins[0] === point.i);
  return now < 0 ? { sketch: added(point.sketch, "force", [point.i]), drag: aim(s.elements.length) } : { sketch: s, drag: aim(now) };
};
const pressErase: OnPress = (s, at) => {
  const [i, k, link] = [pinAt(s, at), elementAt(s, at), linkAt(s, at)];
  if (i < 0 && k < 0 && link < 0) return null;
  return { sketch: i >= 0 ? withoutPin(s, i) : k >= 0 ? withElement(s, k, null) : withoutLink(s, link), from: null };
};

export const tools: Tool[] = [
  { name: "link", text: "Link", group: "Links", sign: "M-8 4L8 -4M-8 4m-3 0a3 3 0 1 0 6 0a3 3 0 1 0 -6 0M8 -4m-3 0a3 3 0 1 0 6 0a3 3 0 1 0 -6 0", press: pressLink,
    hint: "Press from pin to pin: each press makes the next link. With Shift the pin is added to the link before, which becomes a plate. Escape ends the chain." },
  { name: "move", text: "Move", group: "Links", sign: "M0 -8V8M-9 0H9M-3 -5L0 -8L3 -5M-3 5L0 8L3 5M-6 -3L-9 0L-6 3M6 -3L9 0L6 3", press: (s, at) => {
    const drag = gripAt(s, at);
    return drag && { sketch: s, drag };
  }, hint: "Drag a point, the tip of a force, or the mark where two gears meet, which sets their ratio. With Alt every tool does." },
  { name: "erase", text: "Erase", group: "Links", sign: "M-6 -6L6 6M6 -6L-6 6", press: pressErase, hint: "Press a point to remove it with what is on it; or a link, spring, force or gear." },
  { name: "ground", text: "Ground", group: "Motion", sign: "M0 -6L-7 4H7ZM-10 4H10M-7 4l-3 4M-1 4l-3 4M5 4l-3 4", press: onPin((s, i) => withPin(s, i, { ground: !s.pins[i].ground, guide: null })),
    hint: "Press a pin to fix it to the ground, or to free it." },
  { name: "guide", text: "Guide", group: "Motion", sign: "M-11 -6H11M-11 6H11M-6 -3H6V3H-6Z", press: pressGuide, hint: "Press a pin to put it on a guide, and drag to turn the guide; press again to take it off." },
  { name: "drive", text: "Drive", group: "Motion", sign: "M7 4A7.8 7.8 0 1 0 -7 4M-7 4l-2.5 -4.5M-7 4l4.5 -2.5", press: onJoint("drive"),
    hint: "Press the pin that is driven: one on the ground, on a guide, or between two links. Where several links meet, press again for the next of them." },
  { name: "gear", text: "Gears", group: "Motion", sign: "M-5 0m-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0M5.5 0m-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0", press: between("gear", {}),
    hint: "Press the pins of two wheels, which are on one link or on the ground. The links that turn there become the wheels, where there are several once more for the next; Move sets their ratio." },
  { name: "trace", text: "Trace", group: "Motion", sign: "M-10 5C-8 -9 6 -9 10 1M10 1m-2 0a2 2 0 1 0 4 0a2 2 0 1 0 -4 0", press: pressTrace,
    hint: "Press a pin, or any place of a link, to see its path; press again to leave it out." },
  { name: "spring", text: "Spring", group: "Loads", sign: "M-12 0H-8L-6 -5L-2 5L2 -5L6 5L8 0H12", press: between("spring", { stiffness_N_per_mm: 1 }),
    hint: "Press its two ends: pins, places of links, or the paper, which is the ground. It is relaxed as drawn unless Numbers says otherwise." },
  { name: "damper", text: "Damper", group: "Loads", sign: "M-12 0H-4M5 -5H-4V5H5M1 -3V3M1 0H12", press: between("spring", { damping_N_s_per_m: 100 }),
    hint: "Press its two ends, as of a spring; on a spring that is there it damps it." },
  { name: "torsion_spring", text: "Torsion", group: "Loads", sign: "M-9 6H0A6 6 0 1 0 -6 0A4 4 0 1 0 0 -3A2 2 0 0 0 0 1", press: onJoint("torsion_spring"),
    hint: "Press a pin to put a torsion spring on it, relaxed as drawn. Where several bodies meet, press again for the next of them." },
  { name: "force", text: "Force", group: "Loads", sign: "M-11 5L9 -4M9 -4l-6 -1M9 -4l-4 4.5", press: pressForce,
    hint: "Press a pin or a place of a link, and drag: 1 N for each millimetre." },
];
