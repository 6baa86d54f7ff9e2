// SPDX-License-Identifier: BSD-3-Clause

// The pointer over a spatial view: what lies under it, a joint that it takes hold of, and clicks.
import { Plane, Raycaster, Vector2, Vector3, type Object3D, type Ray } from "three";
import type { Place } from "./motion";
import type { SpaceCamera } from "./space_camera";
import type { SpaceModel } from "./space_model";

export interface Events {
  hover: (pick: string) => void;
  pick: (pick: string) => void;
  /** A press on a joint: true = it is taken hold of, and the pointer drags it in the plane of the screen until it is dropped. */
  hold: (joint: number) => boolean;
  drag: (to: Place, alone: boolean) => void;
  drop: () => void;
}

const near = 12; // px about a joint that count as the joint
const still = 5; // px that a click may move

/** The name of what an object is a part of. */
const owner = (object: Object3D | null): string => (object ? ((object.userData.pick as string | undefined) ?? owner(object.parent)) : "");

export class SpacePointer {
  private readonly ray = new Raycaster();
  private readonly ended = new AbortController();
  private held: Plane | null = null;
  private pressed: { x: number; y: number } | null = null;

  constructor(private readonly host: HTMLElement, private readonly canvas: HTMLCanvasElement, private readonly camera: SpaceCamera, private readonly model: SpaceModel, private readonly events: Events) {
    this.listenForDrags();
    this.listenForClicks();
  }

  close(): void {
    this.ended.abort();
  }

  /** A joint that is held takes precedence over turning the view. */
  private listenForDrags(): void {
    const end = (event: PointerEvent) => this.drop(event);
    const options = { capture: true, signal: this.ended.signal };
    this.host.addEventListener("pointerdown", (event) => this.take(event), options);
    this.host.addEventListener("pointermove", (event) => this.drag(event), options);
    for (const name of ["pointerup", "pointercancel"] as const) this.host.addEventListener(name, end, options);
    // The wheel scrolls the page; with Ctrl it zooms, as in the plane.
    this.host.addEventListener("wheel", (event) => !event.ctrlKey && !event.metaKey && event.stopPropagation(), options);
  }

  private listenForClicks(): void {
    const { canvas, events } = this;
    canvas.addEventListener("pointerdown", (event) => (this.pressed = event.button === 0 ? { x: event.clientX, y: event.clientY } : null));
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons === 0 && event.pointerType !== "touch") events.hover(this.pickAt(event));
    });
    canvas.addEventListener("pointerleave", () => events.hover(""));
    canvas.addEventListener("pointerup", (event) => {
      if (this.pressed && Math.hypot(event.clientX - this.pressed.x, event.clientY - this.pressed.y) < still) events.pick(this.pickAt(event));
      this.pressed = null;
    });
  }

  /** The name under the pointer: that of a joint within a few pixels first, then that of the object hit. */
  private pickAt(event: PointerEvent): string {
    const joint = this.jointAt(event);
    if (joint) return joint;
    this.aim(event);
    const hits = this.ray.intersectObjects(this.model.objects()).filter((h) => (h.object as { isMesh?: boolean }).isMesh && !("isLineSegments2" in h.object));
    const picks = hits.map((h) => owner(h.object));
    // A wheel is seen through: what lies in it comes first.
    return picks.find((p) => !p.startsWith("disc")) ?? picks[0] ?? "";
  }

  private jointAt(event: PointerEvent): string {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const pointer = new Vector2(event.clientX - left, event.clientY - top);
    let [least, best] = [near, ""];
    this.model.joints.forEach(({ object }, i) => {
      const p = object.position.clone().project(this.camera.now);
      const distance = object.visible ? new Vector2(((p.x + 1) / 2) * width, ((1 - p.y) / 2) * height).distanceTo(pointer) : Infinity;
      if (distance < least) [least, best] = [distance, `joint ${i}`];
    });
    return best;
  }

  private aim(event: PointerEvent): Ray {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    this.ray.setFromCamera(new Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height), this.camera.now);
    return this.ray.ray;
  }

  private take(event: PointerEvent): void {
    const [kind, joint] = event.button === 0 ? this.pickAt(event).split(" ") : [];
    if (kind !== "joint" || !this.events.hold(Number(joint))) return;
    event.stopPropagation();
    const facing = this.camera.now.getWorldDirection(new Vector3());
    this.held = new Plane().setFromNormalAndCoplanarPoint(facing, this.model.joints[Number(joint)].object.position);
    this.host.setPointerCapture(event.pointerId);
  }

  private drag(event: PointerEvent): void {
    if (!this.held) return;
    event.stopPropagation();
    const to = this.aim(event).intersectPlane(this.held, new Vector3());
    if (to) this.events.drag({ x: to.x, y: to.y, z: to.z }, event.altKey);
  }

  private drop(event: PointerEvent): void {
    if (!this.held) return;
    event.stopPropagation();
    this.held = null;
    this.events.drop();
  }
}
