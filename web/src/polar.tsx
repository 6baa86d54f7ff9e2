// SPDX-License-Identifier: BSD-3-Clause

// Polar diagrams: the way of the tip of a vector, or of a point, with equal axes.
import type { RefObject } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { valueNear } from "./arrows";
import { Chooser, Mark, Reset, Sign, useChoice } from "./chart";
import { boxOf, curvesOf, frameOf, nearestPoint, type Frame } from "./curves";
import type { Plot, Table } from "./data";
import { boxWithin, gestureHint, listen, type Spot } from "./gestures";
import { lookOf, mostNamed, type Choice } from "./look";
import { inputAt, positionOf, turnOf } from "./motion";
import { nearestRow, sortedRows } from "./rows";
import * as state from "./state";
import { format } from "./units";
import { pathOf, type Box } from "./view";
import { nearer, shifted, type Range } from "./zoom";

const axisName = (name: string, symbol: string) => (symbol ? `${name} (${symbol})` : name);
const margin = { left: 50, right: 14, top: 12, bottom: 40 };
const height = 320;
const pale = { stroke: "--soft", dash: [] as number[] };

const inner = (width: number) => [width - margin.left - margin.right, height - margin.top - margin.bottom];

type Curves = ReturnType<typeof curvesOf>;
interface Point {
  x: number;
  y: number;
}

/** A curve that has a name, with the points at the two cursors. */
interface Named {
  label: string;
  look: number;
  fixed: Point | null;
  moving: Point | null;
}

/** The width of an element, as it changes. */
function useWidth(box: RefObject<HTMLElement>): number {
  const [width, setWidth] = useState(500);
  useEffect(() => {
    const measure = () => setWidth(box.current!.clientWidth || 500);
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(box.current!);
    return () => observer.disconnect();
  }, []);
  return width;
}

/** The fractional row of the table that is shown: that of the motion where the diagram follows it, else the one that is pointed at. */
function useRow(plot: Plot, table: Table) {
  const [hovered, setHovered] = useState<number | null>(null);
  const linked = plot.scene !== "" && plot.scene === state.sceneName.value;
  const motion = state.motion.value;
  // Rows in the order of the input of the scene that is shown.
  const order = useMemo(() => {
    const x = table.columns.findIndex((c) => c.key === plot.x);
    return linked && x >= 0 ? sortedRows(table.data[x], turnOf(motion)) : null;
  }, [plot, table, linked, motion]);
  return {
    at: order ? rowNear(order, inputAt(motion, state.position.value)) : hovered,
    /** Shows a row; negative = none is near the pointer. */
    show: (row: number) => {
      if (!order) return setHovered(row < 0 ? null : row);
      const k = order.order.indexOf(row);
      if (k >= 0) state.position.value = positionOf(motion, order.xs[k]);
    },
    hold: (on: boolean) => {
      if (order) state.held.value = on;
      else if (!on) setHovered(null);
    },
  };
}

/** The frame of the part that is zoomed into, and the gestures that choose it; `mark` sets the fixed cursor or removes it. */
function useZoom(svg: RefObject<SVGSVGElement>, all: Box | null, width: number, mark: (on: boolean) => void) {
  const [part, setPart] = useState<Box | null>(null);
  const [drag, setDrag] = useState<[Spot, Spot] | null>(null);
  const frame = useMemo(() => all && frameOf(part ?? all, width, height, margin), [all, part, width]);
  const live = useRef({ frame, mark });
  live.current = { frame, mark };
  useEffect(() => {
    const element = svg.current;
    if (!element || !all) return;
    const whole = frameOf(all, width, height, margin).box;
    const seen = () => live.current.frame!.box;
    const [w, h] = inner(width);
    const place = (p: Spot) => {
      const { left, right, bottom, top } = seen();
      return { x: left + ((p.x - margin.left) / w) * (right - left), y: top - ((p.y - margin.top) / h) * (top - bottom) };
    };
    const boxed = (x: Range | null, y: Range | null) => setPart(x && y && { left: x[0], right: x[1], bottom: y[0], top: y[1] });
    const [wholeX, wholeY] = [[whole.left, whole.right], [whole.bottom, whole.top]] as Range[];
    const nowX = () => [seen().left, seen().right] as Range;
    const nowY = () => [seen().bottom, seen().top] as Range;
    return listen(element, element as unknown as HTMLElement, {
      zoomed: () => live.current.frame!.scale > frameOf(all, width, height, margin).scale * (1 + 1e-9),
      box: (from, to, done) => {
        setDrag(done ? null : [from, to]);
        if (!done) return;
        const [a, b] = [place(from), place(to)];
        setPart({ left: Math.min(a.x, b.x), right: Math.max(a.x, b.x), bottom: Math.min(a.y, b.y), top: Math.max(a.y, b.y) });
      },
      cancel: () => setDrag(null),
      zoom: (factor, about) => {
        const p = place(about ?? { x: (margin.left + width - margin.right) / 2, y: (margin.top + height - margin.bottom) / 2 });
        boxed(nearer(nowX(), wholeX, p.x, factor), nearer(nowY(), wholeY, p.y, factor));
      },
      move: (dx, dy) => boxed(shifted(nowX(), wholeX, -dx / w), shifted(nowY(), wholeY, dy / h)),
      reset: () => setPart(null),
      click: () => live.current.mark(true),
      mark: () => live.current.mark(true),
      unmark: () => live.current.mark(false),
    });
  }, [all, width]);
  return { frame, drag, reset: part && (() => setPart(null)) };
}

/** The plane inside the axes; nothing of it is seen outside. */
function planeOf(width: number) {
  const [w, h] = inner(width);
  return { x: margin.left, y: margin.top, width: w, height: h, viewBox: `${margin.left} ${margin.top} ${w} ${h}` };
}

/** The axes and the curves. */
function Still({ frame, curves: { curves, unit, path }, choice, width }: { frame: Frame; curves: Curves; choice: Choice; width: number }) {
  return (
    <>
      <g class="grid">
        <path d={frame.xs.map((t) => `M${frame.x(t.at).toFixed(1)} ${margin.top}V${height - margin.bottom}`).join("") + frame.ys.map((t) => `M${margin.left} ${frame.y(t.at).toFixed(1)}H${width - margin.right}`).join("")} />
        {frame.xs.map((t) => <text x={frame.x(t.at)} y={height - margin.bottom + 15} text-anchor="middle">{t.text}</text>)}
        {frame.ys.map((t) => <text x={margin.left - 6} y={frame.y(t.at) + 4} text-anchor="end">{t.text}</text>)}
        <text class="name" x={(margin.left + width - margin.right) / 2} y={height - 5} text-anchor="middle">{axisName("x", unit.symbol)}</text>
        <text class="name" transform={`translate(12,${(height - margin.bottom) / 2}) rotate(-90)`} text-anchor="middle">{axisName("y", unit.symbol)}</text>
      </g>
      <svg {...planeOf(width)}>
        {!path && <path class="origin" d={`M${frame.x(0)} ${margin.top}V${height - margin.bottom}M${margin.left} ${frame.y(0)}H${width - margin.right}`} />}
        {!path && <circle class="origin" cx={frame.x(0)} cy={frame.y(0)} r={4} />}
        {curves.map((c, i) => {
          const look = choice.has(i) ? lookOf(choice.get(i)!) : pale;
          return (
            <path class={choice.has(i) ? "curve" : "curve faint"} d={pathOf(c.x.map((x, k) => (x === null || c.y[k] == null ? null : { x: frame.x(x), y: frame.y(c.y[k]!) })), false)}
              style={{ stroke: `var(${look.stroke})`, strokeDasharray: look.dash.join(" ") }}><title>{c.label}</title></path>
          );
        })}
      </svg>
    </>
  );
}

/** The fixed and the moving point of each curve that has a name. */
function Points({ frame, named, path, width }: { frame: Frame; named: Named[]; path: boolean; width: number }) {
  return (
    <svg {...planeOf(width)}>
      {named.map(({ look, fixed, moving }) => (
        <g style={{ color: `var(${lookOf(look).stroke})` }}>
          {fixed && <circle class="marked" cx={frame.x(fixed.x).toFixed(1)} cy={frame.y(fixed.y).toFixed(1)} r={4.6} />}
          {moving && (
            <g class="at" data-x={moving.x} data-y={moving.y}>
              {!path && <path d={`M${frame.x(0).toFixed(1)} ${frame.y(0).toFixed(1)}L${frame.x(moving.x).toFixed(1)} ${frame.y(moving.y).toFixed(1)}`} />}
              <circle cx={frame.x(moving.x).toFixed(1)} cy={frame.y(moving.y).toFixed(1)} r={4.6} />
            </g>
          )}
        </g>
      ))}
    </svg>
  );
}

function Legend({ named, unit, path }: { named: Named[]; unit: Curves["unit"]; path: boolean }) {
  const withUnit = (text: string) => `${text}${unit.symbol ? ` ${unit.symbol}` : ""}`;
  const text = ({ x, y }: Point) => (path ? withUnit(`(${format(x, 5)}, ${format(y, 5)})`) : `${withUnit(format(Math.hypot(x, y), 5))} (${format(x, 4)}, ${format(y, 4)})`);
  return (
    <div class="legend">
      {named.map(({ label, look, fixed, moving }) => (
        <span><Sign look={lookOf(look)} />{label} {moving && <b>{text(moving)}{fixed && ` (Δ ${format(moving.x - fixed.x, 4)}, ${format(moving.y - fixed.y, 4)})`}</b>}</span>
      ))}
    </div>
  );
}

export function Polar({ plot, table }: { plot: Plot; table: Table }) {
  const box = useRef<HTMLDivElement>(null);
  const svg = useRef<SVGSVGElement>(null);
  const width = useWidth(box);
  const [mark, setMark] = useState<number | null>(null); // row of the fixed cursor
  const drawn = useMemo(() => curvesOf(plot, table), [plot, table]);
  const { curves, unit, path } = drawn;
  const labels = curves.map((c) => c.label);
  const [choice, choose] = useChoice(labels, false);
  const all = useMemo(() => boxOf(curves, !path), [curves, path]);
  const { at, show, hold } = useRow(plot, table);
  const { frame, drag, reset } = useZoom(svg, all, width, (on) => setMark(on && at !== null ? Math.round(at) : null));
  // The part that does not move is not written again as the mechanism moves.
  const still = useMemo(() => frame && <Still frame={frame} curves={drawn} choice={choice} width={width} />, [frame, drawn, choice, width]);
  if (!frame) return <div ref={box}><p class="note">No values.</p></div>;
  const placeOf = (i: number, row: number | null) => {
    if (row === null) return null;
    const [x, y] = [valueNear(curves[i].x, row), valueNear(curves[i].y, row)];
    return x === null || y === null ? null : { x, y };
  };
  const point = (event: PointerEvent) => {
    if (drag || (event.buttons && event.pointerType === "mouse")) return;
    const { left, top } = (event.currentTarget as Element).getBoundingClientRect();
    show(nearestPoint(curves, frame, event.clientX - left, event.clientY - top));
  };
  const named = [...choice].sort((a, b) => a[0] - b[0]).map(([i, look]) => ({ label: labels[i], look, fixed: placeOf(i, mark), moving: placeOf(i, at) }));
  const dragged = drag && boxWithin(drag[0], drag[1], width, height);
  return (
    <>
      <div class="diagram polar" ref={box}>
        <svg ref={svg} viewBox={`0 0 ${width} ${height}`} width={width} height={height} role="img" tabindex={0} aria-label={`${plot.title}: ${labels.join(", ")}; equal axes${unit.symbol ? ` in ${unit.symbol}` : ""}`} aria-description={gestureHint}
          onPointerEnter={() => hold(true)} onPointerLeave={() => hold(false)} onPointerMove={point} onPointerDown={(e) => e.pointerType !== "mouse" && point(e)}>
          {still}
          <Points frame={frame} named={named} path={path} width={width} />
          {dragged && <rect class="drag" x={dragged.left} y={dragged.top} width={dragged.right - dragged.left} height={dragged.bottom - dragged.top} />}
        </svg>
        {reset && <Reset onClick={reset} />}
      </div>
      <Legend named={named} unit={unit} path={path} />
      {mark !== null && <Mark remove={() => setMark(null)}><span>A is fixed; Δ is from A to the moving point</span></Mark>}
      {curves.length > mostNamed && <Chooser names={labels} choice={choice} choose={choose} />}
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
