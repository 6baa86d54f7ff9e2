// SPDX-License-Identifier: BSD-3-Clause

// Mobility of a sketch: its freedoms by count and by what its joints allow, and what it lacks until its drive moves all
// of it.
import { bodiesAt, driveOf, elementName, jointOf, jointsAt, kinds, least, movingBodies, pinName, sliderName, valueOf, wheelsOf, type Place, type Sketch } from "./sketch";

const gearsOf = (sketch: Sketch) => sketch.elements.flatMap((e) => {
  const wheels = e.kind === "gear" && wheelsOf(sketch, e);
  return wheels ? [{ ...wheels, ratio: valueOf(sketch, e, "ratio") }] : [];
});

/** Degrees of freedom by counting: three for each link and slider, less two for each pin between two bodies and each guide, less one for
 *  each gear. */
export function freedom(sketch: Sketch): number {
  const joints = sketch.pins.reduce((sum, _, i) => sum + jointsAt(sketch, i).length, 0);
  return 3 * movingBodies(sketch).length - 2 * joints - gearsOf(sketch).length;
}

/** The equations of joints, gears and, where it is asked for, the drive: for the speeds of bodies (x, y of the origin, angle) against
 *  each other and against the known ones, which are at rest. */
function equations(sketch: Sketch, bodies: string[], known: Set<string>, driven: boolean, places: Place[] = sketch.pins): number[][] {
  const size = Math.max(1, ...places.map((p) => Math.hypot(p.x, p.y)));
  const column = new Map(bodies.map((body, k) => [body, 3 * k]));
  const has = (body: string) => column.has(body) || known.has(body);
  const out: number[][] = [];
  const say = (...terms: [string, number[]][]) => {
    if (!terms.every(([body]) => has(body))) return;
    const row = new Array<number>(3 * bodies.length).fill(0);
    for (const [body, factors] of terms) factors.forEach((f, k) => column.has(body) && (row[column.get(body)! + k] += f));
    out.push(row);
  };
  const same = (first: string, second: string, factors: number[]) => say([second, factors], [first, factors.map((f) => -f)]);
  const turning = [0, 0, 1];
  /** Speed of the point of a body that is at a place, in a direction. */
  const along = (i: number, angle: number) => [Math.cos(angle), Math.sin(angle), (places[i].x * Math.sin(angle) - places[i].y * Math.cos(angle)) / size];
  const guide = (i: number) => ((sketch.pins[i].guide ?? 0) * Math.PI) / 180;
  sketch.pins.forEach((pin, i) => {
    const [first, ...others] = bodiesAt(sketch, i).filter(has);
    for (const other of others) for (const angle of [0, Math.PI / 2]) same(first, other, along(i, angle));
    if (pin.guide !== null) for (const factors of [turning, along(i, guide(i) + Math.PI / 2)]) same("ground", sliderName(i), factors);
  });
  for (const { first, second, carrier, ratio } of gearsOf(sketch)) say([second, turning], [first, [0, 0, -ratio]], [carrier, [0, 0, ratio - 1]]);
  const drive = driven ? driveOf(sketch) : undefined;
  const joint = drive && jointOf(sketch, drive);
  if (joint) same(joint.first, joint.second, joint.slides ? along(drive.pins[0], guide(drive.pins[0])) : turning);
  return out;
}

/** The motions that equations leave, one a row of as many numbers as there are columns; Gauss and Jordan's elimination. */
function motions(rows: number[][], columns: number): number[][] {
  const left = rows.map((r) => [...r]);
  const pivots: number[] = []; // columns, one a row
  const small = 1e-7;
  for (let c = 0; c < columns; ++c) {
    const at = pivots.length;
    const best = left.slice(at).reduce((b, r, k) => (Math.abs(r[c]) > Math.abs(left[b]?.[c] ?? 0) ? at + k : b), at);
    if (!(Math.abs(left[best]?.[c] ?? 0) > small)) continue;
    [left[at], left[best]] = [left[best], left[at]];
    const pivot = left[at][c];
    left[at] = left[at].map((v) => v / pivot);
    left.forEach((r, k) => k !== at && r[c] !== 0 && (left[k] = r.map((v, i) => v - r[c] * left[at][i])));
    pivots.push(c);
  }
  return Array.from({ length: columns }, (_, c) => c).filter((c) => !pivots.includes(c))
    .map((free) => Array.from({ length: columns }, (_, c) => (c === free ? 1 : pivots.includes(c) ? -left[pivots.indexOf(c)][free] : 0)));
}
function freeMotions(sketch: Sketch, driven: boolean, places?: Place[]): number {
  const bodies = movingBodies(sketch);
  return motions(equations(sketch, bodies, new Set(["ground"]), driven, places), 3 * bodies.length).length;
}

/** The same pins a little elsewhere: what still holds there does not hold for special dimensions only. */
function moved(sketch: Sketch): Place[] {
  const size = Math.max(1, ...sketch.pins.map((p) => Math.hypot(p.x, p.y)));
  return sketch.pins.map((p, i) => ({ x: p.x + 0.05 * size * Math.sin(12.9898 * (i + 1)), y: p.y + 0.05 * size * Math.sin(78.233 * (i + 1)) }));
}

/** True if all gears can be followed from the drive, as the program asks: one wheel and the carrier are turned by drives and gears
 *  alone, and the other wheel has a pin on a body that has its place. */
function gearsFollow(sketch: Sketch): boolean {
  const known = new Set(["ground"]); // have their place
  const turned = new Set(["ground"]); // by drives and gears alone
  const drive = jointOf(sketch, driveOf(sketch)!)!;
  let gears = gearsOf(sketch);
  const pinned = (body: string) => sketch.pins.some((_, i) => bodiesAt(sketch, i).includes(body) && bodiesAt(sketch, i).some((other) => known.has(other)));
  for (;;) {
    const [from, to] = known.has(drive.first) ? [drive.first, drive.second] : [drive.second, drive.first];
    if (known.has(from) && !known.has(to)) {
      known.add(to);
      if (turned.has(from)) turned.add(to);
      continue;
    }
    const gear = gears.find((g) => [[g.first, g.second], [g.second, g.first]].some(([a, b]) => turned.has(g.carrier) && turned.has(a) && !known.has(b) && pinned(b)));
    if (gear) {
      for (const wheel of [gear.first, gear.second]) known.add(wheel) && turned.add(wheel);
      gears = gears.filter((g) => g !== gear);
      continue;
    }
    const free = movingBodies(sketch).filter((body) => !known.has(body) && !gears.some((g) => g.first === body || g.second === body));
    const left = motions(equations(sketch, free, known, true, moved(sketch)), 3 * free.length);
    const placed = free.filter((_, k) => left.every((m) => m.slice(3 * k, 3 * k + 3).every((v) => Math.abs(v) < 1e-6)));
    if (!placed.length) return gears.length === 0;
    for (const body of placed) known.add(body);
  }
}

const capital = (words: string) => words[0].toUpperCase() + words.slice(1);

/** The elements that are still missing before it moves; "" = nothing. */
export function missing(sketch: Sketch): string {
  const { pins, links, elements } = sketch;
  if (!links.length) return "Draw a link: press where its pins are.";
  if (!pins.some((p) => p.ground || p.guide !== null)) return "Fix a pin to the ground, or put it on a guide.";
  const loose = pins.findIndex((_, i) => bodiesAt(sketch, i).length === 0);
  if (loose >= 0) return `Pin ${pinName(loose)} is on no link.`;
  for (const [k, on] of links.entries())
    for (const i of on)
      for (const j of on) if (i < j && Math.hypot(pins[i].x - pins[j].x, pins[i].y - pins[j].y) < least) return `${pinName(i)} and ${pinName(j)} of link ${k + 1} lie in one place: move one of them.`;
  for (const e of elements) {
    const problem = kinds[e.kind].problem(sketch, e);
    if (problem) return `${e.kind === "drive" ? "The drive" : capital(elementName(sketch, e))} ${problem}.`;
  }
  const free = freedom(sketch);
  if (free < 1) return "It cannot move: there are more pins than links leave room for.";
  if (free > 1) return `It moves in ${free} ways: close it with a link, a pin to the ground, a guide or a gear, so that one is left.`;
  if (freeMotions(sketch, false, moved(sketch)) > 1) return "Some links are held twice while others are loose: look for links between pins that cannot move against each other.";
  const drive = driveOf(sketch);
  if (!drive) return "Choose the pin that is driven.";
  if (freeMotions(sketch, true, moved(sketch)) > 0) return `Pin ${pinName(drive.pins[0])} cannot drive it: what it joins does not move against each other.`;
  if (freeMotions(sketch, true) > 0) return "It is drawn at a dead point, where the drive cannot move it: move a pin.";
  if (!gearsFollow(sketch)) return "The gears cannot be followed from the drive: drive one wheel, or what carries the wheels, from the ground.";
  return "";
}
