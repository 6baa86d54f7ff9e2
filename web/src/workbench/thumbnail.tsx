// A small picture of a mechanism: its path and one pose.
import type { Scene } from "../data";
import { isSpatial } from "../grid";
import { analyse, placeAt } from "../motion";
import { bodyColours, bounds, fit, pathOf, toScreen } from "../view";

const size = { width: 200, height: 124 };

export function Thumbnail({ scene }: { scene: Scene }) {
  const flat = isSpatial(scene) ? fromTheSide(scene) : scene;
  const box = bounds(flat);
  if (!box) return <svg viewBox={`0 0 ${size.width} ${size.height}`} />;
  const camera = fit(box, size, 12);
  const { runs } = analyse(flat);
  const at = runs.length ? Math.round(runs[0][0] + 0.15 * (runs[0][1] - runs[0][0])) : 0;
  const place = (point: number, i: number) => {
    const p = placeAt(flat, point, i);
    return p && toScreen(camera, size, p);
  };
  const colours = bodyColours(flat.bodies);
  return (
    <svg viewBox={`0 0 ${size.width} ${size.height}`} aria-hidden="true">
      {flat.traces.map((t) => <path class="path" d={pathOf(flat.input.map((_, i) => place(t.point, i)), t.closed)} />)}
      {flat.bodies.map((b, k) => !b.run && b.style !== "ground" && b.style !== "gap" && (
        <path class={b.style === "plate" && b.points.length > 2 ? "plate" : "stroke"} style={{ "--colour": `var(--c${colours[k]})` }}
          d={pathOf(b.points.map((p) => place(p, at)), b.style === "plate" && b.points.length > 2)} />))}
      {flat.joints.map((j) => {
        const p = place(j.point, at);
        return p && <circle cx={p.x.toFixed(1)} cy={p.y.toFixed(1)} r={j.style === "ground_pivot" ? 3 : 2} class={j.style} />;
      })}
    </svg>
  );
}

// Seen obliquely: x towards the reader's left below, y to the right, z up.
function fromTheSide(scene: Scene): Scene {
  const each = <T,>(list: T[], i: number) => (list.length === 1 ? list[0] : list[i]);
  return {
    ...scene,
    points: scene.points.map((p) => {
      const n = Math.max(p.x.length, p.y.length, p.z?.length ?? 1);
      const seen = Array.from({ length: n }, (_, i) => [each(p.x, i), each(p.y, i), p.z ? each(p.z, i) : 0] as const);
      return {
        name: p.name,
        x: seen.map(([x, y]) => (x == null || y == null ? null : y - 0.35 * x)),
        y: seen.map(([x, , z]) => (x == null || z == null ? null : z - 0.35 * x)),
      };
    }),
  };
}
