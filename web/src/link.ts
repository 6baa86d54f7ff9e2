// SPDX-License-Identifier: BSD-3-Clause

// A place of the report as the fragment of its address: "#scene=solution-2&input=1.5708&second=0.02", in SI units.
import { inputAt, positionOf } from "./motion";
import * as state from "./state";

const written = (value: number) => String(Number(value.toPrecision(9)));

/** The scene and the inputs that are shown. */
export function fragment(): string {
  const scene = state.whole.value;
  if (!scene) return "";
  const parts = new URLSearchParams({ scene: scene.name, input: written(inputAt(state.motion.value, state.position.value)) });
  const second = scene.second?.[state.row.value];
  if (second !== undefined) parts.set("second", written(second));
  return `#${parts}`;
}

/** Goes to the place that the address names, if it names one of this report. */
export function follow(): void {
  const asked = new URLSearchParams(location.hash.slice(1));
  const index = state.view.scenes.findIndex((s) => s.name === asked.get("scene"));
  if (index < 0) return;
  state.showScene(index);
  const [input, second] = ["input", "second"].map((key) => Number.parseFloat(asked.get(key) ?? ""));
  const rows = state.whole.value?.second ?? [];
  if (Number.isFinite(second)) state.showRow(rows.reduce((best, v, i) => (Math.abs(v - second) < Math.abs(rows[best] - second) ? i : best), 0));
  if (!Number.isFinite(input)) return;
  const at = positionOf(state.motion.value, input);
  // The digits of the address do not tell a sample from its neighbourhood.
  state.scrub(Math.abs(at - Math.round(at)) < 1e-4 ? Math.round(at) : at);
}
