// Diagrams. Their cursor and the animation follow each other.
import { effect } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Num, Plot, Table } from "./data";
import { histogram, stackDots, type Run } from "./log";
import { inputAt, positionOf, positionOfTurn } from "./motion";
import { Polar } from "./polar";
import { nearestRow, sortedRows } from "./rows";
import * as state from "./state";
import { format, labelWith, unitOf } from "./units";

const css = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const seriesColours = ["--c0", "--c5", "--c2", "--c3", "--c1", "--c4"];
const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [5, 2], [1, 2]];
const height = 230;

const axis = (label: string, log = false): uPlot.Axis => ({
  label,
  labelSize: 20,
  labelFont: "12px system-ui, sans-serif",
  font: "11px system-ui, sans-serif",
  stroke: () => css("--soft"),
  grid: { stroke: () => css("--faint"), width: 1 },
  ticks: { stroke: () => css("--line"), width: 1, size: 5 },
  values: (_, ticks) => ticks.map((t) => (t === null ? "" : log && Math.abs(Math.log10(t) % 1) > 1e-9 && ticks.length > 12 ? "" : format(t, 5))),
  size: (_, values, index) => (index === 0 ? 30 : Math.max(40, 14 + 6.4 * (values ?? []).reduce((n, v) => Math.max(n, v.length), 0))),
});

interface Props {
  label: string;
  options: () => Omit<uPlot.Options, "width" | "height">;
  data: uPlot.AlignedData;
  linked?: boolean; // x is the input of the scene shown, times `factor`
  factor?: number;
  units?: { label: string; symbol: string }[];
  pick?: (row: number) => void; // a click at a row of the data
}

export function Chart({ label, options, data, linked = false, factor = 1, units = [], pick }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const values = useRef<HTMLSpanElement[]>([]);
  useEffect(() => {
    const element = box.current!;
    let now: HTMLDivElement | null = null;
    let inside = false;
    const build = () =>
      new uPlot(
        {
          ...options(),
          // Two plots stand side by side on an A4 page; its layout comes too late to be measured.
          width: state.printing ? 310 : element.clientWidth || 500,
          height,
          legend: { show: false },
          hooks: {
            ready: [
              (u) => {
                if (pick) u.over.addEventListener("click", () => typeof u.cursor.idx === "number" && pick(u.cursor.idx));
                if (!linked) return;
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
                if (linked && inside && left >= 0) state.position.value = positionOf(state.motion.peek(), u.posToVal(left, "x") / factor);
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
      if (!now || !plot) return;
      const input = inputAt(state.motion.peek(), state.position.peek()) * factor;
      now.style.transform = `translateX(${plot.valToPos(input, "x").toFixed(1)}px)`;
      const row = nearestRow(data[0] as number[], input);
      values.current.forEach((span, i) => {
        span.textContent = `${format(data[i + 1]?.[row] ?? null, 5)}${units[i]?.symbol ? ` ${units[i].symbol}` : ""}`;
      });
    };
    const stop = effect(() => {
      state.position.value;
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
            <span><svg viewBox="0 0 24 6" aria-hidden="true"><path d="M0 3H24" style={{ stroke: `var(${seriesColours[i % 6]})`, strokeDasharray: dashes[i % 6].join(" ") }} /></svg>
              {u.label} <b ref={(e) => { if (e) values.current[i] = e; }} /></span>
          ))}
        </div>
      )}
    </>
  );
}

const scaled = (values: Num[], factor: number, log: boolean) => values.map((v) => (v === null || (log && v <= 0) ? null : v * factor));
const largest = (lists: Num[][]) => lists.flat().reduce<number>((a, v) => Math.max(a, Math.abs(v ?? 0)), 0);

const many = 7; // more lines than this are one bundle: same colour, no legend

function TablePlot({ plot, table }: { plot: Plot; table: Table }) {
  const column = (key: string) => table.columns.findIndex((c) => c.key === key);
  const linked = plot.scene !== "" && plot.scene === state.scene.value?.name;
  const made = useMemo(() => {
    const ys = plot.y.map(column).filter((i) => i >= 0);
    const unit = unitOf(plot.y[0] ?? "", largest(ys.map((i) => table.data[i])));
    const labels = ys.map((i) => labelWith(table.columns[i].label, table.columns[i].key, unit));
    const x = column(plot.x);
    const motion = state.motion.peek();
    const { xs, order } = sortedRows(table.data[x] ?? [], (v) => (linked ? inputAt(motion, positionOfTurn(motion, v)) : v));
    const xUnit = unitOf(plot.x, largest([xs]));
    const points = plot.style === "points";
    const bundle = labels.length > many;
    // Rows that are solutions can be picked.
    const solutions = column("solution");
    const scenes = solutions < 0 ? [] : order.map((row) => state.sceneOf((table.data[solutions][row] ?? 0) - 1));
    return {
      pick: scenes.length ? (row: number) => state.showScene(scenes[row]) : undefined,
      data: [
        xs.map((v) => v * xUnit.factor),
        ...ys.map((i) => scaled(order.map((row) => table.data[i][row]), unit.factor, plot.logarithmic_y)),
      ] as uPlot.AlignedData,
      units: bundle ? [] : labels.map((l) => ({ label: l.replace(/ \([^()]*\)$/, ""), symbol: unit.symbol })),
      factor: xUnit.factor,
      options: () => ({
        scales: { x: { time: false }, y: { distr: plot.logarithmic_y ? (3 as const) : (1 as const) } },
        axes: [axis(labelWith(table.columns[x]?.label ?? "", plot.x, xUnit)), axis(labels.length > 1 ? unit.symbol : (labels[0] ?? ""), plot.logarithmic_y)],
        series: [
          {},
          ...labels.map((l, i) => {
            const colour = css(bundle ? "--accent" : seriesColours[i % 6]);
            return {
              label: l, stroke: colour, width: points ? 0 : bundle ? 1.5 : 2, alpha: bundle ? 0.5 : 1, dash: bundle ? [] : dashes[i % 6],
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
      <Chart label={plot.title} data={made.data} options={made.options} linked={linked} factor={made.factor} units={made.units} pick={made.pick} />
      {made.pick && <p class="note screen-only">Click a point to see its design.</p>}
    </>
  );
}

const maximumOfDots = 200;

function Histogram({ plot, table }: { plot: Plot; table: Table }) {
  const made = useMemo(() => {
    const columns = table.columns.flatMap((c, i) => (plot.y.includes(c.key) ? [i] : []));
    const unit = unitOf(plot.y[0] ?? "", largest(columns.map((i) => table.data[i])));
    const values = scaled(columns.flatMap((i) => table.data[i]), unit.factor, false);
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

const withTable = (plots: Plot[]) =>
  plots.flatMap((plot) => {
    const table = state.result.tables.find((t) => t.name === plot.table);
    return table ? [{ plot, table }] : [];
  });

const Cards = ({ plots }: { plots: Plot[] }) => (
  <>
    {withTable(plots).map(({ plot, table }) => (
      <div class="card plot" key={`${plot.name}/${plot.scene}`} data-plot={plot.name}>
        <h3>{plot.title}</h3>
        {plot.style === "histogram" ? <Histogram plot={plot} table={table} /> : plot.style === "polar" ? <Polar plot={plot} table={table} /> : <TablePlot plot={plot} table={table} />}
      </div>
    ))}
  </>
);

/** Plots over the input of the scene that is shown. */
export function Plots() {
  const shown = state.view.plots.filter((p) => p.scene !== "" && p.scene === state.scene.value?.name);
  if (withTable(shown).length === 0) return null;
  return (
    <section aria-labelledby="h-plots">
      <h2 id="h-plots">Over the motion</h2>
      <p class="note screen-only">Point at a diagram and the mechanism moves there.</p>
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
  const data = useMemo<uPlot.AlignedData>(
    () => (lines.length ? uPlot.join(lines.map((r) => [r.x, r.y.map((v) => (v > 0 ? v : null))] as uPlot.AlignedData)) : [[]]),
    [runs],
  );
  if (lines.length === 0) return null;
  const counts = lines[0].counts;
  return (
    <div class="card plot" data-plot="convergence">
      <h3>Convergence of the {lines.length === 1 ? "run" : `${lines.length} runs`}</h3>
      <Chart label="Best cost of each seed against effort, logarithmic" data={data} options={() => ({
        scales: { x: { time: false }, y: { distr: 3 } },
        axes: [axis(counts), axis("best so far", true)],
        series: [{}, ...lines.map((r) => ({
          label: `seed ${r.seed}`, stroke: css("--accent"), alpha: lines.length > 6 ? 0.5 : 0.9, width: 1.5, spanGaps: true,
          points: { show: false }, paths: uPlot.paths.stepped!({ align: 1 }),
        }))],
        focus: { alpha: 0.15 },
        cursor: { drag: { setScale: false }, focus: { prox: 24 }, y: false, points: { show: false } },
      })} />
    </div>
  );
}
