// Target points set by hand: one by one, or as a path that is drawn in one stroke.
import type { JsonObject, Scene } from "../data";
import type { Place } from "../motion";
import type { Edit } from "./engine";
import { valueOf } from "./handles";

/** The key of the list that holds the points of the first target, which is "" when they are not in the study. */
export function listOf(scene: Scene | undefined): string {
  const key = scene?.handles?.find((h) => h.target === 0)?.key ?? "";
  return key.replace(/\[\d+\]$/, "");
}

/** To a ten-thousandth of the drawing: what is below comes from the screen's pixels. */
export function tidy(v: number, size: number): number {
  const digits = 4 - Math.floor(Math.log10(size));
  return Number(v.toFixed(Math.min(12, Math.max(0, digits))));
}

const pointsOf = (study: JsonObject | null, key: string) => (valueOf(study, key) ?? []) as number[][];

export const withPoint = (study: JsonObject | null, key: string, at: Place, size: number): Edit =>
  ({ key, value: [...pointsOf(study, key), [tidy(at.x, size), tidy(at.y, size)]] });

/** Without one of the points; nothing when fewer than two would be left. */
export function withoutPoint(study: JsonObject | null, key: string, index: number): Edit[] {
  const left = pointsOf(study, key).filter((_, i) => i !== index);
  return left.length < 2 ? [] : [{ key, value: left }];
}

/** Points at equal steps along a stroke, its ends included; of one that comes back to its beginning the end is left out. */
export function along(stroke: readonly Place[], count: number, size: number): { points: number[][]; closed: boolean } {
  const closed = Math.hypot(stroke[0].x - stroke[stroke.length - 1].x, stroke[0].y - stroke[stroke.length - 1].y) < 0.03 * size;
  const ring = closed ? [...stroke, stroke[0]] : stroke;
  const way = [0];
  for (let i = 1; i < ring.length; ++i) way.push(way[i - 1] + Math.hypot(ring[i].x - ring[i - 1].x, ring[i].y - ring[i - 1].y));
  const step = way[way.length - 1] / (closed ? count : count - 1);
  let i = 1;
  const points = Array.from({ length: count }, (_, k) => {
    const s = Math.min(k * step, way[way.length - 1]);
    while (i < ring.length - 1 && way[i] < s) ++i;
    const part = way[i] > way[i - 1] ? (s - way[i - 1]) / (way[i] - way[i - 1]) : 0;
    return [tidy(ring[i - 1].x + part * (ring[i].x - ring[i - 1].x), size), tidy(ring[i - 1].y + part * (ring[i].y - ring[i - 1].y), size)];
  });
  return { points, closed };
}
