// SPDX-License-Identifier: BSD-3-Clause

// A picture of a mechanism for a page that has no engine yet: its path and one pose, as what stands in an <svg>.
import type { Scene } from "../data";
import { isSpatial, middleRow, rowOf } from "../grid";
import { analyse, placeAt, placeNear, type Motion, type Place } from "../motion";
import { bodyColours, bounds, fit, toScreen, type Size } from "../view";

/** Size of the pictures in the gallery; on the screen they are half as large. */
export const small: Size = { width: 400, height: 248 };
/** Size of the picture that a page opens with: as wide as the mechanism asks for. */
export function large(scene: Scene): Size {
  const height = 900;
  const box = bounds(scene);
  return { width: box ? Math.round((height * (box.right - box.left)) / (box.top - box.bottom)) : height, height };
}

export const viewBox = ({ width, height }: Size) => `0 0 ${width} ${height}`;

/** Without what no eye sees: points nearer than `reach` to the line between their neighbours. */
export function thinned(line: Place[], reach: number): Place[] {
  if (line.length < 3) return line;
  const [a, b] = [line[0], line[line.length - 1]];
  const length = Math.hypot(b.x - a.x, b.y - a.y);
  let far = 0;
  let most = 0;
  line.forEach((p, i) => {
    const off = length > 0 ? Math.abs((p.x - a.x) * (b.y - a.y) - (p.y - a.y) * (b.x - a.x)) / length : Math.hypot(p.x - a.x, p.y - a.y);
    if (off > most) [far, most] = [i, off];
  });
  return most <= reach ? [a, b] : [...thinned(line.slice(0, far + 1), reach).slice(0, -1), ...thinned(line.slice(far), reach)];
}

/** Path data in whole pixels, from point to point; a missing place interrupts the line. */
export function pathOf(places: (Place | null)[], closed = false, reach = 0.4): string {
  const lines: Place[][] = [[]];
  for (const p of places) {
    if (p) lines[lines.length - 1].push(p);
    else if (lines[lines.length - 1].length) lines.push([]);
  }
  const list = (numbers: number[]) => numbers.map((n, i) => (i && n >= 0 ? ` ${n}` : String(n))).join("");
  const written = lines.flatMap((line) => {
    const points = thinned(line, reach).map((p) => ({ x: Math.round(p.x), y: Math.round(p.y) })).filter((p, i, all) => !i || p.x !== all[i - 1].x || p.y !== all[i - 1].y);
    if (!points.length) return [];
    const steps = points.slice(1).flatMap((p, i) => [p.x - points[i].x, p.y - points[i].y]);
    return [`M${list([points[0].x, points[0].y])}${steps.length ? `l${list(steps)}` : "h0"}`];
  });
  return written.join("") + (closed && written.length === 1 && places.every((p) => p !== null) ? "z" : "");
}

const most = 2000; // letters of a path: a long motion is a tangle, of which that much is seen
function briefPathOf(places: (Place | null)[], closed: boolean): string {
  for (let reach = 0.4; ; reach *= 2) {
    const path = pathOf(places, closed, reach);
    if (path.length <= most || reach > 20) return path;
  }
}

/** A mechanism in parts: what stays, one pose, and what lies over it, each as what stands in an <svg>. */
export interface Picture {
  under: string;
  pose: (position: number) => string; // a fractional sample number
  over: string;
  motion: Motion;
}

const path = (kind: string, d: string, colours = "") => (d ? `<path class="${kind}"${colours} d="${d}"/>` : "");

export function pictureOf(whole: Scene, size: Size): Picture | null {
  const scene = rowOf(whole, middleRow(whole));
  const flat = isSpatial(scene) ? fromTheSide(scene) : scene;
  const all = bounds(flat);
  if (!all) return null;
  const motion = analyse(flat);
  const wheels = rims(scene, restOf(motion));
  const box = wheels.flat().reduce((b, { x, y }) => ({ left: Math.min(b.left, x), right: Math.max(b.right, x), bottom: Math.min(b.bottom, y), top: Math.max(b.top, y) }), all);
  const camera = fit(box, size, size.height / 10);
  const screen = (p: Place | null) => p && toScreen(camera, size, p);
  const colours = bodyColours(flat.bodies);
  const bodies = flat.bodies.map((body, k) => ({ ...body, colour: colours[k] })).filter(({ run, style }) => !run && style !== "ground" && style !== "gap");
  const traces = flat.traces.filter((t) => !t.run).map((t) => briefPathOf(flat.input.map((_, i) => screen(placeAt(flat, t.point, i))), t.closed));
  const targets = flat.targets.flatMap((t) => t.x.map((x, i) => (x === null || t.y[i] == null ? "" : pathOf([screen({ x, y: t.y[i]! })]))));
  const pose = (position: number) => {
    const place = (point: number) => screen(placeNear(flat, point, position));
    const bars = bodies.map(({ style, points, colour }) => {
      const plate = style === "plate" && points.length > 2;
      const ink = `var(--c${colour})`;
      return path(plate ? "plate" : "stroke", pathOf(points.map(place), plate), ` stroke="${ink}"${plate ? ` fill="${ink}"` : ""}`);
    });
    const pins = flat.joints.map((j) => {
      const p = place(j.point);
      return p ? `<circle cx="${Math.round(p.x)}" cy="${Math.round(p.y)}" r="${j.style === "ground_pivot" ? 6 : 4}"/>` : "";
    });
    return [...bars, ...pins].join("");
  };
  return { under: path("rims", wheels.map((rim) => pathOf(rim.map(screen), true)).join("")) + path("path", traces.join("")), pose, over: path("targets", targets.join("")), motion };
}

/** The sample at which a picture that does not move shows the mechanism. */
export const restOf = ({ runs }: Motion) => (runs.length ? Math.round(runs[0][0] + 0.15 * (runs[0][1] - runs[0][0])) : 0);

export function thumbnail(scene: Scene, size: Size): string {
  const picture = pictureOf(scene, size);
  return picture ? picture.under + picture.pose(restOf(picture.motion)) + picture.over : "";
}

// Seen obliquely: x towards the reader's left below, y to the right, z up.
const seen = ({ x, y, z = 0 }: Place): Place => ({ x: y - 0.35 * x, y: z - 0.35 * x });

function fromTheSide(scene: Scene): Scene {
  return {
    ...scene,
    points: scene.points.map((p, point) => {
      const places = Array.from({ length: Math.max(p.x.length, p.y.length, p.z?.length ?? 1) }, (_, i) => placeAt(scene, point, i)).map((place) => place && seen(place));
      return { name: p.name, x: places.map((place) => place && place.x), y: places.map((place) => place && place.y) };
    }),
  };
}

/** The circles of wheels. */
function rims(scene: Scene, at: number): Place[][] {
  return (scene.discs ?? []).flatMap(({ centre, axis, radius }) => {
    const [c, to] = [placeAt(scene, centre, at), placeAt(scene, axis, at)];
    if (!c || !to) return [];
    const [ax, ay, az] = [to.x - c.x, to.y - c.y, (to.z ?? 0) - (c.z ?? 0)];
    const long = Math.hypot(ax, ay, az) || 1;
    // Two directions across the axis: one level, the other across both.
    const level = Math.hypot(ax, ay) || 1;
    const [ux, uy] = [-ay / level, ax / level];
    const [vx, vy, vz] = [(-uy * az) / long, (ux * az) / long, (ax * uy - ay * ux) / long];
    return [Array.from({ length: 32 }, (_, k) => {
      const [cos, sin] = [radius * Math.cos((k * Math.PI) / 16), radius * Math.sin((k * Math.PI) / 16)];
      return seen({ x: c.x + cos * ux + sin * vx, y: c.y + cos * uy + sin * vy, z: (c.z ?? 0) + sin * vz });
    })];
  });
}
