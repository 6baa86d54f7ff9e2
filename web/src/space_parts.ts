// SPDX-License-Identifier: BSD-3-Clause

// Bodies, wheels, joints, arrows and traces of a spatial scene as meshes that follow its points.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, CircleGeometry, Color, ConeGeometry, Curve, CylinderGeometry, DoubleSide, DynamicDrawUsage, Group, LatheGeometry,
  Mesh, MeshBasicMaterial, MeshLambertMaterial, Quaternion, SphereGeometry, TubeGeometry, Vector2, Vector3, type Material, type Object3D,
} from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { Disc, Quantity, Scene } from "./data";
import { lookOf } from "./look";
import { dashDots } from "./space_view";

export type Places = (point: number) => Vector3 | null;

/** Something that is drawn; `pose` puts it where its points are. */
export interface Part {
  object: Object3D;
  pose: (at: Places) => void;
}

const up = new Vector3(0, 1, 0);
const segments = 24;

/** Materials by use; their colours are those of the page. */
export class Palette {
  private solids = new Map<string, MeshLambertMaterial>();
  private sheets = new Map<string, MeshBasicMaterial>();
  private strokes = new Map<string, LineMaterial>();
  private css = (name: string) => new Color(getComputedStyle(document.documentElement).getPropertyValue(name).trim() || "#808080");

  solid(name: string): MeshLambertMaterial {
    return this.make(this.solids, name, name, () => new MeshLambertMaterial());
  }
  /** A see-through surface. */
  sheet(name: string, opacity: number): MeshBasicMaterial {
    return this.make(this.sheets, `${name} ${opacity}`, name, () => new MeshBasicMaterial({ transparent: true, opacity, side: DoubleSide, depthWrite: false }));
  }
  /** A line of constant width on the screen (px). */
  stroke(name: string, linewidth: number, opacity = 1): LineMaterial {
    return this.make(this.strokes, `${name} ${linewidth} ${opacity}`, name, () => new LineMaterial({ linewidth, transparent: opacity < 1, opacity, depthWrite: opacity === 1 }));
  }
  private make<M extends Material & { color: Color }>(map: Map<string, M>, key: string, name: string, create: () => M): M {
    let made = map.get(key);
    if (!made) {
      made = create();
      made.color.copy(this.css(name));
      map.set(key, made);
    }
    return made;
  }
  background = () => this.css("--sheet");
  recolour(): void {
    for (const map of [this.solids, this.sheets, this.strokes] as Map<string, Material & { color: Color }>[])
      for (const [key, material] of map) material.color.copy(this.css(key.split(" ")[0]));
  }
  dispose(): void {
    for (const map of [this.solids, this.sheets, this.strokes] as Map<string, Material>[]) for (const material of map.values()) material.dispose();
  }
}

/** Line segments whose ends can be moved. */
export function lines(material: LineMaterial): { object: LineSegments2; set: (ends: number[]) => void } {
  const object = new LineSegments2(new LineSegmentsGeometry(), material);
  object.frustumCulled = false;
  object.visible = false;
  let held = 0;
  return {
    object,
    set: (ends) => {
      object.visible = ends.length > 0;
      if (!ends.length) return;
      if (ends.length !== held) {
        object.geometry.dispose();
        object.geometry = new LineSegmentsGeometry();
        object.geometry.setPositions(ends);
        held = ends.length;
        return;
      }
      const { data } = object.geometry.attributes.instanceStart as unknown as { data: { array: Float32Array; needsUpdate: boolean } };
      data.array.set(ends);
      data.needsUpdate = true;
    },
  };
}

const unitCylinder = (ends = segments) => new CylinderGeometry(1, 1, 1, ends).translate(0, 0.5, 0);

/** Puts an object that runs along y from 0 to 1 between two places. */
function span(object: Object3D, from: Vector3, to: Vector3, radius: number): void {
  const way = to.clone().sub(from);
  const length = way.length();
  object.visible = length > 0;
  if (!object.visible) return;
  object.position.copy(from);
  object.quaternion.setFromUnitVectors(up, way.divideScalar(length));
  object.scale.set(radius, length, radius);
}

const turns = 7;

class Helix extends Curve<Vector3> {
  constructor(private radius: number, private length: number) {
    super();
  }
  getPoint(t: number, out = new Vector3()): Vector3 {
    const angle = 2 * Math.PI * turns * t;
    return out.set(this.radius * Math.cos(angle), this.length * (0.05 + 0.9 * t), this.radius * Math.sin(angle));
  }
}

type Body = Scene["bodies"][number];

/** Lines of dashes and dots from place to place, `beyond` of their length longer at both ends. */
function dashed(palette: Palette, colour: string, width: number, body: Body, pitch: number, beyond: number): Part {
  const line = lines(palette.stroke(colour, width));
  const counts = new Map<number, [number, number][]>();
  return {
    object: line.object,
    pose: (at) => {
      const ends: number[] = [];
      for (let i = 1; i < body.points.length; ++i) {
        const [a, b] = [at(body.points[i - 1]), at(body.points[i])];
        if (!a || !b) continue;
        const from = a.clone().lerp(b, -beyond);
        const to = b.clone().lerp(a, -beyond);
        // The number of pieces is the same at every instant, so that they do not flicker.
        if (!counts.has(i)) counts.set(i, dashDots(from.distanceTo(to), pitch));
        for (const [s, e] of counts.get(i)!) ends.push(...from.clone().lerp(to, s).toArray(), ...from.clone().lerp(to, e).toArray());
      }
      line.set(ends);
    },
  };
}

function bar(palette: Palette, colour: string, body: Body, radius: number, closed = false): Part {
  const object = new Group();
  const shape = unitCylinder();
  const pairs = body.points.slice(1).map((p, i) => [body.points[i], p]);
  if (closed) pairs.push([body.points[body.points.length - 1], body.points[0]]);
  const rods = pairs.map(() => new Mesh(shape, palette.solid(colour)));
  // Balls close the corners of a bent bar.
  const balls = body.points.map(() => new Mesh(new SphereGeometry(1, 16, 12), palette.solid(colour)));
  object.add(...rods, ...balls);
  return {
    object,
    pose: (at) => {
      pairs.forEach(([p, q], i) => {
        const [a, b] = [at(p), at(q)];
        rods[i].visible = a !== null && b !== null;
        if (a && b) span(rods[i], a, b, radius);
      });
      body.points.forEach((p, i) => {
        const a = at(p);
        balls[i].visible = a !== null;
        if (a) balls[i].position.copy(a);
        balls[i].scale.setScalar(radius);
      });
    },
  };
}

function plate(palette: Palette, colour: string, body: Body, radius: number): Part {
  const rim = bar(palette, colour, body, radius * 0.6, true);
  const n = body.points.length;
  const shape = new BufferGeometry();
  const corners = new BufferAttribute(new Float32Array(9 * n), 3).setUsage(DynamicDrawUsage);
  shape.setAttribute("position", corners);
  const face = new Mesh(shape, palette.sheet(colour, 0.26));
  face.frustumCulled = false;
  const object = new Group().add(face, rim.object);
  return {
    object,
    pose: (at) => {
      rim.pose(at);
      const places = body.points.map(at);
      face.visible = places.every((p) => p !== null);
      if (!face.visible) return;
      // A fan about the middle: the corners need not lie in one plane.
      const middle = places.reduce<Vector3>((sum, p) => sum.add(p!), new Vector3()).divideScalar(n);
      places.forEach((p, i) => {
        const q = places[(i + 1) % n]!;
        [p!, q, middle].forEach((v, k) => corners.setXYZ(3 * i + k, v.x, v.y, v.z));
      });
      corners.needsUpdate = true;
      shape.computeBoundingSphere();
    },
  };
}

function spring(palette: Palette, body: Body, radius: number): Part {
  const object = new Group();
  const coils = body.points.slice(1).map(() => new Mesh(new BufferGeometry(), palette.solid("--soft")));
  object.add(...coils);
  const wound = new Set<number>();
  return {
    object,
    pose: (at) =>
      coils.forEach((coil, i) => {
        const [a, b] = [at(body.points[i]), at(body.points[i + 1])];
        const length = a && b ? a.distanceTo(b) : 0;
        // Wound for the first length that is seen, so that the wire is round; other lengths stretch it a little.
        if (length > 0 && !wound.has(i)) {
          wound.add(i);
          const wire = Math.min(0.2 * radius, (0.3 * length) / turns);
          coil.geometry = new TubeGeometry(new Helix(radius, length), 40 * turns, wire, 8).scale(1 / radius, 1 / length, 1 / radius);
        }
        between(coil, a, b, radius);
      }),
  };
}

function between(object: Object3D, a: Vector3 | null, b: Vector3 | null, radius: number): void {
  object.visible = a !== null && b !== null;
  if (a && b) span(object, a, b, radius);
}

function damper(palette: Palette, body: Body, radius: number): Part {
  const object = new Group();
  const shape = unitCylinder();
  const pieces = body.points.slice(1).map(() => [new Mesh(shape, palette.solid("--ink")), new Mesh(shape, palette.solid("--soft"))]);
  object.add(...pieces.flat());
  const lengths = new Map<number, number>();
  return {
    object,
    pose: (at) =>
      pieces.forEach(([tube, rod], i) => {
        const [a, b] = [at(body.points[i]), at(body.points[i + 1])];
        between(rod, a, b, radius * 0.45);
        tube.visible = a !== null && b !== null;
        if (!a || !b) return;
        // The cylinder keeps its length; the rod moves in it.
        if (!lengths.has(i)) lengths.set(i, 0.52 * a.distanceTo(b));
        span(tube, a, a.clone().lerp(b, Math.min(0.9, lengths.get(i)! / a.distanceTo(b))), radius);
      }),
  };
}

export function bodyPart(palette: Palette, body: Body, colour: string, size: number, thin: number): Part {
  const radius = (thin * size) / 110;
  const part = (() => {
    if (body.run) {
      const closed = body.style === "plate" && body.points.length > 2;
      return dashed(palette, lookOf(body.run).stroke, 1.8, { ...body, points: closed ? [...body.points, body.points[0]] : body.points }, size / 30, 0);
    }
    switch (body.style) {
      case "ground":
        return dashed(palette, "--soft", 1.4, body, size / 22, 0);
      case "axis":
        return dashed(palette, "--error", 1.7, body, size / 18, 0.18);
      case "spring":
        return spring(palette, body, radius * 3.4);
      case "damper":
        return damper(palette, body, radius * 1.7);
      case "guide":
        return bar(palette, "--soft", body, radius * 0.5);
      case "plate":
        return body.points.length > 2 ? plate(palette, colour, body, radius) : bar(palette, colour, body, radius);
      default:
        return bar(palette, colour, body, radius);
    }
  })();
  part.object.name = body.name;
  return part;
}

/** A tyre that can be seen through, with the plane of the wheel: its circle and two diameters. */
export function discPart(palette: Palette, disc: Disc): Part {
  const object = new Group();
  const [r, w] = [disc.radius, disc.width];
  const profile = [[0.62, -0.42], [0.7, -0.49], [0.82, -0.5], [0.93, -0.47], [0.98, -0.4], [1, -0.28], [1, 0.28], [0.98, 0.4], [0.93, 0.47], [0.82, 0.5], [0.7, 0.49], [0.62, 0.42]]
    .map(([a, b]) => new Vector2(a * r, b * w));
  const tyre = new Mesh(new LatheGeometry(profile, 72), palette.sheet("--soft", 0.2));
  const plane = new Mesh(new CircleGeometry(r, 72).rotateX(-Math.PI / 2), palette.sheet("--accent", 0.07));
  const ring = (radius: number, height: number) => {
    const ends: number[] = [];
    const on = (i: number) => [radius * Math.cos((i * Math.PI) / 48), height, radius * Math.sin((i * Math.PI) / 48)];
    for (let i = 0; i < 96; ++i) ends.push(...on(i), ...on(i + 1));
    return ends;
  };
  const middle = lines(palette.stroke("--accent", 1.8));
  middle.set(ring(r, 0));
  const edges = lines(palette.stroke("--soft", 1.1, 0.75));
  edges.set([...ring(0.98 * r, -0.4 * w), ...ring(0.98 * r, 0.4 * w), ...ring(0.62 * r, -0.42 * w), ...ring(0.62 * r, 0.42 * w)]);
  const cross = lines(palette.stroke("--accent", 1, 0.5));
  cross.set([-r, 0, 0, r, 0, 0, 0, 0, -r, 0, 0, r]);
  object.add(tyre, plane, middle.object, edges.object, cross.object);
  object.name = disc.name;
  const turn = new Quaternion();
  const [z, across] = [new Vector3(0, 0, 1), new Vector3()];
  return {
    object,
    pose: (at) => {
      const [centre, end] = [at(disc.centre), at(disc.axis)];
      object.visible = centre !== null && end !== null && centre.distanceTo(end) > 0;
      if (!centre || !end || !object.visible) return;
      object.position.copy(centre);
      const axis = end.clone().sub(centre).normalize();
      object.quaternion.setFromUnitVectors(up, axis);
      // One diameter is level.
      across.crossVectors(z, axis);
      if (across.lengthSq() > 1e-12) {
        const now = new Vector3(1, 0, 0).applyQuaternion(object.quaternion);
        object.quaternion.premultiply(turn.setFromUnitVectors(now, across.normalize()));
      }
    },
  };
}

/** Ground joints are dark blocks, others light balls, the traced point is coloured. */
export function jointPart(palette: Palette, joint: Scene["joints"][number], size: number, thin: number): Part & { pick: (on: boolean) => void } {
  const radius = (thin * size) / 68;
  const ground = joint.style === "ground_pivot";
  const usual = palette.solid(ground ? "--ink" : joint.style === "tracer" ? "--error" : "--joint");
  const object = new Mesh(ground ? new BoxGeometry(1.7, 1.7, 1.7) : new SphereGeometry(1, 24, 16), usual);
  object.scale.setScalar(radius);
  object.renderOrder = joint.style === "tracer" ? 1 : 0; // seen where another joint is at its place
  object.name = joint.name;
  return {
    object,
    pose: (at) => {
      const p = at(joint.point);
      object.visible = p !== null;
      if (p) object.position.copy(p);
    },
    pick: (on) => {
      object.scale.setScalar(on ? 1.35 * radius : radius);
      object.material = on ? palette.solid("--accent") : usual;
    },
  };
}

/** An arrow; forces have a long head, velocities a slender shaft, accelerations two heads. */
export function arrowPart(palette: Palette, quantity: Quantity, size: number): { object: Group; set: (from: Vector3, way: Vector3) => void } {
  const material = palette.solid(`--${quantity}`);
  const shaft = new Mesh(unitCylinder(12), material);
  const cone = () => new Mesh(new ConeGeometry(1, 1, 18).translate(0, -0.5, 0), material);
  const heads = quantity === "acceleration" ? [cone(), cone()] : [cone()];
  const object = new Group().add(shaft, ...heads);
  const thick = (size / 190) * (quantity === "force" ? 1.25 : 0.8);
  return {
    object,
    set: (from, way) => {
      const length = way.length();
      object.visible = length > 1e-4 * size;
      if (!object.visible) return;
      const head = Math.min(thick * 7, 0.6 * length);
      const along = way.clone().divideScalar(length);
      span(shaft, from, from.clone().addScaledVector(along, length - 0.9 * head), thick);
      heads.forEach((cone, i) => {
        cone.position.copy(from).addScaledVector(along, length - 0.7 * i * head);
        cone.quaternion.setFromUnitVectors(up, along);
        cone.scale.set(head / 3, head, head / 3);
      });
    },
  };
}
