// SPDX-License-Identifier: BSD-3-Clause

// A diagram over one input as it is drawn on the page: uPlot with the gestures and the two cursors of every diagram.
import { effect, type Signal } from "@preact/signals";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { axisOf, bandsOf, drawn, numberOf, seriesOf, valueText, withUnit, type Curve, type Look, type Side } from "./chart_options";
import type { Num } from "./data";
import { boxWithin, listen, type Gestures } from "./gestures";
import { logRange } from "./logarithm";
import { mostNamed, type Choice } from "./look";
import { nearestRow } from "./rows";
import * as state from "./state";
import { format } from "./units";
import { between, nearer, shifted, type Peak, type Range } from "./zoom";

/** The link between the x of a diagram and an input of the scene, which follow each other. */
export interface Link {
  now: () => number;
  go: (x: number) => void;
}

/** The content of a diagram. */
export interface Shown {
  data: uPlot.AlignedData;
  curves: Curve[]; // one for each list of the data after x
  x: Side;
  y: Side;
  link?: Link; // x is an input of the scene shown
  present?: () => number; // group that is shown in the scene; -1 = none
  presentName?: (group: number) => string;
  baseline?: string; // name of what is drawn behind
  pick?: (row: number) => void; // a click at a row of the data
  range?: (low: number, high: number) => Range; // range of y
  upright?: boolean; // x points up
}

/** The part of the content that is chosen. */
export interface Chosen {
  choice: Choice; // curves with a look of their own
  own: number[]; // curves among which it chooses
  peak: Peak | null; // peak that is left out
  height: number; // px
}

/** State that outlives a plot, which is made again with new data or another choice. */
export interface Kept {
  zoom: { x: Range | null; y: Range | null; of: string };
  mark: Signal<number | null>; // x of the fixed cursor
  values: Map<number, HTMLElement>; // in the legend, by curve
  marked: { current: HTMLElement | null }; // description of the fixed cursor
  setZoomed: (on: boolean) => void;
}

/** The value of a list at a row, or next to it where lines of several inputs have none of their own. */
function valueAt(values: (Num | undefined)[], row: number): Num {
  for (let k = 0; k < values.length; ++k) {
    if (values[row - k] !== undefined) return values[row - k]!;
    if (values[row + k] !== undefined) return values[row + k]!;
  }
  return null;
}

/** An element over a plot, inside of its axes. */
function layer(u: uPlot, kind: string): HTMLElement {
  const made = u.over.appendChild(document.createElement("div"));
  made.className = kind;
  return made;
}

const nothing = { left: 0, top: 0, width: 0, height: 0 };

export class ChartPlot {
  private plot: uPlot | undefined;
  private gestures: Gestures | null = null;
  private stopListening = () => {};
  private ended = new AbortController();
  private marker: HTMLElement | null = null;
  private fixed: HTMLElement | null = null;
  private name: HTMLElement | null = null;
  private inside = false;
  private pressed = false;
  private inSight = true;
  private pointed: number | null = null; // series that is pointed at
  private group: number; // group that is shown in the scene
  private readonly xs: number[];
  private readonly whole: Record<"x" | "y", Range> = { x: [0, 1], y: [0, 1] };
  private readonly bundle: boolean;
  private readonly stops: (() => void)[];

  constructor(private readonly element: HTMLElement, private readonly shown: Shown, private readonly chosen: Chosen, private readonly kept: Kept) {
    this.group = shown.present?.() ?? -1;
    this.bundle = chosen.own.length > mostNamed;
    this.xs = shown.data[0] as number[];
    const of = `${this.xs[0]} ${this.xs[this.xs.length - 1]}`;
    if (kept.zoom.of !== of) {
      Object.assign(kept.zoom, { x: null, y: null, of });
      kept.setZoomed(false);
    }
    this.stops = [...this.follow(), ...this.watch()];
  }

  /** Shows all of the diagram. */
  reset(): void {
    this.gestures?.reset();
  }

  close(): void {
    if (this.inside && this.shown.link) state.held.value = false;
    for (const stop of this.stops) stop();
    this.ended.abort();
    this.stopListening();
    this.plot?.destroy();
  }

  /** Follows the colours of the page, the motion and the fixed cursor. */
  private follow(): (() => void)[] {
    return [
      effect(() => {
        state.theme.value;
        this.build();
      }),
      effect(() => {
        state.position.value;
        state.row.value;
        state.playing.value; // at rest it is right out of sight, too
        this.update();
      }),
      effect(() => {
        this.kept.mark.value;
        queueMicrotask(() => this.update()); // after the legend is written
      }),
    ];
  }

  /** Watches the size of the element, and whether it is in sight. */
  private watch(): (() => void)[] {
    const { element } = this;
    const sizes = new ResizeObserver(() => {
      if (!this.plot || !element.clientWidth || element.clientWidth === this.plot.width) return;
      this.plot.setSize({ width: element.clientWidth, height: this.chosen.height });
      this.update();
    });
    sizes.observe(element);
    const sight = new IntersectionObserver((seen) => {
      this.inSight = seen[seen.length - 1].isIntersecting;
      this.update();
    });
    sight.observe(element.closest(".plot") ?? element);
    return [() => sizes.disconnect(), () => sight.disconnect()];
  }

  private build(): void {
    const { data, link, upright } = this.shown;
    this.ended.abort();
    this.stopListening();
    this.plot?.destroy();
    const u = (this.plot = new uPlot(this.options(), data, this.element));
    this.whole.x = [this.xs[0] ?? 0, this.xs[this.xs.length - 1] ?? 1];
    if (!(this.whole.x[1] > this.whole.x[0])) this.whole.x = [u.scales.x.min ?? 0, u.scales.x.max ?? 1];
    let [low, high] = [Infinity, -Infinity];
    for (const list of data.slice(1)) for (const v of list) if (v !== null && v !== undefined) [low, high] = [Math.min(low, v), Math.max(high, v)];
    this.whole.y = low <= high ? this.rangeOf(low, high) : [0, 1];
    this.name = layer(u, "curve-name");
    this.name.hidden = true;
    this.marker = link ? layer(u, upright ? "now level" : "now") : null;
    this.fixed = layer(u, upright ? "fixed level" : "fixed");
    this.ended = new AbortController();
    this.listenToPointer(u);
    this.gestures = this.gesturesOf(u);
    this.stopListening = listen(u.over, this.element, this.gestures);
    queueMicrotask(() => this.update()); // after the scales are set
  }

  private options(): uPlot.Options {
    const { curves, x, y, upright = false, link, present } = this.shown;
    const { zoom } = this.kept;
    const printing = state.printing.peek();
    return {
      // Three plots stand side by side on an A4 page, in two rows; its layout comes too late to be measured.
      width: printing ? 300 : this.element.clientWidth || 500,
      height: printing ? 160 : this.chosen.height,
      legend: { show: false },
      scales: {
        x: { time: false, ori: upright ? 1 : 0, range: (_, low, high) => zoom.x ?? [low, high] },
        y: { ori: upright ? 0 : 1, range: (_, low, high) => zoom.y ?? this.rangeWithoutPeak(low, high) },
      },
      axes: [axisOf(x, upright, this.chosen.height), axisOf(y, !upright, this.chosen.height)],
      series: [{}, ...curves.map((c, i) => seriesOf(c, () => this.lookAt(i)))],
      bands: bandsOf(curves),
      focus: { alpha: 1 },
      cursor: {
        drag: { setScale: false, x: false, y: false },
        bind: { dblclick: () => null },
        x: !upright, y: upright,
        points: { size: 7, show: !this.bundle && !present && curves.every((c) => c.kind === "curve") },
        focus: { prox: this.chosen.own.length > 1 || curves.some((c) => c.kind === "baseline") ? 24 : -1 },
      },
      hooks: {
        setCursor: [
          (u) => {
            if (!link) this.update();
            this.nameCurve(u);
          },
        ],
        setSeries: [
          (u, curve) => {
            if (this.pointed === curve) return;
            this.pointed = curve;
            this.restyle();
            this.nameCurve(u);
          },
        ],
      },
    };
  }

  private rangeOf(low: number | null, high: number | null): Range {
    const { y, range } = this.shown;
    if (y.log) return logRange(low, high);
    if (low === null || high === null) return [0, 1];
    return range ? range(low, high) : (uPlot.rangeNum(low, high, 0.1, true) as Range);
  }

  private rangeWithoutPeak(low: number | null, high: number | null): Range {
    const { peak } = this.chosen;
    return peak && low !== null && high !== null ? this.rangeOf(Math.max(low, peak.low), Math.min(high, peak.high)) : this.rangeOf(low, high);
  }

  private lookAt(i: number): Look {
    const { choice, own } = this.chosen;
    return drawn(this.shown.curves[i], choice.get(own.indexOf(i)), this.bundle, choice.size > 0, this.group, this.pointed === i + 1);
  }

  private restyle(): void {
    const { plot } = this;
    if (!plot) return;
    this.shown.curves.forEach((c, i) => {
      if (c.kind !== "curve" && c.kind !== "baseline") return;
      const { width, alpha, dash } = this.lookAt(i);
      Object.assign(plot.series[i + 1], { width: c.points ? 0 : width, alpha, dash });
    });
    plot.redraw(false);
  }

  private listenToPointer(u: uPlot): void {
    const { link, upright } = this.shown;
    const { signal } = this.ended;
    const hold = (on: boolean) => {
      this.inside = on;
      if (link) state.held.value = on;
    };
    u.over.addEventListener("pointerenter", () => hold(true), { signal });
    u.over.addEventListener("pointerleave", () => {
      hold(false);
      this.pointed = null;
      this.restyle();
      this.nameCurve(u);
      this.update();
    }, { signal });
    u.over.addEventListener("pointermove", (event) => {
      if (this.pressed || !event.isPrimary) return;
      const at = u.over.getBoundingClientRect();
      const place = { left: event.clientX - at.left, top: event.clientY - at.top };
      link?.go(u.posToVal(upright ? place.top : place.left, "x"));
      if (event.pointerType !== "mouse") u.setCursor(place); // uPlot does it for a mouse
    }, { signal });
  }

  private gesturesOf(u: uPlot): Gestures {
    const { whole, xs } = this;
    const { upright, pick } = this.shown;
    const { zoom, mark } = this.kept;
    const [across, up] = upright ? (["y", "x"] as const) : (["x", "y"] as const);
    const shownRange = (key: "x" | "y"): Range => zoom[key] ?? [u.scales[key].min!, u.scales[key].max!];
    return {
      zoomed: () => zoom.x !== null || zoom.y !== null,
      box: (from, to, done) => {
        const { along, left, right, top, bottom } = boxWithin(from, to, u.over.clientWidth, u.over.clientHeight);
        this.pressed = !done;
        u.setSelect(done ? nothing : { left, top, width: right - left, height: bottom - top }, false);
        if (!done) return;
        const next = { [across]: along.x && between(u.posToVal(left, across), u.posToVal(right, across), whole[across]), [up]: along.y && between(u.posToVal(bottom, up), u.posToVal(top, up), whole[up]) };
        for (const key of ["x", "y"] as const) if (next[key] !== false) zoom[key] = next[key] as Range | null;
        this.applyZoom(u);
      },
      cancel: () => {
        this.pressed = false;
        u.setSelect(nothing, false);
      },
      zoom: (factor, about) => {
        const at = about ?? { x: u.over.clientWidth / 2, y: u.over.clientHeight / 2 };
        const next = { [across]: u.posToVal(at.x, across), [up]: u.posToVal(at.y, up) };
        for (const key of ["x", "y"] as const) zoom[key] = nearer(shownRange(key), whole[key], next[key], factor);
        this.applyZoom(u);
      },
      move: (dx, dy) => {
        const by = { [across]: -dx / u.over.clientWidth, [up]: dy / u.over.clientHeight };
        for (const key of ["x", "y"] as const) zoom[key] = zoom[key] && shifted(zoom[key]!, whole[key], by[key]);
        this.applyZoom(u);
      },
      reset: () => {
        zoom.x = zoom.y = null;
        this.applyZoom(u);
      },
      click: (at) => {
        if (pick) typeof u.cursor.idx === "number" && pick(u.cursor.idx);
        else mark.value = xs[nearestRow(xs, u.posToVal(upright ? at.y : at.x, "x"))] ?? null;
      },
      mark: () => (mark.value = xs[nearestRow(xs, this.here() ?? whole.x[0])] ?? null),
      unmark: () => (mark.value = null),
    };
  }

  private applyZoom(u: uPlot): void {
    const { x, y } = this.kept.zoom;
    const [min, max] = x ?? this.whole.x;
    u.setScale("x", { min, max }); // and y after it
    this.kept.setZoomed(x !== null || y !== null);
    queueMicrotask(() => this.update());
  }

  /** Writes the name and the value of the curve that is pointed at, beside the pointer. */
  private nameCurve(u: uPlot): void {
    const { name, pointed } = this;
    if (!name) return;
    const { left = -1, top = -1, idx } = u.cursor;
    const curve = pointed === null ? undefined : this.shown.curves[pointed - 1];
    name.hidden = !curve || left < 0 || curve.kind === "edge";
    if (name.hidden) return;
    const value = typeof idx === "number" ? valueAt(this.shown.data[pointed!] as Num[], idx) : null;
    name.textContent = `${curve!.kind === "baseline" ? `${this.shown.baseline}: ` : ""}${curve!.name}${value === null ? "" : `: ${this.text(value)}${this.difference(pointed! - 1, value)}`}`;
    name.style.transform = `translate(${left > u.over.clientWidth / 2 ? `calc(${left - 10}px - 100%)` : `${left + 10}px`}, ${Math.max(0, top - 30)}px)`;
  }

  private text = (value: Num) => valueText(value, this.shown.y);

  /** The value of a curve at a row. */
  private value = (i: number, row: number) => valueAt(this.shown.data[i + 1] as Num[], row);

  /** Position of the moving cursor on the x axis; null = there is none. */
  private here(): number | null {
    const { plot } = this;
    const { link, upright } = this.shown;
    if (link) return link.now();
    const at = plot && this.inside ? (upright ? plot.cursor.top : plot.cursor.left) ?? -1 : -1;
    return at < 0 ? null : plot!.posToVal(at, "x");
  }

  /** Difference of a value from that of its curve at the fixed cursor. */
  private difference(i: number, value: Num): string {
    const mark = this.kept.mark.peek();
    if (mark === null) return "";
    const { y } = this.shown;
    const [a, b] = [numberOf(this.value(i, nearestRow(this.xs, mark)), y), numberOf(value, y)];
    return a === null || b === null ? "" : ` (Δ ${withUnit(format(b - a, 5), y.symbol)})`;
  }

  private put(line: HTMLElement | null, at: number | null): void {
    const { plot } = this;
    if (!line || !plot) return;
    const [low, high] = [plot.scales.x.min ?? 0, plot.scales.x.max ?? 0];
    const room = 1e-9 * (high - low);
    line.hidden = at === null || at < low - room || at > high + room;
    if (!line.hidden) line.style.transform = `translate${this.shown.upright ? "Y" : "X"}(${plot.valToPos(at!, "x").toFixed(1)}px)`;
  }

  /** Puts the cursors and their values where the motion and the pointer are. */
  private update(): void {
    // While a mechanism moves, most of a frame would go into diagrams that nobody sees.
    if (!this.plot || (!this.inSight && state.playing.peek())) return;
    const { present, presentName } = this.shown;
    const now = present?.() ?? -1;
    if (now !== this.group) {
      this.group = now;
      this.restyle();
    }
    if (presentName) this.element.dataset.present = presentName(this.group);
    const [at, mark] = [this.here(), this.kept.mark.peek()];
    this.put(this.marker, at);
    this.put(this.fixed, mark);
    this.kept.values.forEach((span, i) => {
      if (at !== null && nearestRow(this.xs, at) >= 0) {
        const value = this.value(i, nearestRow(this.xs, at));
        span.textContent = this.text(value) + this.difference(i, value);
      } else span.textContent = mark === null ? "" : this.text(this.value(i, nearestRow(this.xs, mark)));
    });
    const { current: marked } = this.kept.marked;
    if (!marked || mark === null) return;
    const xText = (v: number) => withUnit(format(v, 5), this.shown.x.symbol);
    marked.textContent = `A ${xText(mark)}${at === null ? "" : ` → B ${xText(at)}: Δ ${xText(at - mark)}`}`;
  }
}
