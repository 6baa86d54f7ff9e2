// SPDX-License-Identifier: BSD-3-Clause

// The eye of a spatial view: a camera with perspective and one without, and the controls that turn, move and zoom them.
import { OrthographicCamera, PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { fit3, viewpoints, type V3, type ViewName } from "./space_view";

const fieldOfView = 32; // degrees
const tangent = Math.tan((fieldOfView * Math.PI) / 360);

export class SpaceCamera {
  readonly controls: OrbitControls<PerspectiveCamera | OrthographicCamera>;
  private readonly perspective: PerspectiveCamera;
  private readonly flat: OrthographicCamera;
  private halfHeight: number; // half the height that the flat camera sees at zoom 1

  /** `size` is the extent of what is seen. */
  constructor(canvas: HTMLCanvasElement, size: number) {
    this.perspective = new PerspectiveCamera(fieldOfView, 1, size / 100, size * 60);
    this.flat = new OrthographicCamera(-1, 1, 1, -1, -size * 40, size * 60);
    this.halfHeight = size;
    for (const camera of [this.perspective, this.flat]) camera.up.set(0, 0, 1);
    this.controls = new OrbitControls<PerspectiveCamera | OrthographicCamera>(this.perspective, canvas);
    Object.assign(this.controls, { minDistance: size / 30, maxDistance: size * 30, minZoom: 1 / 30, maxZoom: 100 });
  }

  /** The camera that is looked through. */
  get now(): PerspectiveCamera | OrthographicCamera {
    return this.controls.object;
  }

  /** Looks from a viewpoint so that all places are seen in a window of this size. */
  look(name: ViewName, places: V3[], width: number, height: number): void {
    const { eye } = viewpoints.find((v) => v.name === name)!;
    const { target, distance, halfHeight } = fit3(places, eye, (fieldOfView * Math.PI) / 180, Math.max(0.2, width / height));
    this.controls.target.set(...target);
    this.perspective.position.copy(this.controls.target).addScaledVector(new Vector3(...eye).normalize(), distance);
    this.flat.position.copy(this.perspective.position);
    this.flat.zoom = 1;
    this.halfHeight = halfHeight;
    this.resize(width, height);
    this.controls.update();
  }

  /** Fits both cameras to a window of this size. */
  resize(width: number, height: number): void {
    this.perspective.aspect = width / height;
    this.perspective.updateProjectionMatrix();
    const half = this.halfHeight;
    Object.assign(this.flat, { top: half, bottom: -half, left: (-half * width) / height, right: (half * width) / height });
    this.flat.updateProjectionMatrix();
  }

  /** Takes the camera without perspective, or the one with it; what lies about the target keeps its size. False = it was taken already. */
  parallel(on: boolean): boolean {
    const next = on ? this.flat : this.perspective;
    if (next === this.now) return false;
    const fromTarget = this.now.position.clone().sub(this.controls.target);
    if (on) {
      this.flat.zoom = this.halfHeight / (fromTarget.length() * tangent);
      this.flat.position.copy(this.now.position);
    } else {
      const distance = this.halfHeight / this.flat.zoom / tangent;
      this.perspective.position.copy(this.controls.target).addScaledVector(fromTarget.normalize(), distance);
    }
    this.controls.object = next;
    next.updateProjectionMatrix();
    this.controls.update();
    return true;
  }

  /** A direction of the scene as the camera sees it: x to the right, y up, z to the eye. */
  seen(direction: Vector3): Vector3 {
    return direction.clone().applyQuaternion(this.now.quaternion.clone().invert());
  }
}
