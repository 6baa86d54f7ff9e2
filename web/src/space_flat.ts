// The spatial view painted on a plane canvas: for machines whose browser computes WebGL, at ten pictures a second, or has none.
// Everything is painted from far to near; bars are painted in pieces, so that what crosses is in front where it is nearer.
import { BufferGeometry, Color, Matrix4, Mesh, TubeGeometry, Vector3, type Camera, type Material, type Object3D, type Scene } from "three";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import type { Spot } from "./gestures";
import { hullOf } from "./hull";

type Coloured = Material & { color: Color; opacity: number; linewidth?: number };
interface Item {
  depth: number; // away from the eye
  over?: number;  // order of things at one place: the one with more of it is seen
  paint: (to: CanvasRenderingContext2D) => void;
}

/** True if the browser has a graphics card for WebGL: computing the pictures itself, a browser is too slow to move them. */
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

const pieces = 4;  // pieces of a bar
const shades = new Map<string, string>();
function shade(colour: Color, by: number): string {
  const key = `${colour.getHex()} ${by}`;
  let text = shades.get(key);
  if (!text) shades.set(key, (text = `#${(by < 0 ? colour.clone().multiplyScalar(1 + by) : colour.clone().lerp(new Color(1, 1, 1), by)).getHexString()}`));
  return text;
}

/** Paints what a camera sees of a scene on a canvas of so many pixels, `scale` of them to a px of the page. */
export function paint(to: CanvasRenderingContext2D, stage: Scene, camera: Camera, background: Color, width: number, height: number, scale: number): void {
  stage.updateMatrixWorld();
  camera.updateMatrixWorld();
  const view = camera.matrixWorldInverse;
  const whole = new Matrix4().multiplyMatrices(camera.projectionMatrix, view);
  const seen = new Vector3();
  const depthOf = (place: Vector3) => -seen.copy(place).applyMatrix4(view).z;
  /** The position of a place on the canvas; null = behind the eye. */
  const spot = (place: Vector3): Spot | null => {
    const e = whole.elements;
    const w = e[3] * place.x + e[7] * place.y + e[11] * place.z + e[15];
    if (w <= 0) return null;
    const { x, y } = seen.copy(place).applyMatrix4(whole);
    return { x: ((x + 1) / 2) * width, y: ((1 - y) / 2) * height };
  };
  /** Pixels of a length across the line of sight, at a place. */
  const side = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
  const pixels = (length: number, place: Vector3) => {
    const [a, b] = [spot(place), spot(place.clone().addScaledVector(side, length))];
    return a && b ? Math.hypot(b.x - a.x, b.y - a.y) : 0;
  };

  const items: Item[] = [];
  const path = (spots: (Spot | null)[], closed: boolean) => {
    if (spots.some((p) => p === null)) return false;
    to.beginPath();
    spots.forEach((p, i) => (i ? to.lineTo(p!.x, p!.y) : to.moveTo(p!.x, p!.y)));
    if (closed) to.closePath();
    return true;
  };
  const stroke = (colour: string, thick: number) => {
    to.strokeStyle = colour;
    to.lineWidth = thick;
    to.stroke();
  };

  function lines(object: LineSegments2, { color, opacity, linewidth = 1 }: Coloured): void {
    const start = object.geometry.attributes.instanceStart as unknown as { data: { array: Float32Array } } | undefined;
    const ends = start?.data.array ?? [];
    const ways: [Spot, Spot][] = [];
    const middle = new Vector3();
    const place = new Vector3();
    for (let i = 0; i + 5 < ends.length; i += 6) {
      const a = spot(place.set(ends[i], ends[i + 1], ends[i + 2]).applyMatrix4(object.matrixWorld));
      middle.add(place);
      const b = spot(place.set(ends[i + 3], ends[i + 4], ends[i + 5]).applyMatrix4(object.matrixWorld));
      middle.add(place);
      if (a && b) ways.push([a, b]);
    }
    if (!ways.length) return;
    items.push({
      depth: depthOf(middle.divideScalar(ends.length / 3)),
      paint: () => {
        to.globalAlpha = opacity;
        to.beginPath();
        let last: Spot | null = null;
        for (const [a, b] of ways) {
          if (!last || a.x !== last.x || a.y !== last.y) to.moveTo(a.x, a.y);
          to.lineTo(b.x, b.y);
          last = b;
        }
        stroke(shade(color, 0), linewidth * scale);
      },
    });
  }

  /** A round bar along its own y from 0 to 1. */
  function bar(object: Mesh, { color }: Coloured): void {
    const at = (share: number) => new Vector3(0, share, 0).applyMatrix4(object.matrixWorld);
    const radius = seen.setFromMatrixColumn(object.matrixWorld, 0).length();
    for (let i = 0; i < pieces; ++i) {
      const [a, middle, b] = [at(i / pieces), at((i + 0.5) / pieces), at((i + 1) / pieces)];
      items.push({
        depth: depthOf(middle),
        paint: () => {
          if (!path([spot(a), spot(b)], false)) return;
          const thick = 2 * pixels(radius, middle);
          to.globalAlpha = 1;
          stroke(shade(color, -0.35), thick);
          stroke(shade(color, 0), 0.72 * thick);
          stroke(shade(color, 0.3), 0.28 * thick);
        },
      });
    }
  }

  function ball(object: Mesh, { color }: Coloured): void {
    const middle = new Vector3().setFromMatrixPosition(object.matrixWorld);
    const radius = seen.setFromMatrixColumn(object.matrixWorld, 0).length();
    items.push({
      depth: depthOf(middle) - radius, // it lies before the bars that end in it
      over: object.renderOrder,
      paint: () => {
        const [at, r] = [spot(middle), pixels(radius, middle)];
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
  function wire(object: Mesh<TubeGeometry>, { color }: Coloured): void {
    const { path: curve, radius } = object.geometry.parameters;
    const { x, y } = object.scale; // the wire was wound in full size and divided by what stretches it
    const first = curve.getPoint(0), last = curve.getPoint(1);
    const length = (last.y - first.y) / 0.9;
    const spots = Array.from({ length: 113 }, (_, i) => {
      const p = curve.getPoint(i / 112);
      return spot(p.set(p.x / first.x, p.y / length, p.z / first.x).applyMatrix4(object.matrixWorld));
    });
    const middle = new Vector3(0, 0.5, 0).applyMatrix4(object.matrixWorld);
    if (x > 0 && y > 0)
      items.push({
        depth: depthOf(middle),
        paint: () => {
          if (!path(spots, false)) return;
          to.globalAlpha = 1;
          stroke(shade(color, -0.25), 2 * pixels(radius, middle));
          stroke(shade(color, 0.2), 0.8 * pixels(radius, middle));
        },
      });
  }

  /** Triangles, as plates are made of. */
  function facets(object: Mesh, { color, opacity }: Coloured): void {
    const { position } = object.geometry.attributes;
    const all = Array.from({ length: position.count }, (_, i) => new Vector3().fromBufferAttribute(position, i).applyMatrix4(object.matrixWorld));
    const middle = all.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(Math.max(1, all.length));
    items.push({
      depth: depthOf(middle),
      paint: () => {
        const spots = all.map(spot);
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
  function solid(object: Mesh, { color, opacity, transparent }: Coloured): void {
    const all = cornersOf(object.geometry).map((v) => v.clone().applyMatrix4(object.matrixWorld));
    const middle = all.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(Math.max(1, all.length));
    items.push({
      depth: transparent ? depthOf(middle) : all.reduce((least, p) => Math.min(least, depthOf(p)), Infinity),
      paint: () => {
        const spots = all.map(spot).filter((p) => p !== null);
        if (spots.length < all.length || !path(hullOf(spots), true)) return;
        to.globalAlpha = transparent ? opacity : 1;
        to.fillStyle = shade(color, 0);
        to.fill();
        if (!transparent) stroke(shade(color, -0.35), scale);
      },
    });
  }

  stage.traverseVisible((object: Object3D) => {
    const material = (object as Mesh).material as Coloured | undefined;
    if (!material) return;
    if (object instanceof LineSegments2) lines(object, material);
    else if (object instanceof Mesh) {
      const kind = object.geometry.type;
      (kind === "CylinderGeometry" ? bar : kind === "SphereGeometry" ? ball : kind === "TubeGeometry" ? wire : kind === "BufferGeometry" ? facets : solid)(object as Mesh<TubeGeometry>, material);
    }
  });
  items.sort((a, b) => b.depth - a.depth || (a.over ?? 0) - (b.over ?? 0));

  to.globalAlpha = 1;
  to.lineJoin = "round";
  to.fillStyle = shade(background, 0);
  to.fillRect(0, 0, width, height);
  for (const item of items) item.paint(to);
  to.globalAlpha = 1;
}
