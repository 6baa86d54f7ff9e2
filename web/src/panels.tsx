// SPDX-License-Identifier: BSD-3-Clause

// Everything on the page that is text and tables.
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { hasResult, isObject, resultText, type Change, type Design, type Json, type JsonObject, type Num } from "./data";
import { Copy, moveFocus } from "./controls";
import { save, targetTable } from "./exports";
import { Masonry } from "./masonry";
import { positionOfTurn } from "./motion";
import { Convergence, Dots, hasHistogram, hasLoosePlots, LoosePlots } from "./plots";
import { designOf, goOn, motion, paced, pacedScene, reason, result, runs, sceneIndex, sceneOf, scrub, showScene, spatial, view } from "./state";
import { format, nameOf, quantity, unitOf } from "./units";
import { DataTable } from "./tables";
import { targetErrors } from "./view";

const marks = { passed: "✓", doubtful: "!", incomplete: "!", failed: "✗" };

/** A text of which a long one shows two lines until one asks for the rest. */
function Fold({ text }: { text: string }) {
  const box = useRef<HTMLSpanElement>(null);
  const [open, setOpen] = useState(false);
  const [cut, setCut] = useState(false);
  useLayoutEffect(() => {
    const element = box.current!;
    const measure = () => setCut(element.scrollHeight > element.clientHeight + 1);
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  return (
    <>
      <span ref={box} class={open ? "fold open" : "fold"}>{text}</span>
      {(cut || open) && <button type="button" class="link screen-only" aria-expanded={open} onClick={() => setOpen(!open)}>{open ? "less" : "more"}</button>}
    </>
  );
}

/** The subject of the study and its outcome: one strip, so that the mechanism stands on the first screen. */
export function Banner() {
  const failed = result.checks.filter((c) => !c.passed).length;
  const checks = result.checks.length > 0 && ` · ${result.checks.length - failed} of ${result.checks.length} checks passed`;
  return (
    <header class={`verdict ${view.verdict}`}>
      <b class="mark" aria-hidden="true">{marks[view.verdict]}</b>
      <div class="words">
        <h1>{view.title}</h1>
        <p class="headline" role="status"><Fold text={view.headline} /></p>
      </div>
      <span>status {view.status.replace(/_/g, " ")}{checks}</span>
    </header>
  );
}

/** Words of a narrow card, where a number with its unit is never broken: "0.52°/100 mm". */
const longest = 24;
const whole = (text: string) =>
  text.split(" ").flatMap((word, i) => [i ? " " : "", /[\d°%]/.test(word) && word.length <= longest ? <span class="whole">{word}</span> : word]);

/** The key figures, beside the mechanism. */
export function Facts() {
  if (!view.facts.length) return null;
  return (
    <dl class="facts">
      {view.facts.map((f) => <div class={`${f.verdict}${f.long ? " long" : ""}`}><dt>{f.label}</dt><dd>{whole(f.text)}{f.rest && <small>{whole(f.rest)}</small>}</dd></div>)}
    </dl>
  );
}

function Section({ title, id, children }: { title: string; id: string; children: ComponentChildren }) {
  return <section aria-labelledby={`h-${id}`} id={id}><h2 id={`h-${id}`}>{title}</h2>{children}</section>;
}

export function Checks() {
  if (!result.checks.length) return null;
  return (
    <div class="card side">
      <h2>Checks</h2>
      <ul class="checks">
        {result.checks.map((c) => (
          <li class={c.passed ? "pass" : "fail"}>
            <b aria-label={c.passed ? "passed" : "failed"}>{c.passed ? "✓" : "✗"}</b>
            <span>{c.quantity}<small>{c.at && `${c.at}: `}{c.message || format(c.value, 7)} — {c.limit.replace(/_/g, " ")}</small></span>
          </li>
        ))}
      </ul>
    </div>
  );
}

/** Bars of how far each target is missed; a click goes there. */
export function Errors() {
  const target = pacedScene.value?.targets[0];
  if (!target) return null;
  const { distance, worst } = targetErrors(target);
  if (worst < 0) return null;
  const high = distance[worst]!;
  const go = (i: number) => {
    const at = target.achieved_input[i];
    if (at !== null && at !== undefined) scrub(positionOfTurn(motion.peek(), at));
  };
  const step = Math.max(1, Math.ceil(distance.length / 12));
  return (
    <div class="card side">
      <h2>Distance from each target</h2>
      <div class="bars" role="group" aria-label="Distance from each target">
        {distance.map((d, i) => (
          <button type="button" class={i === worst ? "worst" : ""} onClick={() => go(i)} aria-label={`target ${i + 1}: ${quantity("_m", d, 4)}`} title={`target ${i + 1}: ${quantity("_m", d, 4)}`}>
            <i style={{ height: `${high > 0 ? Math.max(1, ((d ?? 0) / high) * 100) : 1}%` }} />
            <small>{i % step === 0 ? i + 1 : ""}</small>
          </button>
        ))}
      </div>
      <p class="note">worst: target {worst + 1}, {quantity("_m", high, 4)}</p>
    </div>
  );
}

export function display(key: string, value: Json | undefined): string {
  if (value === null || value === undefined) return "–";
  if (typeof value === "number") return key.includes("rate") && value >= 0 && value <= 1 ? `${format(value * 100, 4)}\u202f%` : quantity(key, value);
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (typeof value === "string") return value.replace(/_/g, " ");
  if (Array.isArray(value)) return value.length > 12 ? `${value.length} values` : value.map((v) => display(key, v)).join(", ");
  return Object.entries(value).map(([k, v]) => `${nameOf(k)} ${display(k, v)}`).join(", ");
}

const keysOf = (objects: (JsonObject | null)[]) => [...new Set(objects.flatMap((o) => Object.keys(o ?? {})))];
/** Scenes of no solution: of a balancing, the first design. */
const otherScenes = () => view.scenes.flatMap((s, i) => (view.solution_scenes.includes(s.name) ? [] : [i]));

export function SolutionPicker() {
  paced.value;
  const others = otherScenes();
  const choices = result.solutions.length
    ? [
        ...result.solutions.map((s, i) => ({ label: s.label, scene: sceneOf(i), note: display("", firstOf(s.objectives)), defects: s.defects, i })),
        ...others.map((scene, k) => ({ label: view.scenes[scene].title, scene, note: "", defects: [] as string[], i: result.solutions.length + k })),
      ]
    : view.scenes.map((s, i) => ({ label: s.title, scene: i, note: "", defects: [] as string[], i }));
  if (choices.length < 2) return null;
  return (
    <div class="card side">
      <h2>{choices.length} {result.solutions.length && !others.length ? "solutions" : result.solutions.length ? "designs" : "scenes"}</h2>
      <div class="picker" role="radiogroup" aria-label="Solution shown" onKeyDown={(e) => ["ArrowUp", "ArrowDown"].includes(e.key) && moveFocus(e, "button:not(:disabled)")}>
        {choices.map((c) => (
          <button type="button" role="radio" aria-checked={c.scene === sceneIndex.value} disabled={c.scene < 0} data-solution={c.i} onClick={() => showScene(c.scene)}>
            <b>{c.i + 1}</b><span>{c.label}<small>{c.note}{c.defects.length > 0 && <em> · {c.defects.join(", ")}</em>}</small></span>
          </button>
        ))}
      </div>
    </div>
  );
}
const firstOf = (o: JsonObject | null) => {
  const key = Object.keys(o ?? {})[0];
  return key ? { [key]: o![key] } : "";
};

const heading = (key: string, size = Infinity) => {
  const unit = unitOf(key, size);
  return nameOf(key) + (unit.symbol ? ` (${unit.symbol})` : "");
};
const bare = (key: string, value: Json | undefined) =>
  typeof value === "number" ? format(value * unitOf(key).factor) : display(key, value);

/** Takes a design out of the report, to run it or to change it. */
function TakeDesign({ design }: { design: Design }) {
  return (
    <span class="take">
      <button type="button" class="get" data-design={design.solution} aria-label={`Study of solution ${design.solution + 1}`} onClick={() => save(`${design.name}.toml`, design.toml)}>study</button>
      <Copy text={design.toml} label={`copy the study of solution ${design.solution + 1}`} />
      {goOn.now && <button type="button" data-go-on={design.solution} aria-label={`Go on with solution ${design.solution + 1}`} onClick={() => goOn.now!(`${design.name}.toml`, design.toml)}>go on</button>}
    </span>
  );
}

export function Solutions() {
  paced.value;
  if (!result.solutions.length) return null;
  const objectives = keysOf(result.solutions.map((s) => s.objectives));
  const classes = keysOf(result.solutions.map((s) => s.classification));
  return (
    <Section title={result.solutions.length > 1 ? "Distinct solutions" : "Solution"} id="solutions">
      <div class="scroll">
        <table class="choose">
          <thead><tr><th scope="col">#</th><th scope="col">solution</th>{view.designs.length > 0 && <th scope="col" class="screen-only">study</th>}{objectives.map((k) => <th scope="col" class="num">{heading(k)}</th>)}{classes.map((k) => <th scope="col">{heading(k)}</th>)}<th scope="col">defects</th></tr></thead>
          <tbody>
            {result.solutions.map((s, i) => {
              const at = sceneOf(i);
              const design = designOf(i);
              return (
                <tr class={at >= 0 && at === sceneIndex.value ? "current" : ""} onClick={() => showScene(at)}>
                  <td>{i + 1}</td>
                  <th scope="row">{at >= 0 ? <button type="button" class="link" onClick={() => showScene(at)}>{s.label}</button> : s.label}</th>
                  {view.designs.length > 0 && <td class="screen-only" onClick={(e) => e.stopPropagation()}>{design && <TakeDesign design={design} />}</td>}
                  {objectives.map((k) => <td class="num">{bare(k, s.objectives?.[k])}</td>)}
                  {classes.map((k) => <td>{bare(k, s.classification?.[k])}</td>)}
                  <td>{s.defects.length ? <span class="defect">{s.defects.join(", ")}</span> : "none"}</td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
    </Section>
  );
}

function Within({ value, lower, upper }: { value: Num; lower: Num; upper: Num }) {
  if (value === null || lower === null || upper === null || lower === upper) return null;
  const share = Math.min(1, Math.max(0, (value - lower) / (upper - lower)));
  return <span class="within" aria-hidden="true"><i style={{ left: `${share * 100}%` }} /></span>;
}

export function Parameters() {
  paced.value;
  const shown = result.solutions.findIndex((_, i) => sceneOf(i) === sceneIndex.value);
  const index = shown < 0 ? 0 : shown;
  const list = view.parameters[index];
  if (!list?.length) return null;
  // One unit for all lengths, so that they can be compared.
  const largest = list.filter((p) => p.key.endsWith("_m")).flatMap((p) => [p.value, p.lower, p.upper])
    .reduce<number>((a, v) => Math.max(a, Math.abs(v ?? 0)), 0);
  return (
    <Section title={result.solutions.length > 1 ? `Parameters of solution ${index + 1}` : "Parameters"} id="parameters">
      <div class="scroll">
        <table>
          <thead><tr><th scope="col">parameter</th><th scope="col" class="num">value</th><th scope="col" class="num">lower</th><th scope="col">within bounds</th><th scope="col" class="num">upper</th><th scope="col">remark</th></tr></thead>
          <tbody>
            {list.map((p) => {
              const free = p.lower === null && p.upper === null;
              const fixed = !free && p.lower === p.upper;
              const unit = unitOf(p.key, largest);
              const show = (v: Num, digits = 6) => (v === null ? "–" : format(v * unit.factor, digits) + (unit.symbol === "°" ? "°" : unit.symbol ? `\u202f${unit.symbol}` : ""));
              const span = p.lower !== null && p.upper !== null ? p.upper - p.lower : Math.abs(p.value ?? 1);
              const near = (b: Num) => !fixed && b !== null && p.value !== null && Math.abs(p.value - b) <= 1e-6 * span;
              const active = near(p.lower) ? "at lower bound" : near(p.upper) ? "at upper bound" : "";
              return (
                <tr>
                  <th scope="row">{p.label} <code>{p.key}</code></th>
                  <td class="num">{show(p.value)}</td>
                  <td class="num">{fixed ? "" : show(p.lower, 5)}</td>
                  <td><Within value={p.value} lower={p.lower} upper={p.upper} /></td>
                  <td class="num">{fixed ? "" : show(p.upper, 5)}</td>
                  <td>{fixed ? "fixed" : active && <span class="defect">{active}</span>}</td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
    </Section>
  );
}

function Distribution() {
  const values = runs.map((r) => r.final);
  if (hasHistogram() || values.filter((v) => v !== null).length < 2) return null;
  return (
    <div class="card plot">
      <h3>Final value of each seed</h3>
      <Dots values={values} names={runs.map((r) => `seed ${r.seed}`)} label="best" />
    </div>
  );
}

export function Runs() {
  const statistics = Object.entries(isObject(result.statistics) ? result.statistics : {});
  if (!runs.length && !statistics.length && !hasLoosePlots()) return null;
  return (
    <Section title={runs.length ? "Search" : "Overview"} id="search">
      <Masonry><LoosePlots /><Convergence runs={runs} /><Distribution /></Masonry>
      {statistics.length > 0 && <dl class="facts across">{statistics.map(([k, v]) => <div><dt>{nameOf(k)}</dt><dd>{display(k, v)}</dd></div>)}</dl>}
      {runs.length > 0 && (
        <details>
          <summary>Table of the runs</summary>
          <div class="scroll"><table>
            <thead><tr><th scope="col">seed</th><th scope="col" class="num">final value</th><th scope="col" class="num">evaluations</th><th scope="col">status</th></tr></thead>
            <tbody>{runs.map((r) => <tr><td>{r.seed}</td><td class="num">{format(r.final, 9)}</td><td class="num">{format(r.evaluations, 12)}</td><td>{r.status.replace(/_/g, " ")}</td></tr>)}</tbody>
          </table></div>
        </details>
      )}
    </Section>
  );
}

/** From the first design to the answer: what was to become small, and what that does to all else. */
export function Changes() {
  const [all, setAll] = useState(false);
  if (!view.changes.length) return null;
  const wanted = view.changes.filter((c) => c.wanted);
  const rows = all || !wanted.length ? view.changes : wanted;
  const percent = (c: Change) => c.percent === null ? "" : `${c.percent > 0 ? "+" : ""}${format(c.percent, 4)}\u202f%`;
  return (
    <Section title="Before and after" id="changes">
      <div class="scroll"><table>
        <thead><tr><th scope="col">quantity</th><th scope="col">measure</th><th scope="col" class="num">before</th><th scope="col" class="num">after</th><th scope="col" class="num">change</th><th scope="col">objective</th></tr></thead>
        <tbody>{rows.map((c) => (
          <tr><th scope="row">{c.label}</th><td>{c.measure}</td><td class="num">{format(c.before, 6)}</td><td class="num">{format(c.after, 6)}</td>
            <td class="num"><span class={`badge ${(c.percent ?? 0) > 0 ? "bad" : "good"}`}>{percent(c)}</span></td><td>{c.wanted ? "yes" : ""}</td></tr>))}</tbody>
      </table></div>
      {wanted.length > 0 && wanted.length < view.changes.length && (
        <button type="button" onClick={() => setAll(!all)}>{all ? "objectives only" : `all ${view.changes.length} rows`}</button>)}
    </Section>
  );
}

export function Comparisons() {
  if (!view.comparisons.length) return null;
  return (
    <Section title="Published and ours" id="published">
      <div class="scroll"><table>
        <thead><tr><th scope="col">item</th><th scope="col">source</th><th scope="col" class="num">published</th><th scope="col" class="num">ours</th><th scope="col">verdict</th><th scope="col">note</th></tr></thead>
        <tbody>{view.comparisons.map((c) => (
          <tr><th scope="row">{c.item}</th><td>{c.source}</td><td class="num">{format(c.published, 9)}</td><td class="num">{format(c.ours, 9)}</td>
            <td><span class={`badge ${c.verdict.startsWith("not") ? "bad" : "good"}`}>{c.verdict}</span></td><td>{c.note}</td></tr>))}</tbody>
      </table></div>
    </Section>
  );
}

export function Remarks() {
  const remarks = result.diagnostics.filter((d) => d !== reason); // it stands where the mechanism would
  if (!remarks.length) return null;
  return (
    <Section title="Remarks" id="remarks">
      <ul class="remarks">{remarks.map((d) => (
        <li class={d.severity}><b>{d.severity}</b><span>{d.key && <code>{d.key}</code>} {d.message}{d.hint && <small>{d.hint}</small>}</span></li>))}</ul>
    </Section>
  );
}

export function Data() {
  paced.value;
  const missed = pacedScene.value && targetTable(pacedScene.value);
  const tables = missed ? [...result.tables, missed] : result.tables;
  return (
    <Section title="Data" id="data">
      <div class="downloads">
        {hasResult() && <button type="button" class="get" data-download="result.json" onClick={() => save("result.json", resultText(), "application/json")}>Result (JSON)</button>}
        {view.study_toml && <button type="button" class="get" data-download="study.toml" onClick={() => save("study.toml", view.study_toml)}>Study (TOML)</button>}
      </div>
      {tables.map((t) => <DataTable key={t.name} table={t} />)}
    </Section>
  );
}

const planarKeys = "space plays, ← → step (shift: 10), T trace, V speed, E targets, G ghosts, N names, F forces, W velocities, A accelerations, B bounce, + − 0 zoom, M full screen; drag a moving joint to move the mechanism";
const spatialKeys = "space plays, ← → step (shift: 10), comma and full stop step the second input, 1 to 5 fixed views, P parallel projection, + − 0 zoom, M full screen, T traces, N names, R ground, F forces, W velocities, A accelerations, B bounce; in the drawing drag to turn, drag with the right button or shift to move, Ctrl + wheel to zoom, arrow keys turn (shift: move); click a joint, a body or a wheel for its coordinates";

export function Reproduce() {
  paced.value;
  return (
    <Section title="How to reproduce" id="reproduce">
      {view.source && <p class="source">Source of the study: {view.source}</p>}
      {view.command && <div class="copyable"><pre>{view.command}</pre><Copy text={view.command} /></div>}
      {view.study_toml && <details><summary>The study</summary><div class="copyable"><pre>{view.study_toml}</pre><Copy text={view.study_toml} /></div></details>}
      <footer>{view.tool}<span class="screen-only"> · keys: {spatial.value ? spatialKeys : planarKeys}</span></footer>
    </Section>
  );
}
