// SPDX-License-Identifier: BSD-3-Clause

// Arrows of forces and motion: their scale, their values between samples, their shapes.
import type { BodyStyle, Moment, Num, Quantity, Scene, Vector } from "./data";
import { isSpatial, samplesOf } from "./grid";
import { placeNear, type Place } from "./motion";
import { format, spaced } from "./units";
import { bounds3, sizeOf } from "./space_view";
import { bounds, niceStep, onceOf, type Box } from "./view";

export const quantities: Quantity[] = ["force", "velocity", "acceleration"];
export const plurals: Record<Quantity, string> = { force: "Forces", velocity: "Velocities", acceleration: "Accelerations" };

const shareOfScene = 0.25;
const outstanding = 3; // times the median

/** Value at a position: between two samples it is interpolated; where one of them is missing the nearer one decides. */
export function valueNear(values: Num[], position: number): Num {
  if (values.length === 1) return values[0];
  const i = Math.floor(position);
  const share = position - i;
  const a = values[i] ?? null;
  if (share === 0) return a;
  const b = values[i + 1] ?? null;
  if (a !== null && b !== null) return a + share * (b - a);
  return share < 0.5 ? a : b;
}

export function componentsNear(vector: Vector, position: number): Place | null {
  const x = valueNear(vector.x, position);
  const y = valueNear(vector.y, position);
  if (x === null || y === null) return null;
  if (!vector.z) return { x, y };
  const z = valueNear(vector.z, position);
  return z === null ? null : { x, y, z };
}

const sized = ({ left, right, bottom, top }: Box) => Math.max(right - left, top - bottom);

/** Largest side of the scene over all samples (m); null when nothing of it exists. */
export function extentOf(scene: Scene): number | null {
  if (isSpatial(scene)) {
    const box = bounds3(scene);
    return box && sizeOf(box);
  }
  const box = bounds(scene);
  return box && sized(box);
}

/** Metres of an arrow in the drawing for a value of 1, the same at every sample: the largest arrow is a quarter of the scene, and
 *  samples that stand out, as near a dead point, count as three times the median. 0 = no arrow to draw. */
export const arrowScale = (scene: Scene, quantity: Quantity): number => arrowScales(scene)[quantity];
const arrowScales = onceOf((scene) => Object.fromEntries(quantities.map((quantity) => {
  const vectors = scene.vectors.filter((v) => v.quantity === quantity);
  const extent = vectors.length ? extentOf(scene) : null;
  if (extent === null) return [quantity, 0];
  const sizes = Array.from({ length: samplesOf(scene) }, (_, i) => vectors.reduce((most, v) => {
    const c = componentsNear(v, i);
    return c ? Math.max(most, Math.hypot(c.x, c.y, c.z ?? 0)) : most;
  }, 0))
    .filter((size) => size > 0)
    .sort((a, b) => a - b);
  const counted = Math.min(sizes[sizes.length - 1], outstanding * sizes[sizes.length >> 1]);
  return [quantity, sizes.length ? (shareOfScene * extent) / counted : 0];
})) as Record<Quantity, number>);

/** The scene's box with the arrows of the quantities at all samples; one that stands out counts up to a third of the scene, and of
 *  a flat scene less across it, which would else be a line in an empty drawing. */
export function boundsWith(scene: Scene, scales: { quantity: Quantity; scale: number }[]): Box | null {
  const box = bounds(scene);
  if (!box) return null;
  const out = { ...box };
  const [width, height] = [box.right - box.left, box.top - box.bottom];
  const most = { x: Math.max(width, height / 4) / 3, y: Math.max(height, width / 4) / 3 };
  const within = (v: number, most: number) => Math.min(most, Math.max(-most, v));
  for (const { quantity, scale } of scales)
    for (const vector of scene.vectors)
      if (vector.quantity === quantity && scale > 0)
        scene.input.forEach((_, i) => {
          const p = placeNear(scene, vector.point, i);
          const v = componentsNear(vector, i);
          if (!p || !v) return;
          const x = p.x + within(scale * v.x, most.x);
          const y = p.y + within(scale * v.y, most.y);
          out.left = Math.min(out.left, x);
          out.right = Math.max(out.right, x);
          out.bottom = Math.min(out.bottom, y);
          out.top = Math.max(out.top, y);
        });
  return out;
}

/** Value that the arrow in the key stands for, so that it is up to `room` pixels long. */
export const keyValue = (pixelsPerUnit: number, room: number) => niceStep(room / pixelsPerUnit);

export const largestMoment = (moments: Moment[]) =>
  moments.reduce((most, m) => m.value.reduce<number>((a, v) => Math.max(a, Math.abs(v ?? 0)), most), 0);

/** Angle of the arc of a couple of this share of the largest: up to 5/6 of a turn, at least 1/12 so that the sign shows. */
export const arcTurn = (share: number) =>
  share === 0 ? 0 : Math.sign(share) * 2 * Math.PI * (1 / 12 + 0.75 * Math.min(1, Math.abs(share)));

const at = (x: number, y: number) => `${x.toFixed(2)} ${y.toFixed(2)}`;

/** Head of an arrow: one filled for forces, one open for velocities, two open for accelerations. Angles from the screen's x axis. */
export function headOf(quantity: Quantity, end: Place, angle: number, size: number): string {
  const wings = (back: number) => {
    const tip = { x: end.x - back * Math.cos(angle), y: end.y - back * Math.sin(angle) };
    const wing = (side: number) => at(tip.x - size * Math.cos(angle + side), tip.y - size * Math.sin(angle + side));
    return `M${wing(0.36)}L${at(tip.x, tip.y)}L${wing(-0.36)}`;
  };
  if (quantity === "force") return `${wings(0)}Z`;
  return quantity === "velocity" ? wings(0) : wings(0) + wings(0.6 * size);
}

/** Shaft and head between two places of the screen; null when there is no length to see. */
export function arrowPaths(quantity: Quantity, from: Place, end: Place): { shaft: string; head: string; angle: number } | null {
  const length = Math.hypot(end.x - from.x, end.y - from.y);
  if (!(length > 0.5)) return null;
  const angle = Math.atan2(end.y - from.y, end.x - from.x);
  const size = Math.min(13, Math.max(5, 0.6 * length));
  // The shaft ends inside the filled head, so that the head keeps its point.
  const reach = quantity === "force" ? Math.max(0, length - 0.8 * size) : length;
  return {
    shaft: `M${at(from.x, from.y)}L${at(from.x + reach * Math.cos(angle), from.y + reach * Math.sin(angle))}`,
    head: headOf(quantity, end, angle, size),
    angle,
  };
}

/** Arc from the top with its head, counter-clockwise for a positive turn. */
export function arcPaths(centre: Place, radius: number, turn: number): { arc: string; head: string } {
  const start = -Math.PI / 2;
  const end = start - turn; // y points down on the screen
  const on = (angle: number) => ({ x: centre.x + radius * Math.cos(angle), y: centre.y + radius * Math.sin(angle) });
  const direction = end - (Math.sign(turn) * Math.PI) / 2;
  const tip = on(end);
  return {
    arc: `M${at(on(start).x, on(start).y)}A${at(radius, radius)} 0 ${Math.abs(turn) > Math.PI ? 1 : 0} ${turn > 0 ? 0 : 1} ${at(tip.x, tip.y)}`,
    head: headOf("force", { x: tip.x + 5 * Math.cos(direction), y: tip.y + 5 * Math.sin(direction) }, direction, 12),
  };
}

export const isSymbol = (style: BodyStyle) => style === "spring" || style === "damper" || style === "guide";

/** Lines of a spring (zigzag), damper (piston and cylinder) or guide (line, hatching on its right when y points up) between two
 *  places, `width` across. With y pointing down `width` is negative. */
export function symbolLines(style: BodyStyle, a: Place, b: Place, width: number): Place[][] {
  const way = { x: b.x - a.x, y: b.y - a.y };
  const length = Math.hypot(way.x, way.y);
  if (!isSymbol(style) || !(length > 0)) return [];
  const on = (share: number, across: number): Place => ({
    x: a.x + share * way.x - (across * width * way.y) / length,
    y: a.y + share * way.y + (across * width * way.x) / length,
  });
  if (style === "spring") {
    const strokes = 12;
    const lead = 0.12;
    const coils = Array.from({ length: strokes }, (_, i) => on(lead + ((1 - 2 * lead) * (i + 0.5)) / strokes, i % 2 === 0 ? 0.5 : -0.5));
    return [[a, on(lead, 0), ...coils, on(1 - lead, 0), b]];
  }
  if (style === "damper")
    return [[a, on(0.35, 0)], [on(0.7, -0.5), on(0.35, -0.5), on(0.35, 0.5), on(0.7, 0.5)], [on(0.55, -0.35), on(0.55, 0.35)], [on(0.55, 0), b]];
  const pitch = Math.abs(width);
  const marks = Math.floor(Math.min(60, Math.max(2, length / pitch)));
  return [[a, b], ...Array.from({ length: marks }, (_, i) => {
    const share = (i + 1) / marks;
    return [on(share, 0), on(share - Math.min((0.7 * pitch) / length, share), -0.7)];
  })];
}

const withUnit = (value: Num, unit: string, digits = 5) => `${format(value, digits)}\u202f${spaced(unit)}`;

export interface Reading {
  name: string;
  quantity: Quantity | "moment";
  size: string;
  x: string;
  y: string;
  z?: string; // in space, instead of the direction
  direction: string;
}

/** The value of a vector at a position, as text with its unit. */
export function readVector(vector: Vector, position: number): Reading {
  const c = componentsNear(vector, position);
  const degrees = c && c.z === undefined && (Math.atan2(c.y, c.x) * 180) / Math.PI;
  return {
    name: vector.name,
    quantity: vector.quantity,
    size: withUnit(c && Math.hypot(c.x, c.y, c.z ?? 0), vector.unit),
    x: withUnit(c && c.x, vector.unit),
    y: withUnit(c && c.y, vector.unit),
    ...(vector.z ? { z: withUnit(c && c.z!, vector.unit) } : {}),
    direction: typeof degrees === "number" ? `${format(degrees, 4)}°` : vector.z ? "" : "–",
  };
}

export const readMoment = (moment: Moment, position: number): Reading => ({
  name: moment.name,
  quantity: "moment",
  size: withUnit(valueNear(moment.value, position), moment.unit),
  x: "",
  y: "",
  direction: "",
});

/** One line to be pasted elsewhere. */
export const lineOf = (r: Reading) =>
  r.quantity === "moment" ? `${r.name}: ${r.size}`
  : r.z !== undefined ? `${r.name}: ${r.size} (x ${r.x}, y ${r.y}, z ${r.z})` : `${r.name}: ${r.size} (x ${r.x}, y ${r.y}, direction ${r.direction})`;
