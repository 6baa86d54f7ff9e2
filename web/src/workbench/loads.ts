// SPDX-License-Identifier: BSD-3-Clause

// Springs, forces and torques of a linkage, and points that are traced: what they begin with, and what they may be put on.
import type { Json, JsonObject } from "../data";
import type { Edit } from "./engine";
import { nodeAt } from "./schema";

export const loads = ["spring", "torsion_spring", "force", "torque", "trace"] as const;
export type Load = (typeof loads)[number];
const listOf = (load: Load) => (load === "trace" ? "trace" : `mechanism.${load}`);
/** The entry of such a list that a path of the study leads to or into. */
const entry = /^(?:trace|mechanism\.(?:spring|torsion_spring|force|torque))\[\d+\]/;

const bodiesOf = (study: JsonObject) => ((study.mechanism as JsonObject).body ?? []) as JsonObject[];
const pointsOf = (body: JsonObject) => Object.keys((body.points_m ?? {}) as JsonObject).map((point) => `${body.name}.${point}`);

/** The names that a word of a spring, load or trace may have: points, "body.point", or bodies. */
export function places(study: JsonObject, key: string): string[] {
  const [, load, end] = /^(?:mechanism\.)?(\w+)\[\d+\]\.(point|first|second|body|from)$/.exec(entry.test(key) ? key : "") ?? [];
  if (!end) return [];
  return load === "torque" || load === "torsion_spring" ? bodiesOf(study).map((b) => String(b.name)) : bodiesOf(study).flatMap(pointsOf);
}

/** True if a table can be taken out of its list. */
export const isLoad = (path: string) => entry.exec(path)?.[0] === path;

/** The loads that studies of the kind may have. */
export const possible = (study: JsonObject, schema: JsonObject | null): Load[] =>
  bodiesOf(study).length > 1 ? loads.filter((load) => nodeAt(schema, study, `${listOf(load)}[0]`) !== null) : [];

/** One more, on the moving point among the picked keys of the study, else on the last one of the last body; a spring goes to the ground. */
export function withLoad(study: JsonObject, load: Load, picked: ReadonlySet<string>): Edit {
  const bodies = bodiesOf(study);
  const chosen = [...picked].map((key) => /^mechanism\.body\[(\d+)\]\.points_m\.(\w+)/.exec(key)).find((found) => found && Number(found[1]) > 0);
  const body = bodies[chosen ? Number(chosen[1]) : bodies.length - 1];
  const point = chosen ? `${body.name}.${chosen[2]}` : (pointsOf(body).pop() ?? "");
  const key = listOf(load);
  const list = ((load === "trace" ? study.trace : (study.mechanism as JsonObject)[load]) ?? []) as JsonObject[];
  const taken = new Set([...bodies, ...loads.flatMap((l) => ((study.mechanism as JsonObject)[l] ?? []) as JsonObject[])].map((one) => one.name));
  const word = load.replace("_", " ");
  let name = word;
  for (let k = 2; taken.has(name); ++k) name = `${word} ${k}`;
  const ground = bodies[0];
  const value: Record<Load, Json> = {
    force: { name, point, force_N: [0, -10] },
    torque: { name, body: body.name, torque_N_m: 1 },
    spring: { name, first: pointsOf(ground)[0] ?? "", second: point, stiffness_N_per_m: 1000 },
    torsion_spring: { name, first: ground.name, second: body.name, stiffness_N_m_per_rad: 1 },
    trace: { point },
  };
  return { key: `${key}[${list.length}]`, value: value[load] as Edit["value"] };
}
