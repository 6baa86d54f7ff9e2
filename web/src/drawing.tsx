// SPDX-License-Identifier: BSD-3-Clause

// The mechanism to scale: grid, traces, targets with error whiskers, ghost positions and the pose itself.
import { computed } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { isSymbol, symbolLines } from "./arrows";
import { camera, extent, fitView, heightAt, moved, screen, size, thickness, zoomBy } from "./camera";
import { Sign } from "./chart";
import { WheelHint } from "./controls";
import type { Scene } from "./data";
import { Arrows, Card, Key } from "./forces";
import { placeLabels } from "./labels";
import { lookOf } from "./look";
import { isAssembled, isFixed, nearestSample, placeAt, placeNear, speeds, type Place } from "./motion";
import { beyond } from "./space_view";
import * as state from "./state";
import { format, lengthUnit, quantity, unitOf } from "./units";
import { bodyColours, niceStep, pathOf, targetErrors, ticks, toScreen, toWorld, whiskerScale, type Camera } from "./view";

/** The factor by which the whiskers are enlarged. */
export const whiskerFactor = computed(() => {
  if (state.whisker.value !== "auto") return state.whisker.value;
  const target = state.scene.value?.targets[0];
  if (!target) return 1;
  const { distance, worst } = targetErrors(target);
  return whiskerScale(worst < 0 ? 0 : distance[worst]!, extent.value);
});

function Grid() {
  const { width, height } = size.value;
  const cam = camera.value;
  const unit = lengthUnit(extent.value);
  // The lines are at round numbers of the unit that is shown.
  const step = niceStep((110 / cam.scale) * unit.factor) / unit.factor;
  const low = toWorld(cam, size.value, { x: 0, y: height });
  const high = toWorld(cam, size.value, { x: width, y: 0 });
  const label = (v: number) => format(Math.abs(v) < step * 1e-6 ? 0 : v * unit.factor, 6);
  const xs = ticks(low.x, high.x, step);
  const ys = ticks(low.y, high.y, step);
  const x = (v: number) => toScreen(cam, size.value, { x: v, y: 0 }).x;
  const y = (v: number) => toScreen(cam, size.value, { x: 0, y: v }).y;
  const bar = step * cam.scale;
  return (
    <g class="grid">
      <path class="minor" d={ticks(low.x, high.x, step / 5).map((v) => `M${x(v).toFixed(1)} 0V${height}`).join("") +
        ticks(low.y, high.y, step / 5).map((v) => `M0 ${y(v).toFixed(1)}H${width}`).join("")} />
      <path class="major" d={xs.map((v) => `M${x(v).toFixed(1)} 0V${height}`).join("") + ys.map((v) => `M0 ${y(v).toFixed(1)}H${width}`).join("")} />
      {xs.filter((v) => x(v) > 44 && x(v) < width - 190).map((v) => <text x={x(v)} y={height - 8} text-anchor="middle">{label(v)}</text>)}
      {ys.filter((v) => y(v) > 16 && y(v) < height - 30).map((v) => <text x={7} y={y(v) - 4}>{label(v)}</text>)}
      <g class="scale-bar" transform={`translate(${width - 22 - bar},${height - 16})`}>
        <path d={`M0 -5V0H${bar}V-5`} />
        <text x={bar / 2} y={-6} text-anchor="middle">{`${label(step)} ${unit.symbol}`}</text>
      </g>
    </g>
  );
}

// Cividis, which keeps its order for every kind of colour vision (Nunez, Anderton and Renslow 2018).
const cividis = ["#00224e", "#123570", "#3b496c", "#575d6d", "#707173", "#8a8678", "#a59c74", "#c3b369", "#e1cc55", "#fee838"];

function speedRange(scene: Scene) {
  const motion = state.motion.value;
  const lists = scene.traces.map((trace) => speeds(scene, motion, trace.point));
  const known = lists.flat().filter((v): v is number => v !== null);
  return { lists, low: known.reduce((a, b) => Math.min(a, b), Infinity), high: known.reduce((a, b) => Math.max(a, b), 0) };
}

function Traces({ scene }: { scene: Scene }) {
  const coloured = state.showSpeed.value;
  const range = useMemo(() => speedRange(scene), [scene]);
  if (!state.showTrace.value) return null;
  return (
    <g class="traces">
      {scene.traces.map((trace, k) => {
        const places = scene.input.map((_, i) => (state.motion.value.ok[i] ? screen(placeAt(scene, trace.point, i)) : null));
        const whole = pathOf(places, trace.closed);
        const run = trace.run ?? 0;
        if (scene.runs && (run || !coloured)) return <path class={run ? "trace thin" : "trace"} style={{ stroke: runLook(run).stroke }} d={whole}><title>{trace.name}</title></path>;
        if (!coloured) return <path class="trace" d={whole}><title>{trace.name}</title></path>;
        const strokes = cividis.map(() => "");
        places.forEach((p, i) => {
          const q = places[i + 1];
          const v = range.lists[k][i];
          if (!p || !q || v === null) return;
          const bin = Math.min(9, Math.floor(((v - range.low) / (range.high - range.low || 1)) * 10));
          strokes[bin] += `M${p.x.toFixed(2)} ${p.y.toFixed(2)}L${q.x.toFixed(2)} ${q.y.toFixed(2)}`;
        });
        return (
          <g>
            <path class="trace under" d={whole} />
            {strokes.map((d, i) => d && <path class="trace speed" d={d} style={{ stroke: cividis[i] }} />)}
          </g>
        );
      })}
    </g>
  );
}

export function SpeedLegend() {
  const scene = state.scene.value;
  if (!scene || !state.showSpeed.value || !state.showTrace.value || !scene.traces.length) return null;
  const { low, high } = speedRange(scene);
  const [unit, per] = [lengthUnit(extent.value), unitOf(scene.input_key)];
  const text = (v: number) => `${format((v * unit.factor) / per.factor, 3)}\u202f${unit.symbol}/${per.symbol}`;
  return (
    <div class="speed-legend">
      <span>{text(low)}</span>
      <i style={{ background: `linear-gradient(90deg, ${cividis.join(",")})` }} />
      <span>{text(high)}</span>
    </div>
  );
}

function Targets({ scene }: { scene: Scene }) {
  if (!state.showTargets.value) return null;
  const factor = whiskerFactor.value;
  return (
    <g class="targets">
      {scene.targets.map((target) => {
        const { distance, worst } = targetErrors(target);
        const wanted = target.x.map((x, i) => (x === null || target.y[i] == null ? null : { x, y: target.y[i]! }));
        return (
          <g>
            {wanted.map((p, i) => {
              const at = screen(p);
              if (!p || !at) return null;
              const end = distance[i] === null ? null
                : screen({ x: p.x + factor * (target.achieved_x[i]! - p.x), y: p.y + factor * (target.achieved_y[i]! - p.y) });
              return (
                <g class="target" data-index={i}>
                  <title>{`${target.name} ${i + 1}: missed by ${quantity("_m", distance[i], 4)}`}</title>
                  {end && <path class="whisker" d={`M${at.x.toFixed(2)} ${at.y.toFixed(2)}L${end.x.toFixed(2)} ${end.y.toFixed(2)}`} />}
                  <circle cx={at.x} cy={at.y} r={3.6} />
                </g>
              );
            })}
            {worst >= 0 && distance[worst]! > 0 && screen(wanted[worst]) && (
              <circle class="worst" cx={screen(wanted[worst])!.x} cy={screen(wanted[worst])!.y} r={10}>
                <title>{`worst point: ${worst + 1}`}</title>
              </circle>
            )}
          </g>
        );
      })}
    </g>
  );
}

/** Handles that turn the poses of a target by hand. */
function Turns({ scene }: { scene: Scene }) {
  const turns = scene.handles?.filter((h) => h.target >= 0 && h.point >= 0) ?? [];
  if (!turns.length || !state.showTargets.value) return null;
  return (
    <g class="turns">
      {turns.map(({ key, point }) => {
        const p = screen(placeAt(scene, point, 0));
        return p && <circle key={point} data-turns={key} cx={p.x} cy={p.y} r={5}><title>drag to turn the pose</title></circle>;
      })}
    </g>
  );
}

function Circles({ scene, at }: { scene: Scene; at: number }) {
  return (
    <>
      {scene.circles.map((circle) => {
        const centre = screen(placeNear(scene, circle.centre, at));
        const rim = screen(placeNear(scene, circle.rim, at));
        if (!centre || !rim) return null;
        const inner = { x: centre.x + 0.72 * (rim.x - centre.x), y: centre.y + 0.72 * (rim.y - centre.y) };
        return (
          <g class="circle" data-circle={circle.name}>
            <title>{circle.name}</title>
            <circle cx={centre.x.toFixed(2)} cy={centre.y.toFixed(2)} r={Math.hypot(rim.x - centre.x, rim.y - centre.y).toFixed(2)} />
            <path d={pathOf([inner, rim], false)} />
          </g>
        );
      })}
    </>
  );
}

const symbolWidth = 18; // px

/** The gap of a loop that does not close, with its length. */
function Gap({ name, ends: [a, b] }: { name: string; ends: Place[] }) {
  const [p, q] = [screen(a)!, screen(b)!];
  const unit = lengthUnit(extent.value);
  return (
    <g class="gap" data-body={name}>
      <title>{name}</title>
      <path d={pathOf([p, q], false)} />
      <text x={(p.x + q.x) / 2 + 8} y={(p.y + q.y) / 2 - 8}>{`gap ${format(Math.hypot(b.x - a.x, b.y - a.y) * unit.factor, 4)} ${unit.symbol}`}</text>
    </g>
  );
}

/** The look of a mechanism that others are compared with: like its curves in the diagrams. */
function runLook(run: number): { stroke: string; strokeDasharray: string } {
  const { stroke, dash } = lookOf(run);
  return { stroke: `var(${stroke})`, strokeDasharray: dash.join(" ") };
}

/** The names of the mechanisms that are drawn over each other. */
export function Runs() {
  const runs = state.scene.value?.runs;
  if (!runs) return null;
  return <ul class="runs">{runs.map((name, run) => <li><Sign look={lookOf(run)} />{name}</li>)}</ul>;
}

/** Bodies of one kind: plates lie under the traces, bars above them. */
function Bodies({ scene, at, plates }: { scene: Scene; at: number; plates: boolean }) {
  const colours = bodyColours(scene.bodies);
  return (
    <>
      {scene.bodies.map((body, number) => {
        const fill = `var(--c${colours[number]})`;
        const places = body.points.map((p) => screen(placeNear(scene, p, at)));
        if (isSymbol(body.style)) {
          const lines = places.slice(1).flatMap((q, i) => (places[i] && q ? symbolLines(body.style, places[i]!, q, -symbolWidth) : []));
          return plates ? null : <path class={`symbol ${body.style}`} data-body={body.name} d={lines.map((line) => pathOf(line, false)).join("")}><title>{body.name}</title></path>;
        }
        const plate = body.style === "plate" && places.length > 2;
        if (plate !== plates || places.length < 2 || places.some((p) => p === null)) return null;
        const d = pathOf(places, plate);
        if (body.run) return <path class="other" data-body={body.name} style={runLook(body.run)} d={d}><title>{body.name}</title></path>;
        if (body.style === "ground") return <path class="ground" d={d}><title>{body.name}</title></path>;
        if (body.style === "axis") return <path class="ground axis" d={pathOf(beyond(places as Place[]), false)}><title>{body.name}</title></path>;
        if (body.style === "gap") return <Gap name={body.name} ends={[0, 1].map((end) => placeNear(scene, body.points[end], at)!)} />;
        return (
          <g class="link" data-body={body.name}>
            <title>{body.name}</title>
            {plate && <path class="plate" d={d} style={{ fill }} />}
            <path class="outline" d={d} />
            <path class="bar" d={d} style={{ stroke: fill }} />
          </g>
        );
      })}
    </>
  );
}

function Joints({ scene, at }: { scene: Scene; at: number }) {
  const before = useRef<number[]>([]);
  const places = scene.joints.map((joint) => screen(placeNear(scene, joint.point, at)));
  const names = state.showLabels.value ? placeLabels(places.map((p, i) => p && { ...p, text: scene.joints[i].name }), before.current) : [];
  before.current = names.map((n) => n?.slot ?? 0);
  return (
    <>
      {scene.joints.map((joint, i) => {
        const [p, name] = [places[i], names[i]];
        if (!p) return null;
        const cut = [0, 1, 2, 3, 4, 5].map((k) => `M${-13 + 6 * k} 18l-6 7`).join("");
        const thick = Math.max(0.45, thickness.value);
        const marked = [state.picked.value, state.hovered.value].includes(`joint ${i}`) ? " marked" : "";
        return (
          <g class={`joint ${joint.style}${marked}`} data-joint={joint.name} data-pick={`joint ${i}`} transform={`translate(${p.x.toFixed(2)},${p.y.toFixed(2)})`}>
            <title>{joint.name}</title>
            {joint.style === "ground_pivot" && <path class="foot" d="M0 0L-11 18H11Z" />}
            {joint.style === "ground_pivot" && <path class="hatch" d={`M-18 18H18${cut}`} />}
            <circle r={(joint.style === "tracer" ? 5.4 : 4.6) * thick} />
            {joint.style !== "tracer" && <circle class="pin" r={1.1 * thick} />}
            <circle class="reach" r={Math.max(6, 12 * thick)} />
            {name?.far && <path class="leader" d={`M0 0L${name.x} ${name.y}`} />}
            {name && <text x={name.x} y={name.y} text-anchor={name.anchor}>{joint.name}</text>}
          </g>
        );
      })}
    </>
  );
}

function Ghosts({ scene }: { scene: Scene }) {
  if (!state.showGhosts.value) return null;
  const motion = state.motion.value;
  const count = 12;
  const at = Array.from({ length: count }, (_, i) => Math.round(((motion.samples - 1) * i) / (motion.fullTurn ? count : count - 1)));
  return <g class="ghosts" style={{ "--thick": thickness.value.toFixed(3) }}>{at.filter((i) => motion.ok[i]).map((i) => <g><Bodies scene={scene} at={i} plates /><Bodies scene={scene} at={i} plates={false} /></g>)}</g>;
}

function Pose({ scene, under }: { scene: Scene; under: boolean }) {
  const at = state.position.value;
  const name = isAssembled(state.motion.value, at) ? "" : " broken";
  const style = { "--thick": thickness.value.toFixed(3) };
  if (under) return <g class={`plates${name}`} style={style}><Circles scene={scene} at={at} /><Bodies scene={scene} at={at} plates /></g>;
  return (
    <g class={`pose${name}`} style={style} data-position={at.toFixed(3)}>
      <Bodies scene={scene} at={at} plates={false} />
      <Joints scene={scene} at={at} />
    </g>
  );
}

// A press on a moving joint drags the mechanism along its motion; elsewhere it moves the sheet.
type Gesture = { kind: "hand" } | { kind: "joint"; point: number } | { kind: "sheet"; from: Place; camera: Camera };

/** The path that the mechanism was found for. */
function Backdrop() {
  const path = state.backdrop.value;
  return path && <path class="backdrop" d={pathOf(path.places.map((p) => toScreen(camera.value, size.value, p)), path.closed)} />;
}

function Stroke() {
  const places = state.stroke.value.map((p) => toScreen(camera.value, size.value, p));
  return places.length > 1 ? <path class="stroke" d={`M${places.map((p) => `${p.x.toFixed(1)} ${p.y.toFixed(1)}`).join("L")}`} /> : null;
}

export function Drawing(): JSX.Element {
  const box = useRef<HTMLDivElement>(null);
  const gesture = useRef<Gesture | null>(null);
  useEffect(() => {
    const element = box.current!;
    const measure = () => {
      const width = element.clientWidth || 760;
      size.value = { width, height: document.fullscreenElement ? element.clientHeight : heightAt(width) };
    };
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    addEventListener("resize", measure);
    const wheel = (event: WheelEvent) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      const at = element.getBoundingClientRect();
      zoomBy(Math.exp(-event.deltaY * 0.0025), { x: event.clientX - at.left, y: event.clientY - at.top });
    };
    element.addEventListener("wheel", wheel, { passive: false });
    return () => {
      observer.disconnect();
      removeEventListener("resize", measure);
    };
  }, []);
  const scene = state.scene.value;
  const here = (event: PointerEvent): Place => {
    const at = box.current!.getBoundingClientRect();
    return { x: event.clientX - at.left, y: event.clientY - at.top };
  };
  const down = (event: PointerEvent) => {
    if (event.button !== 0 || !scene) return;
    const at = here(event);
    const target = pickOf(event);
    if (target) state.picked.value = state.picked.value === target && !target.startsWith("joint") ? "" : target;
    if (target.startsWith("vector") || target.startsWith("moment")) return;
    if (state.hand.now?.down(scene, toWorld(camera.value, size.value, at), 14 / camera.value.scale, event.altKey)) {
      moved.value = camera.value; // the sheet stays while the mechanism changes
      gesture.current = { kind: "hand" };
      (event.currentTarget as Element).setPointerCapture(event.pointerId);
      return;
    }
    const joint = scene.joints.find((j) => {
      const p = screen(placeNear(scene, j.point, state.position.value));
      return p && !isFixed(scene, j.point) && Math.hypot(p.x - at.x, p.y - at.y) < 16;
    });
    if (!joint && event.pointerType === "touch") return; // the page scrolls
    gesture.current = joint ? { kind: "joint", point: joint.point } : { kind: "sheet", from: at, camera: camera.value };
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
  };
  const move = (event: PointerEvent) => {
    const g = gesture.current;
    if (!g || !scene) return;
    const at = here(event);
    if (g.kind === "hand") state.hand.now?.move(toWorld(camera.value, size.value, at), event.altKey);
    else if (g.kind === "joint")
      state.scrub(nearestSample(scene, state.motion.value, g.point, state.position.value, toWorld(camera.value, size.value, at)));
    else
      moved.value = { ...g.camera, x: g.camera.x - (at.x - g.from.x) / g.camera.scale, y: g.camera.y + (at.y - g.from.y) / g.camera.scale };
  };
  const up = () => {
    if (gesture.current?.kind === "hand") state.hand.now?.up();
    gesture.current = null;
  };
  const pickOf = (event: Event) => (event.target as Element).closest<SVGElement>("[data-pick]")?.dataset.pick ?? "";
  const { width, height } = size.value;
  return (
    <div class="stage" ref={box} style={{ height: `${height}px` }}>
      <svg id="drawing" viewBox={`0 0 ${width} ${height}`} role="img" tabindex={0} aria-label={`Drawing of the mechanism: ${scene?.title ?? "none"}`}
        onPointerDown={down} onPointerMove={move} onPointerOver={(e) => (state.hovered.value = pickOf(e))} onPointerLeave={() => (state.hovered.value = "")} onPointerUp={up} onPointerCancel={up}
        onDblClick={fitView}>
        <rect class="paper" width={width} height={height} />
        <Grid />
        {scene && (
          <>
            <Backdrop />
            <Ghosts scene={scene} />
            <Pose scene={scene} under />
            <Traces scene={scene} />
            <Pose scene={scene} under={false} />
            <Targets scene={scene} />
            <Turns scene={scene} />
            <Stroke />
            <Arrows scene={scene} />
            <Key scene={scene} />
          </>
        )}
      </svg>
      <Card />
      <WheelHint />
    </div>
  );
}
