// SPDX-License-Identifier: BSD-3-Clause

// Points of the curves of DXF: arcs, ellipses, and splines of control points with knots.
import type { Place } from "../motion";

const stepsOf = (span: number, perTurn: number) => Math.max(1, Math.ceil((Math.abs(span) / (2 * Math.PI)) * perTurn - 1e-9));

/** An ellipse by its centre, its half axes as vectors, and the range of its parameter; both ends are among the points. */
export function ellipsePoints(centre: Place, major: Place, minor: Place, from: number, span: number, perTurn: number): Place[] {
  const steps = stepsOf(span, perTurn);
  return Array.from({ length: steps + 1 }, (_, k) => {
    const [cos, sin] = [Math.cos(from + (span * k) / steps), Math.sin(from + (span * k) / steps)];
    return { x: centre.x + cos * major.x + sin * minor.x, y: centre.y + cos * major.y + sin * minor.y };
  });
}

export const arcPoints = (centre: Place, radius: number, from: number, span: number, perTurn: number): Place[] =>
  ellipsePoints(centre, { x: radius, y: 0 }, { x: 0, y: radius }, from, span, perTurn);

/** The arc from a to b whose bulge is the tangent of a quarter of its angle, positive counterclockwise; without b. */
export function bulgePoints(a: Place, b: Place, bulge: number, perTurn: number): Place[] {
  if (Math.abs(bulge) < 1e-9 || (a.x === b.x && a.y === b.y)) return [{ x: a.x, y: a.y }];
  const away = (1 / bulge - bulge) / 4; // distance of the centre from the chord, in chords
  const centre = { x: (a.x + b.x) / 2 - away * (b.y - a.y), y: (a.y + b.y) / 2 + away * (b.x - a.x) };
  const [dx, dy] = [a.x - centre.x, a.y - centre.y];
  return ellipsePoints(centre, { x: dx, y: dy }, { x: -dy, y: dx }, 0, 4 * Math.atan(bulge), perTurn).slice(0, -1);
}

/** A B-spline; a weight for each control point, 1 where it is not rational. */
export interface Spline {
  degree: number;
  knots: number[];
  control: Place[];
  weights: number[];
}

/** The reason why these numbers are not a spline; "" if they are one. */
export function splineFault({ degree, knots, control, weights }: Spline): string {
  if (!Number.isInteger(degree) || degree < 1 || degree > 25) return `the degree ${degree} instead of one from 1 to 25`;
  if (control.length <= degree) return `${control.length} control points, which are too few for the degree ${degree}`;
  if (knots.length !== control.length + degree + 1) return `${knots.length} knots instead of ${control.length + degree + 1}`;
  if (knots.some((t, i) => i > 0 && t < knots[i - 1])) return "knots that do not increase";
  if (!(knots[control.length] > knots[degree])) return "knots that are all equal";
  if (weights.length !== control.length) return `${weights.length} weights for ${control.length} control points`;
  return weights.some((w) => !(w > 0)) ? "a weight that is not positive" : "";
}

/** The point at the parameter t between the knots `span` and `span + 1` (algorithm of de Boor, with weights as a third coordinate). */
function splinePoint({ degree, knots, control, weights }: Spline, span: number, t: number): Place {
  const first = span - degree;
  const w = weights.slice(first, span + 1);
  const x = w.map((weight, j) => weight * control[first + j].x);
  const y = w.map((weight, j) => weight * control[first + j].y);
  for (let r = 1; r <= degree; ++r)
    for (let j = degree; j >= r; --j) {
      const share = (t - knots[first + j]) / (knots[first + j + degree - r + 1] - knots[first + j]);
      for (const row of [x, y, w]) row[j] = (1 - share) * row[j - 1] + share * row[j];
    }
  return { x: x[degree] / w[degree], y: y[degree] / w[degree] };
}

/** A spline with `steps` points between two knots; both ends are among the points. */
export function splinePoints(spline: Spline, steps: number): Place[] {
  const { degree, knots, control } = spline;
  const points: Place[] = [];
  let last = degree;
  for (let span = degree; span < control.length; ++span) {
    if (!(knots[span + 1] > knots[span])) continue;
    for (let k = 0; k < steps; ++k) points.push(splinePoint(spline, span, knots[span] + ((knots[span + 1] - knots[span]) * k) / steps));
    last = span;
  }
  return [...points, splinePoint(spline, last, knots[last + 1])];
}
