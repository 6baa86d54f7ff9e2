// SPDX-License-Identifier: BSD-3-Clause

// The appearance of a diagram: its axes, its curves and the bands between them, in the form of uPlot.
import uPlot from "uplot";
import type { Num } from "./data";
import { logTicks } from "./logarithm";
import { lookOf } from "./look";
import { format } from "./units";
import { degreeSteps } from "./zoom";

const css = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export interface Curve {
  name: string;
  kind: "curve" | "edge" | "baseline" | "bars"; // edges come in pairs, the lower one first
  points?: boolean;
  stepped?: boolean;
  group?: number;
}

export interface Side {
  label: string;
  symbol: string; // unit symbol
  log?: boolean; // the data are logarithms
}

export const withUnit = (text: string, symbol: string) => (symbol ? `${text} ${symbol}` : text);
const fits = (label: string, height: number) => 6.4 * label.length <= height - 50;

/** The number that a value of the data stands for, which may be its logarithm. */
export const numberOf = (value: Num, side: Side): Num => (value !== null && side.log ? 10 ** value : value);
export const valueText = (value: Num | undefined, side: Side): string => withUnit(format(numberOf(value ?? null, side), 5), side.symbol);

export function axisOf(side: Side, up: boolean, height: number): uPlot.Axis {
  return {
    // Beside the values stands the label where the diagram is high enough for it, else the unit, for the legend has the name.
    label: !up || fits(side.label, height) ? side.label : side.symbol,
    side: up ? 3 : 2,
    labelSize: 20,
    labelFont: "12px system-ui, sans-serif",
    font: "11px system-ui, sans-serif",
    stroke: () => css("--soft"),
    grid: { stroke: () => css("--faint"), width: 1 },
    ticks: { stroke: () => css("--line"), width: 1, size: 5 },
    ...(side.log ? { splits: (_: uPlot, __: number, low: number, high: number) => logTicks(low, high) } : {}),
    ...(side.symbol === "°" ? { incrs: degreeSteps } : {}),
    values: (_, ticks) => ticks.map((t) => (t === null ? "" : format(side.log ? 10 ** t : t, 5))),
    size: (_, values) => (up ? Math.max(40, 14 + 6.4 * (values ?? []).reduce((n, v) => Math.max(n, v.length), 0)) : 30),
  };
}

export interface Look {
  stroke: string;
  dash: number[];
  width: number;
  alpha: number;
}

/** The look of a curve while the group `now` is present; `pointed` is true if the pointer is at it. */
export function drawn(curve: Curve, look: number | undefined, bundle: boolean, anyNamed: boolean, now: number, pointed: boolean): Look {
  const here = now < 0 || curve.group === now;
  if (curve.kind === "baseline") return { stroke: "--soft", dash: [5, 4], width: pointed ? 2.4 : 1.4, alpha: here || pointed ? 0.85 : bundle ? 0.12 : 0.35 };
  const width = pointed ? 3.4 : now < 0 ? 2 : here ? 3 : 1.4;
  if (look !== undefined) return { ...lookOf(look), width, alpha: here || pointed ? 1 : 0.7 };
  if (pointed || (here && now >= 0)) return { stroke: "--accent", dash: [], width, alpha: 1 };
  return { stroke: anyNamed ? "--soft" : "--accent", dash: [], width: now < 0 ? 1.5 : 1.4, alpha: here ? 0.5 : 0.3 };
}

/** `look` is asked whenever the curve is drawn, for the colours of the page change. */
export function seriesOf(curve: Curve, look: () => Look): uPlot.Series {
  if (curve.kind === "edge") return { stroke: "transparent", width: 0, points: { show: false } };
  if (curve.kind === "bars") return { fill: css("--c0"), stroke: css("--c0"), width: 0, paths: uPlot.paths.bars!({ size: [0.92] }), points: { show: false } };
  const { width, alpha, dash } = look();
  const stroke = () => css(look().stroke);
  return {
    stroke, dash, alpha, width: curve.points ? 0 : width, pxAlign: 0, spanGaps: curve.stepped,
    paths: curve.points ? () => null : curve.stepped ? uPlot.paths.stepped!({ align: 1 }) : undefined,
    points: { show: curve.points ?? false, size: 7, fill: stroke },
  };
}

/** Areas between two edges that follow each other. */
export const bandsOf = (curves: Curve[]): uPlot.Band[] =>
  curves.flatMap((c, i) => (c.kind === "edge" && curves.slice(0, i).filter((e) => e.kind === "edge").length % 2 === 1 ? [{ series: [i + 1, i] as [number, number], fill: `${css("--good")}30` }] : []));
