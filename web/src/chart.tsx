// A diagram with curves over one input: uPlot, with the gestures, the legend and the two cursors of every diagram.
import { effect, useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Num } from "./data";
import { boxWithin, gestureHint, listen, type Gestures } from "./gestures";
import { logRange, logTicks } from "./logarithm";
import { chosen, firstChoice, lookOf, mostNamed, type Choice } from "./look";
import { nearestRow } from "./rows";
import * as state from "./state";
import { format } from "./units";
import { between, degreeSteps, nearer, peakOf, shifted, type Range } from "./zoom";

const css = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export interface Curve {
  name: string;
  kind: "curve" | "edge" | "baseline" | "bars"; // edges come in pairs, the lower one first
  points?: boolean;
  stepped?: boolean;
  group?: number;
}

export interface Side {
  label: string;
  symbol: string;  // symbol of its unit
  log?: boolean; // the data are logarithms
}

/** The link between the x of a diagram and an input of the scene, which follow each other. */
export interface Link {
  now: () => number;
  go: (x: number) => void;
}

interface Props {
  label: string;
  data: uPlot.AlignedData;
  curves: Curve[]; // one for each list of the data after x
  x: Side;
  y: Side;
  link?: Link; // x is an input of the scene shown
  present?: () => number; // group that is shown in the scene; -1 = none
  presentName?: (group: number) => string;
  baseline?: string; // name of what is drawn behind
  family?: boolean; // many curves are one family, without names until they are chosen
  pick?: (row: number) => void; // a click at a row of the data
  range?: (low: number, high: number) => Range;  // zoomed range of y
  upright?: boolean; // x points up
}

const withUnit = (text: string, symbol: string) => (symbol ? `${text} ${symbol}` : text);
const fits = (label: string, height: number) => 6.4 * label.length <= height - 50;

function axisOf(side: Side, up: boolean, height: number): uPlot.Axis {
  return {
    // Beside the values stands the label where the diagram is high enough for it, else the unit, for the legend has the name.
    label: !up || fits(side.label, height) ? side.label : side.symbol,
    side: up ? 3 : 2,
    labelSize: 20,
    labelFont: "12px system-ui, sans-serif",
    font: "11px system-ui, sans-serif",
    stroke: () => css("--soft"),
    grid: { stroke: () => css("--faint"), width: 1 },
    ticks: { stroke: () => css("--line"), width: 1, size: 5 },
    ...(side.log ? { splits: (_: uPlot, __: number, low: number, high: number) => logTicks(low, high) } : {}),
    ...(side.symbol === "°" ? { incrs: degreeSteps } : {}),
    values: (_, ticks) => ticks.map((t) => (t === null ? "" : format(side.log ? 10 ** t : t, 5))),
    size: (_, values) => (up ? Math.max(40, 14 + 6.4 * (values ?? []).reduce((n, v) => Math.max(n, v.length), 0)) : 30),
  };
}

/** Sign of a curve in a legend: a line, points, or an area. */
export function Sign({ look, points }: { look: { stroke: string; dash: number[] }; points?: boolean }) {
  const stroke = `var(${look.stroke})`;
  return (
    <svg viewBox="0 0 24 6" aria-hidden="true">
      {points ? <circle cx="12" cy="3" r="3" style={{ fill: stroke }} /> : <path d="M0 3H24" style={{ stroke, strokeDasharray: look.dash.join(" ") }} />}
    </svg>
  );
}

/** Chooses the curves of a bundle that have a look and a name of their own. */
export function Chooser({ names, choice, choose }: { names: string[]; choice: Choice; choose: (choice: Choice) => void }): JSX.Element {
  const all = () => names.reduce<Choice>((c, _, i) => chosen(c, i, true), new Map());
  return (
    <details class="chooser">
      <summary>{`${names.length} curves, ${choice.size} with a name; `}<span class="screen-only">point at one, or choose</span></summary>
      <div class="buttons">
        <button type="button" onClick={() => choose(all())}>all</button>
        <button type="button" onClick={() => choose(new Map())}>none</button>
        <button type="button" onClick={() => choose(firstChoice(names.length, false))}>first six</button>
      </div>
      <div class="names">
        {names.map((name, i) => (
          <label><input type="checkbox" checked={choice.has(i)} onChange={(e) => choose(chosen(choice, i, e.currentTarget.checked))} />{name}</label>
        ))}
      </div>
    </details>
  );
}

/** The choice among curves; it holds as long as they have the same names. */
export function useChoice(names: string[], family: boolean): [Choice, (choice: Choice) => void] {
  const key = names.join("\n");
  const [kept, keep] = useState<{ key: string; choice: Choice } | null>(null);
  const choice = useMemo(() => (kept?.key === key ? kept.choice : firstChoice(names.length, family)), [key, kept, family]);
  return [choice, (choice) => keep({ key, choice })];
}

export const Reset = ({ onClick }: { onClick: () => void }) => <button type="button" class="reset screen-only" title="Show all of the diagram (0 or double click)" onClick={onClick}>Reset</button>;

/** The fixed cursor in words, and what removes it. */
export const Mark = ({ children, remove }: { children: JSX.Element; remove: () => void }) => (
  <p class="mark-line" role="status">{children}<button type="button" class="screen-only" aria-label="Remove the fixed cursor A" title="Remove the fixed cursor (Escape)" onClick={remove}>×</button></p>
);

interface Look {
  stroke: string;
  dash: number[];
  width: number;
  alpha: number;
}

/** The look of a curve when the group `now` is present and the curve `told` is pointed at. */
function drawn(curve: Curve, look: number | undefined, bundle: boolean, anyNamed: boolean, now: number, told: boolean): Look {
  const here = now < 0 || curve.group === now;
  if (curve.kind === "baseline") return { stroke: "--soft", dash: [5, 4], width: told ? 2.4 : 1.4, alpha: here || told ? 0.85 : bundle ? 0.12 : 0.35 };
  const width = told ? 3.4 : now < 0 ? 2 : here ? 3 : 1.4;
  if (look !== undefined) return { ...lookOf(look), width, alpha: here || told ? 1 : 0.7 };
  if (told || (here && now >= 0)) return { stroke: "--accent", dash: [], width, alpha: 1 };
  return { stroke: anyNamed ? "--soft" : "--accent", dash: [], width: now < 0 ? 1.5 : 1.4, alpha: here ? 0.5 : 0.3 };
}

/** The value of a list at a row, or next to it where lines of several inputs have none of their own. */
function valueAt(values: (Num | undefined)[], row: number): Num {
  for (let k = 0; k < values.length; ++k) {
    if (values[row - k] !== undefined) return values[row - k]!;
    if (values[row + k] !== undefined) return values[row + k]!;
  }
  return null;
}

export function Chart({ label, data, curves, x, y, link, present, presentName, baseline, family = false, pick, range, upright = false }: Props) {
  const height = upright ? 340 : 230;
  const box = useRef<HTMLDivElement>(null);
  const values = useRef(new Map<number, HTMLElement>());
  const zoom = useRef<{ x: Range | null; y: Range | null; of: string }>({ x: null, y: null, of: "" });
  const gestures = useRef<Gestures | null>(null);
  const [zoomed, setZoomed] = useState(false);
  const [withPeak, setWithPeak] = useState(false);
  const mark = useSignal<number | null>(null);
  const marked = useRef<HTMLSpanElement>(null);
  const own = useMemo(() => curves.flatMap((c, i) => (c.kind === "curve" ? [i] : [])), [curves]);
  const names = own.map((i) => curves[i].name);
  const [choice, choose] = useChoice(names, family);
  const bundle = own.length > mostNamed;
  const peak = useMemo(() => (y.log || curves.some((c) => c.kind === "bars" || c.points) ? null : peakOf(own.map((i) => data[i + 1] as Num[]))), [data, curves]);
  const valueText = (value: Num | undefined) => withUnit(format(y.log && typeof value === "number" ? 10 ** value : value ?? null, 5), y.symbol);
  const numberOf = (value: Num) => (value !== null && y.log ? 10 ** value : value);

  useEffect(() => {
    const element = box.current!;
    let plot: uPlot | undefined;
    let stopListening = () => {};
    let marker: HTMLElement | null = null;
    let fixed: HTMLElement | null = null;
    let name: HTMLElement | null = null;
    let inside = false;
    let pressed = false;
    let told: number | null = null; // series that is pointed at
    let group = present?.() ?? -1;
    const xs = data[0] as number[];
    const whole: Record<"x" | "y", Range> = { x: [0, 1], y: [0, 1] };
    const [across, up] = upright ? (["y", "x"] as const) : (["x", "y"] as const);
    const of = `${xs[0]} ${xs[xs.length - 1]}`;
    if (zoom.current.of !== of) {
      zoom.current = { x: null, y: null, of };
      setZoomed(false);
    }

    const lookAt = (i: number) => drawn(curves[i], choice.get(own.indexOf(i)), bundle, choice.size > 0, group, told === i + 1);
    const restyle = () => {
      if (!plot) return;
      curves.forEach((c, i) => {
        if (c.kind !== "curve" && c.kind !== "baseline") return;
        const { width, alpha, dash } = lookAt(i);
        Object.assign(plot!.series[i + 1], { width: c.points ? 0 : width, alpha, dash });
      });
      plot.redraw(false);
    };
    const series = (c: Curve, i: number): uPlot.Series => {
      if (c.kind === "edge") return { stroke: "transparent", width: 0, points: { show: false } };
      if (c.kind === "bars") return { fill: css("--c0"), stroke: css("--c0"), width: 0, paths: uPlot.paths.bars!({ size: [0.92] }), points: { show: false } };
      const { width, alpha, dash } = lookAt(i);
      const stroke = () => css(lookAt(i).stroke);
      return {
        stroke, dash, alpha, width: c.points ? 0 : width, pxAlign: 0, spanGaps: c.stepped,
        paths: c.points ? () => null : c.stepped ? uPlot.paths.stepped!({ align: 1 }) : undefined,
        points: { show: c.points ?? false, size: 7, fill: stroke },
      };
    };
    const base = (low: number | null, high: number | null): Range =>
      y.log ? logRange(low, high) : low === null || high === null ? [0, 1] : range ? range(low, high) : (uPlot.rangeNum(low, high, 0.1, true) as Range);
    const rangeOfY = (low: number | null, high: number | null): Range => {
      if (zoom.current.y) return zoom.current.y;
      return peak && !withPeak && low !== null && high !== null ? base(Math.max(low, peak.low), Math.min(high, peak.high)) : base(low, high);
    };
    const options = (): uPlot.Options => ({
      // Three plots stand side by side on an A4 page, in two rows; its layout comes too late to be measured.
      width: state.printing.peek() ? 300 : element.clientWidth || 500,
      height: state.printing.peek() ? 160 : height,
      legend: { show: false },
      scales: {
        x: { time: false, ori: upright ? 1 : 0, range: (_, low, high) => zoom.current.x ?? [low, high] },
        y: { ori: upright ? 0 : 1, range: (_, low, high) => rangeOfY(low, high) },
      },
      axes: [axisOf(x, upright, height), axisOf(y, !upright, height)],
      series: [{}, ...curves.map(series)],
      bands: curves.flatMap((c, i) => (c.kind === "edge" && curves.slice(0, i).filter((e) => e.kind === "edge").length % 2 === 1 ? [{ series: [i + 1, i] as [number, number], fill: `${css("--good")}30` }] : [])),
      focus: { alpha: 1 },
      cursor: {
        drag: { setScale: false, x: false, y: false },
        bind: { dblclick: () => null },
        x: !upright, y: upright,
        points: { size: 7, show: !bundle && !present && curves.every((c) => c.kind === "curve") },
        focus: { prox: own.length > 1 || curves.some((c) => c.kind === "baseline") ? 24 : -1 },
      },
      hooks: {
        setCursor: [
          (u) => {
            if (!link) update();
            tell(u);
          },
        ],
        setSeries: [
          (u, curve) => {
            if (told === curve) return;
            told = curve;
            restyle();
            tell(u);
          },
        ],
      },
    });
    const added = (u: uPlot, kind: string) => {
      const made = u.over.appendChild(document.createElement("div"));
      made.className = kind;
      return made;
    };
    const build = () => {
      stopListening();
      plot?.destroy();
      plot = new uPlot(options(), data, element);
      const u = plot;
      whole.x = [xs[0] ?? 0, xs[xs.length - 1] ?? 1];
      if (!(whole.x[1] > whole.x[0])) whole.x = [u.scales.x.min ?? 0, u.scales.x.max ?? 1];
      let [low, high] = [Infinity, -Infinity];
      for (const list of data.slice(1)) for (const v of list) if (v !== null && v !== undefined) [low, high] = [Math.min(low, v), Math.max(high, v)];
      whole.y = low <= high ? base(low, high) : [0, 1];
      name = added(u, "curve-name");
      name.hidden = true;
      marker = link ? added(u, upright ? "now level" : "now") : null;
      fixed = added(u, upright ? "fixed level" : "fixed");
      const { signal } = (ended = new AbortController());
      u.over.addEventListener("pointerenter", () => {
        inside = true;
        if (link) state.held.value = true;
      }, { signal });
      u.over.addEventListener("pointerleave", () => {
        inside = false;
        if (link) state.held.value = false;
        told = null;
        restyle();
        tell(u);
        update();
      }, { signal });
      u.over.addEventListener("pointermove", (event) => {
        if (pressed || !event.isPrimary) return;
        const at = u.over.getBoundingClientRect();
        const place = { left: event.clientX - at.left, top: event.clientY - at.top };
        link?.go(u.posToVal(upright ? place.top : place.left, "x"));
        if (event.pointerType !== "mouse") u.setCursor(place);  // uPlot does this for a mouse
      }, { signal });
      gestures.current = gesturesOf(u);
      stopListening = listen(u.over, element, gestures.current);
      queueMicrotask(update); // after the scales are set
    };
    let ended = new AbortController();

    const apply = (u: uPlot) => {
      const { x: nx, y: ny } = zoom.current;
      u.setScale("x", { min: (nx ?? whole.x)[0], max: (nx ?? whole.x)[1] }); // and y after it
      setZoomed(nx !== null || ny !== null);
      queueMicrotask(update);
    };
    const shownRange = (u: uPlot, key: "x" | "y"): Range => zoom.current[key] ?? [u.scales[key].min!, u.scales[key].max!];
    const gesturesOf = (u: uPlot): Gestures => ({
      zoomed: () => zoom.current.x !== null || zoom.current.y !== null,
      box: (from, to, done) => {
        const { along, left, right, top, bottom } = boxWithin(from, to, u.over.clientWidth, u.over.clientHeight);
        pressed = !done;
        u.setSelect(done ? { left: 0, top: 0, width: 0, height: 0 } : { left, top, width: right - left, height: bottom - top }, false);
        if (!done) return;
        const next = { [across]: along.x && between(u.posToVal(left, across), u.posToVal(right, across), whole[across]), [up]: along.y && between(u.posToVal(bottom, up), u.posToVal(top, up), whole[up]) };
        for (const key of ["x", "y"] as const) if (next[key] !== false) zoom.current[key] = next[key] as Range | null;
        apply(u);
      },
      cancel: () => {
        pressed = false;
        u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      },
      zoom: (factor, about) => {
        const at = about ?? { x: u.over.clientWidth / 2, y: u.over.clientHeight / 2 };
        const next = { [across]: u.posToVal(at.x, across), [up]: u.posToVal(at.y, up) };
        for (const key of ["x", "y"] as const) zoom.current[key] = nearer(shownRange(u, key), whole[key], next[key], factor);
        apply(u);
      },
      move: (dx, dy) => {
        const by = { [across]: -dx / u.over.clientWidth, [up]: dy / u.over.clientHeight };
        for (const key of ["x", "y"] as const) zoom.current[key] = zoom.current[key] && shifted(zoom.current[key]!, whole[key], by[key]);
        apply(u);
      },
      reset: () => {
        zoom.current.x = zoom.current.y = null;
        apply(u);
      },
      click: (at) => {
        if (pick) typeof u.cursor.idx === "number" && pick(u.cursor.idx);
        else mark.value = xs[nearestRow(xs, u.posToVal(upright ? at.y : at.x, "x"))] ?? null;
      },
      mark: () => (mark.value = xs[nearestRow(xs, here() ?? whole.x[0])] ?? null),
      unmark: () => (mark.value = null),
    });

    /** Name and value of the curve that is pointed at, beside the pointer. */
    const tell = (u: uPlot) => {
      if (!name) return;
      const { left = -1, top = -1, idx } = u.cursor;
      const curve = told === null ? undefined : curves[told - 1];
      name.hidden = !curve || left < 0 || curve.kind === "edge";
      if (name.hidden) return;
      const value = typeof idx === "number" ? valueAt(data[told!] as Num[], idx) : null;
      name.textContent = `${curve!.kind === "baseline" ? `${baseline}: ` : ""}${curve!.name}${value === null ? "" : `: ${valueText(value)}${difference(told! - 1, value)}`}`;
      name.style.transform = `translate(${left > u.over.clientWidth / 2 ? `calc(${left - 10}px - 100%)` : `${left + 10}px`}, ${Math.max(0, top - 30)}px)`;
    };
    /** The position of the moving cursor; null = nowhere. */
    const here = (): number | null => {
      if (link) return link.now();
      const at = plot && inside ? (upright ? plot.cursor.top : plot.cursor.left) ?? -1 : -1;
      return at < 0 ? null : plot!.posToVal(at, "x");
    };
    /** The value at B less that at A. */
    const difference = (i: number, value: Num): string => {
      if (mark.peek() === null) return "";
      const [a, b] = [numberOf(valueAt(data[i + 1] as Num[], nearestRow(xs, mark.peek()!))), numberOf(value)];
      return a === null || b === null ? "" : ` (Δ ${withUnit(format(b - a, 5), y.symbol)})`;
    };
    const put = (line: HTMLElement | null, at: number | null) => {
      if (!line || !plot) return;
      const [low, high] = [plot.scales.x.min ?? 0, plot.scales.x.max ?? 0];
      const room = 1e-9 * (high - low);
      line.hidden = at === null || at < low - room || at > high + room;
      if (!line.hidden) line.style.transform = `translate${upright ? "Y" : "X"}(${plot.valToPos(at!, "x").toFixed(1)}px)`;
    };
    let inSight = true;
    const update = () => {
      // While a mechanism moves, most of a frame would go into diagrams that nobody sees.
      if (!plot || (!inSight && state.playing.peek())) return;
      const now = present?.() ?? -1;
      if (now !== group) {
        group = now;
        restyle();
      }
      if (presentName) element.dataset.present = presentName(group);
      const at = here();
      put(marker, at);
      put(fixed, mark.peek());
      const row = at === null ? -1 : nearestRow(xs, at);
      values.current.forEach((span, i) => {
        const value = row < 0 ? null : valueAt(data[i + 1] as Num[], row);
        span.textContent = row < 0 ? (mark.peek() === null ? "" : valueText(valueAt(data[i + 1] as Num[], nearestRow(xs, mark.peek()!)))) : valueText(value) + difference(i, value);
      });
      if (marked.current && mark.peek() !== null) {
        const xText = (v: number) => withUnit(format(v, 5), x.symbol);
        marked.current.textContent = `A ${xText(mark.peek()!)}${at === null ? "" : ` → B ${xText(at)}: Δ ${xText(at - mark.peek()!)}`}`;
      }
    };
    const stopTheme = effect(() => {
      state.theme.value;
      ended.abort();
      build();
    });
    const stop = effect(() => {
      state.position.value;
      state.row.value;
      state.playing.value; // at rest it is right out of sight, too
      update();
    });
    const stopMark = effect(() => {
      mark.value;
      queueMicrotask(update); // after the legend is written
    });
    const observer = new ResizeObserver(() => {
      if (!plot || !element.clientWidth || element.clientWidth === plot.width) return;
      plot.setSize({ width: element.clientWidth, height });
      update();
    });
    observer.observe(element);
    const watch = new IntersectionObserver((seen) => {
      inSight = seen[seen.length - 1].isIntersecting;
      update();
    });
    watch.observe(element.closest(".plot") ?? element);
    return () => {
      if (inside && link) state.held.value = false;
      observer.disconnect();
      watch.disconnect();
      stop();
      stopMark();
      stopTheme();
      ended.abort();
      stopListening();
      plot?.destroy();
    };
  }, [data, choice, withPeak]);

  const named = [...choice].sort((a, b) => a[0] - b[0]);
  const areas = [...new Set(curves.filter((c) => c.kind === "edge").map((c) => c.name))];
  return (
    <>
      <div class="diagram">
        <div class="chart" style={{ minHeight: `${height}px` }} ref={box} role="img" tabIndex={0} aria-label={label} aria-description={gestureHint} />
        {zoomed && <Reset onClick={() => gestures.current?.reset()} />}
      </div>
      {(named.length + areas.length > 0 || baseline) && (
        <div class="legend">
          {named.map(([k, look]) => (
            <span key={own[k]}><Sign look={lookOf(look)} points={curves[own[k]].points} />{curves[own[k]].name} <b ref={(e) => { if (e) values.current.set(own[k], e); else values.current.delete(own[k]); }} /></span>
          ))}
          {areas.map((text) => <span key={text}><i class="swatch" aria-hidden="true" />{text}</span>)}
          {baseline && <span key="baseline"><Sign look={{ stroke: "--soft", dash: [5, 4] }} />{baseline}</span>}
        </div>
      )}
      {mark.value !== null && <Mark remove={() => (mark.value = null)}><span ref={marked} /></Mark>}
      {bundle && <Chooser names={names} choice={choice} choose={choose} />}
      {peak && (
        <p class="note peak">
          {withPeak ? "All values are shown. " : `Peak ${valueText(peak.value)} at ${withUnit(format((data[0] as number[])[peak.row], 5), x.symbol)} is outside. `}
          <button type="button" class="screen-only" onClick={() => setWithPeak(!withPeak)}>{withPeak ? "Without the peaks" : "Show all"}</button>
        </p>
      )}
    </>
  );
}
