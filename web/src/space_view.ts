// SPDX-License-Identifier: BSD-3-Clause

// From where a spatial scene is seen, and what of it there is to see. z points up; "rear" looks along +x, with y to the left.
import type { Disc, Scene } from "./data";
import { samplesOf } from "./grid";
import { placeAt, type Place } from "./motion";

export type V3 = [number, number, number];
export type ViewName = "oblique" | "rear" | "front" | "side" | "top";

export interface Viewpoint {
  name: ViewName;
  text: string;
  title: string;
  key: string;
  eye: V3; // direction from the middle of the scene to the eye
}

export const viewpoints: Viewpoint[] = [
  { name: "oblique", text: "3D", title: "from behind, above and the right", key: "1", eye: [-0.74, -0.66, 0.5] },
  { name: "rear", text: "Rear", title: "rear view: along +x, y to the left", key: "2", eye: [-1, 0, 0] },
  { name: "front", text: "Front", title: "front view: along −x, y to the right", key: "3", eye: [1, 0, 0] },
  { name: "side", text: "Side", title: "side view from the left: along −y, x to the left", key: "4", eye: [0, 1, 0] },
  // A little behind the middle, so that x points up on the screen.
  { name: "top", text: "Top", title: "top view: along −z, x up and y to the left", key: "5", eye: [-1e-4, 0, 1] },
];

const dot = (a: V3, b: V3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: V3, b: V3): V3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a: V3): V3 => {
  const size = Math.hypot(...a) || 1;
  return [a[0] / size, a[1] / size, a[2] / size];
};

export interface Basis {
  right: V3;
  up: V3;
  back: V3; // to the eye
}

/** The directions to the right and up on the screen for an eye in this direction. */
export function basisOf(eye: V3): Basis {
  const back = unit(eye);
  const level = cross([0, 0, 1], back);
  const right = Math.hypot(...level) > 0 ? unit(level) : ([0, -1, 0] as V3);
  return { right, up: cross(back, right), back };
}

export interface Box3 {
  low: V3;
  high: V3;
}

const at = (values: { x: number; y: number; z?: number }): V3 => [values.x, values.y, values.z ?? 0];

/** Smallest box with every point and wheel over all samples; null when nothing of the scene exists. */
export function bounds3(scene: Scene): Box3 | null {
  const low: V3 = [Infinity, Infinity, Infinity];
  const high: V3 = [-Infinity, -Infinity, -Infinity];
  const add = (p: V3, reach: V3 = [0, 0, 0]) =>
    p.forEach((v, k) => {
      low[k] = Math.min(low[k], v - reach[k]);
      high[k] = Math.max(high[k], v + reach[k]);
    });
  for (let i = 0; i < samplesOf(scene); ++i) {
    scene.points.forEach((_, point) => {
      const p = placeAt(scene, point, i);
      if (p) add(at(p));
    });
    for (const disc of scene.discs ?? []) {
      const centre = placeAt(scene, disc.centre, i);
      const end = placeAt(scene, disc.axis, i);
      if (centre && end) add(at(centre), reachOf(unit(at(end).map((v, k) => v - at(centre)[k]) as V3), disc));
    }
  }
  return low[0] <= high[0] ? { low, high } : null;
}

/** The extent of a wheel from its centre along each coordinate. */
export const reachOf = (axis: V3, disc: { radius: number; width: number }): V3 =>
  axis.map((a) => disc.radius * Math.sqrt(Math.max(0, 1 - a * a)) + (disc.width / 2) * Math.abs(a)) as V3;

export const middleOf = ({ low, high }: Box3): V3 => [0, 1, 2].map((k) => (low[k] + high[k]) / 2) as V3;
export const sizeOf = ({ low, high }: Box3) => Math.max(...[0, 1, 2].map((k) => high[k] - low[k]), 1e-9);

/** Places that a view must show: all points, and the rims of the wheels, over all samples. */
export function cloudOf(scene: Scene): V3[] {
  const out: V3[] = [];
  const step = Math.max(1, Math.floor(samplesOf(scene) / 100));
  for (let i = 0; i < samplesOf(scene); i += step) {
    scene.points.forEach((_, point) => {
      const p = placeAt(scene, point, i);
      if (p) out.push(at(p));
    });
    for (const disc of scene.discs ?? [])
      for (const side of [-0.5, 0.5]) out.push(...wheelCircle(scene, disc, i, side * disc.width, 24).map(at));
  }
  return out;
}

const placeOf = ([x, y, z]: V3): Place => ({ x, y, z });
/** p + a u + b v + c w. */
const sum = (p: V3, ...terms: [number, V3][]): V3 => p.map((v, k) => terms.reduce((s, [by, u]) => s + by * u[k], v)) as V3;

/** A circle of a wheel about its axis, `aside` from its centre along it; empty when the wheel does not exist. */
export function wheelCircle(scene: Scene, disc: Disc, sample: number, aside: number, count: number): Place[] {
  const [centre, end] = [placeAt(scene, disc.centre, sample), placeAt(scene, disc.axis, sample)];
  if (!centre || !end) return [];
  const axis = sum(at(end), [-1, at(centre)]);
  if (!(Math.hypot(...axis) > 0)) return [];
  const { right, up, back } = basisOf(axis);
  return Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    return placeOf(sum(at(centre), [disc.radius * Math.cos(angle), right], [disc.radius * Math.sin(angle), up], [aside, back]));
  });
}

/** The wire of a spring between two places, `width` across. */
export function helix(a: Place, b: Place, width: number): Place[] {
  const way = sum(at(b), [-1, at(a)]);
  if (!(Math.hypot(...way) > 0)) return [];
  const { right, up } = basisOf(way);
  const [turns, pieces] = [7, 24];
  const wire = Array.from({ length: turns * pieces + 1 }, (_, i) => {
    const angle = (2 * Math.PI * i) / pieces;
    return placeOf(sum(at(a), [i / (turns * pieces), way], [(width / 2) * Math.cos(angle), right], [(width / 2) * Math.sin(angle), up]));
  });
  return [a, ...wire, b];
}

/** The line of an axis: from its first to its last place and on at both ends. */
export function beyond(places: Place[]): Place[] {
  const n = places.length;
  if (n < 2) return places;
  const on = (a: Place, b: Place) => ({ x: a.x + 0.15 * (a.x - b.x), y: a.y + 0.15 * (a.y - b.y), ...(a.z === undefined || b.z === undefined ? {} : { z: a.z + 0.15 * (a.z - b.z) }) });
  return [on(places[0], places[1]), ...places.slice(1, -1), on(places[n - 1], places[n - 2])];
}

export interface Fit {
  target: V3;
  distance: number;  // distance of the eye from the target, in perspective
  halfHeight: number;  // half height of a parallel projection
}

/** Fits the places into the view; `fov` is the vertical angle of view (rad), `aspect` width over height. */
export function fit3(places: V3[], eye: V3, fov: number, aspect: number, margin = 1.15): Fit {
  const axes = basisOf(eye);
  const ranges = [axes.right, axes.up, axes.back].map((axis) => {
    const [low, high] = places.reduce(([a, b], p) => [Math.min(a, dot(p, axis)), Math.max(b, dot(p, axis))], [Infinity, -Infinity]);
    return { middle: (low + high) / 2, half: (high - low) / 2 };
  });
  const target = [0, 1, 2].map((k) => axes.right[k] * ranges[0].middle + axes.up[k] * ranges[1].middle + axes.back[k] * ranges[2].middle) as V3;
  const [tall, wide] = [Math.tan(fov / 2), Math.tan(fov / 2) * aspect];
  const distance = places.reduce((most, p) => {
    const [r, u, b] = [axes.right, axes.up, axes.back].map((axis, k) => dot(p, axis) - ranges[k].middle);
    return Math.max(most, (Math.abs(r) * margin) / wide + b, (Math.abs(u) * margin) / tall + b);
  }, 0);
  return { target, distance, halfHeight: Math.max(ranges[1].half, ranges[0].half / aspect) * margin };
}

/** Pieces of a dash-dotted line as shares of its length: dashes of `pitch` long, with a dot between two of them. */
export function dashDots(length: number, pitch: number): [number, number][] {
  const count = Math.max(1, Math.min(200, Math.round((length / pitch - 0.55) / 1)));
  const step = 1 / (count + 0.55);
  const out: [number, number][] = [];
  for (let i = 0; i <= count; ++i) {
    out.push([i * step, (i + 0.55) * step]);
    if (i < count) out.push([(i + 0.73) * step, (i + 0.82) * step]);
  }
  return out;
}

/** Lowest height of the wheels at a position of the scene's row; null without wheels. */
export function lowestTyre(discs: { centre: V3; axis: V3; radius: number; width: number }[]): number | null {
  return discs.length ? Math.min(...discs.map((d) => d.centre[2] - reachOf(unit(d.axis), d)[2])) : null;
}
