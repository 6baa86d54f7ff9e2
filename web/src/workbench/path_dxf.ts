// SPDX-License-Identifier: BSD-3-Clause

// The lines and curves of an ASCII DXF drawing as one path in mm.
import type { Place } from "../motion";
import { PathError, type Path } from "./path";
import { arcPoints, bulgePoints, ellipsePoints, splineFault, splinePoints } from "./path_dxf_curves";
import { onePath, stepsFor, type Part } from "./path_join";

/** A group code with its value, and the line of the value in the file. */
interface Group {
  code: number;
  value: string;
  line: number;
}
interface Entity {
  type: string;
  line: number;
  groups: Group[];
  vertices: Entity[]; // of a POLYLINE
}

/** mm for a unit of the drawing, by $INSUNITS; 0 is a drawing without a unit, which is in mm. */
const units = new Map([[0, 1], [1, 25.4], [2, 304.8], [3, 1609344], [4, 1], [5, 10], [6, 1000], [7, 1e6], [8, 25.4e-6], [9, 0.0254], [10, 914.4], [11, 1e-7], [12, 1e-6], [13, 1e-3], [14, 100], [15, 1e4], [16, 1e5], [21, 1200000 / 3937]]);

const damaged = "Save the drawing again as an ASCII DXF: the file is damaged or cut off.";
const flatten = "Draw the curve in the xy plane, or flatten the drawing in the CAD program, and save it again.";

/** Group codes and values, two lines each, up to the end of the drawing. */
function groupsOf(text: string): Group[] {
  if (text.startsWith("AutoCAD Binary DXF")) throw new PathError("This is a binary DXF file.", "Save the drawing as an ASCII DXF; any version from R12 on is read.");
  const lines = text.split(/\r\n|\n|\r/);
  const groups: Group[] = [];
  for (let k = Math.max(0, lines.findIndex((line) => line.trim() !== "")); k + 1 < lines.length; k += 2) {
    const code = Number(lines[k]);
    if (lines[k].trim() === "" || !Number.isInteger(code)) throw new PathError(`Line ${k + 1} of the DXF file has “${lines[k].trim().slice(0, 20)}” where a group code belongs.`, damaged);
    const value = lines[k + 1].trim();
    if (code === 0 && value === "EOF") break;
    groups.push({ code, value, line: k + 2 });
  }
  return groups;
}

/** The entities of the section of that name, vertices with their polyline; a file of entities alone has no sections. */
function entitiesOf(groups: Group[]): Entity[] {
  const start = groups.findIndex(({ code, value }, i) => code === 2 && value === "ENTITIES" && groups[i - 1]?.value === "SECTION");
  const entities: Entity[] = [];
  let entity: Entity | null = null;
  for (let i = start + 1; i < groups.length; ++i) {
    const { code, value, line } = groups[i];
    if (code === 0 && value === "ENDSEC") return entities;
    if (code !== 0) {
      entity?.groups.push(groups[i]);
      continue;
    }
    entity = { type: value, line, groups: [], vertices: [] };
    const owner = entities[entities.length - 1];
    if (value === "VERTEX" && owner?.type === "POLYLINE") owner.vertices.push(entity);
    else if (value !== "SEQEND" && value !== "SECTION") entities.push(entity);
  }
  if (start >= 0) throw new PathError(`The DXF file ends in line ${groups[groups.length - 1].line}, within its section ENTITIES.`, damaged);
  return entities;
}

const nameOf = ({ type, line }: Entity) => `${type} in line ${line}`;

function valueOf({ value, line }: Group): number {
  const number = value === "" ? NaN : Number(value);
  if (!Number.isFinite(number)) throw new PathError(`Line ${line} of the DXF file has “${value.slice(0, 20)}”, which is not a number.`, damaged);
  return number;
}
const numbersOf = ({ groups }: Entity, code: number): number[] => groups.filter((g) => g.code === code).map(valueOf);

/** The number of a group; one that has no fallback must be given. */
function numberOf(entity: Entity, code: number, fallback?: number): number {
  const group = entity.groups.find((g) => g.code === code);
  if (!group && fallback === undefined) throw new PathError(`${nameOf(entity)} has no group ${code}.`, damaged);
  return group ? valueOf(group) : fallback!;
}
const placeOf = (entity: Entity, code: number): Place => ({ x: numberOf(entity, code), y: numberOf(entity, code + 10) });

/** 1 for an entity whose plane is seen from above, -1 from below. */
function sideOf(entity: Entity): number {
  const normal = [210, 220, 230].map((code) => numberOf(entity, code, code === 230 ? 1 : 0));
  if (Math.hypot(normal[0], normal[1]) > 1e-6 * Math.abs(normal[2])) throw new PathError(`${nameOf(entity)} lies in an inclined plane, whose normal is ${normal.join(", ")}.`, flatten);
  return normal[2] < 0 ? -1 : 1;
}

/** Refuses an entity whose points have different heights. */
function requireFlat(entity: Entity, heights: number[], points: Place[]): void {
  let [low, high, size] = [Infinity, -Infinity, 0];
  for (const z of heights) [low, high] = [Math.min(low, z), Math.max(high, z)];
  for (const p of points) size = Math.max(size, Math.abs(p.x - points[0].x), Math.abs(p.y - points[0].y));
  if (high - low > 1e-6 * size) throw new PathError(`${nameOf(entity)} is in space: its z goes from ${low} to ${high}.`, flatten);
}

interface Vertex extends Place {
  bulge: number;
}

/** Vertices with the arcs between them. */
function pathThrough(vertices: Vertex[], closed: boolean, perTurn: number): Path {
  const points = vertices.flatMap((a, i) => (closed || i + 1 < vertices.length ? bulgePoints(a, vertices[(i + 1) % vertices.length], a.bulge, perTurn) : [{ x: a.x, y: a.y }]));
  return { points, closed };
}

function lightPolyline(entity: Entity, perTurn: number): Path {
  const vertices: Vertex[] = [];
  for (const group of entity.groups) {
    const last = vertices[vertices.length - 1];
    if (group.code === 10) vertices.push({ x: valueOf(group), y: 0, bulge: 0 });
    else if (group.code === 20 && last) last.y = valueOf(group);
    else if (group.code === 42 && last) last.bulge = valueOf(group);
  }
  return pathThrough(vertices, (numberOf(entity, 70, 0) & 1) === 1, perTurn);
}

function oldPolyline(entity: Entity, perTurn: number): Path {
  const flags = numberOf(entity, 70, 0);
  if (flags & (16 | 64)) throw new PathError(`${nameOf(entity)} is a mesh, which is not a line.`, flatten);
  // Points of the frame of a fitted spline are not on the curve.
  const vertices = entity.vertices.filter((v) => !(numberOf(v, 70, 0) & 16)).map((v) => ({ ...placeOf(v, 10), z: numberOf(v, 30, 0), bulge: numberOf(v, 42, 0) }));
  requireFlat(entity, vertices.map((v) => v.z), vertices);
  return pathThrough(vertices, (flags & 1) === 1, perTurn);
}

const full = 2 * Math.PI;
/** The angle from one direction to another, counterclockwise, more than 0 and at most a turn. */
const spanOf = (from: number, to: number): number => {
  if (Math.abs(Math.abs(to - from) - full) < 1e-4) return full; // 2 pi, written with a few digits
  const span = (to - from) % full;
  return span > 1e-9 ? span : span + full;
};

function circularArc(entity: Entity, perTurn: number): Path {
  const [from, to] = [numberOf(entity, 50), numberOf(entity, 51)].map((degrees) => (degrees * Math.PI) / 180);
  return { points: arcPoints(placeOf(entity, 10), radiusOf(entity), from, spanOf(from, to), perTurn), closed: false };
}

function radiusOf(entity: Entity): number {
  const radius = numberOf(entity, 40);
  if (!(radius > 0)) throw new PathError(`${nameOf(entity)} has the radius ${radius}.`, "Delete it, or give it a positive radius.");
  return radius;
}

/** An ellipse, whose axes are given in the plane of the drawing; seen from below it runs the other way. */
function ellipse(entity: Entity, perTurn: number): Path {
  const side = sideOf(entity);
  const major = placeOf(entity, 11);
  requireFlat(entity, [0, numberOf(entity, 31, 0)], [{ x: 0, y: 0 }, major]);
  const ratio = side * numberOf(entity, 40);
  const [from, to] = [numberOf(entity, 41, 0), numberOf(entity, 42, full)];
  const span = spanOf(from, to);
  const points = ellipsePoints(placeOf(entity, 10), major, { x: -ratio * major.y, y: ratio * major.x }, from, span, perTurn);
  return span === full ? { points: points.slice(0, -1), closed: true } : { points, closed: false };
}

function spline(entity: Entity, steps: number): Path {
  const [xs, ys, weights] = [numbersOf(entity, 10), numbersOf(entity, 20), numbersOf(entity, 41)];
  if (!xs.length) throw new PathError(`${nameOf(entity)} has no control points${numbersOf(entity, 11).length ? ", only fit points" : ""}.`, "Convert the spline to a polyline in the CAD program, and save it again.");
  const control = xs.map((x, i) => ({ x, y: ys[i] ?? NaN }));
  const read = { degree: numberOf(entity, 71), knots: numbersOf(entity, 40), control, weights: weights.length ? weights : control.map(() => 1) };
  const fault = splineFault(read);
  if (fault) throw new PathError(`${nameOf(entity)} has ${fault}.`, "Convert the spline to a polyline in the CAD program, and save it again.");
  requireFlat(entity, numbersOf(entity, 30), control);
  return { points: splinePoints(read, steps), closed: false };
}

function line(entity: Entity): Path {
  const points = [placeOf(entity, 10), placeOf(entity, 11)];
  requireFlat(entity, [numberOf(entity, 30, 0), numberOf(entity, 31, 0)], points);
  return { points, closed: false };
}

/** The line of an entity; null for one that draws none. */
function pathOf(entity: Entity, perTurn: number): Path | null {
  const seen = (path: Path): Path => (sideOf(entity) < 0 ? { ...path, points: path.points.map(({ x, y }) => ({ x: -x, y })) } : path);
  switch (entity.type) {
    case "LINE": return line(entity);
    case "LWPOLYLINE": return seen(lightPolyline(entity, perTurn));
    case "POLYLINE": return seen(oldPolyline(entity, perTurn));
    case "ARC": return seen(circularArc(entity, perTurn));
    case "CIRCLE": return seen({ points: arcPoints(placeOf(entity, 10), radiusOf(entity), 0, full, perTurn).slice(0, -1), closed: true });
    case "ELLIPSE": return ellipse(entity, perTurn);
    case "SPLINE": return spline(entity, Math.max(1, perTurn >> 2));
    default: return null;
  }
}

/** mm of the drawing's unit. */
function unitOf(groups: Group[]): number {
  const at = groups.findIndex(({ code, value }) => code === 9 && value === "$INSUNITS");
  const group = at < 0 ? undefined : groups[at + 1];
  const unit = group ? units.get(Number(group.value)) : 1;
  if (unit === undefined) throw new PathError(`Line ${group!.line} of the DXF file has the unit $INSUNITS “${group!.value.slice(0, 20)}”, which is not known here.`, "Save the drawing in millimetres, which are $INSUNITS 4.");
  return unit;
}

export function dxfPath(text: string): Path {
  const groups = groupsOf(text);
  const unit = unitOf(groups);
  // Group 67 marks the sheets that are printed, group 60 what is hidden.
  const entities = entitiesOf(groups).filter((e) => numberOf(e, 67, 0) !== 1 && numberOf(e, 60, 0) !== 1);
  const perTurn = stepsFor(entities.reduce((sum, e) => sum + 1 + e.groups.length / 4 + e.vertices.length, 0), 96);
  const parts: Part[] = [];
  const others = new Map<string, number>(); // the first line of each
  for (const entity of entities) {
    const path = pathOf(entity, perTurn);
    if (path) parts.push({ points: path.points.map(({ x, y }) => ({ x: unit * x, y: unit * y })), closed: path.closed, name: nameOf(entity) });
    else if (!others.has(entity.type)) others.set(entity.type, entity.line);
  }
  if (!parts.length) {
    const listed = [...others].slice(0, 4).map(([type, first]) => `${type.slice(0, 20)} in line ${first}`).join(", ");
    const hint = others.has("INSERT") ? "Explode the blocks in the CAD program (INSERT is a block), and save the drawing again." : "Convert the curve to a polyline in the CAD program, and save it again.";
    throw new PathError(`The DXF drawing has no polyline, line, arc, circle, ellipse or spline${listed ? `, only ${listed}` : ": it has no entities at all"}.`, hint);
  }
  return onePath(parts, "The DXF drawing", "Delete the others, or join the ends of the lines in the CAD program.");
}
