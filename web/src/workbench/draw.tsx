// Drawing a linkage from nothing: press where pins are; links, ground, guides and the drive follow.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { replace } from "./document";
import { blank, freedom, missing, pinName, studyOf, withoutPin, type Pin, type Sketch } from "./sketch";

export const showDraw = signal(false);

type Tool = "link" | "move" | "ground" | "guide" | "drive" | "trace" | "erase";
const tools: { name: Tool; text: string; hint: string }[] = [
  { name: "link", text: "Link", hint: "Press from pin to pin: each press makes the next link. With Shift the pin is added to the link before, which becomes a plate. Escape ends the chain." },
  { name: "move", text: "Move", hint: "Drag a pin to another place; with Alt every tool does." },
  { name: "ground", text: "Ground", hint: "Press a pin to fix it to the ground, or to free it." },
  { name: "guide", text: "Guide", hint: "Press a pin to put it on a guide, and drag to turn the guide; press again to take it off." },
  { name: "drive", text: "Drive", hint: "Press the pin on the ground, or on a guide, that is driven." },
  { name: "trace", text: "Trace", hint: "Press a pin whose path is to be seen." },
  { name: "erase", text: "Erase", hint: "Press a pin to remove it with its links." },
];

const sketch = signal<Sketch>(blank);
const past = signal<Sketch[]>([]);
const tool = signal<Tool>("link");
const last = signal<number | null>(null); // the pin from which the next link goes
const snap = signal(true);
const picture = signal<{ url: string; width: number } | null>(null);

/** mm that are seen: what a finger can press on a phone. */
const paper = matchMedia("(max-width: 600px)").matches ? { width: 300, height: 360 } : { width: 600, height: 400 };
const grid = 10; // mm
/** px within which a press means a pin: fingers are broader than pointers. */
const near = (pointer: string) => (pointer === "touch" ? 18 : 9);

function set(next: Sketch): void {
  past.value = [...past.value, sketch.value];
  sketch.value = next;
}
function undo(): void {
  const before = past.value[past.value.length - 1];
  if (!before) return;
  past.value = past.value.slice(0, -1);
  sketch.value = before;
  last.value = null;
}
const pin = (x: number, y: number): Pin => ({ x, y, ground: false, guide: null, traced: false });
const withPin = (s: Sketch, i: number, change: Partial<Pin>): Sketch => ({ ...s, pins: s.pins.map((p, k) => (k === i ? { ...p, ...change } : p)) });
/** A drive is where the ground is. */
const checked = (s: Sketch): Sketch => (s.drive !== null && !s.pins[s.drive].ground && s.pins[s.drive].guide === null ? { ...s, drive: null } : s);

interface Press {
  x: number; // mm
  y: number;
  reach: number; // mm within which a pin is meant
}

function pinAt({ x, y, reach }: Press): number {
  let best = -1;
  let least = reach;
  sketch.value.pins.forEach((p, i) => {
    const distance = Math.hypot(p.x - x, p.y - y);
    if (distance < least) [least, best] = [distance, i];
  });
  return best;
}

function press(at: Press, more: boolean): void {
  const s = sketch.value;
  let i = pinAt(at);
  if (tool.value === "link") {
    let next = s;
    if (i < 0) {
      const to = (v: number) => (snap.value ? Math.round(v / grid) * grid : Math.round(v * 100) / 100);
      next = { ...next, pins: [...next.pins, pin(to(at.x), to(at.y))] };
      i = next.pins.length - 1;
    }
    const from = last.value;
    const links = [...next.links];
    if (from !== null && from !== i) {
      if (more && links.length && !links[links.length - 1].includes(i)) links[links.length - 1] = [...links[links.length - 1], i];
      else if (!links.some((on) => on.includes(from) && on.includes(i))) links.push([from, i]);
    }
    set({ ...next, links });
    last.value = i;
    return;
  }
  if (i < 0 || tool.value === "move") return;
  const p = s.pins[i];
  if (tool.value === "ground") set(checked(withPin(s, i, { ground: !p.ground, guide: null })));
  else if (tool.value === "guide") set(checked(withPin(s, i, p.guide === null ? { guide: 0, ground: false } : { guide: null })));
  else if (tool.value === "drive") set(p.ground || p.guide !== null ? { ...s, drive: s.drive === i ? null : i } : s);
  else if (tool.value === "trace") set(withPin(s, i, { traced: !p.traced }));
  else set(withoutPin(s, i));
}

function Board() {
  const svg = useRef<SVGSVGElement>(null);
  const turning = useRef<number | null>(null);
  const moving = useRef<number | null>(null);
  const at = (event: PointerEvent): Press => {
    const m = svg.current!.getScreenCTM()!.inverse();
    return { x: m.a * event.clientX + m.e, y: -(m.d * event.clientY + m.f), reach: m.a * near(event.pointerType) };
  };
  const { pins, links, drive } = sketch.value;
  const hidden = { x: -paper.width / 2, y: -paper.height / 2 };
  const lines = (step: number, size: number) => Array.from({ length: Math.floor(size / step) + 1 }, (_, k) => (k - Math.floor(size / step / 2)) * step);
  return (
    <svg ref={svg} id="board" viewBox={`${hidden.x} ${hidden.y} ${paper.width} ${paper.height}`} role="img" aria-label={`Drawing board: ${pins.length} pins, ${links.length} links`}
      onPointerDown={(e) => {
        if (e.button !== 0) return;
        const where = at(e);
        const i = pinAt(where);
        if ((e.altKey || tool.value === "move") && i >= 0) {
          past.value = [...past.value, sketch.value];
          moving.current = i;
        } else {
          press(where, e.shiftKey);
          if (tool.value === "guide" && i >= 0 && sketch.value.pins[i].guide !== null) turning.current = i;
        }
        svg.current!.setPointerCapture(e.pointerId);
      }}
      onPointerMove={(e) => {
        const { x, y, reach } = at(e);
        if (moving.current !== null) sketch.value = withPin(sketch.value, moving.current, { x: snap.value ? Math.round(x / grid) * grid : x, y: snap.value ? Math.round(y / grid) * grid : y });
        const i = turning.current;
        if (i === null) return;
        const p = sketch.value.pins[i];
        if (Math.hypot(x - p.x, y - p.y) < reach) return;
        const angle = (Math.atan2(y - p.y, x - p.x) * 180) / Math.PI;
        sketch.value = withPin(sketch.value, i, { guide: snap.value ? Math.round(angle / 15) * 15 : Math.round(angle * 10) / 10 });
      }}
      onPointerUp={() => {
        turning.current = null;
        moving.current = null;
      }}>
      <rect class="paper" x={hidden.x} y={hidden.y} width={paper.width} height={paper.height} />
      {picture.value && <image href={picture.value.url} x={-picture.value.width / 2} y={hidden.y} width={picture.value.width} height={paper.height} preserveAspectRatio="xMidYMid meet" opacity="0.45" />}
      <g class="grid">
        {lines(50, paper.width).map((x) => <path key={`x${x}`} d={`M${x} ${hidden.y}V${-hidden.y}`} />)}
        {lines(50, paper.height).map((y) => <path key={`y${y}`} d={`M${hidden.x} ${y}H${-hidden.x}`} />)}
      </g>
      {pins.map((p, i) => p.guide !== null && <path key={`g${i}`} class="guide" d="M-60 0H60" transform={`translate(${p.x} ${-p.y}) rotate(${-p.guide})`} />)}
      {links.map((on, k) => <path key={`l${k}`} class="link" style={{ stroke: `var(--c${(k % 6) + 1})`, fill: on.length > 2 ? `var(--c${(k % 6) + 1})` : "none" }} d={`M${on.map((i) => `${pins[i].x} ${-pins[i].y}`).join("L")}${on.length > 2 ? "Z" : ""}`} />)}
      {pins.map((p, i) => (
        <g key={`p${i}`} class={`pin${last.value === i && tool.value === "link" ? " last" : ""}`} data-pin={pinName(i)} transform={`translate(${p.x} ${-p.y})`}>
          {p.ground && <path class="ground" d="M0 0L-9 13H9ZM-13 13H13M-10 13l-4 5M-4 13l-4 5M2 13l-4 5M8 13l-4 5" />}
          {p.guide !== null && <rect class="block" x="-10" y="-6" width="20" height="12" transform={`rotate(${-p.guide})`} />}
          <circle r="4.5" />
          {drive === i && <path class="drive" d="M-12 0A12 12 0 1 1 0 12M0 12l5 -4M0 12l4 5" />}
          {p.traced && <circle class="traced" r="8" />}
          <text x="7" y="-7">{pinName(i)}</text>
        </g>
      ))}
    </svg>
  );
}

/** The same by keyboard: where the pins are. */
function Places() {
  const { pins } = sketch.value;
  return (
    <details class="places">
      <summary>Places of the pins (mm)</summary>
      {pins.map((p, i) => (
        <div class="number" key={i}>
          <span class="label">{pinName(i)}</span>
          {(["x", "y"] as const).map((axis) => (
            <input key={axis} type="number" step="any" value={p[axis]} data-place={`${pinName(i)}.${axis}`} aria-label={`${axis} of ${pinName(i)}`} onChange={(e) => {
              const to = Number(e.currentTarget.value);
              if (e.currentTarget.value !== "" && Number.isFinite(to)) set(withPin(sketch.value, i, { [axis]: to }));
            }} />
          ))}
        </div>
      ))}
    </details>
  );
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
    <dialog ref={dialog} class="draw" aria-label="Draw a linkage" onClose={() => (showDraw.value = false)} onCancel={(e) => {
      // Escape ends the chain of links first.
      if (last.value === null) return;
      e.preventDefault();
      last.value = null;
    }} onKeyDown={(e) => {
      if ((e.ctrlKey || e.metaKey) && e.key.toLowerCase() === "z") {
        e.preventDefault();
        e.stopPropagation();
        undo();
      }
    }}>
      <div class="bar" role="toolbar" aria-label="What a press does">
        {tools.map((t) => <button type="button" key={t.name} class="switch" data-tool={t.name} aria-pressed={tool.value === t.name} title={t.hint} onClick={() => {
          tool.value = t.name;
          last.value = null;
        }}>{t.text}</button>)}
        <button type="button" id="draw-undo" disabled={!past.value.length} onClick={undo}>Undo</button>
        <button type="button" disabled={!sketch.value.pins.length} onClick={() => {
          set(blank);
          last.value = null;
        }}>Clear</button>
        <label><input type="checkbox" checked={snap.value} onChange={(e) => (snap.value = e.currentTarget.checked)} /> snap to {grid} mm</label>
        <label class="button">Picture<input type="file" accept="image/*" aria-label="A picture to draw over" onChange={(e) => {
          const file = e.currentTarget.files?.[0];
          if (picture.value) URL.revokeObjectURL(picture.value.url);
          picture.value = file ? { url: URL.createObjectURL(file), width: paper.width } : null;
        }} /></label>
        {picture.value && <label>width <input type="number" min="1" value={picture.value.width} aria-label="Width of the picture (mm)" onChange={(e) => Number(e.currentTarget.value) > 0 && (picture.value = { ...picture.value!, width: Number(e.currentTarget.value) })} /> mm</label>}
        <span class="spring" />
        <button type="button" onClick={() => (showDraw.value = false)}>Close</button>
        <button type="button" id="draw-use" class="main" disabled={lacks !== ""} onClick={() => {
          showDraw.value = false;
          replace({ name: "my-linkage.toml", text: studyOf(sketch.value), files: {} });
        }}>Let it move</button>
      </div>
      <Board />
      <p class="note" role="status" id="draw-said">{lacks || `${freedom(sketch.value)} degree of freedom, and it is driven.`}</p>
      <p class="note">{tools.find((t) => t.name === tool.value)!.hint}</p>
      <Places />
    </dialog>
  );
}
