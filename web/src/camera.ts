// SPDX-License-Identifier: BSD-3-Clause

// The part of the plane on the screen, and the scale of the drawing.
import { computed, signal } from "@preact/signals";
import { arrowScale, boundsWith, extentOf, quantities } from "./arrows";
import { isSpatial } from "./grid";
import { placeAt, type Place } from "./motion";
import * as state from "./state";
import { fit, toScreen, zoom, type Camera } from "./view";

export const size = signal({ width: 760, height: 520 });
const margin = (width: number) => Math.min(58, 0.1 * width); // px around the scene
export const moved = signal<Camera | null>(null); // null = everything in view
/** Metres in the drawing for a value of 1, a quantity. */
export const scales = computed(() => {
  const scene = state.whole.value;
  return quantities.map((quantity) => ({ quantity, scale: scene ? arrowScale(scene, quantity) : 0 }));
});
const box = computed(() => state.scene.value && boundsWith(state.scene.value, scales.value.filter((s) => state.showArrows[s.quantity].value)));
/** px that the key of the arrows takes from the top of a narrow drawing, where it would lie over the mechanism. */
const keyHeight = computed(() => {
  if (size.value.width >= 500) return 0;
  const couples = state.showArrows.force.value && (state.scene.value?.moments.length ?? 0) > 0;
  const rows = scales.value.filter((s) => s.scale > 0 && state.showArrows[s.quantity].value).length + (couples ? 1 : 0);
  return rows && 24 * rows;
});
const fitted = computed<Camera>(() => {
  if (!box.value) return { x: 0, y: 0, scale: 100 };
  const { width, height } = size.value;
  const below = fit(box.value, { width, height: height - keyHeight.value }, margin(width));
  return { ...below, y: below.y + keyHeight.value / 2 / below.scale };
});

/** Height of the drawing at a width: the shape of the largest of the scenes, so that it stays when another one is chosen, but
 *  never so much that the controls leave the first screen. */
export function heightAt(width: number): number {
  const around = 2 * margin(width);
  const most = 0.6 * innerHeight;
  const least = Math.min(220, most);
  const wanted = (tallest.value ?? 0.6) * (width - around) + around;
  return Math.round(Math.min(most, Math.max(least, wanted)));
}
const tallest = computed(() => (state.revision.value ? state.view.scenes : []).reduce<number | null>((most, scene) => {
  const box = isSpatial(scene) ? null : boundsWith(scene, quantities.map((quantity) => ({ quantity, scale: arrowScale(scene, quantity) })).filter((s) => state.showArrows[s.quantity].peek()));
  if (!box) return most;
  const shape = (box.top - box.bottom) / Math.max(1e-9, box.right - box.left);
  return Math.max(most ?? 0, shape);
}, null));

/** Pixels for a metre of an arrow: arrows keep their length on the screen when the drawing is zoomed. */
export const arrowPixels = computed(() => fitted.value.scale);
export const camera = computed(() => moved.value ?? fitted.value);
export const fitView = () => (moved.value = null);
export function zoomBy(factor: number, about?: Place): void {
  const { width, height } = size.value;
  const next = zoom(camera.value, size.value, about ?? { x: width / 2, y: height / 2 }, factor);
  const share = next.scale / fitted.value.scale;
  if (share > 0.1 && share < 2000) moved.value = next;
}

export const screen = (p: Place | null) => p && toScreen(camera.value, size.value, p);

/** Largest side of the scene (m). */
export const extent = computed(() => (state.whole.value && extentOf(state.whole.value)) ?? 1);

/** Bars and pins are thinner where the bars are short, so that chains of many can be told apart. */
export const thickness = computed(() => {
  const scene = state.scene.value;
  if (!scene) return 1;
  const at = state.motion.value.runs[0]?.[0] ?? 0;
  const lengths = scene.bodies.flatMap((b) => {
    const [p, q] = b.style === "bar" || b.style === "plate" ? [placeAt(scene, b.points[0], at), placeAt(scene, b.points[1], at)] : [null, null];
    return p && q ? [Math.hypot(q.x - p.x, q.y - p.y)] : [];
  }).sort((a, b) => a - b);
  const middle = lengths.length ? lengths[lengths.length >> 1] * camera.value.scale : Infinity;
  return Math.min(1, Math.max(0.22, middle / 40));
});
