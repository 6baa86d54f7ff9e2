// SPDX-License-Identifier: BSD-3-Clause

// The content of a spatial view: the bodies, joints, traces and arrows of a scene at one instant, and the ground below them.
import { Group, Vector3, type Object3D, type Scene as Stage } from "three";
import { arrowScale, quantities, valueNear } from "./arrows";
import type { Quantity, Scene } from "./data";
import { placeAt, placeNear } from "./motion";
import { arrowPart, bodyPart, discPart, jointPart, lines, type Palette, type Part, type Places } from "./space_parts";
import { lowestTyre, middleOf, sizeOf, type Box3, type V3 } from "./space_view";
import { bodyColours, niceStep } from "./view";

/** The parts to be shown beside the mechanism itself. */
export interface Shown {
  labels: boolean;
  traces: boolean;
  road: boolean;
  arrows: Record<Quantity, number>; // times the usual length; 0 = not shown
  picked: string;
}

const vector = (p: { x: number; y: number; z?: number } | null) => p && new Vector3(p.x, p.y, p.z ?? 0);

export class SpaceModel {
  readonly joints: ReturnType<typeof jointPart>[];
  readonly arrows: ReturnType<typeof arrowPart>[];
  /** Ends of the arrows. */
  readonly tips: (Vector3 | null)[] = [];
  private readonly parts: Part[];
  private readonly trace: ReturnType<typeof lines>;
  private readonly road: Object3D;
  private readonly scales: Record<Quantity, number>;
  private drawnTrace: Scene | null = null;

  /** Adds the parts of the scene to the stage; whatever can be pointed at has its name in `userData.pick`. */
  constructor(stage: Stage, palette: Palette, whole: Scene, private readonly box: Box3) {
    const size = sizeOf(box);
    const colours = bodyColours(whole.bodies);
    const thin = thickness(whole, size);
    const added = <P extends { object: Object3D }>(part: P, pick: string): P => {
      part.object.userData.pick = pick;
      stage.add(part.object);
      return part;
    };
    const bodies = whole.bodies.map((body, i) => added(bodyPart(palette, body, `--c${colours[i]}`, size, thin), `body ${i}`));
    const discs = (whole.discs ?? []).map((disc, i) => added(discPart(palette, disc), `disc ${i}`));
    this.joints = whole.joints.map((joint, i) => added(jointPart(palette, joint, size, thin), `joint ${i}`));
    this.parts = [...bodies, ...discs, ...this.joints];
    this.trace = lines(palette.stroke("--trace", 2.2));
    this.road = new Group().add(roadPart(palette, box));
    stage.add(this.trace.object, this.road);
    this.scales = Object.fromEntries(quantities.map((q) => [q, arrowScale(whole, q)])) as Record<Quantity, number>;
    this.arrows = whole.vectors.map((v, i) => added(arrowPart(palette, v.quantity, size), `vector ${i}`));
  }

  /** Puts everything where it is at the position `at` in the samples of `scene`. */
  pose(scene: Scene, at: number, shown: Shown): void {
    const places: Places = (point) => vector(placeNear(scene, point, at));
    for (const part of this.parts) part.pose(places);
    this.poseRoad(scene, places, shown);
    this.poseArrows(scene, places, at, shown);
    this.joints.forEach((joint, i) => joint.pick(shown.picked === `joint ${i}`));
    this.drawTrace(scene);
    this.trace.object.visible = shown.traces && scene.traces.length > 0;
  }

  /** The objects that can be seen and pointed at. */
  objects(): Object3D[] {
    return [...this.parts, ...this.arrows].map((part) => part.object).filter((object) => object.visible);
  }

  private poseRoad(scene: Scene, places: Places, shown: Shown): void {
    const wheels = (scene.discs ?? []).flatMap((d) => {
      const [c, e] = [places(d.centre), places(d.axis)];
      return c && e ? [{ centre: c.toArray() as V3, axis: e.sub(c).toArray() as V3, radius: d.radius, width: d.width }] : [];
    });
    this.road.position.z = lowestTyre(wheels) ?? this.box.low[2];
    this.road.visible = shown.road;
  }

  private poseArrows(scene: Scene, places: Places, at: number, shown: Shown): void {
    scene.vectors.forEach((v, i) => {
      const from = places(v.point);
      const [x, y, z] = [valueNear(v.x, at), valueNear(v.y, at), v.z ? valueNear(v.z, at) : 0];
      const scale = this.scales[v.quantity] * shown.arrows[v.quantity];
      this.arrows[i].object.visible = false;
      if (!from || x === null || y === null || z === null || !(scale > 0)) return;
      const along = new Vector3(x, y, z).multiplyScalar(scale);
      this.arrows[i].set(from, along);
      this.tips[i] = from.clone().add(along);
    });
  }

  private drawTrace(scene: Scene): void {
    if (this.drawnTrace === scene) return;
    this.drawnTrace = scene;
    const ends: number[] = [];
    for (const { point } of scene.traces)
      scene.input.forEach((_, i) => {
        const [a, b] = [placeAt(scene, point, i), i + 1 < scene.input.length ? placeAt(scene, point, i + 1) : null];
        if (a && b) ends.push(a.x, a.y, a.z ?? 0, b.x, b.y, b.z ?? 0);
      });
    this.trace.set(ends);
  }
}

/** A grid of squares below the box, in the plane z = 0. */
function roadPart(palette: Palette, box: Box3): Object3D {
  const [middle, size] = [middleOf(box), sizeOf(box)];
  const step = niceStep(size / 6);
  const reach = Math.ceil((0.75 * size) / step);
  const [cx, cy] = [Math.round(middle[0] / step), Math.round(middle[1] / step)];
  const ends: number[] = [];
  for (let i = -reach; i <= reach; ++i) {
    ends.push((cx + i) * step, (cy - reach) * step, 0, (cx + i) * step, (cy + reach) * step, 0);
    ends.push((cx - reach) * step, (cy + i) * step, 0, (cx + reach) * step, (cy + i) * step, 0);
  }
  const road = lines(palette.stroke("--line", 1));
  road.set(ends);
  return road.object;
}

/** Bars are thinner where they are short, so that chains of many can be told apart. */
function thickness(scene: Scene, size: number): number {
  const lengths = scene.bodies
    .filter((b) => b.style === "bar" || b.style === "plate")
    .flatMap((b) => {
      const [p, q] = [vector(placeAt(scene, b.points[0], 0)), vector(placeAt(scene, b.points[1], 0))];
      return p && q ? [p.distanceTo(q)] : [];
    })
    .sort((a, b) => a - b);
  const usual = lengths.length ? lengths[lengths.length >> 1] : size;
  return Math.min(1, Math.max(0.25, usual / (0.18 * size)));
}
