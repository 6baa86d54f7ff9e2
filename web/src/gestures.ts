// SPDX-License-Identifier: BSD-3-Clause

// The gestures of every diagram, so that all of them are handled alike:
// drag = zoom into a box, Shift or the middle button and drag = move, Ctrl and wheel or two fingers = zoom, double click = all,
// click = fixed cursor. With the keyboard + and −, arrows while zoomed, 0, Enter and Escape.
import { boxed } from "./zoom";

export interface Spot {
  x: number; // px from the left edge of the element
  y: number; // px from its upper edge
}

export interface Gestures {
  zoomed: () => boolean;
  box: (from: Spot, to: Spot, done: boolean) => void;  // called as the box is drawn, and when it is done
  cancel: () => void; // a box that was begun is none
  zoom: (factor: number, about?: Spot) => void; // about the middle when not given
  move: (dx: number, dy: number) => void; // px by which the picture follows the pointer
  reset: () => void;
  click: (at: Spot) => void;
  mark: () => void; // sets the fixed cursor where the moving one is
  unmark: () => void;
}

export const gestureHint = "Drag: zoom. Shift + drag: move. Ctrl + wheel, or two fingers: zoom. Double click: show all. Click: fixed cursor A for differences, Escape removes it. With the keyboard: + − arrows 0, Enter, Escape.";

const least = 5; // px that make a press a drag

/** Listens on the element for pointers and on `keys` for the keyboard; gives back what ends that. */
export function listen(element: HTMLElement | SVGElement, keys: HTMLElement, on: Gestures): () => void {
  let press: { id: number; from: Spot; last: Spot; moves: boolean; far: boolean } | null = null;
  const drop = () => {
    press = null;
    on.cancel();
  };
  const fingers = new Map<number, Spot>();
  const ended = new AbortController();
  const { signal } = ended;
  const at = (event: MouseEvent): Spot => {
    const box = element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const listenTo = <E extends Event>(target: EventTarget, name: string, run: (event: E) => void, options: AddEventListenerOptions = {}) =>
    target.addEventListener(name, run as EventListener, { signal, ...options });

  listenTo<PointerEvent>(element, "pointerdown", (event) => {
    if (event.pointerType === "touch") {
      fingers.set(event.pointerId, at(event));
      if (fingers.size === 2) element.setPointerCapture(event.pointerId);
      return;
    }
    if (event.button > 1) return;
    if (event.button === 1) event.preventDefault(); // no scrolling by the middle button
    press = { id: event.pointerId, from: at(event), last: at(event), moves: event.button === 1 || event.shiftKey, far: false };
    element.setPointerCapture(event.pointerId);
  });
  listenTo<PointerEvent>(element, "pointermove", (event) => {
    const now = at(event);
    const before = fingers.get(event.pointerId);
    if (before && fingers.size === 2) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)![1];
      const [was, is] = [before, now].map((p) => Math.max(10, Math.hypot(p.x - other.x, p.y - other.y)));
      on.move((now.x - before.x) / 2, (now.y - before.y) / 2);
      on.zoom(is / was, { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 });
    }
    if (before) fingers.set(event.pointerId, now);
    if (!press || press.id !== event.pointerId) return;
    press.far ||= Math.hypot(now.x - press.from.x, now.y - press.from.y) >= least;
    if (!press.far) return;
    if (press.moves) on.move(now.x - press.last.x, now.y - press.last.y);
    else on.box(press.from, now, false);
    press.last = now;
  });
  listenTo<PointerEvent>(element, "pointerup", (event) => {
    fingers.delete(event.pointerId);
    if (!press || press.id !== event.pointerId) return;
    const { from, far, moves } = press;
    press = null;
    if (far && !moves) on.box(from, at(event), true);
  });
  listenTo<PointerEvent>(element, "pointercancel", (event) => {
    fingers.delete(event.pointerId);
    if (press?.id === event.pointerId) drop();
  });
  let far = false;  // true if the click that follows is the end of a drag
  listenTo<PointerEvent>(element, "pointerdown", () => (far = false));
  listenTo<PointerEvent>(element, "pointermove", () => (far ||= press?.far ?? false));
  listenTo<MouseEvent>(element, "click", (event) => !far && event.detail < 2 && on.click(at(event)));
  listenTo<MouseEvent>(element, "dblclick", () => {
    on.unmark(); // the first of the two clicks set it
    on.reset();
  });
  listenTo<WheelEvent>(element, "wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    on.zoom(Math.exp(-event.deltaY * 0.0025), at(event));
  }, { passive: false });
  listenTo<KeyboardEvent>(keys, "keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== keys) return;
    const step = 60; // px
    const arrows: Record<string, [number, number]> = { ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    if (event.key === "+" || event.key === "=") on.zoom(1.5);
    else if (event.key === "-") on.zoom(1 / 1.5);
    else if (event.key === "Enter") on.mark();
    else if (event.key === "Escape" && press) drop();
    else if (event.key === "Escape") on.unmark();
    else if (event.key === "0") on.reset();
    // While all is shown the arrows step through the motion, as elsewhere on the page.
    else if (arrows[event.key] && on.zoomed()) on.move(...arrows[event.key]);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  return () => ended.abort();
}

/** The edges of a box in an element of a size: along an axis that the drag does not choose it is as long as the element. */
export function boxWithin(from: Spot, to: Spot, width: number, height: number) {
  const along = boxed(to.x - from.x, to.y - from.y);
  const span = (a: number, b: number, most: number) => [Math.max(0, Math.min(a, b)), Math.min(most, Math.max(a, b))];
  const [left, right] = along.x ? span(from.x, to.x, width) : [0, width];
  const [top, bottom] = along.y ? span(from.y, to.y, height) : [0, height];
  return { along, left, right, top, bottom };
}
