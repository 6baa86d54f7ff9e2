// SPDX-License-Identifier: BSD-3-Clause

// The board and its pen: by mouse, pen, finger or keyboard.
import { signal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { placeAt, type Place } from "../motion";
import { format } from "../units";
import { niceStep, pathOf, ticks } from "../view";
import { smoothed } from "./path";
import { machines } from "./path_search";
import { reachOf, sheet, takeStroke, type Frame } from "./path_sheet";

/** The stroke that is being drawn; empty while the pen is up. */
const stroke = signal<Place[]>([]);
/** The place of the keyboard's pen, while the board has the focus. */
const cursor = signal<Place | null>(null);
const reach = signal(6); // mm within which the stroke closes

export const penIsDown = () => stroke.peek().length > 0;
export const liftPen = () => (stroke.value = []);

function endStroke(): void {
  const drawn = stroke.value;
  stroke.value = [];
  if (drawn.length > 1) takeStroke(drawn, reach.value);
}

const closes = (drawn: Place[]) => {
  const [a, b] = [drawn[0], drawn[drawn.length - 1]];
  return drawn.length > 12 && Math.hypot(a.x - b.x, a.y - b.y) <= reach.value;
};

/** Lines at round numbers of millimetres, with their numbers at the edges. */
function Scale({ frame: { x, y, width, height } }: { frame: Frame }) {
  const step = niceStep(width / 4);
  const [right, top] = [x + width, y + height];
  const size = width / 46;
  const lines = (by: number) => [...ticks(x, right, by).map((v) => `M${v} ${-top}V${-y}`), ...ticks(y, top, by).map((v) => `M${x} ${-v}H${right}`)].join("");
  const within = (v: number, low: number, high: number) => v > low + 2 * size && v < high - 2 * size;
  return (
    <g class="scale" style={{ fontSize: `${size}px` }} aria-hidden="true">
      <path d={lines(step / 5)} />
      <path class="major" d={lines(step)} />
      {ticks(x, right, step).filter((v) => within(v, x, right - 5 * size)).map((v) => <text key={`x${v}`} x={v} y={-y - size / 2} text-anchor="middle">{format(v, 5)}</text>)}
      {ticks(y, top, step).filter((v) => within(v, y, top)).map((v) => <text key={`y${v}`} x={x + size / 2} y={-v - size / 4}>{format(v, 5)}</text>)}
      <text x={right - size / 2} y={-y - size / 2} text-anchor="end">mm</text>
    </g>
  );
}

/** The curve of the best machine, over the path. */
function BestCurve() {
  const scene = machines.value[0]?.scene;
  if (!scene) return null;
  return <>{scene.traces.map((t, k) => <path key={k} class="curve" d={pathOf(scene.input.map((_, i) => {
    const p = placeAt(scene, t.point, i);
    return p && { x: 1000 * p.x, y: -1000 * p.y };
  }), t.closed)} />)}</>;
}

/** Arrows move the pen, Enter lowers and lifts it. */
function onKey(event: KeyboardEvent): void {
  const { frame } = sheet.value;
  const step = ((event.shiftKey ? 1 : 5) * frame.width) / 200;
  const way = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] } as Record<string, number[]>)[event.key];
  const pressed = event.key === "Enter" || event.key === " ";
  if ((!way && !pressed) || event.ctrlKey || event.metaKey) return;
  event.preventDefault();
  const now = cursor.value ?? middleOf(frame);
  const held = (v: number, low: number, size: number) => Math.max(low, Math.min(low + size, v));
  const to = way ? { x: held(now.x + step * way[0], frame.x, frame.width), y: held(now.y + step * way[1], frame.y, frame.height) } : now;
  cursor.value = to;
  reach.value = reachOf(frame, "key");
  if (way && penIsDown()) stroke.value = [...stroke.value, to];
  else if (pressed && penIsDown()) endStroke();
  else if (pressed) stroke.value = [to];
}

const middleOf = ({ x, y, width, height }: Frame): Place => ({ x: x + width / 2, y: y + height / 2 });

function Stroke() {
  const drawn = stroke.value;
  if (!drawn.length) return null;
  return (
    <>
      <circle class={closes(drawn) ? "snap closes" : "snap"} cx={drawn[0].x} cy={-drawn[0].y} r={reach.value} />
      <path class="drawn" d={pathOf(drawn.map((p) => ({ x: p.x, y: -p.y })), false)} />
    </>
  );
}

function Ends() {
  const { path, frame } = sheet.value;
  if (!path || stroke.value.length) return null;
  const ends = path.closed ? [path.points[0]] : [path.points[0], path.points[path.points.length - 1]];
  return <>{ends.map((p, i) => <circle key={i} class={i ? "end" : "end first"} cx={p.x} cy={-p.y} r={frame.width / 110} />)}</>;
}

export function PathBoard() {
  const svg = useRef<SVGSVGElement>(null);
  const { path, frame } = sheet.value;
  const placeOf = (event: PointerEvent): Place => {
    const m = svg.current!.getScreenCTM()!.inverse();
    return { x: m.a * event.clientX + m.e, y: -(m.d * event.clientY + m.f) };
  };
  const draw = (event: PointerEvent) => {
    if (!penIsDown()) return;
    const all = event.getCoalescedEvents?.() ?? [];
    stroke.value = [...stroke.value, ...(all.length ? all : [event]).map(placeOf)];
  };
  return (
    <svg ref={svg} id="path-board" viewBox={`${frame.x} ${-frame.y - frame.height} ${frame.width} ${frame.height}`} tabIndex={0} role="application" aria-roledescription="drawing board"
      aria-label={`Board for the path, ${format(frame.width, 4)} mm wide. Arrow keys move the pen, Enter lowers and lifts it.`}
      onKeyDown={onKey} onFocus={() => svg.current!.matches(":focus-visible") && (cursor.value ??= middleOf(frame))} onBlur={() => {
        endStroke();
        cursor.value = null;
      }}
      onPointerDown={(e) => {
        if (e.button !== 0 || !e.isPrimary) return;
        cursor.value = null;
        reach.value = reachOf(frame, e.pointerType);
        stroke.value = [placeOf(e)];
        svg.current!.setPointerCapture(e.pointerId);
      }}
      onPointerMove={draw} onPointerUp={endStroke} onPointerCancel={liftPen}>
      <Scale frame={frame} />
      {path && !stroke.value.length && <path class="path" d={smoothed(path)} />}
      <BestCurve />
      <Ends />
      <Stroke />
      {cursor.value && <path class="cursor" d="M-6 0H-1.5M1.5 0H6M0 -6V-1.5M0 1.5V6" transform={`translate(${cursor.value.x} ${-cursor.value.y}) scale(${frame.width / 200})`} />}
    </svg>
  );
}
