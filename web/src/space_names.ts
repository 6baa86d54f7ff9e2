// SPDX-License-Identifier: BSD-3-Clause

// Text over a spatial view: the names of joints and arrows beside their places, and the directions of the axes.
import { Vector3 } from "three";
import type { Scene } from "./data";
import { placeLabels, symbolOf } from "./labels";
import type { SpaceCamera } from "./space_camera";
import type { SpaceModel } from "./space_model";

interface Name {
  text: string;
  where: () => Vector3 | null;
  element: HTMLElement;
}

/** An element over the picture, which readers with aids do not meet. */
function layer(host: HTMLElement, kind: string): HTMLElement {
  const made = host.appendChild(document.createElement("div"));
  made.className = kind;
  made.setAttribute("aria-hidden", "true");
  return made;
}

export class SpaceNames {
  private readonly labels: HTMLElement;
  private readonly triad: HTMLElement;
  private readonly names: Name[];
  private readonly leaders: SVGPathElement;
  private readonly slots: number[] = []; // in which each name was

  constructor(private readonly host: HTMLElement, whole: Scene, model: SpaceModel) {
    this.labels = layer(host, "space-labels");
    this.triad = layer(host, "space-triad");
    this.names = [
      ...whole.joints.map(({ name, style }, i) => ({ text: name, kind: `joint ${style}`, object: model.joints[i].object, at: () => model.joints[i].object.position })),
      ...whole.vectors.map((v, i) => ({ text: symbolOf(whole, v), kind: `arrow ${v.quantity}`, object: model.arrows[i].object, at: () => model.tips[i] })),
    ].filter((n) => n.text).map(({ text, kind, object, at }) => {
      const element = this.labels.appendChild(document.createElement("span"));
      element.textContent = text;
      element.className = kind;
      element.dataset.name = text;
      return { text, element, where: () => (object.visible ? at() : null) };
    });
    const leaderLayer = this.labels.appendChild(document.createElementNS("http://www.w3.org/2000/svg", "svg"));
    this.leaders = leaderLayer.appendChild(document.createElementNS("http://www.w3.org/2000/svg", "path"));
    this.leaders.setAttribute("class", "leader");
  }

  /** Writes the names beside their places on the screen, with a leader to those that are further away, and the axes. */
  write(camera: SpaceCamera, shown: boolean): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    const places = this.names.map(({ where, text }) => {
      const p = shown ? where()?.clone().project(camera.now) : undefined;
      const inside = p && Math.abs(p.x) < 1 && Math.abs(p.y) < 1 && p.z < 1;
      return inside ? { x: ((p.x + 1) / 2) * width, y: ((1 - p.y) / 2) * height, text } : null;
    });
    const placed = placeLabels(places, this.slots);
    let leads = "";
    this.names.forEach(({ element }, i) => {
      const [p, name] = [places[i], placed[i]];
      element.hidden = !p || !name;
      if (!p || !name) return;
      this.slots[i] = name.slot;
      const [x, y] = [p.x + name.x, p.y + name.y];
      element.style.transform = `translate(${x.toFixed(1)}px,${(y - 11).toFixed(1)}px)${name.anchor === "start" ? "" : ` translateX(${name.anchor === "end" ? -100 : -50}%)`}`;
      if (name.far) leads += `M${p.x.toFixed(1)} ${p.y.toFixed(1)}L${x.toFixed(1)} ${y.toFixed(1)}`;
    });
    this.leaders.setAttribute("d", leads);
    this.triad.innerHTML = triadOf(camera);
  }

  /** Draws the names on a picture of the view, in px of the page. */
  drawOn(to: CanvasRenderingContext2D): void {
    to.textBaseline = "top";
    const { left, top } = this.host.getBoundingClientRect();
    for (const { element, text } of this.names) {
      if (element.hidden) continue;
      const [place, style] = [element.getBoundingClientRect(), getComputedStyle(element)];
      to.font = `${style.fontStyle} ${style.fontSize} ${style.fontFamily}`;
      to.fillStyle = style.color;
      to.fillText(text, place.left - left, place.top - top);
    }
  }

  close(): void {
    for (const element of [this.labels, this.triad]) element.remove();
  }
}

/** The three axes as they are turned; what is nearer is drawn later. */
function triadOf(camera: SpaceCamera): string {
  const axes = ["x", "y", "z"]
    .map((name, k) => ({ name, v: camera.seen(new Vector3(+(k === 0), +(k === 1), +(k === 2))) }))
    .sort((a, b) => a.v.z - b.v.z);
  return `<svg viewBox="-44 -44 88 88">${axes.map(({ name, v }) =>
    `<g class="${name}"><path d="M0 0L${(28 * v.x).toFixed(1)} ${(-28 * v.y).toFixed(1)}"/><text x="${(37 * v.x).toFixed(1)}" y="${(4 - 37 * v.y).toFixed(1)}" text-anchor="middle"${Math.hypot(v.x, v.y) < 0.25 ? ' opacity="0"' : ""}>${name}</text></g>`).join("")}</svg>`;
}
