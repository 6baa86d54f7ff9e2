// SPDX-License-Identifier: BSD-3-Clause

// Target points and poses set by hand - one by one, or as a path that is drawn in one stroke - and rows of points that are pasted.
import type { JsonObject, Scene } from "../data";
import type { Place } from "../motion";
import type { Edit } from "./engine";
import { valueOf } from "./handles";

/** The key of the list that holds the points or poses of the first target, which is "" when they are not in the study. */
export function listOf(scene: Scene | undefined): string {
  const key = scene?.handles?.find((h) => h.target === 0)?.key ?? "";
  return key.replace(/\[\d+\](\.\w+)?$/, "");
}
/** True if the target is a list of poses, tables of a place and an angle. */
export const isPoses = (key: string) => key.endsWith(".pose");

/** To a ten-thousandth of the drawing: what is below comes from the screen's pixels. */
export function tidy(v: number, size: number): number {
  const digits = 4 - Math.floor(Math.log10(size));
  return Number(v.toFixed(Math.min(12, Math.max(0, digits))));
}

const pointsOf = (study: JsonObject | null, key: string) => (valueOf(study, key) ?? []) as number[][];

export const withPoint = (study: JsonObject | null, key: string, at: Place, size: number): Edit =>
  ({ key, value: [...pointsOf(study, key), [tidy(at.x, size), tidy(at.y, size)]] });

/** One pose more, turned as the last one or, when it was drawn with a stroke, along that. */
export function withPose(study: JsonObject | null, key: string, stroke: readonly Place[], size: number): Edit {
  const poses = (valueOf(study, key) ?? []) as JsonObject[];
  const [from, to] = [stroke[0], stroke[stroke.length - 1]];
  const angle = Math.hypot(to.x - from.x, to.y - from.y) > 0.02 * size ? Math.atan2(to.y - from.y, to.x - from.x) : Number(poses[poses.length - 1]?.angle_rad ?? 0);
  return { key: `${key}[${poses.length}]`, value: { x_m: tidy(from.x, size), y_m: tidy(from.y, size), angle_rad: angle } };
}

/** Without one of the points or poses; nothing when fewer than two would be left. */
export function withoutPoint(study: JsonObject | null, key: string, index: number): Edit[] {
  const all = pointsOf(study, key);
  if (all.length < 3) return [];
  return isPoses(key) ? [{ key: `${key}[${index}]`, value: null }] : [{ key, value: all.filter((_, i) => i !== index) }];
}

/** Places at equal steps along a stroke, its ends included; of a closed one the beginning does not come again at the end. */
export function evenly(stroke: readonly Place[], closed: boolean, count: number): Place[] {
  const ring = closed ? [...stroke, stroke[0]] : stroke;
  const way = [0];
  for (let i = 1; i < ring.length; ++i) way.push(way[i - 1] + Math.hypot(ring[i].x - ring[i - 1].x, ring[i].y - ring[i - 1].y));
  const step = way[way.length - 1] / (closed ? count : count - 1);
  let i = 1;
  return Array.from({ length: count }, (_, k) => {
    const s = Math.min(k * step, way[way.length - 1]);
    while (i < ring.length - 1 && way[i] < s) ++i;
    const part = way[i] > way[i - 1] ? (s - way[i - 1]) / (way[i] - way[i - 1]) : 0;
    return { x: ring[i - 1].x + part * (ring[i].x - ring[i - 1].x), y: ring[i - 1].y + part * (ring[i].y - ring[i - 1].y) };
  });
}

/** Points at equal steps along a stroke; of one that comes back to its beginning the end is left out. */
export function along(stroke: readonly Place[], count: number, size: number): { points: number[][]; closed: boolean } {
  const closed = Math.hypot(stroke[0].x - stroke[stroke.length - 1].x, stroke[0].y - stroke[stroke.length - 1].y) < 0.03 * size;
  return { points: evenly(stroke, closed, count).map((p) => [tidy(p.x, size), tidy(p.y, size)]), closed };
}

/** The numbers of a row, divided by tabs, semicolons, spaces or commas; NaN for what is none. */
export function numbersOf(line: string): number[] {
  const cells = line.trim().split(/\t|;|\s+|,(?=\s)/).filter(Boolean);
  // A decimal comma is one where nothing else divides the two.
  return (cells.length === 1 ? line.trim().split(",") : cells).map((cell) => Number(cell.trim().replace(",", ".").replace("\u2212", "-")));
}

/** Rows as a spreadsheet copies them, or as they are typed: two numbers each, in the unit of the page; null = it is none. */
export function pastedRows(text: string, factor: number): number[][] | null {
  const lines = text.split(/\r?\n/).filter((line) => line.trim() !== "");
  const rows = lines.map((line) => numbersOf(line).map((v) => v / factor));
  return rows.length && rows.every((row) => row.length === 2 && row.every(Number.isFinite)) ? rows : null;
}

/** The row that continues a list: as far from the last one as that is from the one before. */
export const nextRow = (rows: readonly number[][]): number[] => {
  const [last, before] = [rows[rows.length - 1], rows[rows.length - 2]];
  return before ? last.map((v, k) => Number((2 * v - before[k]).toPrecision(7))) : [...last];
};
