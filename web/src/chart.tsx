// SPDX-License-Identifier: BSD-3-Clause

// A diagram with curves over one input, with its legend and what is chosen in it.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { valueText, withUnit, type Curve } from "./chart_options";
import { ChartPlot, type Kept, type Shown } from "./chart_plot";
import type { Num } from "./data";
import { gestureHint } from "./gestures";
import { chosen, firstChoice, lookOf, mostNamed, type Choice } from "./look";
import { format } from "./units";
import { peakOf } from "./zoom";

/** Sign of a curve in a legend: a line, points, or an area. */
export function Sign({ look, points }: { look: { stroke: string; dash: number[] }; points?: boolean }) {
  const stroke = `var(${look.stroke})`;
  return (
    <svg viewBox="0 0 24 6" aria-hidden="true">
      {points ? <circle cx="12" cy="3" r="3" style={{ fill: stroke }} /> : <path d="M0 3H24" style={{ stroke, strokeDasharray: look.dash.join(" ") }} />}
    </svg>
  );
}

/** The choice of the curves of a bundle that have a look and a name of their own. */
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

/** The curves that have names, with their values at the cursors, which the plot writes. */
function Legend({ curves, named, baseline, values }: { curves: Curve[]; named: [number, number][]; baseline?: string; values: Map<number, HTMLElement> }) {
  const areas = [...new Set(curves.filter((c) => c.kind === "edge").map((c) => c.name))];
  if (!named.length && !areas.length && !baseline) return null;
  return (
    <div class="legend">
      {named.map(([i, look]) => (
        <span key={i}><Sign look={lookOf(look)} points={curves[i].points} />{curves[i].name} <b ref={(e) => { if (e) values.set(i, e); else values.delete(i); }} /></span>
      ))}
      {areas.map((text) => <span key={text}><i class="swatch" aria-hidden="true" />{text}</span>)}
      {baseline && <span key="baseline"><Sign look={{ stroke: "--soft", dash: [5, 4] }} />{baseline}</span>}
    </div>
  );
}

interface Props extends Shown {
  label: string;
  family?: boolean; // many curves are one family, without names until they are chosen
}

export function Chart({ label, family = false, ...shown }: Props) {
  const { data, curves, x, y, baseline, upright } = shown;
  const height = upright ? 340 : 230;
  const box = useRef<HTMLDivElement>(null);
  const plot = useRef<ChartPlot | null>(null);
  const [zoomed, setZoomed] = useState(false);
  const [withPeak, setWithPeak] = useState(false);
  const mark = useSignal<number | null>(null);
  const kept = useMemo<Kept>(() => ({ zoom: { x: null, y: null, of: "" }, mark, values: new Map(), marked: { current: null }, setZoomed }), []);
  const own = useMemo(() => curves.flatMap((c, i) => (c.kind === "curve" ? [i] : [])), [curves]);
  const names = own.map((i) => curves[i].name);
  const [choice, choose] = useChoice(names, family);
  const peak = useMemo(() => (y.log || curves.some((c) => c.kind === "bars" || c.points) ? null : peakOf(own.map((i) => data[i + 1] as Num[]))), [data, curves]);
  useEffect(() => {
    const made = (plot.current = new ChartPlot(box.current!, shown, { choice, own, peak: withPeak ? null : peak, height }, kept));
    return () => made.close();
  }, [data, choice, withPeak]);
  const named = [...choice].sort((a, b) => a[0] - b[0]).map(([k, look]): [number, number] => [own[k], look]);
  return (
    <>
      <div class="diagram">
        <div class="chart" style={{ minHeight: `${height}px` }} ref={box} role="img" tabIndex={0} aria-label={label} aria-description={gestureHint} />
        {zoomed && <Reset onClick={() => plot.current?.reset()} />}
      </div>
      <Legend curves={curves} named={named} baseline={baseline} values={kept.values} />
      {mark.value !== null && <Mark remove={() => (mark.value = null)}><span ref={kept.marked} /></Mark>}
      {own.length > mostNamed && <Chooser names={names} choice={choice} choose={choose} />}
      {peak && (
        <p class="note peak">
          {withPeak ? "All values are shown. " : `Peak ${valueText(peak.value, y)} at ${withUnit(format((data[0] as number[])[peak.row], 5), x.symbol)} is outside. `}
          <button type="button" class="screen-only" onClick={() => setWithPeak(!withPeak)}>{withPeak ? "Without the peaks" : "Show all"}</button>
        </p>
      )}
    </>
  );
}
