// What part of the plane is on the screen, and how large things are drawn there.
import { computed, signal } from "@preact/signals";
import { arrowScale, boundsWith, extentOf, quantities } from "./arrows";
import { placeAt, type Place } from "./motion";
import * as state from "./state";
import { fit, toScreen, zoom, type Camera } from "./view";

export const size = signal({ width: 760, height: 520 });
export const moved = signal<Camera | null>(null); // null = everything in view
/** Metres in the drawing for a value of 1, a quantity. */
export const scales = computed(() => {
  const scene = state.whole.value;
  return quantities.map((quantity) => ({ quantity, scale: scene ? arrowScale(scene, quantity) : 0 }));
});
const box = computed(() => state.scene.value && boundsWith(state.scene.value, scales.value.filter((s) => state.showArrows[s.quantity].value)));
const fitted = computed<Camera>(() => (box.value ? fit(box.value, size.value, Math.min(58, 0.1 * size.value.width)) : { x: 0, y: 0, scale: 100 }));
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
