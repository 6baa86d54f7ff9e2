// SPDX-License-Identifier: BSD-3-Clause

// Scenes with a second input: their samples are a grid, of which one row is shown at a time.
import type { Num, Scene } from "./data";

export const isSpatial = (scene: Scene) => scene.points.some((p) => (p.z?.length ?? 0) > 0);

/** Number of rows: values of the second input. */
export const rowsOf = (scene: Scene) => Math.max(1, scene.second?.length ?? 0);

export const samplesOf = (scene: Scene) => scene.input.length * rowsOf(scene);

/** The row with which to begin: the one whose second input is nearest to zero. */
export const middleRow = (scene: Scene) => {
  const values = scene.second ?? [];
  return values.reduce((best, v, i) => (Math.abs(v) < Math.abs(values[best]) ? i : best), 0);
};

/** The scene at one value of its second input, as a scene of the first input alone. */
export function rowOf(scene: Scene, row: number): Scene {
  if (rowsOf(scene) < 2) return scene;
  const n = scene.input.length;
  const from = Math.min(rowsOf(scene) - 1, Math.max(0, row)) * n;
  // A single value holds at all samples.
  const cut = <T>(values: T[]) => (values.length > 1 || n * rowsOf(scene) === 1 ? values.slice(from, from + n) : values);
  const part = <P extends { x: Num[]; y: Num[]; z?: Num[] }>(p: P): P => ({ ...p, x: cut(p.x), y: cut(p.y), ...(p.z ? { z: cut(p.z) } : {}) });
  return {
    ...scene,
    status: scene.status.slice(from, from + n),
    points: scene.points.map(part),
    vectors: scene.vectors.map(part),
    moments: scene.moments.map((m) => ({ ...m, value: cut(m.value) })),
  };
}
