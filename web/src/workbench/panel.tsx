// SPDX-License-Identifier: BSD-3-Clause

// Beside the drawing: the study as text, and its numbers one by one.
import { computed, signal } from "@preact/signals";
import { Fragment, type JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { moveFocus } from "../controls";
import type { JsonObject } from "../data";
import { Menu } from "../menu";
import { spatial } from "../state";
import { format, nameOf, unitOf } from "../units";
import { change, document_ } from "./document";
import { Lists } from "./lists";
import { isLoad, possible, withLoad } from "./loads";
import { NumberInput, refused } from "./number_input";
import { numbersOf, pointsOf, unitKey, type Entry } from "./numbers";
import type { Edit } from "./engine";
import { absent } from "./schema";
import { bestOf, diagnostics, edit, handleKeys, locked, pacedStudy, pickedKeys, pickOut, pointOut, schema, shown, stale, toggleLock, tryEdit } from "./session";

const tab = signal<"text" | "numbers" | "points">("numbers");

/** Typing is one entry of the history until it pauses. */
let typing: symbol = Symbol();
let pause = 0;
function type(text: string): void {
  clearTimeout(pause);
  pause = window.setTimeout(() => (typing = Symbol()), 800);
  change(text, typing);
}

function Text() {
  const box = useRef<HTMLTextAreaElement>(null);
  const go = (line = 1, column = 1) => {
    const lines = document_.value.text.split("\n");
    const at = lines.slice(0, line - 1).reduce((sum, l) => sum + l.length + 1, 0) + column - 1;
    box.current!.focus();
    box.current!.setSelectionRange(at, at);
    box.current!.scrollTop = (line - 4) * 18;
  };
  return (
    <>
      <textarea ref={box} class="study" spellcheck={false} aria-label="The study as text (TOML)" value={document_.value.text} onInput={(e) => type(e.currentTarget.value)} />
      <ul class="problems" role="status">
        {diagnostics.value.map((d) => (
          <li class={d.severity}>
            <button type="button" class="link" disabled={!d.line} onClick={() => go(d.line, d.column)}>{d.line ? `line ${d.line}` : d.severity}</button>
            <span>{d.key && <code>{d.key}</code>} {d.message}{d.hint && <small>{d.hint}</small>}</span>
          </li>))}
      </ul>
    </>
  );
}

/** A range that a search may choose from becomes a number, as the best solution has it, and a number becomes such a range. */
function freed({ key, value, rule }: Entry): { min: number; max: number } | number {
  if (typeof value === "object") {
    return bestOf(key.split(".").pop()!) ?? (value.min + value.max) / 2;
  }
  const size = Math.abs(value as number) || 1;
  const min = (value as number) - size / 2;
  return { min: rule?.least === undefined ? min : Math.max(min, rule.open ? size / 1000 : rule.least), max: (value as number) + size };
}

const Lock = ({ name, label }: { name: string; label: string }) => (
  <button type="button" class="lock" data-lock={name} aria-pressed={locked.value.has(name)} aria-label={`Keep ${label} while dragging`} title="Keep it while the drawing is dragged" onClick={() => toggleLock(name)}>
    <svg viewBox="0 0 16 16" aria-hidden="true"><path d={`M3 7.5h10v7H3zM5 7.5V5a3 3 0 0 1 6 0${locked.value.has(name) ? "v2.5" : ""}`} /></svg>
  </button>
);

function Field({ entry }: { entry: Entry }) {
  const { key, label, value, rule } = entry;
  const about = `${key}${rule?.help ? `: ${rule.help}` : ""}`;
  const point = key.replace(/\[\d+\]$/, "");
  const drawn = handleKeys.value.has(key) ? key : handleKeys.value.has(point) ? point : "";
  return (
    <div class={drawn && pickedKeys.value.has(drawn) ? "number picked" : "number"} title={about} onPointerEnter={drawn ? () => pointOut(drawn) : undefined} onPointerLeave={drawn ? () => pointOut("") : undefined}>
      <span class="label">{label}</span>
      {typeof value === "number" && <NumberInput entry={entry} value={value} label={label} />}
      {typeof value === "object" && (["min", "max"] as const).map((part) => <NumberInput key={part} entry={entry} value={value[part]} part={part} label={`${label}, ${part}`} />)}
      {typeof value === "string" && (
        <select data-key={key} aria-label={label} value={value} onChange={(e) => edit([{ key, value: e.currentTarget.value }])}>
          {rule!.choices!.map((c) => <option key={c.value} value={c.value} title={c.help}>{c.value.replace(/_/g, " ")}</option>)}
        </select>
      )}
      {typeof value === "boolean" && <input type="checkbox" data-key={key} aria-label={label} checked={value} onChange={(e) => edit([{ key, value: e.currentTarget.checked }])} />}
      {typeof value !== "string" && typeof value !== "boolean" && <em>{unitOf(unitKey(key), Math.abs(typeof value === "number" ? value : value.max)).symbol}</em>}
      {drawn && (drawn === key || key.endsWith("[0]")) ? <Lock name={drawn} label={label.replace(/ x$/, "")} /> : <i class="no-lock" />}
      {rule?.free && <button type="button" class="free" data-free={key} aria-pressed={typeof value === "object"} title={typeof value === "object" ? "The search chooses it; press to fix it" : "Fixed; press to let the search choose it"} onClick={() => edit([{ key, value: freed(entry) }])}>{typeof value === "object" ? "free" : "fixed"}</button>}
      {rule?.help && <small class="help">{rule.help}</small>}
      {refused.value.startsWith(`${key}: `) && <small class="refused" role="alert">{refused.value.slice(key.length + 2)}</small>}
    </div>
  );
}

/** The field of each number, made anew only when the number has changed: most have not, while one is dragged. */
function useFields(): (entry: Entry) => JSX.Element {
  const made = useRef(new Map<string, { entry: Entry; field: JSX.Element }>()).current;
  return (entry) => {
    const before = made.get(entry.key);
    if (before && before.entry.value === entry.value && before.entry.label === entry.label && before.entry.rule === entry.rule) return before.field;
    const field = <Field key={entry.key} entry={entry} />;
    made.set(entry.key, { entry, field });
    return field;
  };
}

const most = 400; // numbers of one group that are listed

function Add({ path }: { path: string }) {
  const more = path ? absent(schema.value, pacedStudy.value!, path) : [];
  if (!more.length) return null;
  return (
    <Menu kind="add" label="add …" title={`Add to ${path}`}>
      {more.map((m) => (
        <button type="button" key={m.key} data-add={m.key} onClick={() => edit([{ key: m.key, value: m.start as Edit["value"] }])}>
          {nameOf(m.name)}{m.rule.help && <small>{m.rule.help}</small>}
        </button>))}
    </Menu>
  );
}

/** Springs and loads are put on the point that is picked in the drawing. */
function Loads({ study }: { study: JsonObject }) {
  const may = possible(study, schema.value);
  if (!may.length) return null;
  return (
    <div class="loads">
      <span class="label">Add at the point that is picked in the drawing, or at the last one:</span>
      {may.map((load) => <button key={load} type="button" data-load={load} onClick={() => tryEdit([withLoad(study, load, pickedKeys.value)])}>{load.replace("_", " ")}</button>)}
    </div>
  );
}

function Numbers() {
  const study = pacedStudy.value;
  const box = useRef<HTMLDivElement>(null);
  const keys = [...pickedKeys.value].join();
  const fieldOf = useFields();
  useEffect(() => {
    const [list, number] = [box.current, box.current?.querySelector(".picked")];
    if (!keys || !list || !number) return;
    // Only the list moves, not the page.
    const [all, one] = [list.getBoundingClientRect(), number.getBoundingClientRect()];
    if (one.top < all.top || one.bottom > all.bottom) list.scrollTop += one.top - all.top - all.height / 3;
  }, [keys]);
  if (!study) return diagnostics.value.length ? <p class="note">The numbers are listed as soon as the study has no errors.</p> : null;
  const groups = numbersOf(study, schema.value);
  return (
    <div class="numbers" ref={box}>
      {groups.map((g) => (
        <details key={g.path || g.title} open={g.entries.length < 12 || g.entries.some(({ key }) => pickedKeys.value.has(key) || pickedKeys.value.has(key.replace(/\[\d+\]$/, "")))}>
          <summary>{g.title}<small>{format(g.entries.length + g.lists.reduce((sum, l) => sum + 2 * l.rows.length, 0))}</small></summary>
          {g.entries.slice(0, most).map(fieldOf)}
          <Lists group={g} />
          <Add path={g.path} />
          {isLoad(g.path) && <button type="button" data-remove={g.path} onClick={() => tryEdit([{ key: g.path, value: null }])}>Remove {g.title}</button>}
        </details>))}
      <Loads study={study} />
    </div>
  );
}

const allPoints = computed(() => (pacedStudy.value ? pointsOf(numbersOf(pacedStudy.value, schema.value)) : []));
const showPoints = computed(() => shown.value && spatial.value && allPoints.value.length > 2);

/** Hard points row by row; the row of the point that is picked in the drawing stands out, and the other way round. */
function Points() {
  const symbol = unitOf(unitKey(allPoints.value[0].key), 0).symbol;
  return (
    <div class="points">
      <table>
        <thead><tr><th scope="col">point</th>{["x", "y", "z"].map((axis) => <th scope="col">{axis}{symbol && <small> {symbol}</small>}</th>)}<td /></tr></thead>
        <tbody>
          {allPoints.value.map(({ key, owner, name, entries }, i) => (
            <Fragment key={key}>
              {owner !== allPoints.value[i - 1]?.owner && <tr class="owner"><th scope="rowgroup" colSpan={5}>{owner}</th></tr>}
              <tr data-point={key} class={pickedKeys.value.has(key) ? "picked" : ""} onPointerEnter={() => pointOut(key)} onPointerLeave={() => pointOut("")} onFocusCapture={() => handleKeys.value.has(key) && pickOut(key)}>
                <th scope="row"><button type="button" class="link" disabled={!handleKeys.value.has(key)} onClick={() => pickOut(key)}>{name}</button></th>
                {entries.map((entry) => <td key={entry.key}><NumberInput entry={entry} value={entry.value as number} label={`${owner}, ${entry.label}`} /></td>)}
                <td>{handleKeys.value.has(key) && <Lock name={key} label={`${owner}, ${name}`} />}</td>
              </tr>
            </Fragment>))}
        </tbody>
      </table>
      {refused.value && <p class="refused" role="alert">{refused.value}</p>}
    </div>
  );
}

/** On a small screen the panel lies over the page, and only its tabs are seen until one is pressed. */
const folded = signal(true);
function turnTo(to: typeof tab.value): void {
  folded.value = tab.value === to && !folded.value;
  tab.value = to;
}

export function Panel() {
  const errors = diagnostics.value.filter((d) => d.severity === "error").length;
  return (
    <aside class={folded.value ? "panel folded" : "panel"} aria-label="The study">
      <div class="tabs" role="tablist" onKeyDown={(e) => moveFocus(e, "button")}>
        <button type="button" role="tab" id="tab-numbers" aria-selected={tab.value === "numbers" || (tab.value === "points" && !showPoints.value)} onClick={() => turnTo("numbers")}>Numbers</button>
        {showPoints.value && <button type="button" role="tab" id="tab-points" aria-selected={tab.value === "points"} onClick={() => turnTo("points")}>Points</button>}
        <button type="button" role="tab" id="tab-text" aria-selected={tab.value === "text"} onClick={() => turnTo("text")}>
          Study{errors > 0 && <b class="count">{errors}</b>}
        </button>
      </div>
      {stale.value && <p class="stale" role="alert">The study has an error; what is drawn is the last one without. {tab.value !== "text" && <button type="button" class="link" onClick={() => turnTo("text")}>Show it</button>}</p>}
      {tab.value === "text" ? <Text /> : tab.value === "points" && showPoints.value ? <Points /> : <Numbers />}
    </aside>
  );
}
