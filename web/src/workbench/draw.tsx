// SPDX-License-Identifier: BSD-3-Clause

// Drawing a linkage from nothing: press where pins are; links, ground, guides, the drive, springs, loads and gears follow.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { symbolLines } from "../arrows";
import { moveFocus } from "../controls";
import { format } from "../units";
import { replace } from "./document";
import { freedom, missing } from "./mobility";
import { blank, bodiesAt, elementName, jointOf, kinds, most, pinName, radiiOf, studyOf, valueOf, wheelsOf, type Place, type Sketch, type SketchElement } from "./sketch";
import { cornersOf, gripAt, pinAt, pitchOf, tipOf, tools, withElement, withPin, type Drag, type Press } from "./tools";

export const showDraw = signal(false);

const sketch = signal<Sketch>(blank);
const past = signal<Sketch[]>([]);
const tool = signal(tools[0]);
const from = signal<number | null>(null); // the point from which the next link, spring or gear goes
const snap = signal(true);
const picture = signal<{ url: string; width: number } | null>(null);
/** The place at which the keyboard points, while the board has the focus. */
const cursor = signal<Place | null>(null);

/** mm that are seen: what a finger can press on a phone. */
const paper = matchMedia("(max-width: 600px)").matches ? { width: 300, height: 360 } : { width: 600, height: 400 };
const grid = 10; // mm
/** px within which a press means a pin: fingers are broader than pointers. */
const near = (pointer: string) => (pointer === "touch" ? 18 : 9);

function undo(): void {
  const before = past.value[past.value.length - 1];
  if (!before || gesture.value) return;
  past.value = past.value.slice(0, -1);
  sketch.value = before;
  from.value = null;
}
/** A press, and what is dragged until it ends: one step of the history. */
const gesture = signal<{ before: Sketch; drag?: Drag } | null>(null);
function begin(at: Press, alone: boolean): void {
  const before = sketch.value;
  const grip = alone ? gripAt(before, at) : null;
  const done = grip ? { sketch: before, drag: grip } : tool.value.press(before, at, from.value);
  gesture.value = { before, drag: done?.drag };
  if (!done) return;
  sketch.value = done.sketch;
  if (done.from !== undefined) from.value = done.from;
}
function goOn(to: Press): void {
  if (gesture.value?.drag) sketch.value = gesture.value.drag(sketch.value, to);
}
function end(): void {
  if (gesture.value && gesture.value.before !== sketch.value) past.value = [...past.value, gesture.value.before];
  gesture.value = null;
}
function set(next: Sketch): void {
  past.value = [...past.value, sketch.value];
  sketch.value = next;
  from.value = null;
}

const d = (...lines: Place[][]) => lines.map((line) => `M${line.map(({ x, y }) => `${x.toFixed(2)} ${(-y).toFixed(2)}`).join("L")}`).join("");
const colourOf = (body: string) => (/^link \d/.test(body) ? `var(--c${((Number(body.slice(5)) - 1) % 6) + 1})` : "var(--ink)");

/** Springs, gears and forces as they are drawn; what sits on a pin is drawn with it. */
function Element({ element: e }: { element: SketchElement }) {
  const s = sketch.value;
  const [a, b] = e.pins.map((i) => s.pins[i]);
  const name = elementName(s, e);
  if (e.kind === "spring") {
    const damped = valueOf(s, e, "damping_N_s_per_m") > 0;
    const sprung = valueOf(s, e, "stiffness_N_per_mm") > 0;
    const size = Math.hypot(b.x - a.x, b.y - a.y) || 1;
    // Both stand beside each other, joined at their ends.
    const beside = (by: number) => [a, b].map((p) => ({ x: p.x - (by * (b.y - a.y)) / size, y: p.y + (by * (b.x - a.x)) / size }));
    const off = damped && sprung ? 7 : 0;
    const [left, right] = [beside(off), beside(-off)];
    const lines = [...(sprung || !damped ? symbolLines("spring", left[0], left[1], 11) : []), ...(damped ? symbolLines("damper", right[0], right[1], 11) : []),
      ...(off ? [[left[0], right[0]], [left[1], right[1]]] : [])];
    return <path class="symbol" data-element={name} d={d(...lines)} />;
  }
  if (e.kind === "gear") {
    const meet = pitchOf(s, e);
    const wheels = wheelsOf(s, e);
    return (
      <g class="gear" data-element={name}>
        {radiiOf(s, e).map((r, k) => Number.isFinite(r) && <circle key={k} cx={[a, b][k].x} cy={-[a, b][k].y} r={Math.abs(r)} style={wheels ? { stroke: colourOf([wheels.first, wheels.second][k]) } : undefined} />)}
        <path d={d([a, b])} />
        <circle class="mark" cx={meet.x} cy={-meet.y} r="3" />
        <text x={meet.x + 6} y={-meet.y - 6}>{format(valueOf(s, e, "ratio"), 3)}</text>
      </g>
    );
  }
  if (e.kind !== "force") return null;
  const tip = tipOf(s, e);
  const angle = Math.atan2(tip.y - a.y, tip.x - a.x);
  const barb = (turn: number) => ({ x: tip.x - 9 * Math.cos(angle + turn), y: tip.y - 9 * Math.sin(angle + turn) });
  return (
    <g class="force" data-element={name}>
      <path d={d([a, tip], [barb(0.4), tip, barb(-0.4)])} />
      <text x={tip.x + 6} y={-tip.y + 4}>{`${format(Math.hypot(valueOf(s, e, "x_N"), valueOf(s, e, "y_N")), 4)} N`}</text>
    </g>
  );
}

/** A torsion spring: two turns about its pin. */
const spiral = d(Array.from({ length: 41 }, (_, k) => ({ x: (6 + k / 5) * Math.cos((k * Math.PI) / 10), y: (6 + k / 5) * Math.sin((k * Math.PI) / 10) })), [{ x: 14, y: 0 }, { x: 20, y: 0 }]);

function PinSign({ i }: { i: number }) {
  const s = sketch.value;
  const p = s.pins[i];
  const on = (kind: string) => s.elements.find((e) => e.kind === kind && e.pins[0] === i);
  const [drive, twist] = [on("drive"), on("torsion_spring")];
  const joint = drive && jointOf(s, drive);
  return (
    <g class={`pin${from.value === i ? " last" : ""}${bodiesAt(s, i).length > 1 || !p.traced ? "" : " tracer"}`} data-pin={pinName(i)} transform={`translate(${p.x} ${-p.y})`}>
      {p.ground && <path class="ground" d="M0 0L-9 13H9ZM-13 13H13M-10 13l-4 5M-4 13l-4 5M2 13l-4 5M8 13l-4 5" />}
      {p.guide !== null && <rect class="block" x="-10" y="-6" width="20" height="12" transform={`rotate(${-p.guide})`} />}
      {twist && <path class="twist" d={spiral} />}
      <circle r={bodiesAt(s, i).length > 1 ? 4.5 : 3} />
      {drive && joint?.slides && <path class="drive" transform={`rotate(${-p.guide!})`} d="M-20 13H20M20 13l-6 -4M20 13l-6 4" />}
      {drive && !joint?.slides && <path class="drive" style={joint && { stroke: colourOf(joint.second) }} d="M12 4A12.6 12.6 0 1 0 -12 4M-12 4l-3 -6M-12 4l5.5 -3" />}
      {p.traced && <circle class="traced" r="8" />}
      <text x="8" y="-8">{pinName(i)}</text>
    </g>
  );
}

function Board() {
  const svg = useRef<SVGSVGElement>(null);
  const at = (event: PointerEvent): Press => {
    const m = svg.current!.getScreenCTM()!.inverse();
    return { x: m.a * event.clientX + m.e, y: -(m.d * event.clientY + m.f), reach: m.a * near(event.pointerType), grid: snap.value ? grid : 0, more: event.shiftKey };
  };
  const { pins, links, elements } = sketch.value;
  const hidden = { x: -paper.width / 2, y: -paper.height / 2 };
  /** Arrows move a cursor, Enter presses there; what a drag would change, arrows change until Enter once more. */
  const onKey = (event: KeyboardEvent) => {
    const step = snap.value ? grid : 2;
    const way = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] } as Record<string, number[]>)[event.key];
    const pressed = event.key === "Enter" || event.key === " ";
    if ((!way && !pressed) || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    const now = cursor.value ?? { x: 0, y: 0 };
    const clamped = (v: number, size: number) => Math.max(-size / 2, Math.min(size / 2, v));
    const to = way ? { x: clamped(now.x + step * way[0], paper.width), y: clamped(now.y + step * way[1], paper.height) } : now;
    cursor.value = to;
    const there: Press = { ...to, reach: step / 2 + 1, grid: snap.value ? grid : 0, more: event.shiftKey };
    if (way) goOn(there);
    else if (gesture.value) end();
    else {
      begin(there, event.altKey);
      if (!gesture.peek()?.drag) end();
    }
  };
  return (
    <svg ref={svg} id="board" viewBox={`${hidden.x} ${hidden.y} ${paper.width} ${paper.height}`} tabIndex={0} role="application" aria-roledescription="drawing board"
      aria-label={`Drawing board: ${pins.length} pins, ${links.length} links. Arrows move the cursor, Enter presses there.`}
      onKeyDown={onKey} onFocus={() => svg.current!.matches(":focus-visible") && (cursor.value ??= { x: 0, y: 0 })} onBlur={() => {
        end();
        cursor.value = null;
      }}
      onPointerDown={(e) => {
        if (e.button !== 0) return;
        end();
        cursor.value = null;
        begin(at(e), e.altKey);
        svg.current!.setPointerCapture(e.pointerId);
      }}
      onPointerMove={(e) => e.buttons && goOn(at(e))} onPointerUp={end} onPointerCancel={end}>
      <pattern id="squares" width={5 * grid} height={5 * grid} patternUnits="userSpaceOnUse"><path d={`M${5 * grid} 0H0V${5 * grid}`} /></pattern>
      {picture.value && <image href={picture.value.url} x={-picture.value.width / 2} y={hidden.y} width={picture.value.width} height={paper.height} preserveAspectRatio="xMidYMid meet" opacity="0.45" />}
      <rect x={5 * hidden.x} y={5 * hidden.y} width={5 * paper.width} height={5 * paper.height} fill="url(#squares)" />
      {pins.map((p, i) => p.guide !== null && <path key={`g${i}`} class="guide" d="M-60 0H60" transform={`translate(${p.x} ${-p.y}) rotate(${-p.guide})`} />)}
      {elements.map((e, k) => e.kind === "gear" && <Element key={`e${k}`} element={e} />)}
      {links.map((_, k) => {
        const corners = cornersOf(sketch.value, k);
        const colour = colourOf(`link ${k + 1}`);
        return <path key={`l${k}`} class="link" data-link={k + 1} style={{ stroke: colour, fill: corners.length > 2 ? colour : "none" }} d={`${d(corners)}${corners.length > 2 ? "Z" : ""}`} />;
      })}
      {elements.map((e, k) => e.kind !== "gear" && <Element key={`e${k}`} element={e} />)}
      {pins.map((_, i) => <PinSign key={`p${i}`} i={i} />)}
      {cursor.value && <path class="cursor" d="M-12 0H-3M3 0H12M0 -12V-3M0 3V12" transform={`translate(${cursor.value.x} ${-cursor.value.y})`} />}
    </svg>
  );
}

function NumberField({ label, name, value, unit, least = -most, set: to }: { label: string; name: string; value: number; unit: string; least?: number; set: (value: number) => void }) {
  return (
    <label class="number">
      <span class="label">{label}</span>
      <input type="number" step="any" value={Number(value.toFixed(4))} data-number={name} aria-label={`${label} of ${name.split(".")[0]}`} onChange={(e) => {
        const typed = Number(e.currentTarget.value);
        if (e.currentTarget.value !== "" && typed >= least && typed <= most) to(typed);
        else e.currentTarget.value = String(value);  // restores the old value
      }} />
      <em>{unit}</em>
    </label>
  );
}

/** The same by keyboard: where the points are, and the numbers of what is on them. */
function Numbers() {
  const s = sketch.value;
  // It is there from the start: the board must not move under the hand.
  return (
    <details class="sketch-numbers">
      <summary>Numbers</summary>
      {!s.pins.length && <p class="note">Nothing is drawn yet.</p>}
      {s.elements.map((e, k) => {
        const name = elementName(s, e);
        return (
          <fieldset key={`e${k}`}>
            <legend>{`${name}, ${e.kind === "drive" ? (jointOf(s, e)?.name ?? pinName(e.pins[0])) : e.pins.map(pinName).join("–")}`}</legend>
            {kinds[e.kind].numbers(s, e).map(({ key, label, unit, least }) => (
              <NumberField key={key} label={label} name={`${name}.${label}`} unit={unit} least={least} value={valueOf(s, e, key)} set={(value) => set(withElement(sketch.value, k, { values: { ...e.values, [key]: value } }))} />))}
            <button type="button" onClick={() => set(withElement(sketch.value, k, null))}>Remove</button>
          </fieldset>
        );
      })}
      {s.pins.map((p, i) => (
        <fieldset key={`p${i}`}>
          <legend>{pinName(i)}</legend>
          {(["x", "y"] as const).map((axis) => <NumberField key={axis} label={axis} name={`${pinName(i)}.${axis}`} unit="mm" value={p[axis]} set={(value) => set(withPin(sketch.value, i, { [axis]: value }))} />)}
          {p.guide !== null && <NumberField label="guide" name={`${pinName(i)}.guide`} unit="°" value={p.guide} set={(value) => set(withPin(sketch.value, i, { guide: value }))} />}
        </fieldset>))}
    </details>
  );
}

function Tools() {
  const groups = [...new Set(tools.map((t) => t.group))];
  return (
    <div class="tools" role="toolbar" aria-label="What a press does" onKeyDown={(e) => moveFocus(e, "button")}>
      {groups.map((group) => (
        <div key={group} class="together" role="group" aria-label={group}>
          {tools.filter((t) => t.group === group).map((t) => (
            <button type="button" key={t.name} class="switch" data-tool={t.name} aria-pressed={tool.value === t} tabIndex={tool.value === t ? 0 : -1} title={t.hint} onClick={() => {
              tool.value = t;
              from.value = null;
            }}><svg viewBox="-12 -9 24 18" aria-hidden="true"><path d={t.sign} /></svg>{t.text}</button>))}
        </div>))}
    </div>
  );
}

const freedoms = (count: number) => `${count} degree${count === 1 ? "" : "s"} of freedom`;

/** The object under the cursor of the keyboard. */
function underCursor(): string {
  if (!cursor.value) return "";
  const { x, y } = cursor.value;
  const i = pinAt(sketch.value, { x, y, reach: grid / 2 + 1, grid: 0, more: false });
  return `${i < 0 ? "" : `${pinName(i)}, `}x ${x} mm, y ${y} mm${gesture.value?.drag ? ": arrows change it, Enter ends" : ""}`;
}

export function Draw() {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    if (showDraw.value && !dialog.current!.open) dialog.current!.showModal();
    if (!showDraw.value && dialog.current!.open) dialog.current!.close();
  }, [showDraw.value]);
  if (!showDraw.value) return <dialog ref={dialog} class="draw" aria-label="Draw a linkage" />;
  const lacks = missing(sketch.value);
  return (
    <dialog ref={dialog} class="draw" aria-label="Draw a linkage" onClose={() => (showDraw.value = false)} onKeyDown={(e) => {
      if (e.key === "Escape") {
        // It ends the chain of links first, or what the arrows move.
        if (gesture.value) end();
        else if (from.value !== null) from.value = null;
        else showDraw.value = false;
      } else if ((e.ctrlKey || e.metaKey) && e.key.toLowerCase() === "z") undo();
      else return;
      e.preventDefault();
      e.stopPropagation();
    }}>
      <div class="bar">
        <Tools />
        <span class="together">
          <button type="button" id="draw-undo" disabled={!past.value.length} onClick={undo}>Undo</button>
          <button type="button" disabled={!sketch.value.pins.length} onClick={() => set(blank)}>Clear</button>
        </span>
        <label><input type="checkbox" checked={snap.value} onChange={(e) => (snap.value = e.currentTarget.checked)} /> snap to {grid} mm</label>
        <label class="button">Picture<input type="file" accept="image/*" aria-label="A picture to draw over" onChange={(e) => {
          const file = e.currentTarget.files?.[0];
          if (picture.value) URL.revokeObjectURL(picture.value.url);
          picture.value = file ? { url: URL.createObjectURL(file), width: paper.width } : null;
        }} /></label>
        {picture.value && <label>width <input type="number" min="1" value={picture.value.width} aria-label="Width of the picture (mm)" onChange={(e) => Number(e.currentTarget.value) > 0 && (picture.value = { ...picture.value!, width: Number(e.currentTarget.value) })} /> mm</label>}
        <span class="spring" />
        <span class="together">
          <button type="button" onClick={() => (showDraw.value = false)}>Close</button>
          <button type="button" id="draw-use" class="main" disabled={lacks !== ""} onClick={() => {
            showDraw.value = false;
            replace({ name: "my-linkage.toml", text: studyOf(sketch.value), files: {} });
          }}>Let it move</button>
        </span>
      </div>
      <p class="note hint">{tool.value.hint}</p>
      <div class="sheet">
        <div>
          <Board />
          <p class="note" role="status"><span id="draw-said">{lacks || `${freedoms(freedom(sketch.value))}, and it is driven.`}</span>{cursor.value && <span class="cursor-said"> {underCursor()}</span>}</p>
        </div>
        <Numbers />
      </div>
    </dialog>
  );
}
