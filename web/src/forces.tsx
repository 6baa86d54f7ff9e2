// SPDX-License-Identifier: BSD-3-Clause

// Arrows and couples in the drawing, their controls, and their values at the instant shown.
import { useState } from "preact/hooks";
import {
  arcPaths, arcTurn, arrowPaths, componentsNear, keyValue, largestMoment, lineOf, plurals, quantities, readMoment, readVector, valueNear, type Reading,
} from "./arrows";
import { arrowPixels, extent, scales, screen, size } from "./camera";
import { Copy, Switch } from "./controls";
import type { Quantity, Scene } from "./data";
import { symbolOf } from "./labels";
import { inputAt, placeNear, type Place } from "./motion";
import * as state from "./state";
import { format, lengthUnit, quantity as withUnit } from "./units";
import { niceStep } from "./view";

/** Pixels of an arrow for a value of 1. */
const pixelsPerUnit = (quantity: Quantity) =>
  (scales.value.find((s) => s.quantity === quantity)?.scale ?? 0) * arrowPixels.value * state.magnify[quantity].value;
/** Longest arrow of the key. */
const keyRoom = () => Math.min(110, Math.max(40, 0.2 * size.value.width));
/** Quantities of which there is something to draw. */
const known = () => quantities.filter((q) => pixelsPerUnit(q) > 0 || (q === "force" && largestMoment(state.scene.value?.moments ?? []) > 0));
/** In space an arrow is a length of the drawing: a round value and how long its arrow is. */
const spatialKey = (quantity: Quantity) => {
  const scale = (scales.value.find((s) => s.quantity === quantity)?.scale ?? 0) * state.magnify[quantity].value;
  const value = niceStep((0.25 * extent.value) / scale);
  return { value, length: value * scale };
};
const unitOfAll = (scene: Scene, quantity: Quantity) => (scene.vectors.find((v) => v.quantity === quantity)?.unit ?? "");

const narrow = 480; // px: below it the names of arrows hide what they name

interface ArrowProps {
  quantity: Quantity;
  from: { x: number; y: number };
  end: { x: number; y: number };
  title: string;
  symbol?: string;
  pick?: string;
}

function Arrow({ quantity, from, end, title, symbol = "", pick }: ArrowProps) {
  const paths = arrowPaths(quantity, from, end);
  if (!paths) return null;
  const [cos, sin] = [Math.cos(paths.angle), Math.sin(paths.angle)];
  // Near its start the arrow leaves the pointer to the joint.
  const free = Math.min(14, Math.hypot(end.x - from.x, end.y - from.y) / 2);
  return (
    <g class={`arrow ${quantity}${pick && state.picked.value === pick ? " picked" : ""}`} data-pick={pick} data-tip={pick && `${(end.x - from.x).toFixed(3)} ${(end.y - from.y).toFixed(3)}`}>
      <title>{title}</title>
      <path class="halo" d={paths.shaft + paths.head} />
      <path class="shaft" d={paths.shaft} />
      <path class="head" d={paths.head} />
      {pick && <path class="reach" d={`M${from.x + free * cos} ${from.y + free * sin}L${end.x} ${end.y}`} />}
      {symbol && state.showLabels.value && size.value.width >= narrow && (
        <text x={end.x + 9 * cos} y={end.y + 9 * sin + 4.5} text-anchor={cos < -0.3 ? "end" : cos < 0.3 ? "middle" : "start"}>{symbol}</text>
      )}
    </g>
  );
}

function Vectors({ scene, quantity, at }: { scene: Scene; quantity: Quantity; at: number }) {
  const scale = pixelsPerUnit(quantity);
  if (!(scale > 0)) return null;
  return (
    <g class="vectors">
      {scene.vectors.map((vector, i) => {
        if (vector.quantity !== quantity) return null;
        const from = screen(placeNear(scene, vector.point, at));
        const v = componentsNear(vector, at);
        if (!from || !v) return null;
        return <Arrow quantity={quantity} from={from} end={{ x: from.x + v.x * scale, y: from.y - v.y * scale }} title={vector.name} symbol={symbolOf(scene, vector)} pick={`vector ${i}`} />;
      })}
    </g>
  );
}

function Moments({ scene, at }: { scene: Scene; at: number }) {
  const most = largestMoment(scene.moments);
  if (!(most > 0)) return null;
  return (
    <g class="moments">
      {scene.moments.map((moment, i) => {
        const centre = screen(placeNear(scene, moment.point, at));
        const value = valueNear(moment.value, at);
        if (!centre || !value) return null;
        const radius = 30 + 10 * scene.moments.slice(0, i).filter((m) => m.point === moment.point).length;
        const { arc, head } = arcPaths(centre, radius, arcTurn(value / most));
        return (
          <g class={`arrow force moment${state.picked.value === `moment ${i}` ? " picked" : ""}`} data-pick={`moment ${i}`}>
            <title>{moment.name}</title>
            <path class="halo" d={arc} />
            <path class="shaft" d={arc} />
            <path class="head" d={head} />
            <path class="reach" d={arc} />
            {moment.symbol && state.showLabels.value && <text x={centre.x} y={centre.y - radius - 7} text-anchor="middle">{moment.symbol}</text>}
          </g>
        );
      })}
    </g>
  );
}

export function Arrows({ scene }: { scene: Scene }) {
  const at = state.position.value;
  return (
    <g class="arrows">
      {quantities.map((q) => state.showArrows[q].value && <Vectors scene={scene} quantity={q} at={at} />)}
      {state.showArrows.force.value && <Moments scene={scene} at={at} />}
    </g>
  );
}

/** The key: the value of an arrow of the length shown, at the top left of the drawing. */
export function Key({ scene }: { scene: Scene }) {
  const most = largestMoment(scene.moments);
  const rows = quantities.flatMap((quantity) => {
    const scale = pixelsPerUnit(quantity);
    if (!(scale > 0) || !state.showArrows[quantity].value) return [];
    const value = keyValue(scale, keyRoom());
    return [{ quantity, length: value * scale, text: `${quantity} ${format(value)} ${unitOfAll(scene, quantity)}`, value }];
  });
  const couples = most > 0 && state.showArrows.force.value;
  if (!rows.length && !couples) return null;
  const width = Math.max(...rows.map((r) => r.length), 24);
  const arc = arcPaths({ x: 52, y: 26 + 24 * rows.length }, 9, arcTurn(0.75));
  const unit = scene.moments[0]?.unit ?? "";
  const note = `full arc ${format(most, 4)} ${unit}`;
  const longest = Math.max(...rows.map((r) => r.text.length), couples ? note.length : 0);
  return (
    <g class="key">
      <rect x={34} y={10} width={width + 24 + 6.6 * longest} height={24 * (rows.length + (couples ? 1 : 0)) + 8} rx={4} />
      {rows.map((r, i) => (
        <g data-key={r.quantity} data-value={r.value} data-length={r.length.toFixed(3)}>
          <Arrow quantity={r.quantity} from={{ x: 42, y: 26 + 24 * i }} end={{ x: 42 + r.length, y: 26 + 24 * i }} title={r.text} />
          <text x={52 + width} y={30.5 + 24 * i}>{r.text}</text>
        </g>
      ))}
      {couples && (
        <g class="arrow force moment" data-key="couple">
          <path class="shaft" d={arc.arc} />
          <path class="head" d={arc.head} />
          <text class="note" x={52 + width} y={30.5 + 24 * rows.length}>{note}</text>
        </g>
      )}
    </g>
  );
}

/** Switches and scales, one a quantity. */
export function ArrowBar() {
  const scene = state.scene.value;
  const shown = known();
  if (!scene || !shown.length) return null;
  return (
    <div class="toolbar arrow-bar" role="group" aria-label="Arrows">
      {shown.map((q) => {
        const factor = state.magnify[q].value;
        const text = `×${format(factor, 3)}`;
        const value = state.spatial.value ? spatialKey(q).value : keyValue(pixelsPerUnit(q), keyRoom());
        const key = pixelsPerUnit(q) > 0 ? `${format(value)} ${unitOfAll(scene, q)}` : "";
        return (
          <div class="scale">
            <Switch flag={state.showArrows[q]} text={plurals[q]} hint={`Arrows of ${plurals[q].toLowerCase()} (${{ force: "F", velocity: "W", acceleration: "A" }[q]})`} />
            {pixelsPerUnit(q) > 0 && state.showArrows[q].value && <>
              <input type="range" min={-3} max={3} step={0.25} value={Math.log2(factor)} data-scale={q} aria-label={`Scale of ${plurals[q].toLowerCase()}`}
                aria-valuetext={`${text}, the arrow in the key is ${key}`} onInput={(e) => (state.magnify[q].value = 2 ** Number(e.currentTarget.value))} />
              <output>{text}</output>
            </>}
          </div>
        );
      })}
    </div>
  );
}

/** The key of the arrows in space. */
export function SpaceKey({ scene }: { scene: Scene }) {
  const rows = quantities.filter((q) => state.showArrows[q].value && (scales.value.find((s) => s.quantity === q)?.scale ?? 0) > 0);
  if (!rows.length) return null;
  const unit = lengthUnit(extent.value);
  return (
    <ul class="space-key">
      {rows.map((q) => {
        const { value, length } = spatialKey(q);
        return <li class={q} data-key={q}>{`${q} ${format(value)} ${unitOfAll(scene, q)} is ${format(length * unit.factor, 3)} ${unit.symbol} long`}</li>;
      })}
    </ul>
  );
}

/** The inputs as text. */
export function instant(scene: Scene, at: number): string {
  const first = `${scene.input_label || "input"} ${withUnit(scene.input_key, inputAt(state.motion.value, at), 5)}`;
  const second = scene.second?.[state.row.value];
  return second === undefined ? first : `${first}, ${scene.second_label || "second input"} ${withUnit(scene.second_key ?? "", second, 5)}`;
}

/** Coordinates as text: "x 1, y 2 mm". */
export function coordinates(p: Place | null): string {
  const unit = lengthUnit(extent.value);
  const each = (v: number) => format(Math.abs(v) < 1e-12 * extent.value ? 0 : v * unit.factor, 5);
  return p ? `x ${each(p.x)}, y ${each(p.y)}${p.z === undefined ? "" : `, z ${each(p.z)}`} ${unit.symbol}` : "does not exist here";
}

/** Everything known of what is picked: an arrow, a couple, or a joint with what acts there. */
function readPick(scene: Scene, pick: string, at: number): { title: string; place: string; readings: Reading[] } | null {
  const [kind, number] = pick.split(" ");
  const i = Number(number);
  if (kind === "vector" && scene.vectors[i]) return { title: scene.vectors[i].name, place: "", readings: [readVector(scene.vectors[i], at)] };
  if (kind === "moment" && scene.moments[i]) return { title: scene.moments[i].name, place: "", readings: [readMoment(scene.moments[i], at)] };
  const body = kind === "body" ? scene.bodies[i] : undefined;
  if (body) return { title: body.name, place: body.points.map((p) => `${scene.points[p]?.name ?? ""}: ${coordinates(placeNear(scene, p, at))}`).join("; "), readings: [] };
  const disc = kind === "disc" ? scene.discs?.[i] : undefined;
  if (disc) {
    const unit = lengthUnit(extent.value);
    const size = (v: number) => `${format(v * unit.factor, 4)}\u202f${unit.symbol}`;
    return { title: disc.name, place: `centre ${coordinates(placeNear(scene, disc.centre, at))}; radius ${size(disc.radius)}, width ${size(disc.width)}`, readings: [] };
  }
  const joint = kind === "joint" ? scene.joints[i] : undefined;
  if (!joint) return null;
  return {
    title: joint.name,
    place: coordinates(placeNear(scene, joint.point, at)),
    readings: [
      ...scene.vectors.filter((v) => v.point === joint.point).map((v) => readVector(v, at)),
      ...scene.moments.filter((m) => m.point === joint.point).map((m) => readMoment(m, at)),
    ],
  };
}

/** Values of what is pointed at or picked; not while it is dragged, for the card would hide the mechanism. */
export function Card() {
  const scene = state.scene.value;
  const pick = state.picked.value || state.hovered.value;
  if (!scene || !pick || state.changing.value) return null;
  const at = state.position.value;
  const read = readPick(scene, pick, at);
  if (!read) return null;
  const text = [`${read.title} at ${instant(scene, at)}${read.place && `: ${read.place}`}`, ...read.readings.map(lineOf)].join("\n");
  const pinned = state.picked.value !== "";
  return (
    <div class={`values-card${pinned ? " pinned" : ""}`} id="picked" role="group" aria-label={`Values of ${read.title}`}>
      <b>{read.title}</b>
      {read.place && read.place.split("; ").map((line) => <span>{line}</span>)}
      {read.readings.map((r) => (
        <dl class={r.quantity}>
          {read.readings.length > 1 || read.place ? <div class="name"><dt>{r.name}</dt></div> : null}
          <div><dt>{r.quantity === "moment" ? "couple" : "size"}</dt><dd>{r.size}</dd></div>
          {r.quantity !== "moment" && <>
            <div><dt>x</dt><dd>{r.x}</dd></div>
            <div><dt>y</dt><dd>{r.y}</dd></div>
            {r.z === undefined ? <div><dt>direction</dt><dd>{r.direction}</dd></div> : <div><dt>z</dt><dd>{r.z}</dd></div>}
          </>}
        </dl>
      ))}
      {pinned && <span class="actions"><Copy text={text} /><button type="button" onClick={() => (state.picked.value = "")}>close</button></span>}
    </div>
  );
}

/** All arrows and couples at this instant as a table: the same for keyboards and screen readers. */
export function Values() {
  const [open, setOpen] = useState(false);
  const scene = state.scene.value;
  if (!scene || scene.vectors.length + scene.moments.length === 0) return null;
  const last = state.spatial.value ? "z" : "direction";
  const rows = () => [
    ...scene.vectors.map((v, i) => ({ pick: `vector ${i}`, r: readVector(v, state.position.value) })),
    ...scene.moments.map((m, i) => ({ pick: `moment ${i}`, r: readMoment(m, state.position.value) })),
  ];
  const text = () => [`at ${instant(scene, state.position.value)}`, `name\tsize\tx\ty\t${last}`, ...rows().map(({ r }) => [r.name, r.size, r.x, r.y, r.z ?? r.direction].join("\t"))].join("\n");
  return (
    <details class="values" onToggle={(e) => setOpen(e.currentTarget.open)}>
      <summary>Forces and motion at this instant</summary>
      {(open || state.printing.value) && <>
        <div class="scroll"><table>
          <thead><tr><th scope="col">arrow</th><th scope="col" class="num">size</th><th scope="col" class="num">x</th><th scope="col" class="num">y</th><th scope="col" class="num">{last}</th></tr></thead>
          <tbody>
            {rows().map(({ pick, r }) => (
              <tr class={state.picked.value === pick ? "current" : ""}>
                <th scope="row"><button type="button" class="link" aria-pressed={state.picked.value === pick} onClick={() => (state.picked.value = state.picked.value === pick ? "" : pick)}>{r.name}</button></th>
                <td class="num">{r.size}</td><td class="num">{r.x}</td><td class="num">{r.y}</td><td class="num">{r.z ?? r.direction}</td>
              </tr>
            ))}
          </tbody>
        </table></div>
        <Copy text={text} />
      </>}
    </details>
  );
}
