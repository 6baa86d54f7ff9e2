// Polar diagrams: the way of the tip of a vector, or of a point, with equal axes.
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { valueNear } from "./arrows";
import { curvesOf, frameOf, nearestPoint } from "./curves";
import type { Plot, Table } from "./data";
import { lookOf } from "./look";
import { inputAt, positionOf, turnOf } from "./motion";
import { nearestRow, sortedRows } from "./rows";
import * as state from "./state";
import { format } from "./units";
import { pathOf } from "./view";

const styleOf = (index: number) => ({ stroke: `var(${lookOf(index).stroke})`, strokeDasharray: lookOf(index).dash.join(" ") });
const axisName = (name: string, symbol: string) => (symbol ? `${name} (${symbol})` : name);
const margin = { left: 50, right: 14, top: 12, bottom: 40 };
const height = 320;

export function Polar({ plot, table }: { plot: Plot; table: Table }) {
  const box = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(500);
  useEffect(() => {
    const measure = () => setWidth(box.current!.clientWidth || 500);
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(box.current!);
    return () => observer.disconnect();
  }, []);
  const { curves, unit } = useMemo(() => curvesOf(plot, table), [plot, table]);
  const frame = useMemo(() => frameOf(curves, width, height, margin), [curves, width]);
  const linked = plot.scene !== "" && plot.scene === state.scene.value?.name;
  const motion = state.motion.value;
  // Rows in the order of the input of the scene that is shown.
  const order = useMemo(() => {
    const x = table.columns.findIndex((c) => c.key === plot.x);
    return linked && x >= 0 ? sortedRows(table.data[x], turnOf(motion)) : null;
  }, [plot, table, linked, motion]);
  if (!frame) return <div ref={box}><p class="note">No values.</p></div>;
  const at = order ? rowNear(order, inputAt(motion, state.position.value)) : null;
  const now = curves.map((c) => {
    if (at === null) return null;
    const [x, y] = [valueNear(c.x, at), valueNear(c.y, at)];
    return x === null || y === null ? null : { x, y };
  });
  const point = (event: PointerEvent) => {
    if (!order) return;
    const rectangle = (event.currentTarget as Element).getBoundingClientRect();
    const row = nearestPoint(curves, frame, event.clientX - rectangle.left, event.clientY - rectangle.top);
    const k = order.order.indexOf(row);
    if (k >= 0) state.position.value = positionOf(motion, order.xs[k]);
  };
  const hold = (on: boolean) => order && (state.held.value = on);
  return (
    <>
      <div class="polar" ref={box}>
        <svg viewBox={`0 0 ${width} ${height}`} width={width} height={height} role="img" aria-label={`${plot.title}: ${curves.map((c) => c.label).join(", ")}; equal axes${unit.symbol ? ` in ${unit.symbol}` : ""}`}
          onPointerEnter={() => hold(true)} onPointerLeave={() => hold(false)} onPointerMove={point} onPointerDown={point}>
          <g class="grid">
            <path d={frame.xs.map((t) => `M${frame.x(t.at).toFixed(1)} ${margin.top}V${height - margin.bottom}`).join("") + frame.ys.map((t) => `M${margin.left} ${frame.y(t.at).toFixed(1)}H${width - margin.right}`).join("")} />
            <path class="origin" d={`M${frame.x(0)} ${margin.top}V${height - margin.bottom}M${margin.left} ${frame.y(0)}H${width - margin.right}`} />
            <circle class="origin" cx={frame.x(0)} cy={frame.y(0)} r={4} />
            {frame.xs.map((t) => <text x={frame.x(t.at)} y={height - margin.bottom + 15} text-anchor="middle">{t.text}</text>)}
            {frame.ys.map((t) => <text x={margin.left - 6} y={frame.y(t.at) + 4} text-anchor="end">{t.text}</text>)}
            <text class="name" x={(margin.left + width - margin.right) / 2} y={height - 5} text-anchor="middle">{axisName("x", unit.symbol)}</text>
            <text class="name" transform={`translate(12,${(height - margin.bottom) / 2}) rotate(-90)`} text-anchor="middle">{axisName("y", unit.symbol)}</text>
          </g>
          {curves.map((c, i) => (
            <path class="curve" d={pathOf(c.x.map((x, k) => (x === null || c.y[k] == null ? null : { x: frame.x(x), y: frame.y(c.y[k]!) })), false)}
              style={styleOf(i)}><title>{c.label}</title></path>
          ))}
          {now.map((p, i) => p && (
            <g class="at" style={{ color: `var(${lookOf(i).stroke})` }} data-x={p.x} data-y={p.y}>
              <path d={`M${frame.x(0).toFixed(1)} ${frame.y(0).toFixed(1)}L${frame.x(p.x).toFixed(1)} ${frame.y(p.y).toFixed(1)}`} />
              <circle cx={frame.x(p.x).toFixed(1)} cy={frame.y(p.y).toFixed(1)} r={4.6} />
            </g>
          ))}
        </svg>
      </div>
      <div class="legend">
        {curves.map((c, i) => (
          <span><svg viewBox="0 0 24 6" aria-hidden="true"><path d="M0 3H24" style={styleOf(i)} /></svg>
            {c.label} {now[i] && <b>{`${format(Math.hypot(now[i]!.x, now[i]!.y), 5)}${unit.symbol ? ` ${unit.symbol}` : ""} (${format(now[i]!.x, 4)}, ${format(now[i]!.y, 4)})`}</b>}</span>
        ))}
      </div>
    </>
  );
}

/** Fractional row of the table at an input: rows next to each other are interpolated, others are not. */
function rowNear({ xs, order }: { xs: number[]; order: number[] }, input: number): number | null {
  const k = nearestRow(xs, input);
  if (k < 0) return null;
  const other = input > xs[k] ? k + 1 : k - 1;
  const row = order[k];
  if (order[other] === undefined || Math.abs(order[other] - row) !== 1 || xs[other] === xs[k]) return row;
  return row + (order[other] - row) * Math.min(0.5, Math.max(0, (input - xs[k]) / (xs[other] - xs[k])));
}
