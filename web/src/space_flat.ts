// SPDX-License-Identifier: BSD-3-Clause

// The spatial view painted on a plane canvas: for machines whose browser computes WebGL, at ten pictures a second, or has none.
// Everything is painted from far to near; bars are painted in pieces, so that what crosses is in front where it is nearer.
import { BufferGeometry, Color, Matrix4, Mesh, TubeGeometry, Vector3, type Camera, type Material, type Object3D, type Scene } from "three";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import type { Spot } from "./gestures";
import { hullOf } from "./hull";

type Coloured = Material & { color: Color; opacity: number; linewidth?: number };
interface Item {
  depth: number; // away from the eye
  over?: number; // the larger one is seen where two parts are at one place
  paint: (to: CanvasRenderingContext2D) => void;
}

/** True if the browser has a graphics card for WebGL: pictures that it computes itself are too slow to move. */
export function hasFastWebgl(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) return false;
  const names = context.getExtension("WEBGL_debug_renderer_info");
  const name = String(context.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

const corners = new WeakMap<BufferGeometry, Vector3[]>();
/** The vertices of a shape, each once. */
function cornersOf(shape: BufferGeometry): Vector3[] {
  let all = corners.get(shape);
  if (!all) {
    const { position } = shape.attributes;
    const found = new Map<string, Vector3>();
    for (let i = 0; i < position.count; ++i) {
      const v = new Vector3().fromBufferAttribute(position, i);
      found.set([v.x, v.y, v.z].map((c) => c.toFixed(5)).join(), v);
    }
    corners.set(shape, (all = [...found.values()]));
  }
  return all;
}

const pieces = 4; // pieces of a bar
const shades = new Map<string, string>();
function shade(colour: Color, by: number): string {
  const key = `${colour.getHex()} ${by}`;
  let text = shades.get(key);
  if (!text) shades.set(key, (text = `#${(by < 0 ? colour.clone().multiplyScalar(1 + by) : colour.clone().lerp(new Color(1, 1, 1), by)).getHexString()}`));
  return text;
}

/** The projection of places by a camera on a canvas of so many pixels. */
class Sight {
  private readonly view: Matrix4;
  private readonly whole: Matrix4;
  private readonly side: Vector3;
  private readonly seen = new Vector3();

  constructor(camera: Camera, private readonly width: number, private readonly height: number) {
    this.view = camera.matrixWorldInverse;
    this.whole = new Matrix4().multiplyMatrices(camera.projectionMatrix, this.view);
    this.side = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
  }

  depth(place: Vector3): number {
    return -this.seen.copy(place).applyMatrix4(this.view).z;
  }

  /** The position of a place on the canvas; null = behind the eye. */
  spot(place: Vector3): Spot | null {
    const e = this.whole.elements;
    const w = e[3] * place.x + e[7] * place.y + e[11] * place.z + e[15];
    if (w <= 0) return null;
    const { x, y } = this.seen.copy(place).applyMatrix4(this.whole);
    return { x: ((x + 1) / 2) * this.width, y: ((1 - y) / 2) * this.height };
  }

  /** Pixels of a length across the line of sight, at a place. */
  pixels(length: number, place: Vector3): number {
    const [a, b] = [this.spot(place), this.spot(place.clone().addScaledVector(this.side, length))];
    return a && b ? Math.hypot(b.x - a.x, b.y - a.y) : 0;
  }
}

const middleOf = (places: Vector3[]) => places.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(Math.max(1, places.length));
const radiusOf = (object: Object3D) => new Vector3().setFromMatrixColumn(object.matrixWorld, 0).length();

/** Collects what is painted of each object. */
class Painter {
  private readonly items: Item[] = [];

  /** `scale` pixels of the canvas are a px of the page. */
  constructor(private readonly to: CanvasRenderingContext2D, private readonly sight: Sight, private readonly scale: number) {}

  add(object: Object3D): void {
    const material = (object as Mesh).material as Coloured | undefined;
    if (!material) return;
    if (object instanceof LineSegments2) return this.lines(object, material);
    if (!(object instanceof Mesh)) return;
    switch (object.geometry.type) {
      case "CylinderGeometry":
        return this.bar(object, material);
      case "SphereGeometry":
        return this.ball(object, material);
      case "TubeGeometry":
        return this.wire(object as Mesh<TubeGeometry>, material);
      case "BufferGeometry":
        return this.facets(object, material);
      default:
        return this.solid(object, material);
    }
  }

  /** Paints from far to near. */
  paint(): void {
    this.items.sort((a, b) => b.depth - a.depth || (a.over ?? 0) - (b.over ?? 0));
    for (const item of this.items) item.paint(this.to);
  }

  private path(spots: (Spot | null)[], closed: boolean): boolean {
    if (spots.some((p) => p === null)) return false;
    this.to.beginPath();
    spots.forEach((p, i) => (i ? this.to.lineTo(p!.x, p!.y) : this.to.moveTo(p!.x, p!.y)));
    if (closed) this.to.closePath();
    return true;
  }

  private stroke(colour: string, thick: number): void {
    this.to.strokeStyle = colour;
    this.to.lineWidth = thick;
    this.to.stroke();
  }

  private lines(object: LineSegments2, { color, opacity, linewidth = 1 }: Coloured): void {
    const start = object.geometry.attributes.instanceStart as unknown as { data: { array: Float32Array } } | undefined;
    const ends = start?.data.array ?? [];
    const segments: [Spot, Spot][] = [];
    const middle = new Vector3();
    const place = new Vector3();
    for (let i = 0; i + 5 < ends.length; i += 6) {
      const a = this.sight.spot(place.set(ends[i], ends[i + 1], ends[i + 2]).applyMatrix4(object.matrixWorld));
      middle.add(place);
      const b = this.sight.spot(place.set(ends[i + 3], ends[i + 4], ends[i + 5]).applyMatrix4(object.matrixWorld));
      middle.add(place);
      if (a && b) segments.push([a, b]);
    }
    if (!segments.length) return;
    this.items.push({
      depth: this.sight.depth(middle.divideScalar(ends.length / 3)),
      paint: (to) => {
        to.globalAlpha = opacity;
        to.beginPath();
        let last: Spot | null = null;
        for (const [a, b] of segments) {
          if (!last || a.x !== last.x || a.y !== last.y) to.moveTo(a.x, a.y);
          to.lineTo(b.x, b.y);
          last = b;
        }
        this.stroke(shade(color, 0), linewidth * this.scale);
      },
    });
  }

  /** A round bar along its own y from 0 to 1. */
  private bar(object: Mesh, { color }: Coloured): void {
    const at = (share: number) => new Vector3(0, share, 0).applyMatrix4(object.matrixWorld);
    const radius = radiusOf(object);
    for (let i = 0; i < pieces; ++i) {
      const [a, middle, b] = [at(i / pieces), at((i + 0.5) / pieces), at((i + 1) / pieces)];
      this.items.push({
        depth: this.sight.depth(middle),
        paint: (to) => {
          if (!this.path([this.sight.spot(a), this.sight.spot(b)], false)) return;
          const thick = 2 * this.sight.pixels(radius, middle);
          to.globalAlpha = 1;
          this.stroke(shade(color, -0.35), thick);
          this.stroke(shade(color, 0), 0.72 * thick);
          this.stroke(shade(color, 0.3), 0.28 * thick);
        },
      });
    }
  }

  private ball(object: Mesh, { color }: Coloured): void {
    const middle = new Vector3().setFromMatrixPosition(object.matrixWorld);
    const radius = radiusOf(object);
    this.items.push({
      depth: this.sight.depth(middle) - radius, // it lies before the bars that end in it
      over: object.renderOrder,
      paint: (to) => {
        const [at, r] = [this.sight.spot(middle), this.sight.pixels(radius, middle)];
        if (!at) return;
        to.globalAlpha = 1;
        for (const [by, share, off] of [[-0.35, 1, 0], [0, 0.8, 0.08], [0.4, 0.32, 0.3]]) {
          to.beginPath();
          to.arc(at.x - off * r, at.y - off * r, share * r, 0, 2 * Math.PI);
          to.fillStyle = shade(color, by);
          to.fill();
        }
      },
    });
  }

  /** The wire of a spring. */
  private wire(object: Mesh<TubeGeometry>, { color }: Coloured): void {
    const { path: curve, radius } = object.geometry.parameters;
    const { x, y } = object.scale; // the wire was wound in full size and divided by what stretches it
    const first = curve.getPoint(0), last = curve.getPoint(1);
    const length = (last.y - first.y) / 0.9;
    const spots = Array.from({ length: 113 }, (_, i) => {
      const p = curve.getPoint(i / 112);
      return this.sight.spot(p.set(p.x / first.x, p.y / length, p.z / first.x).applyMatrix4(object.matrixWorld));
    });
    const middle = new Vector3(0, 0.5, 0).applyMatrix4(object.matrixWorld);
    if (x > 0 && y > 0)
      this.items.push({
        depth: this.sight.depth(middle),
        paint: (to) => {
          if (!this.path(spots, false)) return;
          to.globalAlpha = 1;
          this.stroke(shade(color, -0.25), 2 * this.sight.pixels(radius, middle));
          this.stroke(shade(color, 0.2), 0.8 * this.sight.pixels(radius, middle));
        },
      });
  }

  /** Triangles, as plates are made of. */
  private facets(object: Mesh, { color, opacity }: Coloured): void {
    const { position } = object.geometry.attributes;
    const all = Array.from({ length: position.count }, (_, i) => new Vector3().fromBufferAttribute(position, i).applyMatrix4(object.matrixWorld));
    const middle = middleOf(all);
    this.items.push({
      depth: this.sight.depth(middle),
      paint: (to) => {
        const spots = all.map((p) => this.sight.spot(p));
        to.globalAlpha = opacity;
        to.fillStyle = shade(color, 0);
        to.beginPath();
        for (let i = 0; i + 2 < spots.length; i += 3) {
          const three = spots.slice(i, i + 3);
          if (three.some((p) => !p)) continue;
          // All the same way round, or what lies over each other would be left out.
          const [p, q, r] = three as Spot[];
          const turned = (q.x - p.x) * (r.y - p.y) < (q.y - p.y) * (r.x - p.x);
          to.moveTo(p.x, p.y);
          for (const s of turned ? [r, q] : [q, r]) to.lineTo(s.x, s.y);
          to.closePath();
        }
        to.fill();
      },
    });
  }

  /** Anything without hollows. */
  private solid(object: Mesh, { color, opacity, transparent }: Coloured): void {
    const all = cornersOf(object.geometry).map((v) => v.clone().applyMatrix4(object.matrixWorld));
    const middle = middleOf(all);
    this.items.push({
      depth: transparent ? this.sight.depth(middle) : all.reduce((least, p) => Math.min(least, this.sight.depth(p)), Infinity),
      paint: (to) => {
        const spots = all.map((p) => this.sight.spot(p)).filter((p) => p !== null);
        if (spots.length < all.length || !this.path(hullOf(spots), true)) return;
        to.globalAlpha = transparent ? opacity : 1;
        to.fillStyle = shade(color, 0);
        to.fill();
        if (!transparent) this.stroke(shade(color, -0.35), this.scale);
      },
    });
  }
}

/** Paints what a camera sees of a scene on a canvas of so many pixels, `scale` of them to a px of the page. */
export function paint(to: CanvasRenderingContext2D, stage: Scene, camera: Camera, background: Color, width: number, height: number, scale: number): void {
  stage.updateMatrixWorld();
  camera.updateMatrixWorld();
  const painter = new Painter(to, new Sight(camera, width, height), scale);
  stage.traverseVisible((object) => painter.add(object));
  to.globalAlpha = 1;
  to.lineJoin = "round";
  to.fillStyle = shade(background, 0);
  to.fillRect(0, 0, width, height);
  painter.paint();
  to.globalAlpha = 1;
}
