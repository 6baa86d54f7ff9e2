// SPDX-License-Identifier: BSD-3-Clause

// "Draw a motion, get a machine": the board with its tools, what is wished, and the machines.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import * as state from "../state";
import { format } from "../units";
import type { Diagnostic } from "./engine";
import { boxOf, lengthOf, PathError, type Wishes } from "./path";
import { liftPen, PathBoard, penIsDown } from "./path_board";
import { PathList } from "./path_list";
import { watched } from "./path_pictures";
import { problems, stopSearch } from "./path_search";
import { canRedoPath, canUndoPath, clearPath, closePath, redoPath, sheet, showPath, takePath, undoPath, wishes } from "./path_sheet";
import { readPath, requireSize, textOf } from "./path_text";

/** The reason why a text is not a path, and the way out. */
const refused = signal<{ message: string; hint: string } | null>(null);
const pasting = signal(false); // the field for a text is open

/** Takes what `read` gives, or says why there is no path, with the name of the file. */
async function take(read: () => string | Promise<string>, file = ""): Promise<void> {
  try {
    takePath(readPath(await read()));
    refused.value = null;
    pasting.value = false;
  } catch (error) {
    const { message, hint } = error instanceof PathError ? error : { message: `The path cannot be read: ${error instanceof Error ? error.message : String(error)}.`, hint: "Save the file once more, or paste its text." };
    refused.value = { message: file ? `${file}: ${message}` : message, hint };
  }
}

const takeFile = (file: File) => take(async () => {
  requireSize(file.size);
  return textOf(new Uint8Array(await file.arrayBuffer()));
}, file.name);

/** Takes what was dropped or pasted: its first file, or its text. */
function takeData(data: DataTransfer | null): void {
  const file = data?.files[0];
  const text = data?.getData("text") ?? "";
  void (file ? takeFile(file) : take(() => text));
}

const kinds = ".svg,.csv,.txt,.dxf";

function Tools() {
  const { path } = sheet.value;
  return (
    <div class="path-tools" role="toolbar" aria-label="Tools of the board">
      <button type="button" class="switch" aria-pressed={!pasting.value} title="Draw with the mouse, a pen or a finger" onClick={() => (pasting.value = false)}>
        <svg viewBox="0 0 20 20" aria-hidden="true"><path d="M3 17l1-4L14 3l3 3L7 16zM12 5l3 3" /></svg>Pen
      </button>
      <button type="button" id="path-paste" class="switch" aria-pressed={pasting.value} aria-expanded={pasting.value} onClick={() => (pasting.value = !pasting.value)}>Paste</button>
      <label class="button">Open a file<input type="file" accept={kinds} aria-label="Open a file with a path: SVG, CSV or DXF" onChange={(e) => {
        const file = e.currentTarget.files?.[0];
        if (file) void takeFile(file);
        e.currentTarget.value = "";
      }} /></label>
      <span class="together">
        <button type="button" id="path-undo" disabled={!canUndoPath.value} title="Undo (Ctrl Z)" onClick={undoPath}>Undo</button>
        <button type="button" id="path-redo" disabled={!canRedoPath.value} title="Redo (Ctrl Y)" onClick={redoPath}>Redo</button>
        <button type="button" id="path-clear" disabled={!path} onClick={clearPath}>Clear</button>
      </span>
      <label><input type="checkbox" id="path-closed" disabled={!path} checked={path?.closed ?? false} onChange={(e) => closePath(e.currentTarget.checked)} /> Closed</label>
      <label title="The drive of an open path goes there and back over the range that it needs, and the machine need not turn fully">
        <input type="checkbox" id="path-rocks" disabled={!path || path.closed} checked={wishes.value.rocks} onChange={(e) => (wishes.value = { ...wishes.peek(), rocks: e.currentTarget.checked })} /> Drive rocks</label>
    </div>
  );
}

function Paste() {
  const box = useRef<HTMLTextAreaElement>(null);
  if (!pasting.value) return null;
  return (
    <div class="path-paste">
      <label for="path-text">SVG path data or an SVG file, two coordinates in each line, or a DXF drawing. Numbers without a unit are in mm.</label>
      <textarea ref={box} id="path-text" rows={4} spellcheck={false} placeholder={"M 0 0 C 20 60 80 60 100 0 Z\n\n0; 0\n12,5; 40"} />
      <button type="button" id="path-use" class="main" onClick={() => void take(() => box.current!.value)}>Put it on the board</button>
    </div>
  );
}

/** Errors with their place in the study and their remedy. */
function Problems() {
  const all: Diagnostic[] = [...(refused.value ? [{ severity: "error" as const, ...refused.value }] : []), ...problems.value];
  return (
    <div id="path-problems" role="status">
      {all.length > 0 && <ul class="problems">{all.map((d, i) => <li key={i} class={d.severity}><span>{d.key && <code>{d.key}</code>} {d.message}{d.hint && <small>{d.hint}</small>}</span></li>)}</ul>}
    </div>
  );
}

function Description() {
  const { path } = sheet.value;
  if (!path) return <p class="note" id="path-said">Press on the board and draw. A path that ends near its beginning closes.</p>;
  const { width, height } = boxOf(path.points);
  const mm = (value: number) => format(value, 3);
  return <p class="note" id="path-said">{`${path.closed ? "Closed" : "Open"} path of ${mm(width)} × ${mm(height)} mm, ${mm(lengthOf(path))} mm long, with ${path.points.length} points.`}</p>;
}

const sliders: { key: Exclude<keyof Wishes, "rocks">; label: string; min: number; max: number; step: number; unit: string; hint: string }[] = [
  { key: "mostLinks", label: "most links", min: 4, max: 10, step: 1, unit: "", hint: "The frame counts as a link: a four-bar has four" },
  { key: "leastPairAngle", label: "least pair angle", min: 5, max: 45, step: 1, unit: "°", hint: "The smallest angle between two links that hold a pin, over the whole turn: large angles transmit forces well" },
  { key: "longestLink", label: "longest link", min: 1, max: 20, step: 1, unit: "×", hint: "In sizes of the path, which are the root mean square distance of its points from their middle" },
];

function Sliders() {
  return (
    <div class="sliders">
      {sliders.map(({ key, label, min, max, step, unit, hint }) => (
        <label key={key} title={hint}>
          <span>{label}</span>
          <input type="range" data-wish={key} min={min} max={max} step={step} value={wishes.value[key]} aria-valuetext={`${wishes.value[key]}${unit}`}
            onChange={(e) => (wishes.value = { ...wishes.peek(), [key]: Number(e.currentTarget.value) })}
            onInput={(e) => (e.currentTarget.nextElementSibling!.textContent = `${e.currentTarget.value}${unit}`)} />
          <output>{`${wishes.value[key]}${unit}`}</output>
        </label>))}
    </div>
  );
}

function close(): void {
  stopSearch();
  showPath.value = false;
}

function onKey(event: KeyboardEvent): void {
  const writing = event.target instanceof HTMLTextAreaElement;
  const command = event.ctrlKey || event.metaKey;
  const key = event.key.toLowerCase();
  if (key === "escape") {
    if (penIsDown()) liftPen();
    else if (pasting.value) pasting.value = false;
    else close();
  } else if (command && !writing && key === "z") (event.shiftKey ? redoPath : undoPath)();
  else if (command && !writing && key === "y") redoPath();
  else return;
  event.preventDefault();
  event.stopPropagation();
}

/** The mechanism behind the dialog rests meanwhile. */
function useDialog() {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const shown = showPath.value;
    if (shown && !dialog.current!.open) dialog.current!.showModal();
    if (!shown && dialog.current!.open) dialog.current!.close();
    state.held.value = watched.value = shown;
    if (!shown) return undefined;
    // A button that has become disabled has no focus any more, and then keys go to the page.
    document.addEventListener("keydown", onKey, true);
    return () => document.removeEventListener("keydown", onKey, true);
  }, [showPath.value]);
  return dialog;
}

export function PathDialog() {
  const dialog = useDialog();
  return (
    <dialog ref={dialog} class="path-dialog" aria-label="Draw a motion" onClose={close}
      onPaste={(e) => {
        if (e.target instanceof HTMLTextAreaElement) return;
        takeData(e.clipboardData);
      }}
      onDrop={(e) => {
        e.preventDefault();
        e.stopPropagation();
        takeData(e.dataTransfer);
      }}>
      {showPath.value && (
        <>
          <header><h2>Draw a motion, get a machine</h2><button type="button" id="path-close" onClick={close}>Close</button></header>
          <div class="path-page">
            <section aria-label="Path"><Tools /><Paste /><PathBoard /><Description /><Problems /><Sliders /></section>
            <PathList />
          </div>
        </>)}
    </dialog>
  );
}
