// SPDX-License-Identifier: BSD-3-Clause

// Diagrams. Their cursor and the animation follow each other.
import { computed } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import uPlot from "uplot";
import { Chart, Reset, Sign } from "./chart";
import type { Curve } from "./chart_options";
import type { Link } from "./chart_plot";
import type { Num, Plot, Table } from "./data";
import { gestureHint, listen, type Spot } from "./gestures";
import { aligned, groupsOf, inputOf, linesOf, presentGroup } from "./groups";
import { histogram, stackDots, type Run } from "./log";
import { logarithms, rounding } from "./logarithm";
import { lookOf, mostNamed } from "./look";
import { MapPlot, mapHint } from "./map";
import { Masonry } from "./masonry";
import { inputAt, positionOf, turnOf } from "./motion";
import { Polar } from "./polar";
import { sortedRows } from "./rows";
import * as state from "./state";
import { format, labelWith, unitOf } from "./units";
import { between, nearer, shifted, type Range } from "./zoom";

const firstInput = (factor: number): Link => ({
  now: () => inputAt(state.motion.peek(), state.position.peek()) * factor,
  go: (x) => (state.position.value = positionOf(state.motion.peek(), x / factor)),
});
const secondInput = (factor: number): Link => ({
  now: () => (state.whole.peek()?.second?.[state.row.peek()] ?? 0) * factor,
  go: (x) => {
    const values = state.whole.peek()?.second ?? [];
    state.showRow(values.reduce((best, v, i) => (Math.abs(v * factor - x) < Math.abs(values[best] * factor - x) ? i : best), 0));
  },
});

const scaled = (values: Num[], factor: number) => values.map((v) => (v === null ? null : v * factor));
const largest = (lists: Num[][]) => lists.flat().reduce<number>((a, v) => Math.max(a, Math.abs(v ?? 0)), 0);

/** Says that values were raised to the lower edge of a logarithmic axis. */
const Clipped = ({ what, why = "" }: { what: string; why?: string }) => <p class="note">{what} below {format(rounding, 1)} of the largest lie on the lower edge{why}.</p>;

/** A label without its unit. */
const bare = (label: string) => label.replace(/ \([^()]*\)$/, "");

function TablePlot({ plot, table }: { plot: Plot; table: Table }) {
  const column = (key: string) => table.columns.findIndex((c) => c.key === key);
  const linked = plot.scene !== "" && plot.scene === state.sceneName.value;
  const made = useMemo(() => {
    const ys = plot.y.map(column).filter((i) => i >= 0);
    const unit = unitOf(plot.y[0] ?? "", largest(ys.map((i) => table.data[i])));
    const labels = ys.map((i) => labelWith(table.columns[i].label, table.columns[i].key, unit));
    const x = column(plot.x);
    const { xs, order } = sortedRows(table.data[x] ?? [], linked ? turnOf(state.motion.peek(), inputOf(state.scene.peek(), plot.x).factor) : undefined);
    const xUnit = unitOf(plot.x, largest([xs]));
    const lists = ys.map((i) => scaled(order.map((row) => table.data[i][row]), unit.factor));
    const logs = plot.logarithmic_y ? logarithms(lists) : undefined;
    // Rows that are solutions can be picked.
    const solutions = column("solution");
    const scenes = solutions < 0 ? [] : order.map((row) => state.sceneOf((table.data[solutions][row] ?? 0) - 1));
    return {
      pick: scenes.length ? (row: number) => state.showScene(scenes[row]) : undefined,
      data: [xs.map((v) => v * xUnit.factor), ...(logs?.lists ?? lists)] as uPlot.AlignedData,
      curves: labels.map((l): Curve => ({ name: bare(l), kind: "curve", points: plot.style === "points" })),
      clipped: logs?.clipped,
      link: linked ? firstInput(xUnit.factor) : undefined,
      x: { label: labelWith(table.columns[x]?.label ?? "", plot.x, xUnit), symbol: xUnit.symbol },
      y: { label: labels.length > 1 ? unit.symbol : labels[0] ?? "", symbol: unit.symbol, log: plot.logarithmic_y },
    };
  }, [plot, table, linked]);
  return (
    <>
      <Chart label={plot.title} data={made.data} curves={made.curves} x={made.x} y={made.y} link={made.link} pick={made.pick} upright={plot.upright} />
      {made.clipped && <Clipped what="Values" why=": they are zero up to rounding" />}
      {made.pick && <p class="note screen-only">Click a point to see its design.</p>}
    </>
  );
}

const behindOf = (table: Table) => state.behind.value?.tables.find((t) => t.name === table.name);

/** A diagram with a curve for each value of its group, bands or a baseline. */
function GroupPlot({ plot, table }: { plot: Plot; table: Table }) {
  const linked = plot.scene !== "" && plot.scene === state.sceneName.value;
  const baseline = plot.baseline ? state.result.tables.find((t) => t.name === plot.baseline) : behindOf(table);
  const groups = useMemo(() => groupsOf(plot, table), [plot, table]);
  /** The group of the inputs that are shown; -1 = none. */
  const present = useMemo(() => {
    const { input, factor } = inputOf(linked ? state.whole.peek() : undefined, plot.group ?? "");
    return computed(() => {
      if (input === 2) return presentGroup(groups, factor, state.whole.value?.second?.[state.row.value] ?? 0);
      return input === 1 ? presentGroup(groups, factor, inputAt(state.motion.value, state.position.value)) : -1;
    });
  }, [plot, groups, linked]);
  // Only bands have to be looked up again for another group.
  const banded = plot.bands?.length ? present.value : -1;
  const made = useMemo(() => {
    const motion = state.motion.peek();
    const x = table.columns.findIndex((c) => c.key === plot.x);
    const onX = inputOf(linked ? state.whole.peek() : undefined, plot.x);
    const lines = linesOf(plot, table, baseline, banded, linked && onX.input === 1 ? turnOf(motion, onX.factor) : undefined);
    const unit = unitOf(plot.y[0] ?? "", largest(lines.filter((l) => l.kind !== "baseline").map((l) => l.ys)));
    const xUnit = unitOf(plot.x, largest(lines.map((l) => l.xs)));
    const yColumn = table.columns.find((c) => c.key === plot.y[0]);
    const [xs, ...lists] = aligned(lines, xUnit.factor, unit.factor);
    const logs = plot.logarithmic_y ? logarithms(lists) : undefined;
    return {
      data: [xs, ...(logs?.lists ?? lists)] as uPlot.AlignedData,
      curves: lines.map(({ kind, label, group }): Curve => ({ name: label, group, kind: kind === "lower" || kind === "upper" ? "edge" : kind, points: plot.style === "points" && kind === "curve" })),
      clipped: logs?.clipped,
      link: !linked || onX.input === 0 ? undefined : onX.input === 2 ? secondInput(xUnit.factor / onX.factor) : firstInput(xUnit.factor / onX.factor),
      x: { label: labelWith(table.columns[x]?.label ?? "", plot.x, xUnit), symbol: xUnit.symbol },
      y: { label: plot.y.length === 1 ? labelWith(yColumn?.label ?? "", plot.y[0], unit) : unit.symbol, symbol: unit.symbol, log: plot.logarithmic_y },
    };
  }, [plot, table, baseline, linked, banded]);
  const count = made.curves.filter((c) => c.kind === "curve").length;
  return (
    <>
      <Chart label={plot.title} data={made.data} curves={made.curves} x={made.x} y={made.y} link={made.link} upright={plot.upright}
        present={() => present.value} presentName={(now) => groups[now]?.label ?? ""} baseline={plot.baseline ? baseline?.name : baseline && state.behind.value?.name} family={groups.length > 1} />
      {count > mostNamed && groups.length > 1 && <p class="note">{`${count} curves`}{`, ${groups[0].label} to ${groups[groups.length - 1].label}`}{present.value >= 0 && <>; strong: <b>{groups[present.value].label}</b></>}</p>}
      {made.clipped && <Clipped what="Values" why=": they are zero up to rounding" />}
    </>
  );
}

const maximumOfDots = 200;
const w = 520;  // width of the drawing of dots

function Histogram({ plot, table }: { plot: Plot; table: Table }) {
  const made = useMemo(() => {
    const columns = table.columns.flatMap((c, i) => (plot.y.includes(c.key) ? [i] : []));
    const unit = unitOf(plot.y[0] ?? "", largest(columns.map((i) => table.data[i])));
    const label = columns.map((i) => labelWith(table.columns[i].label, table.columns[i].key, unit)).join(", ");
    const groups = groupsOf(plot, table);
    const one = groups.length === 1;
    // A group may share its rows with longer lists.
    const lists = groups.map(({ rows }) => scaled(columns.flatMap((i) => rows.map((row) => table.data[i][row])), unit.factor).filter((v) => one || v !== null));
    const { middles, counts } = histogram(lists);
    return {
      lists, groups, x: { label, symbol: unit.symbol }, data: [middles, ...counts] as uPlot.AlignedData,
      curves: groups.map((g): Curve => (one ? { name: "count", kind: "bars" } : { name: g.label, kind: "curve", stepped: true })),
    };
  }, [plot, table]);
  if (made.lists.flat().length <= maximumOfDots)
    return <Dots values={made.lists.flat()} label={made.x.label} groups={made.groups.length > 1 ? made.groups.map((g) => g.label) : undefined}
      of={made.lists.flatMap((list, k) => list.map(() => k))} names={made.lists.flatMap((list) => list.map((_, i) => `row ${i + 1}`))} />;
  return <Chart label={plot.title} data={made.data} curves={made.curves} x={made.x} y={{ label: "count", symbol: "" }} range={(_, high) => [0, Math.max(1, high * 1.1)]} />;
}

const dotsHint = "Drag: zoom. Shift + drag: move. Ctrl + wheel, or two fingers: zoom. Double click: show all. With the keyboard: + − arrows 0.";

/** A dot a value: shows how often a search comes to the same answer. Dots of several groups have the colours of their curves. */
export function Dots({ values, names, label, groups, of }: { values: Num[]; names: string[]; label: string; groups?: string[]; of?: number[] }) {
  const svg = useRef<SVGSVGElement>(null);
  const [part, setPart] = useState<Range | null>(null); // shares of the axis that are zoomed into
  const [drag, setDrag] = useState<Range | null>(null); // px
  const live = useRef<Range>([0, 1]);
  live.current = part ?? [0, 1];
  const known = values.filter((v): v is number => v !== null);
  useEffect(() => {
    const element = svg.current;
    if (!element) return;
    /** Converts px on the screen: the place in the drawing, and on the axis. */
    const across = (p: Spot) => (p.x * w) / (element.clientWidth || w);
    const share = (p: Spot) => live.current[0] + ((across(p) - 16) / (w - 32)) * (live.current[1] - live.current[0]);
    const all: Range = [0, 1];
    return listen(element, element as unknown as HTMLElement, {
      zoomed: () => live.current[1] - live.current[0] < 1,
      box: (from, to, done) => {
        setDrag(done ? null : [Math.min(across(from), across(to)), Math.max(across(from), across(to))]);
        if (done) setPart(between(share(from), share(to), all));
      },
      cancel: () => setDrag(null),
      zoom: (factor, about) => setPart(nearer(live.current, all, about ? share(about) : (live.current[0] + live.current[1]) / 2, factor)),
      move: (dx) => setPart(shifted(live.current, all, -dx / (element.clientWidth || w))),
      reset: () => setPart(null),
      click: () => {},
      mark: () => {},
      unmark: () => {},
    });
  }, [known.length > 0]);
  if (known.length === 0) return <p class="note">No values.</p>;
  const { logarithmic, low, high, dots } = stackDots(values, 60, live.current);
  // The height is that of all dots, so that nothing else on the page moves.
  const tallest = stackDots(values, 60).dots.reduce((most, d) => Math.max(most, d.level), 0) + 1;
  const h = Math.min(190, Math.max(70, tallest * 11 + 16));
  const pitch = Math.min(11, (h - 16) / tallest);
  const middle = logarithmic ? Math.sqrt(low * high) : (low + high) / 2;
  const spread = known.reduce((a, b) => Math.max(a, b)) - known.reduce((a, b) => Math.min(a, b));
  return (
    <>
      <div class="diagram">
      <svg ref={svg} class="dots" viewBox={`0 0 ${w} ${h + 50}`} role="img" tabindex={0} aria-description={dotsHint} aria-label={`${dots.length} values of ${label} from ${format(low)} to ${format(high)}`}>
        <path class="axis" d={`M10 ${h}H${w - 10}M10 ${h}v5M${w / 2} ${h}v5M${w - 10} ${h}v5`} />
        <text x={10} y={h + 20}>{format(low, 5)}</text>
        <text x={w / 2} y={h + 20} text-anchor="middle">{format(middle, 5)}</text>
        <text x={w - 10} y={h + 20} text-anchor="end">{format(high, 5)}</text>
        <text x={w / 2} y={h + 42} text-anchor="middle">{label}</text>
        {dots.map((d) => (
          <circle cx={16 + d.share * (w - 32)} cy={h - 7 - d.level * pitch} r={Math.min(4.6, pitch / 2)} style={groups && { fill: `var(${lookOf(of![d.index]).stroke})` }}><title>{`${groups ? `${groups[of![d.index]]}, ` : ""}${names[d.index]}: ${format(values[d.index], 9)}`}</title></circle>
        ))}
        {drag && <rect class="drag" x={drag[0]} y={0} width={drag[1] - drag[0]} height={h} />}
      </svg>
      {part && <Reset onClick={() => setPart(null)} />}
      </div>
      {groups && <ul class="runs">{groups.map((name, k) => <li><Sign look={lookOf(k)} points />{name}</li>)}</ul>}
      <p class="note">{known.length > 1 && spread <= 1e-9 * Math.abs(known[0]) ? `All ${known.length} have the same value to nine digits.` : `${known.length} values, one dot each${logarithmic ? ", logarithmic axis" : ""}.`}{known.length < values.length && ` ${values.length - known.length} without a value.`}</p>
    </>
  );
}

/** The plots that have anything to show. */
const withTable = (plots: Plot[]) =>
  plots.flatMap((plot) => {
    const table = state.result.tables.find((t) => t.name === plot.table);
    const keys = plot.style === "map" ? plot.y.slice(1) : plot.y;
    const shown = table?.columns.some((c, i) => keys.includes(c.key) && table.data[i].some((v) => v !== null));
    return table && shown ? [{ plot, table }] : [];
  });

function Diagram({ plot, table }: { plot: Plot; table: Table }) {
  switch (plot.style) {
    case "histogram": return <Histogram plot={plot} table={table} />;
    case "polar": return <Polar plot={plot} table={table} />;
    case "map": return <MapPlot plot={plot} table={table} />;
  }
  return plot.group || plot.bands?.length || plot.baseline || behindOf(table) ? <GroupPlot plot={plot} table={table} /> : <TablePlot plot={plot} table={table} />;
}

/** A diagram in a card. Out of sight, as most are, it is not drawn anew before it comes into sight; until then it is there for nobody, for
 *  what it says is of the study before. */
function DiagramCard({ plot, table }: { plot: Plot; table: Table }) {
  const card = useRef<HTMLDivElement>(null);
  const inSight = useRef(true);
  const drawn = useRef<JSX.Element | null>(null);
  const stale = useRef(false);
  const [, drawAnew] = useState({});
  useEffect(() => {
    const watch = new IntersectionObserver((seen) => {
      inSight.current = seen[seen.length - 1].isIntersecting;
      if (inSight.current && stale.current) drawAnew({});
    }, { rootMargin: "100px" });
    watch.observe(card.current!);
    return () => watch.disconnect();
  }, []);
  stale.current = drawn.current !== null && !inSight.current && !state.printing.value;
  if (!stale.current) drawn.current = <Diagram plot={plot} table={table} />;
  return (
    <div class="card plot" data-plot={plot.name} ref={card}>
      <h3 title={plot.style === "map" ? mapHint : gestureHint}>{plot.title}</h3>
      <div style={{ visibility: stale.current ? "hidden" : undefined }}>{drawn.current}</div>
    </div>
  );
}

const Cards = ({ plots }: { plots: Plot[] }) => <>{withTable(plots).map(({ plot, table }) => <DiagramCard key={`${state.subject} ${plot.name}/${plot.scene}`} plot={plot} table={table} />)}</>;

/** Plots over the input of the scene that is shown. */
export function Plots() {
  state.paced.value;
  const shown = state.view.plots.filter((p) => p.scene !== "" && p.scene === state.sceneName.value);
  const drawn = withTable(shown).map(({ plot }) => plot);
  if (drawn.length === 0) return null;
  const without = shown.filter((p) => !drawn.includes(p));
  return (
    <section aria-labelledby="h-plots">
      <h2 id="h-plots">Over the motion</h2>
      <p class="note screen-only">Point at a diagram and the mechanism moves there. Drag to zoom (Shift moves, double click shows all); click to set a cursor A and read differences.</p>
      {without.length > 0 && <p class="note">Without values, and so not drawn: {without.map((p) => p.title).join(", ")}.</p>}
      <Masonry><Cards plots={shown} /></Masonry>
    </section>
  );
}

const unlinked = () => state.view.plots.filter((p) => p.scene === "");
// A plot of solutions is a front to pick from.
const isFront = (plot: Plot) => state.result.tables.some((t) => t.name === plot.table && t.columns.some((c) => c.key === "solution"));
const loose = () => unlinked().filter((p) => !isFront(p));

/** The cost of one objective in terms of another. */
export function Fronts() {
  const fronts = unlinked().filter(isFront);
  if (withTable(fronts).length === 0) return null;
  return (
    <section aria-labelledby="h-front">
      <h2 id="h-front">The front</h2>
      <Masonry><Cards plots={fronts} /></Masonry>
    </section>
  );
}

export const hasLoosePlots = () => withTable(loose()).length > 0;
export const hasHistogram = () => withTable(loose()).some(({ plot }) => plot.style === "histogram");
/** Plots that belong to no scene. */
export const LoosePlots = () => <Cards plots={loose()} />;

/** Best cost against effort, one line a seed. */
export function Convergence({ runs }: { runs: Run[] }) {
  const made = useMemo(() => {
    const lines = runs.filter((run) => run.x.length > 1 && run.y.some((v) => v > 0));
    if (lines.length === 0) return null;
    const { lists, clipped } = logarithms(lines.map((r) => r.y), true);
    return {
      clipped, counts: lines[0].counts,
      data: uPlot.join(lines.map((r, i) => [r.x, lists[i]] as uPlot.AlignedData)),
      curves: lines.map((r): Curve => ({ name: `seed ${r.seed}`, kind: "curve", stepped: true })),
    };
  }, [runs]);
  if (!made) return null;
  return (
    <div class="card plot" data-plot="convergence">
      <h3 title={gestureHint}>Convergence of the {made.curves.length === 1 ? "run" : `${made.curves.length} runs`}</h3>
      <Chart label="Best cost of each seed against effort, logarithmic" data={made.data} curves={made.curves} x={{ label: made.counts, symbol: "" }} y={{ label: "best so far", symbol: "", log: true }} family />
      {made.clipped && <Clipped what="Solved to rounding: costs" />}
    </div>
  );
}
