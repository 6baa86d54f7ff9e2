// SPDX-License-Identifier: BSD-3-Clause

// The spatial view: a bundle of its own, which only reports with a spatial scene carry. It draws when something has changed.
// A graphics card draws it, or paint() where there is none.
import { AmbientLight, DirectionalLight, Scene as Stage, WebGLRenderer } from "three";
import type { Scene } from "./data";
import { SpaceCamera } from "./space_camera";
import { hasFastWebgl, paint } from "./space_flat";
import { SpaceModel, type Shown } from "./space_model";
import { SpaceNames } from "./space_names";
import { Palette } from "./space_parts";
import { SpacePointer, type Events } from "./space_pointer";
import { bounds3, cloudOf, sizeOf, type Box3, type V3, type ViewName } from "./space_view";

let fast: boolean | undefined; // asked once a page

/** The canvas of a view, with the graphics card that draws on it when there is one. */
class Screen {
  readonly canvas = document.createElement("canvas");
  private readonly renderer: WebGLRenderer | null;
  private readonly plane: CanvasRenderingContext2D | null;

  constructor(host: HTMLElement) {
    fast ??= hasFastWebgl();
    this.renderer = fast ? new WebGLRenderer({ canvas: this.canvas, antialias: true }) : null;
    this.plane = fast ? null : this.canvas.getContext("2d", { alpha: false })!;
    host.append(this.canvas);
  }

  private ratio = () => Math.min(2, devicePixelRatio);

  resize(width: number, height: number): void {
    const ratio = this.ratio();
    if (this.renderer) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height);
      return;
    }
    Object.assign(this.canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    Object.assign(this.canvas.style, { width: `${width}px`, height: `${height}px` });
  }

  draw(stage: Stage, { now }: SpaceCamera, palette: Palette): void {
    if (this.renderer) {
      this.renderer.setClearColor(palette.background(), 1);
      this.renderer.render(stage, now);
    } else paint(this.plane!, stage, now, palette.background(), this.canvas.width, this.canvas.height, this.ratio());
  }

  close(): void {
    this.renderer?.dispose();
    this.renderer?.forceContextLoss(); // browsers allow few of them at a time
    this.canvas.remove();
  }
}

export class SpaceView {
  private readonly screen: Screen;
  private readonly palette = new Palette();
  private readonly stage = new Stage();
  private readonly sun = new DirectionalLight(0xffffff, 2.1);
  private readonly camera: SpaceCamera;
  private readonly model: SpaceModel;
  private readonly names: SpaceNames;
  private readonly pointer: SpacePointer;
  private readonly observer = new ResizeObserver(() => this.resize());
  private readonly cloud: V3[];
  private readonly size: number;
  private scene: Scene;
  private at = 0;
  private shown: Shown = { labels: true, traces: true, road: true, arrows: { force: 1, velocity: 1, acceleration: 1 }, picked: "" };
  private viewpoint: ViewName = "oblique";
  private frameAsked = 0;
  private frames = 0;

  /** `box` holds all of the scene. */
  constructor(private readonly host: HTMLElement, whole: Scene, box: Box3, events: Events) {
    this.scene = whole;
    this.size = sizeOf(box);
    this.cloud = cloudOf(whole);
    this.screen = new Screen(host);
    const { canvas } = this.screen;
    this.stage.add(new AmbientLight(0xffffff, 1.7), this.sun, this.sun.target);
    this.camera = new SpaceCamera(canvas, this.size);
    this.model = new SpaceModel(this.stage, this.palette, whole, box);
    this.names = new SpaceNames(host, whole, this.model);
    this.pointer = new SpacePointer(host, canvas, this.camera, this.model, events);
    canvas.addEventListener("dblclick", () => this.look(this.viewpoint));
    this.camera.controls.addEventListener("change", this.request);
    this.observer.observe(host);
    this.look(this.viewpoint);
  }

  /** `scene` is the row of the samples that is shown, `at` a position in it. */
  pose(scene: Scene, at: number): void {
    this.scene = scene;
    this.at = at;
    this.request();
  }

  show(shown: Shown): void {
    this.shown = shown;
    this.request();
  }

  look(name: ViewName): void {
    this.viewpoint = name;
    const [width, height] = this.extent();
    this.screen.resize(width, height);
    this.camera.look(name, this.cloud, width, height);
    this.request();
  }

  parallel(on: boolean): void {
    if (this.camera.parallel(on)) this.request();
  }

  /** Turns the view by angles in radians. */
  turn(right: number, up: number): void {
    this.camera.controls.rotateLeft(-right);
    this.camera.controls.rotateUp(-up);
    this.request();
  }

  /** Moves the view by px. */
  move(right: number, up: number): void {
    this.camera.controls.pan(-right, up);
    this.request();
  }

  zoom(factor: number): void {
    this.camera.controls.dollyIn(1 / factor);
    this.request();
  }

  recolour(): void {
    this.palette.recolour();
    this.request();
  }

  picture(): Promise<Blob> {
    this.draw();
    return new Promise((resolve, reject) => this.screen.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the picture could not be made")))));
  }

  /** The picture on the screen, with the names: for pictures that move. */
  frame(): HTMLCanvasElement {
    cancelAnimationFrame(this.frameAsked); // the frame is drawn here instead
    this.draw();
    const { canvas } = this.screen;
    const [out, scale] = [document.createElement("canvas"), canvas.width / Math.max(1, this.host.clientWidth)];
    [out.width, out.height] = [canvas.width, canvas.height];
    const to = out.getContext("2d")!;
    to.drawImage(canvas, 0, 0);
    to.scale(scale, scale);
    this.names.drawOn(to);
    return out;
  }

  close(): void {
    cancelAnimationFrame(this.frameAsked);
    this.observer.disconnect();
    this.pointer.close();
    this.camera.controls.dispose();
    this.stage.traverse((o) => (o as { geometry?: { dispose(): void } }).geometry?.dispose());
    this.palette.dispose();
    this.screen.close();
    this.names.close();
  }

  private extent = () => [Math.max(1, this.host.clientWidth), Math.max(1, this.host.clientHeight)];

  private resize(): void {
    const [width, height] = this.extent();
    this.screen.resize(width, height);
    this.camera.resize(width, height);
    this.request();
  }

  private request = () => {
    this.frameAsked ||= requestAnimationFrame(() => this.draw());
  };

  private draw(): void {
    this.frameAsked = 0;
    this.model.pose(this.scene, this.at, this.shown);
    // The light comes from the eye, a little from the left and above.
    const { target } = this.camera.controls;
    this.sun.target.position.copy(target);
    this.sun.position.set(-0.35, 0.5, 1).applyQuaternion(this.camera.now.quaternion).multiplyScalar(this.size * 4).add(target);
    this.screen.draw(this.stage, this.camera, this.palette);
    this.names.write(this.camera, this.shown.labels);
    this.screen.canvas.dataset.frames = String(++this.frames);
  }
}

/** Opens a view in an element; null when the scene has nothing to draw. */
export function open(host: HTMLElement, whole: Scene, events: Events): SpaceView | null {
  const box = bounds3(whole);
  return box && new SpaceView(host, whole, box, events);
}
