// The spatial view: a bundle of its own, which only reports with a spatial scene carry. It draws when something has changed.
// A graphics card draws it, or paint() where there is none.
import { AmbientLight, DirectionalLight, Group, OrthographicCamera, PerspectiveCamera, Raycaster, Plane, Scene as Stage, Vector2, Vector3, WebGLRenderer, type Object3D } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { arrowScale, quantities, valueNear } from "./arrows";
import type { Quantity, Scene } from "./data";
import { placeLabels, symbolOf } from "./labels";
import { placeAt, placeNear, type Place } from "./motion";
import { arrowPart, bodyPart, discPart, jointPart, lines, Palette, type Part, type Places } from "./space_parts";
import { hasFastWebgl, paint } from "./space_flat";
import { bounds3, cloudOf, fit3, lowestTyre, middleOf, sizeOf, viewpoints, type V3, type ViewName } from "./space_view";
import { bodyColours, niceStep } from "./view";

/** The parts that are shown beside the mechanism itself. */
export interface Shown {
  labels: boolean;
  traces: boolean;
  road: boolean;
  arrows: Record<Quantity, number>; // times the usual length; 0 = not shown
  picked: string;
}

export interface Events {
  hover: (pick: string) => void;
  pick: (pick: string) => void;
  /** A press on a joint: true = it is taken hold of, and the pointer drags it in the plane of the screen until it is dropped. */
  hold: (joint: number) => boolean;
  drag: (to: Place, alone: boolean) => void;
  drop: () => void;
}

export interface SpaceView {
  /** `scene` is the row of the samples that is shown, `at` a position in it. */
  pose: (scene: Scene, at: number) => void;
  show: (shown: Shown) => void;
  look: (view: ViewName) => void;
  parallel: (on: boolean) => void;
  turn: (right: number, up: number) => void; // radians
  move: (right: number, up: number) => void; // pixels
  zoom: (factor: number) => void;
  recolour: () => void;
  picture: () => Promise<Blob>;
  /** The picture on the screen, with the names: for pictures that move. */
  frame: () => HTMLCanvasElement;
  close: () => void;
}

const fov = 32; // degrees
const vector = (p: { x: number; y: number; z?: number } | null) => p && new Vector3(p.x, p.y, p.z ?? 0);

let fast: boolean | undefined; // asked once a page

/** Opens a view in an element; null when the scene has nothing to draw. */
export function open(host: HTMLElement, whole: Scene, events: Events): SpaceView | null {
  const box = bounds3(whole);
  if (!box) return null;
  const canvas = document.createElement("canvas");
  fast ??= hasFastWebgl();
  const renderer = fast ? new WebGLRenderer({ canvas, antialias: true }) : null;
  const plane = renderer ? null : canvas.getContext("2d", { alpha: false })!;
  host.append(canvas);
  const labels = host.appendChild(document.createElement("div"));
  labels.className = "space-labels";
  labels.setAttribute("aria-hidden", "true");
  const triad = host.appendChild(document.createElement("div"));
  triad.className = "space-triad";
  triad.setAttribute("aria-hidden", "true");

  const palette = new Palette();
  const stage = new Stage();
  const cloud = cloudOf(whole);
  const [middle, size] = [new Vector3(...middleOf(box)), sizeOf(box)];
  stage.add(new AmbientLight(0xffffff, 1.7));
  const sun = new DirectionalLight(0xffffff, 2.1);
  stage.add(sun, sun.target);

  // Cameras and controls.
  const perspective = new PerspectiveCamera(fov, 1, size / 100, size * 60);
  const flat = new OrthographicCamera(-1, 1, 1, -1, -size * 40, size * 60);
  for (const c of [perspective, flat]) c.up.set(0, 0, 1);
  let camera: PerspectiveCamera | OrthographicCamera = perspective;
  const controls = new OrbitControls<PerspectiveCamera | OrthographicCamera>(camera, canvas);
  controls.minDistance = size / 30;
  controls.maxDistance = size * 30;
  controls.minZoom = 1 / 30;
  controls.maxZoom = 100;

  // The mechanism.
  const parts: { part: Part; pick: string }[] = [];
  const colours = bodyColours(whole.bodies);
  const thin = thickness(whole, size);
  whole.bodies.forEach((body, i) => {
    parts.push({ part: bodyPart(palette, body, `--c${colours[i]}`, size, thin), pick: `body ${i}` });
  });
  (whole.discs ?? []).forEach((disc, i) => parts.push({ part: discPart(palette, disc), pick: `disc ${i}` }));
  const joints = whole.joints.map((joint) => jointPart(palette, joint, size, thin));
  joints.forEach((part, i) => parts.push({ part, pick: `joint ${i}` }));
  for (const { part, pick } of parts) {
    part.object.userData.pick = pick;
    stage.add(part.object);
  }
  const trace = lines(palette.stroke("--trace", 2.2));
  const road = lines(palette.stroke("--line", 1));
  stage.add(trace.object, road.object);
  const roadGroup = new Group().add(road.object);
  stage.add(roadGroup);
  layRoad();
  const scales = Object.fromEntries(quantities.map((q) => [q, arrowScale(whole, q)])) as Record<Quantity, number>;
  const arrows = whole.vectors.map((v, i) => {
    const arrow = arrowPart(palette, v.quantity, size);
    arrow.object.userData.pick = `vector ${i}`;
    stage.add(arrow.object);
    return arrow;
  });
  const names = [
    ...whole.joints.map((joint, i) => ({ text: joint.name, kind: `joint ${joint.style}`, where: () => joints[i].object.visible ? joints[i].object.position : null, pick: `joint ${i}` })),
    ...whole.vectors.map((v, i) => ({ text: symbolOf(whole, v), kind: `arrow ${v.quantity}`, where: () => (arrows[i].object.visible ? tips[i] : null), pick: `vector ${i}` })),
  ].filter((n) => n.text).map((n) => {
    const element = labels.appendChild(document.createElement("span"));
    element.textContent = n.text;
    element.className = n.kind;
    element.dataset.name = n.text;
    return { ...n, element };
  });
  const leaderLayer = labels.appendChild(document.createElementNS("http://www.w3.org/2000/svg", "svg"));
  const leaders = leaderLayer.appendChild(document.createElementNS("http://www.w3.org/2000/svg", "path"));
  leaders.setAttribute("class", "leader");
  const slots: number[] = []; // in which each name was
  const tips: (Vector3 | null)[] = [];

  let scene = whole;
  let at = 0;
  let shown: Shown = { labels: true, traces: true, road: true, arrows: { force: 1, velocity: 1, acceleration: 1 }, picked: "" };
  let drawnTrace: Scene | null = null;
  let frame = 0;
  let frames = 0;
  let view: ViewName = "oblique";

  function layRoad(): void {
    const step = niceStep(size / 6);
    const reach = Math.ceil((0.75 * size) / step);
    const [cx, cy] = [Math.round(middle.x / step), Math.round(middle.y / step)];
    const ends: number[] = [];
    for (let i = -reach; i <= reach; ++i) {
      ends.push((cx + i) * step, (cy - reach) * step, 0, (cx + i) * step, (cy + reach) * step, 0);
      ends.push((cx - reach) * step, (cy + i) * step, 0, (cx + reach) * step, (cy + i) * step, 0);
    }
    road.set(ends);
  }

  function place(): void {
    const places: Places = (point) => vector(placeNear(scene, point, at));
    for (const { part } of parts) part.pose(places);
    const wheels = (scene.discs ?? []).flatMap((d) => {
      const [c, e] = [places(d.centre), places(d.axis)];
      return c && e ? [{ centre: c.toArray() as V3, axis: e.sub(c).toArray() as V3, radius: d.radius, width: d.width }] : [];
    });
    roadGroup.position.z = lowestTyre(wheels) ?? box!.low[2];
    roadGroup.visible = shown.road;
    scene.vectors.forEach((v, i) => {
      const from = places(v.point);
      const [x, y, z] = [valueNear(v.x, at), valueNear(v.y, at), v.z ? valueNear(v.z, at) : 0];
      const scale = scales[v.quantity] * shown.arrows[v.quantity];
      arrows[i].object.visible = false;
      if (!from || x === null || y === null || z === null || !(scale > 0)) return;
      const way = new Vector3(x, y, z).multiplyScalar(scale);
      arrows[i].set(from, way);
      tips[i] = from.clone().add(way);
    });
    joints.forEach((joint, i) => joint.pick(shown.picked === `joint ${i}`));
    if (drawnTrace !== scene) {
      drawnTrace = scene;
      const ends: number[] = [];
      for (const { point } of scene.traces)
        scene.input.forEach((_, i) => {
          const [a, b] = [placeAt(scene, point, i), i + 1 < scene.input.length ? placeAt(scene, point, i + 1) : null];
          if (a && b) ends.push(a.x, a.y, a.z ?? 0, b.x, b.y, b.z ?? 0);
        });
      trace.set(ends);
    }
    trace.object.visible = shown.traces && scene.traces.length > 0;
  }

  const request = () => {
    if (!frame) frame = requestAnimationFrame(draw);
  };
  function draw(): void {
    frame = 0;
    place();
    // The light comes from the eye, a little from the left and above.
    sun.target.position.copy(controls.target);
    sun.position.set(-0.35, 0.5, 1).applyQuaternion(camera.quaternion).multiplyScalar(size * 4).add(controls.target);
    if (renderer) {
      renderer.setClearColor(palette.background(), 1);
      renderer.render(stage, camera);
    } else paint(plane!, stage, camera, palette.background(), canvas.width, canvas.height, Math.min(2, devicePixelRatio));
    write();
    canvas.dataset.frames = String(++frames);
  }

  /** Names beside their places on the screen; a leader goes to those that are further away. */
  function write(): void {
    const { clientWidth: width, clientHeight: height } = host;
    const places = names.map(({ where, text }) => {
      const p = shown.labels ? where()?.clone().project(camera) : undefined;
      const inside = p && Math.abs(p.x) < 1 && Math.abs(p.y) < 1 && p.z < 1;
      return inside ? { x: ((p.x + 1) / 2) * width, y: ((1 - p.y) / 2) * height, text } : null;
    });
    const placed = placeLabels(places, slots);
    let leads = "";
    names.forEach(({ element }, i) => {
      const [p, name] = [places[i], placed[i]];
      element.hidden = !p || !name;
      if (!p || !name) return;
      slots[i] = name.slot;
      const [x, y] = [p.x + name.x, p.y + name.y];
      element.style.transform = `translate(${x.toFixed(1)}px,${(y - 11).toFixed(1)}px)${name.anchor === "start" ? "" : ` translateX(${name.anchor === "end" ? -100 : -50}%)`}`;
      if (name.far) leads += `M${p.x.toFixed(1)} ${p.y.toFixed(1)}L${x.toFixed(1)} ${y.toFixed(1)}`;
    });
    leaders.setAttribute("d", leads);
    const turned = (v: Vector3) => v.applyQuaternion(camera.quaternion.clone().invert());
    const axes = ["x", "y", "z"].map((name, k) => ({ name, v: turned(new Vector3(+(k === 0), +(k === 1), +(k === 2))) })).sort((a, b) => a.v.z - b.v.z);
    triad.innerHTML = `<svg viewBox="-44 -44 88 88">${axes.map(({ name, v }) =>
      `<g class="${name}"><path d="M0 0L${(28 * v.x).toFixed(1)} ${(-28 * v.y).toFixed(1)}"/><text x="${(37 * v.x).toFixed(1)}" y="${(4 - 37 * v.y).toFixed(1)}" text-anchor="middle"${Math.hypot(v.x, v.y) < 0.25 ? ' opacity="0"' : ""}>${name}</text></g>`).join("")}</svg>`;
  }

  function look(name: ViewName): void {
    view = name;
    const eye = viewpoints.find((v) => v.name === name)!.eye;
    const aspect = Math.max(0.2, host.clientWidth / Math.max(1, host.clientHeight));
    const { target, distance, halfHeight } = fit3(cloud, eye, (fov * Math.PI) / 180, aspect);
    const direction = new Vector3(...eye).normalize();
    controls.target.set(...target);
    perspective.position.copy(controls.target).addScaledVector(direction, distance);
    flat.position.copy(perspective.position);
    flat.zoom = 1;
    flat.userData.halfHeight = halfHeight;
    resize();
    controls.update();
    request();
  }

  function resize(): void {
    const [width, height] = [Math.max(1, host.clientWidth), Math.max(1, host.clientHeight)];
    const ratio = Math.min(2, devicePixelRatio);
    renderer?.setPixelRatio(ratio);
    renderer?.setSize(width, height);
    if (!renderer) {
      Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
      Object.assign(canvas.style, { width: `${width}px`, height: `${height}px` });
    }
    perspective.aspect = width / height;
    perspective.updateProjectionMatrix();
    const half = flat.userData.halfHeight ?? size;
    Object.assign(flat, { top: half, bottom: -half, left: (-half * width) / height, right: (half * width) / height });
    flat.updateProjectionMatrix();
    request();
  }

  /** The other camera shows what lies about the target at the same size. */
  function parallel(on: boolean): void {
    const next = on ? flat : perspective;
    if (next === camera) return;
    const tangent = Math.tan((fov * Math.PI) / 360);
    const way = camera.position.clone().sub(controls.target);
    if (on) {
      flat.zoom = flat.userData.halfHeight / (way.length() * tangent);
      flat.position.copy(camera.position);
    } else {
      const distance = flat.userData.halfHeight / flat.zoom / tangent;
      perspective.position.copy(controls.target).addScaledVector(way.normalize(), distance);
    }
    camera = next;
    controls.object = camera;
    camera.updateProjectionMatrix();
    controls.update();
    request();
  }

  // The object under the pointer: joints within a few pixels first, then whatever is hit.
  const ray = new Raycaster();
  function pickAt(event: PointerEvent): string {
    const frameOf = canvas.getBoundingClientRect();
    const [px, py] = [event.clientX - frameOf.left, event.clientY - frameOf.top];
    const onScreen = (p: Vector3) => {
      const q = p.clone().project(camera);
      return new Vector2(((q.x + 1) / 2) * frameOf.width, ((1 - q.y) / 2) * frameOf.height);
    };
    let best = "";
    let least = 12;
    joints.forEach((joint, i) => {
      const distance = joint.object.visible ? onScreen(joint.object.position).distanceTo(new Vector2(px, py)) : Infinity;
      if (distance < least) [least, best] = [distance, `joint ${i}`];
    });
    if (best) return best;
    aim(event);
    const meshes: Object3D[] = [...parts.map((p) => p.part.object), ...arrows.map((a) => a.object)].filter((o) => o.visible);
    const hits = ray.intersectObjects(meshes).filter((h) => (h.object as { isMesh?: boolean }).isMesh && !("isLineSegments2" in h.object));
    const owner = (object: Object3D | null): string => (object ? ((object.userData.pick as string | undefined) ?? owner(object.parent)) : "");
    const picks = hits.map((h) => owner(h.object));
    // A wheel is seen through: what lies in it comes first.
    return picks.find((p) => !p.startsWith("disc")) ?? picks[0] ?? "";
  }
  const aim = (event: PointerEvent) => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    ray.setFromCamera(new Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height), camera);
    return ray.ray;
  };
  // A held object comes before the turning of the view.
  let held: Plane | null = null;
  const down = (event: PointerEvent) => {
    const [kind, joint] = event.button === 0 ? pickAt(event).split(" ") : [];
    if (kind !== "joint" || !events.hold(Number(joint))) return;
    event.stopPropagation();
    const facing = camera.getWorldDirection(new Vector3());
    held = new Plane().setFromNormalAndCoplanarPoint(facing, joints[Number(joint)].object.position);
    host.setPointerCapture(event.pointerId);
  };
  const dragged = (event: PointerEvent) => {
    if (!held) return;
    event.stopPropagation();
    const to = aim(event).intersectPlane(held, new Vector3());
    if (to) events.drag({ x: to.x, y: to.y, z: to.z }, event.altKey);
  };
  const drop = (event: PointerEvent) => {
    if (!held) return;
    event.stopPropagation();
    held = null;
    events.drop();
  };
  const ended = new AbortController();
  for (const [name, run] of [["pointerdown", down], ["pointermove", dragged], ["pointerup", drop], ["pointercancel", drop]] as const)
    host.addEventListener(name, run, { capture: true, signal: ended.signal });
  let pressed: { x: number; y: number } | null = null;
  canvas.addEventListener("pointerdown", (event) => (pressed = event.button === 0 ? { x: event.clientX, y: event.clientY } : null));
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons === 0 && event.pointerType !== "touch") events.hover(pickAt(event));
  });
  canvas.addEventListener("pointerleave", () => events.hover(""));
  canvas.addEventListener("pointerup", (event) => {
    if (pressed && Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) < 5) events.pick(pickAt(event));
    pressed = null;
  });
  canvas.addEventListener("dblclick", () => look(view));
  // The wheel scrolls the page; with Ctrl it zooms, as in the plane.
  const wheel = (event: WheelEvent) => {
    if (!event.ctrlKey && !event.metaKey) event.stopPropagation();
  };
  host.addEventListener("wheel", wheel, { capture: true });
  controls.addEventListener("change", request);
  const observer = new ResizeObserver(resize);
  observer.observe(host);
  look(view);

  return {
    pose: (next, position) => {
      scene = next;
      at = position;
      request();
    },
    show: (next) => {
      shown = next;
      request();
    },
    look,
    parallel,
    turn: (right, above) => {
      controls.rotateLeft(-right);
      controls.rotateUp(-above);
      request();
    },
    move: (right, above) => {
      controls.pan(-right, above);
      request();
    },
    zoom: (factor) => {
      controls.dollyIn(1 / factor);
      request();
    },
    recolour: () => {
      palette.recolour();
      request();
    },
    picture: () => {
      draw();
      return new Promise((resolve, reject) => canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the picture could not be made")))));
    },
    frame: () => {
      cancelAnimationFrame(frame);  // the requested frame is drawn here
      draw();
      const [out, scale] = [document.createElement("canvas"), canvas.width / Math.max(1, host.clientWidth)];
      [out.width, out.height] = [canvas.width, canvas.height];
      const paint = out.getContext("2d")!;
      paint.drawImage(canvas, 0, 0);
      paint.scale(scale, scale);
      paint.textBaseline = "top";
      const { left, top } = host.getBoundingClientRect();
      for (const { element, text } of names) {
        if (element.hidden) continue;
        const [place, style] = [element.getBoundingClientRect(), getComputedStyle(element)];
        paint.font = `${style.fontStyle} ${style.fontSize} ${style.fontFamily}`;
        paint.fillStyle = style.color;
        paint.fillText(text, place.left - left, place.top - top);
      }
      return out;
    },
    close: () => {
      cancelAnimationFrame(frame);
      observer.disconnect();
      host.removeEventListener("wheel", wheel, { capture: true });
      ended.abort();
      controls.dispose();
      stage.traverse((o) => (o as { geometry?: { dispose(): void } }).geometry?.dispose());
      palette.dispose();
      renderer?.dispose();
      renderer?.forceContextLoss(); // browsers allow few of them at a time
      for (const element of [canvas, labels, triad]) element.remove();
    },
  };
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

