// SPDX-License-Identifier: BSD-3-Clause

// Curves of a diagram: one for each value of its group column, its bands, and the design before behind them.
import type { Num, Plot, Scene, Table } from "./data";
import { sortedRows, type Turn } from "./rows";
import { format, labelWith, nameOf, unitOf } from "./units";

const column = (table: Table, key: string | undefined) => table.columns.findIndex((c) => c.key === key);

/** Factor from a table's number to SI, by the unit of its key. */
const toSi = (key: string) => (key.endsWith("_mm") ? 1e-3 : key.endsWith("_deg") ? Math.PI / 180 : key.endsWith("_rpm") ? Math.PI / 30 : 1);

/** The input of a scene that a column is, by its name without the unit: 1, 2 or 0 for none; and its factor to the scene's numbers. */
export function inputOf(scene: Scene | undefined, key: string): { input: 0 | 1 | 2; factor: number } {
  const factor = toSi(key);
  if (scene?.second_key && nameOf(key) === nameOf(scene.second_key)) return { input: 2, factor: factor / toSi(scene.second_key) };
  if (scene && nameOf(key) === nameOf(scene.input_key)) return { input: 1, factor: factor / toSi(scene.input_key) };
  return { input: 0, factor };
}

export interface Group {
  label: string; // "rack −30 mm"; empty = all rows
  value: number;
  rows: number[];
}

/** Rows by the values of the group column, in rising order; one group of all rows when there is no such column. */
export function groupsOf(plot: Plot, table: Table): Group[] {
  const at = column(table, plot.group);
  if (at < 0) return [{ label: "", value: NaN, rows: (table.data[0] ?? []).map((_, i) => i) }];
  const values = [...new Set(table.data[at].filter((v): v is number => v !== null))].sort((a, b) => a - b);
  const { key, label } = table.columns[at];
  const unit = unitOf(key, values.reduce((most, v) => Math.max(most, Math.abs(v)), 0));
  const name = labelWith(label, key, unit).replace(/ \([^()]*\)$/, "");
  return values.map((value) => ({
    label: plot.group_names?.[value - 1] ?? `${name} ${format(value * unit.factor, 5)}${unit.symbol ? `${unit.symbol === "°" ? "" : " "}${unit.symbol}` : ""}`,
    value,
    rows: table.data[at].flatMap((v, row) => (v === value ? [row] : [])),
  }));
}

/** Index of the group that belongs to an input of the scene; -1 = none. Groups may be fewer than the samples. */
export function presentGroup(groups: Group[], factor: number, input: number): number {
  if (groups.length < 2) return -1;
  return groups.reduce((best, g, i) => (Math.abs(g.value * factor - input) < Math.abs(groups[best].value * factor - input) ? i : best), 0);
}

export interface Line {
  kind: "curve" | "baseline" | "lower" | "upper";
  label: string;
  group: number;
  y: number;  // index of the plot's column or band
  xs: number[];
  ys: Num[];
}

/** Everything that a diagram draws, in the numbers of its tables: bands and baselines first, since they lie behind. */
export function linesOf(plot: Plot, table: Table, baseline: Table | undefined, present: number, turn?: Turn): Line[] {
  const from = (source: Table, group: Group, key: string): { xs: number[]; ys: Num[] } | null => {
    const [x, y] = [column(source, plot.x), column(source, key)];
    if (x < 0 || y < 0) return null;
    const { xs, order } = sortedRows(group.rows.map((row) => source.data[x][row] ?? null), turn);
    return { xs, ys: order.map((k) => source.data[y][group.rows[k]] ?? null) };
  };
  const out: Line[] = [];
  const groups = groupsOf(plot, table);
  (plot.bands ?? []).forEach((band, k) => {
    const edges = (g: Group) => {
      const [lower, upper] = [from(table, g, band.lower), from(table, g, band.upper)];
      return lower && upper && lower.ys.some((v, i) => v !== null && upper.ys[i] !== null) ? { lower, upper } : null;
    };
    // The band of the group that is present, or else of the first that has one.
    const candidates = [...(present >= 0 ? [groups[present]] : []), ...groups];
    for (const g of candidates) {
      const found = edges(g);
      if (!found) continue;
      for (const kind of ["lower", "upper"] as const) out.push({ kind, label: band.label, group: groups.indexOf(g), y: k, ...found[kind] });
      break;
    }
  });
  const add = (kind: "curve" | "baseline", source: Table) =>
    plot.y.forEach((key, y) =>
      groupsOf(plot, source).forEach((g, group) => {
        const points = from(source, g, key);
        if (!points) return;
        const at = column(source, key);
        const name = labelWith(source.columns[at].label, key, unitOf(key)).replace(/ \([^()]*\)$/, "");
        out.push({ kind, label: g.label === "" ? name : plot.y.length === 1 ? g.label : `${name}, ${g.label}`, group: g.label === "" ? -1 : group, y, ...points });
      }),
    );
  if (baseline) add("baseline", baseline);
  add("curve", table);
  return out;
}

/** Lines over one rising list of x: a value where a line has none is undefined when it is between its points, so that it goes on. */
export function aligned(lines: Line[], xFactor: number, yFactor: number): [number[], ...(Num | undefined)[][]] {
  const places = [...new Set(lines.flatMap((l) => l.xs))].sort((a, b) => a - b);
  const index = new Map(places.map((x, i) => [x, i]));
  return [
    places.map((x) => x * xFactor),
    ...lines.map((l) => {
      const out: (Num | undefined)[] = places.map(() => undefined);
      l.xs.forEach((x, i) => {
        const v = l.ys[i];
        out[index.get(x)!] = v === null ? null : v * yFactor;
      });
      return out;
    }),
  ];
}

