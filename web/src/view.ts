// SPDX-License-Identifier: BSD-3-Clause

// Position of the drawing on the screen.
import type { Num, Scene } from "./data";
import type { Place } from "./motion";

export interface Box {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

/** Makes something of each scene once: scenes do not change. */
export function onceOf<T>(make: (scene: Scene) => T): (scene: Scene) => T {
  const known = new WeakMap<Scene, { made: T }>();
  return (scene) => {
    if (!known.has(scene)) known.set(scene, { made: make(scene) });
    return known.get(scene)!.made;
  };
}

/** Smallest rectangle with everything of the scene over all samples; null when nothing of it exists. */
export const bounds = onceOf<Readonly<Box> | null>((scene) => {
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  const add = (xs: Num[], ys: Num[]) =>
    xs.forEach((x, i) => {
      const y = ys[i] ?? null;
      if (x === null || y === null) return;
      box.left = Math.min(box.left, x);
      box.right = Math.max(box.right, x);
      box.bottom = Math.min(box.bottom, y);
      box.top = Math.max(box.top, y);
    });
  for (const p of scene.points) add(p.x, p.y);
  for (const circle of scene.circles) {
    const centre = scene.points[circle.centre];
    const rim = scene.points[circle.rim];
    const at = (values: Num[] | undefined, i: number) => (values?.length === 1 ? values[0] : values?.[i]) ?? NaN;
    scene.input.forEach((_, i) => {
      const [x, y] = [at(centre?.x, i), at(centre?.y, i)];
      const r = Math.hypot(at(rim?.x, i) - x, at(rim?.y, i) - y);
      if (Number.isFinite(r)) add([x - r, x + r], [y - r, y + r]);
    });
  }
  for (const t of scene.targets) {
    add(t.x, t.y);
    add(t.achieved_x, t.achieved_y);
  }
  return box.left <= box.right ? box : null;
});

/** Middle of the screen in metres and pixels per metre. */
export interface Camera {
  x: number;
  y: number;
  scale: number;
}

export interface Size {
  width: number;
  height: number;
}

export function fit(box: Box, size: Size, margin = 58): Camera {
  const width = box.right - box.left;
  const height = box.top - box.bottom;
  const least = Math.max(width, height, 1e-9) / 10;
  return {
    x: (box.left + box.right) / 2,
    y: (box.bottom + box.top) / 2,
    scale: Math.min(
      Math.max(40, size.width - 2 * margin) / Math.max(width, least),
      Math.max(40, size.height - 2 * margin) / Math.max(height, least),
    ),
  };
}

export const toScreen = (camera: Camera, size: Size, p: Place): Place => ({
  x: size.width / 2 + (p.x - camera.x) * camera.scale,
  y: size.height / 2 - (p.y - camera.y) * camera.scale,
});

export const toWorld = (camera: Camera, size: Size, p: Place): Place => ({
  x: camera.x + (p.x - size.width / 2) / camera.scale,
  y: camera.y - (p.y - size.height / 2) / camera.scale,
});

/** Zooms about a place of the screen, which keeps its place in the world. */
export function zoom(camera: Camera, size: Size, about: Place, factor: number): Camera {
  const fixed = toWorld(camera, size, about);
  return { x: fixed.x + (camera.x - fixed.x) / factor, y: fixed.y + (camera.y - fixed.y) / factor, scale: camera.scale * factor };
}

/** The largest of 1, 2, 5 times a power of ten that is not above the span. */
export function niceStep(span: number): number {
  if (!(span > 0) || !Number.isFinite(span)) return 1;
  const decade = 10 ** Math.floor(Math.log10(span) + 1e-12);
  const mantissa = (span / decade) * (1 + 1e-12);
  return (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1) * decade;
}

/** Multiples of the step from low to high. */
export function ticks(low: number, high: number, step: number): number[] {
  const out: number[] = [];
  for (let i = Math.ceil(low / step); i * step <= high && out.length < 400; ++i) out.push(i * step);
  return out;
}

/** Path data of places; a missing place interrupts the line, and then the path is not closed either. */
export function pathOf(places: (Place | null)[], closed: boolean): string {
  let path = "";
  let down = false;
  for (const p of places) {
    if (p) path += `${down ? "L" : "M"}${p.x.toFixed(2)} ${p.y.toFixed(2)}`;
    down = p !== null;
  }
  return closed && path && places.every((p) => p !== null) ? `${path}Z` : path;
}

export interface TargetErrors {
  distance: Num[];
  worst: number; // index; -1 = nothing achieved
}

export function targetErrors(target: { x: Num[]; y: Num[]; achieved_x: Num[]; achieved_y: Num[] }): TargetErrors {
  const distance = target.x.map((x, i) => {
    const [y, ax, ay] = [target.y[i], target.achieved_x[i], target.achieved_y[i]];
    return x === null || y == null || ax == null || ay == null ? null : Math.hypot(ax - x, ay - y);
  });
  let worst = -1;
  distance.forEach((d, i) => {
    if (d !== null && (worst < 0 || d > (distance[worst] ?? 0))) worst = i;
  });
  return { distance, worst };
}

/** The factor by which errors are enlarged to be seen: 1, 2, 5, 10 ... so that the worst is about 5 % of the drawing. Not what is only
 *  rounding. */
export function whiskerScale(worst: number, size: number): number {
  if (!(worst > 1e-9 * size) || !(size > 0)) return 1;
  return Math.max(1, niceStep((0.06 * size) / worst));
}

/** The role of each body, whichever side or leg it belongs to: "left tie rod" and "right tie rod" are "tie rod"; "rod 1" and "rod 2"
 *  are "rod" where legs are repeated, that is when their numbers are those of another role, too. */
export function roles(names: readonly string[]): string[] {
  const parts = names.map((name) => {
    const bare = name.replace(/^(left|right) /, "");
    return { bare, ...(/^(?<role>.+) (?<leg>\d+)$/.exec(bare)?.groups as { role?: string; leg?: string } | undefined) };
  });
  return parts.map(({ bare, role, leg }) => (role && parts.some((p) => p.leg === leg && p.role !== role) ? role : bare));
}

const bodyLooks = 18; // colours of the page, --c0 and so on: six, and darker and lighter ones

/** Colour of each body, 0 to 17 in turn: bodies of one role have one colour; ground and axes, and springs and dampers, have none. */
export function bodyColours(bodies: readonly { name: string; style: string; run?: number }[]): number[] {
  const known = new Map<string, number>();
  let used = 0;
  const role = roles(bodies.map((b) => b.name));
  return bodies.map(({ style, run }, i) => {
    if (run) return 0; // in the colour of its run
    if (["ground", "axis", "gap", "spring", "damper", "guide"].includes(style)) return 0;
    const before = role[i] === "" ? undefined : known.get(role[i]);
    if (before !== undefined) return before;
    const colour = used++ % bodyLooks;
    known.set(role[i], colour);
    return colour;
  });
}
