// Polar diagrams: the way of the tip of a vector, or of a point, with equal axes.
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { valueNear } from "./arrows";
import { Chooser, Mark, Reset, Sign, useChoice } from "./chart";
import { boxOf, curvesOf, frameOf, nearestPoint } from "./curves";
import type { Plot, Table } from "./data";
import { boxWithin, gestureHint, listen, type Spot } from "./gestures";
import { lookOf, mostNamed } from "./look";
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

export function Polar({ plot, table }: { plot: Plot; table: Table }) {
  const box = useRef<HTMLDivElement>(null);
  const svg = useRef<SVGSVGElement>(null);
  const [width, setWidth] = useState(500);
  const [part, setPart] = useState<Box | null>(null);  // zoomed part
  const [drag, setDrag] = useState<[Spot, Spot] | null>(null);
  const [mark, setMark] = useState<number | null>(null); // row of the fixed cursor
  const [hovered, setHovered] = useState<number | null>(null); // row of the table
  useEffect(() => {
    const measure = () => setWidth(box.current!.clientWidth || 500);
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(box.current!);
    return () => observer.disconnect();
  }, []);
  const { curves, unit, path } = useMemo(() => curvesOf(plot, table), [plot, table]);
  const [choice, choose] = useChoice(curves.map((c) => c.label), false);
  const all = useMemo(() => boxOf(curves, !path), [curves, path]);
  const frame = useMemo(() => all && frameOf(part ?? all, width, height, margin), [all, part, width]);
  const linked = plot.scene !== "" && plot.scene === state.sceneName.value;
  const motion = state.motion.value;
  // Rows in the order of the input of the scene that is shown.
  const order = useMemo(() => {
    const x = table.columns.findIndex((c) => c.key === plot.x);
    return linked && x >= 0 ? sortedRows(table.data[x], turnOf(motion)) : null;
  }, [plot, table, linked, motion]);
  const at = order ? rowNear(order, inputAt(motion, state.position.value)) : hovered;
  const live = useRef({ frame, at });
  live.current = { frame, at };
  useEffect(() => {
    const element = svg.current;
    if (!element || !all) return;
    const whole = frameOf(all, width, height, margin).box;
    const seen = () => live.current.frame!.box;
    const place = (p: Spot) => {
      const { left, right, bottom, top } = seen();
      return { x: left + ((p.x - margin.left) / (width - margin.left - margin.right)) * (right - left), y: top - ((p.y - margin.top) / (height - margin.top - margin.bottom)) * (top - bottom) };
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
      move: (dx, dy) => boxed(shifted(nowX(), wholeX, -dx / (width - margin.left - margin.right)), shifted(nowY(), wholeY, dy / (height - margin.top - margin.bottom))),
      reset: () => setPart(null),
      click: () => setMark(live.current.at === null ? null : Math.round(live.current.at)),
      mark: () => setMark(live.current.at === null ? null : Math.round(live.current.at)),
      unmark: () => setMark(null),
    });
  }, [all, width]);
  // The size of the area inside the axes; nothing of it is seen outside.
  const [w, h] = [width - margin.left - margin.right, height - margin.top - margin.bottom];
  const plane = { x: margin.left, y: margin.top, width: w, height: h, viewBox: `${margin.left} ${margin.top} ${w} ${h}` };
  // Parts that do not move are not written again as the mechanism moves.
  const still = useMemo(() => frame && (
    <>
      <g class="grid">
        <path d={frame.xs.map((t) => `M${frame.x(t.at).toFixed(1)} ${margin.top}V${height - margin.bottom}`).join("") + frame.ys.map((t) => `M${margin.left} ${frame.y(t.at).toFixed(1)}H${width - margin.right}`).join("")} />
        {frame.xs.map((t) => <text x={frame.x(t.at)} y={height - margin.bottom + 15} text-anchor="middle">{t.text}</text>)}
        {frame.ys.map((t) => <text x={margin.left - 6} y={frame.y(t.at) + 4} text-anchor="end">{t.text}</text>)}
        <text class="name" x={(margin.left + width - margin.right) / 2} y={height - 5} text-anchor="middle">{axisName("x", unit.symbol)}</text>
        <text class="name" transform={`translate(12,${(height - margin.bottom) / 2}) rotate(-90)`} text-anchor="middle">{axisName("y", unit.symbol)}</text>
      </g>
      <svg {...plane}>
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
  ), [frame, curves, choice, width, path, unit]);
  if (!frame) return <div ref={box}><p class="note">No values.</p></div>;
  const placeOf = (i: number, row: number | null) => {
    if (row === null) return null;
    const [x, y] = [valueNear(curves[i].x, row), valueNear(curves[i].y, row)];
    return x === null || y === null ? null : { x, y };
  };
  const rowAt = (event: PointerEvent) => {
    const rectangle = (event.currentTarget as Element).getBoundingClientRect();
    return nearestPoint(curves, frame, event.clientX - rectangle.left, event.clientY - rectangle.top);
  };
  const point = (event: PointerEvent) => {
    if (drag || (event.buttons && event.pointerType === "mouse")) return;
    const row = rowAt(event);
    if (!order) return setHovered(row < 0 ? null : row);
    const k = order.order.indexOf(row);
    if (k >= 0) state.position.value = positionOf(motion, order.xs[k]);
  };
  const hold = (on: boolean) => {
    if (order) state.held.value = on;
    else if (!on) setHovered(null);
  };
  const withUnit = (text: string) => `${text}${unit.symbol ? ` ${unit.symbol}` : ""}`;
  const named = [...choice].sort((a, b) => a[0] - b[0]);
  const text = ({ x, y }: { x: number; y: number }) => (path ? withUnit(`(${format(x, 5)}, ${format(y, 5)})`) : `${withUnit(format(Math.hypot(x, y), 5))} (${format(x, 4)}, ${format(y, 4)})`);
  const dragged = drag && boxWithin(drag[0], drag[1], width, height);
  return (
    <>
      <div class="diagram polar" ref={box}>
        <svg ref={svg} viewBox={`0 0 ${width} ${height}`} width={width} height={height} role="img" tabindex={0} aria-label={`${plot.title}: ${curves.map((c) => c.label).join(", ")}; equal axes${unit.symbol ? ` in ${unit.symbol}` : ""}`} aria-description={gestureHint}
          onPointerEnter={() => hold(true)} onPointerLeave={() => hold(false)} onPointerMove={point} onPointerDown={(e) => e.pointerType !== "mouse" && point(e)}>
          {still}
          <svg {...plane}>
            {named.map(([i, look]) => {
              const [a, p] = [placeOf(i, mark), placeOf(i, at)];
              return (
                <g style={{ color: `var(${lookOf(look).stroke})` }}>
                  {a && <circle class="marked" cx={frame.x(a.x).toFixed(1)} cy={frame.y(a.y).toFixed(1)} r={4.6} />}
                  {p && (
                    <g class="at" data-x={p.x} data-y={p.y}>
                      {!path && <path d={`M${frame.x(0).toFixed(1)} ${frame.y(0).toFixed(1)}L${frame.x(p.x).toFixed(1)} ${frame.y(p.y).toFixed(1)}`} />}
                      <circle cx={frame.x(p.x).toFixed(1)} cy={frame.y(p.y).toFixed(1)} r={4.6} />
                    </g>
                  )}
                </g>
              );
            })}
          </svg>
          {dragged && <rect class="drag" x={dragged.left} y={dragged.top} width={dragged.right - dragged.left} height={dragged.bottom - dragged.top} />}
        </svg>
        {part && <Reset onClick={() => setPart(null)} />}
      </div>
      <div class="legend">
        {named.map(([i, look]) => {
          const [a, p] = [placeOf(i, mark), placeOf(i, at)];
          return (
            <span><Sign look={lookOf(look)} />{curves[i].label} {p && <b>{text(p)}{a && ` (Δ ${format(p.x - a.x, 4)}, ${format(p.y - a.y, 4)})`}</b>}</span>
          );
        })}
      </div>
      {mark !== null && <Mark remove={() => setMark(null)}><span>A is fixed; Δ is from A to the moving point</span></Mark>}
      {curves.length > mostNamed && <Chooser names={curves.map((c) => c.label)} choice={choice} choose={choose} />}
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
