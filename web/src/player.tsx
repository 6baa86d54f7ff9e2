// SPDX-License-Identifier: BSD-3-Clause

// Controls of the motion and of what is drawn.
import { useEffect } from "preact/hooks";
import { extent, fitView, zoomBy } from "./camera";
import { Switch, toggle } from "./controls";
import { Drawing, Runs, SpeedLegend, whiskerFactor } from "./drawing";
import { ExportMenu } from "./export_menu";
import { ArrowBar, Values } from "./forces";
import { rowsOf } from "./grid";
import { gaps, inputAt, isAssembled, placeNear, positionOfTurn, spanOf, step } from "./motion";
import { look, Positions, space, SpaceDrawing, ViewBar, viewName } from "./space_stage";
import { viewpoints } from "./space_view";
import * as state from "./state";
import { format, lengthUnit, quantity, unitOf } from "./units";

const walk = (count: number) => state.scrub(step(state.motion.value, state.position.value, count));
const end = (last: boolean) => state.scrub(last ? state.motion.value.samples - 1 : 0);
const play = () => state.motion.value.runs.length > 0 && toggle(state.playing);

const zoom = (factor: number) => (state.spatial.value ? space.value?.zoom(factor) : zoomBy(factor));
const fit = () => (state.spatial.value ? look(viewName.value) : fitView());
function project(): void {
  if (state.spatial.value) space.value?.parallel(toggle(state.parallel));
}

function fullScreen(): void {
  if (document.fullscreenElement) void document.exitFullscreen();
  else void document.querySelector(".machine")?.requestFullscreen?.();
}

const keys: Record<string, (event: KeyboardEvent) => void> = {
  " ": play,
  k: play,
  ArrowRight: (e) => walk(e.shiftKey ? 10 : 1),
  ArrowLeft: (e) => walk(e.shiftKey ? -10 : -1),
  Home: () => end(false),
  End: () => end(true),
  "+": () => zoom(1.25),
  "=": () => zoom(1.25),
  "-": () => zoom(0.8),
  "0": fit,
  ",": () => state.showRow(state.row.value - 1),
  ".": () => state.showRow(state.row.value + 1),
  p: project,
  r: () => toggle(state.showRoad),
  ...Object.fromEntries(viewpoints.map((v) => [v.key, () => state.spatial.value && look(v.name)])),
  t: () => toggle(state.showTrace),
  v: () => toggle(state.showSpeed),
  e: () => toggle(state.showTargets),
  g: () => toggle(state.showGhosts),
  n: () => toggle(state.showLabels),
  f: () => toggle(state.showArrows.force),
  w: () => toggle(state.showArrows.velocity),
  a: () => toggle(state.showArrows.acceleration),
  Escape: () => (state.picked.value = ""),
  b: () => toggle(state.bounce),
  m: fullScreen,
};

function onKey(event: KeyboardEvent) {
  const target = event.target as HTMLElement;
  // In a dialog keys are those of the dialog: Escape closes it, and letters are typed.
  if (event.ctrlKey || event.metaKey || event.altKey || target.closest("select, textarea, summary, a, pre, dialog")) return;
  if (target.closest("button") && (event.key === " " || event.key === "Enter")) return;
  const act = keys[event.key];
  // Home and End belong to the page unless the drawing or its controls have the focus.
  if (!act || (["Home", "End"].includes(event.key) && !target.closest(".machine"))) return;
  event.preventDefault();
  act(event);
}

function TimeLine() {
  const motion = state.motion.value;
  const scene = state.scene.value!;
  const last = motion.samples - 1;
  const input = inputAt(motion, state.position.value);
  const share = (at: number) => (inputAt(motion, at) - motion.input[0]) / (motion.input[last] - motion.input[0] || 1);
  return (
    <div class="time-line">
      <div class="track" aria-hidden="true">
        {gaps(motion).map(([a, b]) => <i class="gap" style={{ left: `${a * 100}%`, width: `${(b - a) * 100}%` }} title="does not assemble here" />)}
        <i class="done" style={{ width: `${share(state.position.value) * 100}%` }} />
        {state.showTargets.value && scene.targets.flatMap((t) => t.achieved_input.map((at) =>
          at !== null && <i class="tick" style={{ left: `${share(positionOfTurn(motion, at)) * 100}%` }} />))}
      </div>
      <input id="scrub" type="range" min={0} max={Math.max(1, last)} step={1} value={Math.round(state.position.value)}
        aria-label={scene.input_label || "input"} aria-valuetext={`${quantity(scene.input_key, input, 4)}${isAssembled(motion, state.position.value) ? "" : ", does not assemble"}`}
        onInput={(e) => state.scrub(Number(e.currentTarget.value))} />
    </div>
  );
}

/** Slider of the second input; its values are samples, and it stops at each of them. */
function SecondInput() {
  const whole = state.whole.value!;
  const values = whole.second ?? [];
  if (values.length < 2) return null;
  const shown = quantity(whole.second_key ?? "", values[state.row.value], 4);
  const name = whole.second_label || "second input";
  return (
    <div class="controls second">
      <label for="second">{name}</label>
      <input id="second" type="range" min={0} max={values.length - 1} step={1} value={state.row.value} aria-valuetext={shown} title={`${name} (, and .)`}
        onKeyDown={(e) => e.key.startsWith("Arrow") || ["Home", "End", "PageUp", "PageDown"].includes(e.key) ? e.stopPropagation() : undefined}
        onInput={(e) => state.showRow(Number(e.currentTarget.value))} />
      <output>{shown}</output>
    </div>
  );
}

function Readout() {
  const scene = state.scene.value!;
  const motion = state.motion.value;
  const at = state.position.value;
  const good = isAssembled(motion, at);
  const unit = unitOf(scene.input_key, Math.max(...scene.input.map(Math.abs)));
  const tracer = scene.joints.find((j) => j.style === "tracer");
  const p = tracer && placeNear(scene, tracer.point, at);
  const length = lengthUnit(extent.value);
  const value = inputAt(motion, at) * unit.factor;
  const decimals = motion.timed ? Math.min(6, Math.max(0, 3 - Math.floor(Math.log10(spanOf(motion) || 1)))) : 1;
  const even = unit.symbol === "°" || motion.timed;  // the same number of digits at every instant
  return (
    <dl class="title-block">
      <div class="wide"><dt>mechanism</dt><dd>{state.view.title || scene.title}</dd></div>
      {state.view.title && scene.title !== state.view.title && <div class="mid"><dt>drawing</dt><dd>{scene.title}</dd></div>}
      <div><dt>{scene.input_label || "input"}</dt><dd id="input-value">{even ? value.toFixed(decimals).replace("-", "−") : format(value, 5)}{unit.symbol === "°" ? "°" : ` ${unit.symbol}`}</dd></div>
      {rowsOf(state.whole.value!) > 1 && <div><dt>{scene.second_label || "second input"}</dt><dd id="second-value">{quantity(scene.second_key ?? "", scene.second![state.row.value], 5)}</dd></div>}
      {tracer && <div class="mid"><dt>{`point ${tracer.name}`}</dt><dd>{p ? `${[p.x, p.y, ...(p.z === undefined ? [] : [p.z])].map((v) => format(Math.abs(v) < 1e-12 * extent.value ? 0 : v * length.factor, 5)).join(", ")} ${length.symbol}` : "–"}</dd></div>}
      <div><dt>state</dt><dd class={good ? "ok" : "fail"}>{good ? "assembled" : (scene.status[Math.round(at)] ?? "no assembly").replace(/_/g, " ")}</dd></div>
    </dl>
  );
}

/** Instead of the drawing, the controls and the diagrams: why there are none. */
function Nowhere() {
  return (
    <section class="machine card nowhere" aria-label="Mechanism">
      <h2>Nothing to draw: the mechanism assembles at no input.</h2>
      {state.reason && <p>{state.reason.message}{state.reason.hint && <small>{state.reason.hint}</small>}</p>}
    </section>
  );
}

export function Machine() {
  useEffect(() => {
    document.addEventListener("keydown", onKey);
    return () => document.removeEventListener("keydown", onKey);
  }, []);
  const scene = state.scene.value;
  if (!scene) return null;
  if (state.nowhere) return <Nowhere />;
  const still = state.motion.value.samples < 2;
  const spatial = state.spatial.value;
  return (
    <section class="machine card" aria-label="Mechanism">
      {spatial ? <SpaceDrawing /> : <><Drawing /><SpeedLegend /></>}
      <Runs />
      {!still && (
        <div class="controls">
          <button type="button" id="play" class="play" aria-label={state.playing.value ? "Pause" : "Play"} title="Play or pause (space)" onClick={play}>
            <svg viewBox="0 0 20 20" aria-hidden="true"><path d={state.playing.value ? "M5 3h4v14H5zM11 3h4v14h-4z" : "M5 2.5L17 10 5 17.5z"} /></svg>
          </button>
          <button type="button" aria-label="Step back" title="One step back (←, with shift 10)" onClick={() => walk(-1)}>◂</button>
          <button type="button" aria-label="Step forward" title="One step forward (→, with shift 10)" onClick={() => walk(1)}>▸</button>
          <TimeLine />
          <select id="speed" aria-label="Speed" value={String(state.speed.value)} onChange={(e) => (state.speed.value = Number(e.currentTarget.value))}>
            {[0.1, 0.25, 0.5, 1, 2, 5, 10].map((s) => <option value={String(s)}>{`${s}×`}</option>)}
          </select>
          <Switch flag={state.bounce} text="⇄" hint="Bounce: back and forth instead of round (B)" />
        </div>
      )}
      <SecondInput />
      <div class="toolbar">
        {scene.traces.length > 0 && <Switch flag={state.showTrace} text="Trace" hint="Path of the traced point (T)" />}
        {scene.traces.length > 0 && !spatial && <Switch flag={state.showSpeed} text="Speed" hint="Trace coloured by the speed of the point (V)" />}
        {scene.targets.length > 0 && !spatial && <Switch flag={state.showTargets} text="Targets" hint="Target points and errors (E)" />}
        {!spatial && <Switch flag={state.showGhosts} text="Ghosts" hint="Poses at equal steps (G)" />}
        {spatial && <Switch flag={state.showRoad} text="Ground" hint="Grid at the lowest point of the wheels (R)" />}
        <Switch flag={state.showLabels} text="Names" hint="Names of the joints (N)" />
        {scene.targets.length > 0 && !spatial && (
          <label class="pick">errors
            <select id="whisker" value={String(state.whisker.value)} onChange={(e) => (state.whisker.value = e.currentTarget.value === "auto" ? "auto" : Number(e.currentTarget.value))}>
              <option value="auto">{`auto ×${format(whiskerFactor.value)}`}</option>
              {[1, 10, 100, 1000, 10000, 100000].map((f) => <option value={String(f)}>{`×${f}`}</option>)}
            </select>
          </label>
        )}
        <span class="spring" />
        {spatial && <ViewBar />}
        {spatial && <button type="button" class="switch" id="parallel" aria-pressed={state.parallel.value} title="Parallel projection instead of perspective (P)" onClick={project}>Parallel</button>}
        <span class="together">
        <button type="button" title="Zoom out (−)" aria-label="Zoom out" onClick={() => zoom(0.8)}>−</button>
        <button type="button" title="Zoom in (+, or Ctrl + wheel)" aria-label="Zoom in" onClick={() => zoom(1.25)}>+</button>
        <button type="button" title="Everything in view (0 or double click)" onClick={fit}>Fit</button>
        {document.fullscreenEnabled && <button type="button" id="full-screen" title="Full screen (M)" aria-label="Full screen" onClick={fullScreen}><svg viewBox="0 0 14 14" aria-hidden="true"><path d="M1 5V1h4M9 1h4v4M13 9v4H9M5 13H1V9" /></svg></button>}
        <ExportMenu />
        </span>
      </div>
      <ArrowBar />
      <Readout />
      <Positions />
      <Values />
    </section>
  );
}
