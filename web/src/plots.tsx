// Diagrams. Their cursor and the animation follow each other.
import { effect } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Num, Plot, Table } from "./data";
import { histogram, stackDots, type Run } from "./log";
import { aligned, groupsOf, inputOf, linesOf, presentGroup } from "./groups";
import { logarithms, logRange, logTicks, rounding } from "./logarithm";
import { lookOf, mostNamed } from "./look";
import { MapPlot } from "./map";
import { inputAt, positionOf, turnOf } from "./motion";
import { Polar } from "./polar";
import { nearestRow, sortedRows } from "./rows";
import * as state from "./state";
import { format, labelWith, unitOf } from "./units";

const css = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const height = 230;

/** An axis; a logarithmic one is one of decimal logarithms. */
const axis = (label: string, log = false): uPlot.Axis => ({
  label,
  labelSize: 20,
  labelFont: "12px system-ui, sans-serif",
  font: "11px system-ui, sans-serif",
  stroke: () => css("--soft"),
  grid: { stroke: () => css("--faint"), width: 1 },
  ticks: { stroke: () => css("--line"), width: 1, size: 5 },
  ...(log ? { splits: (_: uPlot, __: number, low: number, high: number) => logTicks(low, high) } : {}),
  values: (_, ticks) => ticks.map((t) => (t === null ? "" : format(log ? 10 ** t : t, 5))),
  size: (_, values, index) => (index === 0 ? 30 : Math.max(40, 14 + 6.4 * (values ?? []).reduce((n, v) => Math.max(n, v.length), 0))),
});

const scaleY = (log: boolean): uPlot.Scale => (log ? { range: (_, low, high) => logRange(low, high) } : {});

/** What stands beside the values: the label where the diagram is high enough for it, else the unit, for the legend has the name. */
const beside = (label: string, symbol: string) => (6.4 * label.length <= height - 50 ? label : symbol);

/** How the x of a diagram and an input of the scene follow each other. */
interface Link {
  now: () => number;
  go: (x: number) => void;
}

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

interface Unit {
  label: string;
  symbol: string;
  series?: number; // of the data; as it is listed when not given, 0 = none
  stroke?: string; // variable of its colour
  dash?: number[];
  swatch?: boolean; // of an area
}

interface Props {
  label: string;
  options: () => Omit<uPlot.Options, "width" | "height">;
  data: uPlot.AlignedData;
  link?: Link; // x is an input of the scene shown
  units?: Unit[];
  emphasise?: (plot: uPlot) => void; // as the scene moves: changes the look of the series, and tells whether anything changed
  pick?: (row: number) => void; // a click at a row of the data
  log?: boolean; // the data are logarithms
  names?: string[]; // of the series, shown where one points: they have no legend
  symbol?: string; // unit of what has a name
}

export function Chart({ label, options, data, link, units = [], emphasise, pick, log, names, symbol }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const values = useRef<HTMLSpanElement[]>([]);
  useEffect(() => {
    const element = box.current!;
    let now: HTMLDivElement | null = null;
    let name: HTMLDivElement | null = null;
    let inside = false;
    const written = (value: Num | undefined, unit: string) => `${format(log && typeof value === "number" ? 10 ** value : value ?? null, 5)}${unit ? ` ${unit}` : ""}`;
    /** Name and value of the curve that is pointed at, beside the pointer. */
    const tell = (u: uPlot) => {
      if (!name) return;
      const curve = told;
      const { left = -1, top = -1, idx } = u.cursor;
      name.hidden = curve === null || left < 0 || !names?.[curve - 1];
      if (name.hidden) return;
      const value = typeof idx === "number" ? (data[curve!][idx] as Num | undefined) : undefined;
      name.textContent = value == null ? names![curve! - 1] : `${names![curve! - 1]}: ${written(value, symbol ?? "")}`;
      const width = u.over.clientWidth;
      name.style.transform = `translate(${left > width / 2 ? `calc(${left - 10}px - 100%)` : `${left + 10}px`}, ${Math.max(0, top - 30)}px)`;
    };
    let told: number | null = null;
    const build = () =>
      new uPlot(
        {
          ...options(),
          // Three plots stand side by side on an A4 page, in two rows; its layout comes too late to be measured.
          width: state.printing.peek() ? 300 : element.clientWidth || 500,
          height: state.printing.peek() ? 160 : height,
          legend: { show: false },
          hooks: {
            ready: [
              (u) => {
                if (names?.length) {
                  name = u.over.appendChild(document.createElement("div"));
                  name.className = "curve-name";
                  name.hidden = true;
                  u.over.addEventListener("pointerleave", () => {
                    told = null;
                    tell(u);
                  });
                }
                if (pick) u.over.addEventListener("click", () => typeof u.cursor.idx === "number" && pick(u.cursor.idx));
                if (!link) return;
                now = u.over.appendChild(document.createElement("div"));
                now.className = "now";
                queueMicrotask(follow); // after the scales are set
                u.over.addEventListener("pointerenter", () => (inside = state.held.value = true));
                u.over.addEventListener("pointerleave", () => (inside = state.held.value = false));
              },
            ],
            setCursor: [
              (u) => {
                const left = u.cursor.left ?? -1;
                if (link && inside && left >= 0) link.go(u.posToVal(left, "x"));
                tell(u);
              },
            ],
            setSeries: [
              (u, curve) => {
                told = curve;
                tell(u);
              },
            ],
          },
        },
        data,
        element,
      );
    let plot: uPlot | undefined;
    const stopTheme = effect(() => {
      state.theme.value;
      plot?.destroy();
      now = null;
      plot = build();
    });
    const follow = () => {
      if (!now || !plot || !link) return;
      emphasise?.(plot);
      const input = link.now();
      now.style.transform = `translateX(${plot.valToPos(input, "x").toFixed(1)}px)`;
      const row = nearestRow(data[0] as number[], input);
      values.current.forEach((span, i) => {
        if (units[i].swatch || units[i].series === 0) return;
        span.textContent = written(data[units[i].series ?? i + 1]?.[row], units[i].symbol);
      });
    };
    const stop = effect(() => {
      state.position.value;
      state.row.value;
      follow();
    });
    const observer = new ResizeObserver(() => {
      if (!plot || !element.clientWidth || element.clientWidth === plot.width) return;
      plot.setSize({ width: element.clientWidth, height });
      follow();
    });
    observer.observe(element);
    return () => {
      if (inside) state.held.value = false;
      observer.disconnect();
      stop();
      stopTheme();
      plot?.destroy();
    };
  }, [data]);
  return (
    <>
      <div class="chart" ref={box} role="img" aria-label={label} />
      {units.length > 0 && (
        <div class="legend">
          {units.map((u, i) => (
            <span>{u.swatch ? <i class="swatch" aria-hidden="true" /> : <svg viewBox="0 0 24 6" aria-hidden="true"><path d="M0 3H24" style={{ stroke: `var(${u.stroke ?? lookOf(i).stroke})`, strokeDasharray: (u.dash ?? lookOf(i).dash).join(" ") }} /></svg>}
              {u.label} <b ref={(e) => { if (e) values.current[i] = e; }} /></span>
          ))}
        </div>
      )}
    </>
  );
}

const scaled = (values: Num[], factor: number) => values.map((v) => (v === null ? null : v * factor));
const largest = (lists: Num[][]) => lists.flat().reduce<number>((a, v) => Math.max(a, Math.abs(v ?? 0)), 0);

/** Says that values were raised to the lower edge of a logarithmic axis. */
const Clipped = ({ what, why = "" }: { what: string; why?: string }) => <p class="note">{what} below {format(rounding, 1)} of the largest lie on the lower edge{why}.</p>;

function TablePlot({ plot, table }: { plot: Plot; table: Table }) {
  const column = (key: string) => table.columns.findIndex((c) => c.key === key);
  const linked = plot.scene !== "" && plot.scene === state.scene.value?.name;
  const made = useMemo(() => {
    const ys = plot.y.map(column).filter((i) => i >= 0);
    const unit = unitOf(plot.y[0] ?? "", largest(ys.map((i) => table.data[i])));
    const labels = ys.map((i) => labelWith(table.columns[i].label, table.columns[i].key, unit));
    const x = column(plot.x);
    const { xs, order } = sortedRows(table.data[x] ?? [], linked ? turnOf(state.motion.peek(), inputOf(state.scene.peek(), plot.x).factor) : undefined);
    const xUnit = unitOf(plot.x, largest([xs]));
    const points = plot.style === "points";
    const bundle = labels.length > mostNamed;
    const names = labels.map((l) => l.replace(/ \([^()]*\)$/, ""));
    const lists = ys.map((i) => scaled(order.map((row) => table.data[i][row]), unit.factor));
    const logs = plot.logarithmic_y ? logarithms(lists) : undefined;
    // Rows that are solutions can be picked.
    const solutions = column("solution");
    const scenes = solutions < 0 ? [] : order.map((row) => state.sceneOf((table.data[solutions][row] ?? 0) - 1));
    return {
      pick: scenes.length ? (row: number) => state.showScene(scenes[row]) : undefined,
      data: [xs.map((v) => v * xUnit.factor), ...(logs?.lists ?? lists)] as uPlot.AlignedData,
      units: bundle ? [] : names.map((label) => ({ label, symbol: unit.symbol })),
      names: bundle ? names : undefined,
      symbol: unit.symbol,
      clipped: logs?.clipped,
      factor: xUnit.factor,
      options: () => ({
        scales: { x: { time: false }, y: scaleY(plot.logarithmic_y) },
        axes: [axis(labelWith(table.columns[x]?.label ?? "", plot.x, xUnit)), axis(labels.length > 1 ? unit.symbol : beside(labels[0] ?? "", unit.symbol), plot.logarithmic_y)],
        series: [
          {},
          ...labels.map((l, i) => {
            const colour = css(bundle ? "--accent" : lookOf(i).stroke);
            return {
              label: l, stroke: colour, width: points ? 0 : bundle ? 1.5 : 2, alpha: bundle ? 0.5 : 1, dash: bundle ? [] : lookOf(i).dash,
              paths: points ? () => null : undefined, points: { show: points, size: 7, fill: colour },
            };
          }),
        ],
        focus: { alpha: bundle ? 0.15 : 1 },
        cursor: { drag: { setScale: false }, y: false, points: { size: 7, show: !bundle }, focus: { prox: bundle ? 24 : -1 } },
      }),
    };
  }, [plot, table, linked]);
  return (
    <>
      <Chart label={plot.title} data={made.data} options={made.options} link={linked ? firstInput(made.factor) : undefined} units={made.units} pick={made.pick}
        log={plot.logarithmic_y} names={made.names} symbol={made.symbol} />
      {made.names && <p class="note">{made.names.length} curves<span class="screen-only">; point at one to read its name</span>.</p>}
      {made.clipped && <Clipped what="Values" why=": they are zero up to rounding" />}
      {made.pick && <p class="note screen-only">Click a point to see its design.</p>}
    </>
  );
}

/** A diagram with a curve for each value of its group, bands or a baseline. */
function GroupPlot({ plot, table }: { plot: Plot; table: Table }) {
  const linked = plot.scene !== "" && plot.scene === state.whole.value?.name;
  const baseline = plot.baseline ? state.result.tables.find((t) => t.name === plot.baseline) : undefined;
  const groups = useMemo(() => groupsOf(plot, table), [plot, table]);
  const groupInput = inputOf(linked ? state.whole.value : undefined, plot.group ?? "");
  /** The group of the inputs that are shown; -1 = none. */
  const present = () => {
    if (groupInput.input === 2) return presentGroup(groups, groupInput.factor, state.whole.peek()?.second?.[state.row.value] ?? 0);
    return groupInput.input === 1 ? presentGroup(groups, groupInput.factor, inputAt(state.motion.value, state.position.value)) : -1;
  };
  // Only bands have to be looked up again for another group.
  const banded = plot.bands?.length ? present() : -1;
  const made = useMemo(() => {
    const motion = state.motion.peek();
    const x = table.columns.findIndex((c) => c.key === plot.x);
    const onX = inputOf(linked ? state.whole.peek() : undefined, plot.x);
    const lines = linesOf(plot, table, baseline, banded, linked && onX.input === 1 ? turnOf(motion, onX.factor) : undefined);
    const unit = unitOf(plot.y[0] ?? "", largest(lines.filter((l) => l.kind !== "baseline").map((l) => l.ys)));
    const xUnit = unitOf(plot.x, largest(lines.map((l) => l.xs)));
    const curves = lines.flatMap((l, i) => (l.kind === "curve" ? [i] : []));
    const bundle = curves.length > mostNamed;
    const stroke = (i: number) => (lines[i].kind === "baseline" ? "--soft" : bundle ? "--accent" : lookOf(curves.indexOf(i)).stroke);
    const dash = (i: number) => (lines[i].kind === "baseline" ? [5, 4] : bundle ? [] : lookOf(curves.indexOf(i)).dash);
    // Baselines have one look, so that there names are told, too.
    const named = bundle || lines.filter((l) => l.kind === "baseline").length > 1;
    /** Width and opacity of a line when the group `now` is present. */
    const look = (i: number, now: number) => {
      const here = now < 0 || lines[i].group === now;
      if (lines[i].kind === "baseline") return { width: 1.4, alpha: here ? 0.85 : bundle ? 0.12 : 0.35 };
      return { width: now < 0 ? 2 : here ? 3 : 1.4, alpha: here ? (bundle && now < 0 ? 0.5 : 1) : bundle ? 0.3 : 0.7 };
    };
    let emphasised: number | undefined;
    const legend: Unit[] = [
      ...(bundle ? [] : curves.map((i) => ({ label: lines[i].label, symbol: unit.symbol, series: i + 1, stroke: stroke(i), dash: dash(i) }))),
      ...[...new Set(lines.filter((l) => l.kind === "lower").map((l) => l.label))].map((label) => ({ label, symbol: "", swatch: true })),
      ...(lines.some((l) => l.kind === "baseline") ? [{ label: baseline!.name, symbol: "", series: 0, stroke: "--soft", dash: [5, 4] }] : []),
    ];
    const yColumn = table.columns.find((c) => c.key === plot.y[0]);
    const points = plot.style === "points";
    const [xs, ...lists] = aligned(lines, xUnit.factor, unit.factor);
    const logs = plot.logarithmic_y ? logarithms(lists) : undefined;
    return {
      bundle, curves, lines, unit,
      data: [xs, ...(logs?.lists ?? lists)] as uPlot.AlignedData,
      clipped: logs?.clipped,
      names: named ? lines.map((l) => (l.kind === "baseline" ? `${baseline!.name}: ${l.label}` : l.kind === "curve" ? l.label : "")) : undefined,
      link: !linked || onX.input === 0 ? undefined : onX.input === 2 ? secondInput(xUnit.factor / onX.factor) : firstInput(xUnit.factor / onX.factor),
      legend,
      emphasise: (u: uPlot) => {
        const now = present();
        if (now === emphasised) return;
        emphasised = now;
        u.root.parentElement!.dataset.present = groups[now]?.label ?? "";
        lines.forEach((l, i) => (l.kind === "curve" || l.kind === "baseline") && Object.assign(u.series[i + 1], look(i, now)));
        u.redraw(false);
      },
      options: () => {
        emphasised = undefined;
        const now = present();
        return {
          scales: { x: { time: false }, y: scaleY(plot.logarithmic_y) },
          axes: [axis(labelWith(table.columns[x]?.label ?? "", plot.x, xUnit)), axis(plot.y.length === 1 ? beside(labelWith(yColumn?.label ?? "", plot.y[0], unit), unit.symbol) : unit.symbol, plot.logarithmic_y)],
          series: [{}, ...lines.map((l, i) => (l.kind === "lower" || l.kind === "upper"
            ? { label: l.label, stroke: "transparent", width: 0, points: { show: false } }
            : { label: l.label, stroke: css(stroke(i)), dash: dash(i), paths: points && l.kind === "curve" ? () => null : undefined, points: { show: points && l.kind === "curve", size: 6, fill: css(stroke(i)) }, ...look(i, now) }))],
          bands: lines.flatMap((l, i) => (l.kind === "upper" ? [{ series: [i + 1, i] as [number, number], fill: `${css("--good")}30` }] : [])),
          // The lines keep their look, since it tells which group is present.
          focus: { alpha: 1 },
          cursor: { drag: { setScale: false }, y: false, points: { show: false }, focus: { prox: named ? 24 : -1 } },
        };
      },
    };
  }, [plot, table, baseline, linked, banded]);
  const now = present();
  const shown = made.curves.filter((i) => made.lines[i].group === now);
  return (
    <>
      <Chart label={plot.title} data={made.data} options={made.options} link={made.link} units={made.legend} emphasise={made.emphasise}
        log={plot.logarithmic_y} names={made.names} symbol={made.unit.symbol} />
      {made.bundle && <p class="note">{`${made.curves.length} curves, ${groups[0].label} to ${groups[groups.length - 1].label}`}{shown.length > 0 && <>; strong: <b>{groups[now].label}</b></>}<span class="screen-only">; point at one to read its name</span></p>}
      {made.clipped && <Clipped what="Values" why=": they are zero up to rounding" />}
    </>
  );
}

const maximumOfDots = 200;

function Histogram({ plot, table }: { plot: Plot; table: Table }) {
  const made = useMemo(() => {
    const columns = table.columns.flatMap((c, i) => (plot.y.includes(c.key) ? [i] : []));
    const unit = unitOf(plot.y[0] ?? "", largest(columns.map((i) => table.data[i])));
    const values = scaled(columns.flatMap((i) => table.data[i]), unit.factor);
    const label = columns.map((i) => labelWith(table.columns[i].label, table.columns[i].key, unit)).join(", ");
    const { middles, counts } = histogram(values);
    return {
      values, label, data: [middles, counts] as uPlot.AlignedData,
      options: () => ({
        scales: { x: { time: false }, y: { range: (_: uPlot, __: number, high: number): uPlot.Range.MinMax => [0, Math.max(1, high * 1.1)] } },
        axes: [axis(label), axis("count")],
        series: [{}, { fill: css("--c0"), stroke: css("--c0"), width: 0, paths: uPlot.paths.bars!({ size: [0.92] }), points: { show: false } }],
        cursor: { drag: { setScale: false } },
      }),
    };
  }, [plot, table]);
  if (made.values.length <= maximumOfDots)
    return <Dots values={made.values} names={made.values.map((_, i) => `row ${i + 1}`)} label={made.label} />;
  return <Chart label={plot.title} data={made.data} options={made.options} />;
}

/** A dot a value: shows how often a search comes to the same answer. */
export function Dots({ values, names, label }: { values: Num[]; names: string[]; label: string }) {
  const known = values.filter((v): v is number => v !== null);
  if (known.length === 0) return <p class="note">No values.</p>;
  const { logarithmic, low, high, dots } = stackDots(values, 60);
  const tallest = Math.max(...dots.map((d) => d.level)) + 1;
  const w = 520;
  const h = Math.min(190, Math.max(70, tallest * 11 + 16));
  const pitch = Math.min(11, (h - 16) / tallest);
  const middle = logarithmic ? Math.sqrt(low * high) : (low + high) / 2;
  const spread = known.reduce((a, b) => Math.max(a, b)) - known.reduce((a, b) => Math.min(a, b));
  return (
    <>
      <svg class="dots" viewBox={`0 0 ${w} ${h + 50}`} role="img" aria-label={`${dots.length} values of ${label} from ${format(low)} to ${format(high)}`}>
        <path class="axis" d={`M10 ${h}H${w - 10}M10 ${h}v5M${w / 2} ${h}v5M${w - 10} ${h}v5`} />
        <text x={10} y={h + 20}>{format(low, 5)}</text>
        <text x={w / 2} y={h + 20} text-anchor="middle">{format(middle, 5)}</text>
        <text x={w - 10} y={h + 20} text-anchor="end">{format(high, 5)}</text>
        <text x={w / 2} y={h + 42} text-anchor="middle">{label}</text>
        {dots.map((d) => (
          <circle cx={16 + d.share * (w - 32)} cy={h - 7 - d.level * pitch} r={Math.min(4.6, pitch / 2)}><title>{`${names[d.index]}: ${format(values[d.index], 9)}`}</title></circle>
        ))}
      </svg>
      <p class="note">{known.length > 1 && spread <= 1e-9 * Math.abs(known[0]) ? `All ${known.length} have the same value to nine digits.` : `${known.length} values, one dot each${logarithmic ? ", logarithmic axis" : ""}.`}{known.length < values.length && ` ${values.length - known.length} without a value.`}</p>
    </>
  );
}

/** Of the plots, those that have anything to show. */
const withTable = (plots: Plot[]) =>
  plots.flatMap((plot) => {
    const table = state.result.tables.find((t) => t.name === plot.table);
    const keys = plot.style === "map" ? plot.y.slice(1) : plot.y;
    const shown = table?.columns.some((c, i) => keys.includes(c.key) && table.data[i].some((v) => v !== null));
    return table && shown ? [{ plot, table }] : [];
  });

const Cards = ({ plots }: { plots: Plot[] }) => (
  <>
    {withTable(plots).map(({ plot, table }) => (
      <div class="card plot" key={`${plot.name}/${plot.scene}`} data-plot={plot.name}>
        <h3>{plot.title}</h3>
        {plot.style === "histogram" ? <Histogram plot={plot} table={table} /> : plot.style === "polar" ? <Polar plot={plot} table={table} /> : plot.style === "map" ? <MapPlot plot={plot} table={table} /> : plot.group || plot.bands?.length || plot.baseline ? <GroupPlot plot={plot} table={table} /> : <TablePlot plot={plot} table={table} />}
      </div>
    ))}
  </>
);

/** Plots over the input of the scene that is shown. */
export function Plots() {
  const shown = state.view.plots.filter((p) => p.scene !== "" && p.scene === state.scene.value?.name);
  const drawn = withTable(shown).map(({ plot }) => plot);
  if (drawn.length === 0) return null;
  const without = shown.filter((p) => !drawn.includes(p));
  return (
    <section aria-labelledby="h-plots">
      <h2 id="h-plots">Over the motion</h2>
      <p class="note screen-only">Point at a diagram and the mechanism moves there.</p>
      {without.length > 0 && <p class="note">Without values, and so not drawn: {without.map((p) => p.title).join(", ")}.</p>}
      <div class="grid-2"><Cards plots={shown} /></div>
    </section>
  );
}

const unlinked = state.view.plots.filter((p) => p.scene === "");
// A plot of solutions is a front to pick from.
const isFront = (plot: Plot) => state.result.tables.some((t) => t.name === plot.table && t.columns.some((c) => c.key === "solution"));
const loose = unlinked.filter((p) => !isFront(p));
const fronts = unlinked.filter(isFront);

/** What one objective costs in another. */
export function Fronts() {
  if (withTable(fronts).length === 0) return null;
  return (
    <section aria-labelledby="h-front">
      <h2 id="h-front">The front</h2>
      <div class="grid-2"><Cards plots={fronts} /></div>
    </section>
  );
}

export const hasLoosePlots = withTable(loose).length > 0;
export const hasHistogram = withTable(loose).some(({ plot }) => plot.style === "histogram");
/** Plots that belong to no scene. */
export const LoosePlots = () => <Cards plots={loose} />;

/** Best cost against effort, one line a seed. */
export function Convergence({ runs }: { runs: Run[] }) {
  const lines = runs.filter((run) => run.x.length > 1 && run.y.some((v) => v > 0));
  const { data, clipped } = useMemo(() => {
    const { lists, clipped } = logarithms(lines.map((r) => r.y), true);
    return { data: lines.length ? uPlot.join(lines.map((r, i) => [r.x, lists[i]] as uPlot.AlignedData)) : ([[]] as uPlot.AlignedData), clipped };
  }, [runs]);
  if (lines.length === 0) return null;
  const counts = lines[0].counts;
  return (
    <div class="card plot" data-plot="convergence">
      <h3>Convergence of the {lines.length === 1 ? "run" : `${lines.length} runs`}</h3>
      <Chart label="Best cost of each seed against effort, logarithmic" data={data} log names={lines.map((r) => `seed ${r.seed}`)} options={() => ({
        scales: { x: { time: false }, y: scaleY(true) },
        axes: [axis(counts), axis("best so far", true)],
        series: [{}, ...lines.map((r) => ({
          label: `seed ${r.seed}`, stroke: css("--accent"), alpha: lines.length > 6 ? 0.5 : 0.9, width: 1.5, spanGaps: true,
          points: { show: false }, paths: uPlot.paths.stepped!({ align: 1 }),
        }))],
        focus: { alpha: 0.15 },
        cursor: { drag: { setScale: false }, focus: { prox: 24 }, y: false, points: { show: false } },
      })} />
      {clipped && <Clipped what="Solved to rounding: costs" />}
    </div>
  );
}
