// SPDX-License-Identifier: BSD-3-Clause

// Curves of polar diagrams: pairs of columns of one table in a frame with equal axes.
import type { Num, Plot, Table } from "./data";
import { format, labelWith, nameOf, unitOf, type Unit } from "./units";
import { niceStep, ticks, type Box } from "./view";

export interface Curve {
  label: string;
  x: Num[];
  y: Num[];
}

/** Name of what two components belong to: "O1 x, ground on crank (N)" -> "O1, ground on crank". */
export function nameOfPair(label: string, key: string): string {
  const bare = labelWith(label, key, { factor: 1, symbol: "" }).replace(/\s*\([^()]*\)$/, "");
  const whole = label ? bare : nameOf(key);
  return whole.replace(/(^|\s)x(?=$|[\s,])/, "").trim();
}

/** The curves in the unit in which they are shown; pairs without their columns are left out. */
export function curvesOf(plot: Plot, table: Table): { curves: Curve[]; unit: Unit; path: boolean } {
  const column = (key: string | undefined) => table.columns.findIndex((c) => c.key === key);
  const pairs = plot.y.flatMap((key, i) => (i % 2 === 0 && column(key) >= 0 && column(plot.y[i + 1]) >= 0 ? [[column(key), column(plot.y[i + 1])]] : []));
  const size = pairs.flat().flatMap((i) => table.data[i]).reduce<number>((a, v) => Math.max(a, Math.abs(v ?? 0)), 0);
  const unit = unitOf(plot.y[0] ?? "", size);
  const scaled = (i: number) => table.data[i].map((v) => (v === null ? null : v * unit.factor));
  // The diagram shows paths of points: the origin is a place like any other.
  const path = plot.y.every((key) => key.endsWith("_m") && !key.endsWith("_N_m"));
  return { unit, path, curves: pairs.map(([x, y]) => ({ label: nameOfPair(table.columns[x].label, table.columns[x].key), x: scaled(x), y: scaled(y) })) };
}

export interface Frame {
  box: Box; // all that is seen, margins left out
  x: (value: number) => number;
  y: (value: number) => number;
  scale: number; // pixels per unit, the same along both axes
  xs: { at: number; text: string }[];
  ys: { at: number; text: string }[];
}

/** The rectangle of all curves, with the origin when it is asked for; null when there is no point. */
export function boxOf(curves: Curve[], origin: boolean): Box | null {
  const box: Box = origin ? { left: 0, right: 0, bottom: 0, top: 0 } : { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  let any = false;
  for (const { x, y } of curves)
    x.forEach((vx, i) => {
      const vy = y[i];
      if (vx === null || vy == null) return;
      any = true;
      box.left = Math.min(box.left, vx);
      box.right = Math.max(box.right, vx);
      box.bottom = Math.min(box.bottom, vy);
      box.top = Math.max(box.top, vy);
    });
  return any ? box : null;
}

/** A frame of the size given, margins left out, that holds the rectangle. */
export function frameOf(box: Box, width: number, height: number, margin: { left: number; right: number; top: number; bottom: number }): Frame {
  const [w, h] = [width - margin.left - margin.right, height - margin.top - margin.bottom];
  const least = Math.max(box.right - box.left, box.top - box.bottom, 1e-12) * 1.06;
  const scale = Math.min(w / Math.max(box.right - box.left, least / 20, 1e-300) / 1.06, h / Math.max(box.top - box.bottom, least / 20, 1e-300) / 1.06);
  const [cx, cy] = [(box.left + box.right) / 2, (box.bottom + box.top) / 2];
  const x = (v: number) => margin.left + w / 2 + (v - cx) * scale;
  const y = (v: number) => margin.top + h / 2 - (v - cy) * scale;
  const step = niceStep(70 / scale);
  const named = (low: number, high: number) => ticks(low, high, step).map((at) => ({ at, text: format(Math.abs(at) < step * 1e-6 ? 0 : at, 6) }));
  const seen = { left: cx - w / 2 / scale, right: cx + w / 2 / scale, bottom: cy - h / 2 / scale, top: cy + h / 2 / scale };
  return { box: seen, x, y, scale, xs: named(seen.left, seen.right), ys: named(seen.bottom, seen.top) };
}

/** Row whose point lies nearest to a place of the frame; -1 when there is none. */
export function nearestPoint(curves: Curve[], frame: Frame, px: number, py: number): number {
  let best = -1;
  let least = Infinity;
  for (const { x, y } of curves)
    x.forEach((vx, i) => {
      const vy = y[i];
      if (vx === null || vy == null) return;
      const distance = Math.hypot(frame.x(vx) - px, frame.y(vy) - py);
      if (distance < least) [least, best] = [distance, i];
    });
  return best;
}
