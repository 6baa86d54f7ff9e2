// SPDX-License-Identifier: BSD-3-Clause

// The spatial drawing on the page. What draws it is another script, which only reports with a spatial scene carry.
import { effect, signal } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { extent } from "./camera";
import { Copy, WheelHint } from "./controls";
import { Card, coordinates, instant, SpaceKey } from "./forces";
import { placeNear } from "./motion";
import type { SpaceView } from "./space";
import { viewpoints, type ViewName } from "./space_view";
import * as state from "./state";
import { format, lengthUnit } from "./units";
import { onceOf } from "./view";

declare global {
  var linkwrightSpace: typeof import("./space") | undefined;
}

export const space = signal<SpaceView | null>(null);
export const viewName = signal<ViewName>("oblique");

/** Drawings of the page without scripts, by scene: for print. */
const stills = new Map<number, SVGSVGElement>();
export function keepStills(page: HTMLElement): void {
  for (const figure of page.querySelectorAll<HTMLElement>("[data-scene]")) stills.set(Number(figure.dataset.scene), figure.querySelector("svg")!);
}
export const still = () => stills.get(state.sceneIndex.value);

export function look(name: ViewName): void {
  // Seen along an axis, lengths can be compared; from elsewhere, depth shows.
  state.parallel.value = name !== "oblique";
  viewName.value = name;
  space.value?.parallel(state.parallel.value);
  space.value?.look(name);
}

const quarter = Math.PI / 24;
const moves: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

function onKey(event: KeyboardEvent): void {
  const move = moves[event.key];
  if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  event.stopPropagation(); // elsewhere on the page these keys step through the motion
  if (event.shiftKey) space.value?.move(40 * move[0], 40 * move[1]);
  else space.value?.turn(quarter * move[0], quarter * move[1]);
}

function Still() {
  const box = useRef<HTMLDivElement>(null);
  const drawing = still();
  useEffect(() => {
    box.current!.replaceChildren(...(drawing ? [drawing.cloneNode(true)] : []));
  }, [drawing]);
  return <div class="still" ref={box} />;
}

/** The data that the parts of a view are made from; scenes that agree in it are drawn by the same view. */
const partsOf = onceOf(({ bodies, discs, joints, vectors }) => JSON.stringify([bodies, discs, joints, vectors.map(({ name, quantity, symbol }) => [name, quantity, symbol])]));

export function SpaceDrawing() {
  const box = useRef<HTMLDivElement>(null);
  const [flat, setFlat] = useState(false);
  const whole = state.whole.value!;
  const parts = partsOf(whole);
  useEffect(() => {
    const view = globalThis.linkwrightSpace?.open(box.current!, whole, {
      hover: (pick) => (state.hovered.value = pick),
      pick: (pick) => (state.picked.value = state.picked.value === pick ? "" : pick),
      hold: (joint) => state.hand.now?.hold(state.scene.value!, state.scene.value!.joints[joint].point) ?? false,
      drag: (to, alone) => state.hand.now?.move(to, alone),
      drop: () => state.hand.now?.up(),
    }) ?? null;
    setFlat(view === null);
    space.value = view;
    if (!view) return;
    view.parallel(state.parallel.value);
    view.look(viewName.value);
    const stops = [
      effect(() => {
        const [scene, at] = [state.scene.value!, state.position.value];
        if (state.whole.value && partsOf(state.whole.value) === parts) view.pose(scene, at);
      }),
      effect(() => {
        const arrows = (q: "force" | "velocity" | "acceleration") => (state.showArrows[q].value ? state.magnify[q].value : 0);
        view.show({
          labels: state.showLabels.value, traces: state.showTrace.value, road: state.showRoad.value, picked: state.picked.value,
          arrows: { force: arrows("force"), velocity: arrows("velocity"), acceleration: arrows("acceleration") },
        });
      }),
      effect(() => {
        state.theme.value;
        view.recolour();
      }),
    ];
    return () => {
      for (const stop of stops) stop();
      if (space.value === view) space.value = null;
      view.close();
    };
  }, [parts]);
  return (
    <>
      <div class={`stage space${flat ? " flat" : ""}`}>
        <div id="space" ref={box} role="img" tabIndex={0} onKeyDown={onKey}
          aria-label={`Mechanism in space: ${whole.title}. Arrow keys turn the view, with shift they move it, plus and minus zoom, 1 to 5 are fixed views`} />
        {!flat && <SpaceKey scene={whole} />}
        <Card />
        <WheelHint />
      </div>
      <Still />
    </>
  );
}

/** Buttons of the fixed views. */
export function ViewBar() {
  return (
    <div class="views" role="group" aria-label="View">
      {viewpoints.map((v) => (
        <button type="button" class="switch" data-view={v.name} aria-pressed={viewName.value === v.name} title={`${v.title} (${v.key})`} onClick={() => look(v.name)}>{v.text}</button>
      ))}
    </div>
  );
}

/** A table of all positions at this instant: the same for keyboards and screen readers, and to copy. */
export function Positions() {
  const [open, setOpen] = useState(false);
  const scene = state.scene.value;
  if (!scene || !state.spatial.value || !scene.joints.length) return null;
  const unit = lengthUnit(extent.value);
  const rows = () => scene.joints.map((joint, i) => ({ joint, pick: `joint ${i}`, p: placeNear(scene, joint.point, state.position.value) }));
  const each = (v: number | undefined) => format(v === undefined ? null : v * unit.factor, 6);
  const text = () => [`at ${instant(scene, state.position.value)}`, `joint\tx (${unit.symbol})\ty (${unit.symbol})\tz (${unit.symbol})`,
    ...rows().map(({ joint, p }) => [joint.name, each(p?.x), each(p?.y), each(p ? (p.z ?? 0) : undefined)].join("\t"))].join("\n");
  return (
    <details class="values positions" onToggle={(e) => setOpen(e.currentTarget.open)}>
      <summary>Positions of the joints at this instant</summary>
      {(open || state.printing.value) && <>
        <div class="scroll"><table>
          <thead><tr><th scope="col">joint</th>{["x", "y", "z"].map((axis) => <th scope="col" class="num">{`${axis} (${unit.symbol})`}</th>)}</tr></thead>
          <tbody>
            {rows().map(({ joint, pick, p }) => (
              <tr class={state.picked.value === pick ? "current" : ""}>
                <th scope="row"><button type="button" class="link" aria-pressed={state.picked.value === pick} title={coordinates(p)} onClick={() => (state.picked.value = state.picked.value === pick ? "" : pick)}>{joint.name}</button></th>
                <td class="num">{each(p?.x)}</td><td class="num">{each(p?.y)}</td><td class="num">{each(p ? (p.z ?? 0) : undefined)}</td>
              </tr>
            ))}
          </tbody>
        </table></div>
        <Copy text={text} />
      </>}
    </details>
  );
}
