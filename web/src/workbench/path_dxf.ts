// SPDX-License-Identifier: BSD-3-Clause

// Polylines and chains of lines of a DXF drawing as points in mm.
import type { Place } from "../motion";
import { PathError, type Path } from "./path";

interface Entity {
  type: string;
  groups: [number, string][];
}

const arcSteps = 16; // points of a polyline's arc
/** mm for a unit of the drawing, by $INSUNITS; drawings without a unit are in mm. */
const units: Record<string, number> = { 1: 25.4, 2: 304.8, 4: 1, 5: 10, 6: 1000 };

/** Group codes and values, two lines each. */
function groupsOf(text: string): [number, string][] {
  if (text.startsWith("AutoCAD Binary DXF")) throw new PathError("This is a binary DXF file.", "Save the drawing as an ASCII DXF; any version from R12 on is read.");
  const lines = text.split(/\r\n|\n|\r/);
  return Array.from({ length: lines.length >> 1 }, (_, k) => {
    const code = Number(lines[2 * k]);
    if (lines[2 * k].trim() === "" || !Number.isInteger(code)) throw new PathError(`Line ${2 * k + 1} of the DXF file has “${lines[2 * k].trim().slice(0, 20)}” where a group code belongs.`, "Save the drawing again: the file is damaged or cut off.");
    return [code, lines[2 * k + 1].trim()];
  });
}

/** The entities of the section of that name; a file of entities alone has no sections. */
function entitiesOf(groups: [number, string][]): Entity[] {
  const start = groups.findIndex(([code, value], i) => code === 2 && value === "ENTITIES" && groups[i - 1]?.[1] === "SECTION");
  const inside = start < 0 ? groups : groups.slice(start + 1);
  const entities: Entity[] = [];
  for (const [code, value] of inside) {
    if (code === 0 && value === "ENDSEC") break;
    if (code === 0) entities.push({ type: value, groups: [] });
    else entities[entities.length - 1]?.groups.push([code, value]);
  }
  return entities;
}

const numberOf = ({ groups }: Entity, code: number) => Number(groups.find(([c]) => c === code)?.[1] ?? 0);

interface Vertex extends Place {
  bulge: number; // tangent of a quarter of the angle of the arc to the next one
}

/** Vertices with the arcs between them. */
function pathThrough(vertices: Vertex[], closed: boolean): Path {
  const points = vertices.flatMap((a, i) => {
    const b = vertices[(i + 1) % vertices.length];
    if (!a.bulge || (!closed && i === vertices.length - 1)) return [{ x: a.x, y: a.y }];
    const angle = 4 * Math.atan(a.bulge);
    const away = (1 / a.bulge - a.bulge) / 4; // distance of the centre from the chord, in chords
    const centre = { x: (a.x + b.x) / 2 - away * (b.y - a.y), y: (a.y + b.y) / 2 + away * (b.x - a.x) };
    return Array.from({ length: arcSteps }, (_, k) => {
      const [cos, sin] = [Math.cos((angle * k) / arcSteps), Math.sin((angle * k) / arcSteps)];
      const [dx, dy] = [a.x - centre.x, a.y - centre.y];
      return { x: centre.x + cos * dx - sin * dy, y: centre.y + sin * dx + cos * dy };
    });
  });
  return { points, closed };
}

function lightPolyline(entity: Entity): Path {
  const vertices: Vertex[] = [];
  for (const [code, value] of entity.groups) {
    const last = vertices[vertices.length - 1];
    if (code === 10) vertices.push({ x: Number(value), y: 0, bulge: 0 });
    else if (code === 20 && last) last.y = Number(value);
    else if (code === 42 && last) last.bulge = Number(value);
  }
  return pathThrough(vertices, (numberOf(entity, 70) & 1) === 1);
}

/** Lines, joined where their ends meet. */
function chainsOf(lines: [Place, Place][]): Path[] {
  const all = lines.flat();
  const size = Math.max(...[all.map((p) => p.x), all.map((p) => p.y)].map((v) => Math.max(...v) - Math.min(...v)));
  const meet = (a: Place, b: Place) => Math.hypot(a.x - b.x, a.y - b.y) <= 1e-4 * size;
  const rest = [...lines];
  const chains: Path[] = [];
  while (rest.length) {
    const points = [...rest.shift()!];
    for (let grown = true; grown; ) {
      grown = false;
      for (const [i, [a, b]] of rest.entries()) {
        const [first, last] = [points[0], points[points.length - 1]];
        if (meet(a, last)) points.push(b);
        else if (meet(b, last)) points.push(a);
        else if (meet(b, first)) points.unshift(a);
        else if (meet(a, first)) points.unshift(b);
        else continue;
        rest.splice(i, 1);
        grown = true;
        break;
      }
    }
    const closed = points.length > 3 && meet(points[0], points[points.length - 1]);
    chains.push({ points: closed ? points.slice(0, -1) : points, closed });
  }
  return chains;
}

function pathsOf(entities: Entity[]): Path[] {
  const paths: Path[] = [];
  const lines: [Place, Place][] = [];
  entities.forEach((entity, i) => {
    if (entity.type === "LWPOLYLINE") paths.push(lightPolyline(entity));
    else if (entity.type === "LINE") lines.push([{ x: numberOf(entity, 10), y: numberOf(entity, 20) }, { x: numberOf(entity, 11), y: numberOf(entity, 21) }]);
    else if (entity.type === "POLYLINE") {
      const end = entities.findIndex((e, k) => k > i && e.type !== "VERTEX");
      const vertices = entities.slice(i + 1, end < 0 ? undefined : end).map((v) => ({ x: numberOf(v, 10), y: numberOf(v, 20), bulge: numberOf(v, 42) }));
      paths.push(pathThrough(vertices, (numberOf(entity, 70) & 1) === 1));
    }
  });
  return [...paths, ...(lines.length ? chainsOf(lines) : [])];
}

export function dxfPath(text: string): Path {
  const groups = groupsOf(text);
  const entities = entitiesOf(groups);
  const paths = pathsOf(entities);
  const others = [...new Set(entities.map((e) => e.type).filter((type) => !["LWPOLYLINE", "POLYLINE", "VERTEX", "SEQEND", "LINE", "EOF"].includes(type)))];
  if (!paths.length) throw new PathError(`The DXF drawing has no polyline and no line${others.length ? `, only ${others.join(", ")}` : ""}.`, "Convert the curve to a polyline in the CAD program, and save it again.");
  if (paths.length > 1) throw new PathError(`The DXF drawing has ${paths.length} separate lines; a traced point can follow only one.`, "Keep one polyline, or join the ends of the lines.");
  if (paths[0].points.some((p) => !Number.isFinite(p.x) || !Number.isFinite(p.y))) throw new PathError("A coordinate of the DXF drawing is not a number.", "Save the drawing again: the file is damaged.");
  const at = groups.findIndex(([code, value]) => code === 9 && value === "$INSUNITS");
  const unit = units[at < 0 ? "" : groups[at + 1]?.[1]] ?? 1;
  return { ...paths[0], points: paths[0].points.map(({ x, y }) => ({ x: unit * x, y: unit * y })) };
}
