// Diagrams. Their cursor and the animation follow each other.
import { effect } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Num, Plot, Table } from "./data";
import { histogram, readLog, type Run } from "./log";
import { inputAt, positionOf } from "./motion";
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
}

export function Chart({ label, options, data, linked = false, factor = 1, units = [] }: Props) {
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
                if (!linked) return;
                now = u.over.appendChild(document.createElement("div"));
                now.className = "now";
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
    const stop = effect(() => {
      state.theme.value;
      const at = state.position.value;
      if (!linked || !now || !plot) return;
      now.style.transform = `translateX(${plot.valToPos(inputAt(state.motion.value, at) * factor, "x").toFixed(1)}px)`;
      values.current.forEach((span, i) => {
        const v = data[i + 1]?.[Math.round(at)];
        if (span) span.textContent = `${format(v ?? null, 5)}${units[i]?.symbol ? ` ${units[i].symbol}` : ""}`;
      });
    });
    const observer = new ResizeObserver(() => {
      if (!plot || !element.clientWidth || element.clientWidth === plot.width) return;
      plot.setSize({ width: element.clientWidth, height });
      if (now && linked) now.style.transform = `translateX(${plot.valToPos(inputAt(state.motion.peek(), state.position.peek()) * factor, "x").toFixed(1)}px)`;
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

function TablePlot({ plot, table }: { plot: Plot; table: Table }) {
  const column = (key: string) => table.columns.findIndex((c) => c.key === key);
  const linked = plot.style !== "histogram" && plot.scene !== "" && plot.scene === state.scene.value?.name;
  const made = useMemo(() => {
    const ys = plot.y.map(column).filter((i) => i >= 0);
    const unit = unitOf(plot.y[0] ?? "", largest(ys.map((i) => table.data[i])));
    const labels = ys.map((i) => labelWith(table.columns[i].label, table.columns[i].key, unit));
    if (plot.style === "histogram") {
      const { middles, counts } = histogram(scaled(ys.flatMap((i) => table.data[i]), unit.factor, false));
      return {
        data: [middles, counts] as uPlot.AlignedData, units: [], factor: 1,
        options: () => ({
          scales: { x: { time: false }, y: { range: (_: uPlot, __: number, high: number): uPlot.Range.MinMax => [0, Math.max(1, high * 1.1)] } },
          axes: [axis(labels.join(", ")), axis("count")],
          series: [{}, { fill: css("--c0"), stroke: css("--c0"), width: 0, paths: uPlot.paths.bars!({ size: [0.92] }), points: { show: false } }],
          cursor: { drag: { setScale: false } },
        }),
      };
    }
    const x = column(plot.x);
    const xs = table.data[x] ?? [];
    const xUnit = unitOf(plot.x, largest([xs]));
    const multiple = labels.length > 1;
    return {
      data: [xs.map((v) => (v ?? 0) * xUnit.factor), ...ys.map((i) => scaled(table.data[i], unit.factor, plot.logarithmic_y))] as uPlot.AlignedData,
      units: labels.map((l) => ({ label: l.replace(/ \([^()]*\)$/, ""), symbol: unit.symbol })),
      factor: xUnit.factor,
      options: () => ({
        scales: { x: { time: false }, y: { distr: plot.logarithmic_y ? (3 as const) : (1 as const) } },
        axes: [axis(labelWith(table.columns[x]?.label ?? "", plot.x, xUnit)), axis(multiple ? unit.symbol : labels[0] ?? "", plot.logarithmic_y)],
        series: [
          {},
          ...labels.map((l, i) => ({
            label: l, stroke: css(seriesColours[i % 6]), width: plot.style === "points" ? 0 : 2, dash: dashes[i % 6],
            paths: plot.style === "points" ? () => null : undefined, points: { show: plot.style === "points", size: 6, fill: css(seriesColours[i % 6]) },
          })),
        ],
        cursor: { drag: { setScale: false }, y: false, points: { size: 7 } },
      }),
    };
  }, [plot, table]);
  return <Chart label={plot.title} data={made.data} options={made.options} linked={linked} factor={made.factor} units={made.units} />;
}

export function Plots() {
  const name = state.scene.value?.name ?? "";
  const shown = state.view.plots.filter((p) => p.scene === "" || p.scene === name);
  const known = shown.flatMap((plot) => {
    const table = state.result.tables.find((t) => t.name === plot.table);
    return table ? [{ plot, table }] : [];
  });
  if (known.length === 0) return null;
  return (
    <section aria-labelledby="h-plots">
      <h2 id="h-plots">Over the motion</h2>
      <p class="note screen-only">Point at a diagram and the mechanism moves there.</p>
      <div class="grid-2">
        {known.map(({ plot, table }) => (
          <div class="card plot" key={`${plot.name}/${plot.scene}`} data-plot={plot.name}>
            <h3>{plot.title}</h3>
            <TablePlot plot={plot} table={table} />
          </div>
        ))}
      </div>
    </section>
  );
}

/** Best cost against effort, one line a seed. */
export function Convergence({ runs }: { runs: ReturnType<typeof readLog> }) {
  const lines = runs.filter((run: Run) => run.x.length > 1 && run.y.some((v) => v > 0));
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
