// SPDX-License-Identifier: BSD-3-Clause

// Tables of the data: in the units of the study, with a choice of columns where there are many.
import { useMemo, useState } from "preact/hooks";
import type { Table } from "./data";
import { csv, inOtherUnits, save, slug, tableInFile } from "./exports";
import { cellsOf, labelWith, largestSize, unitOf } from "./units";

const mostRows = 2000;
const mostColumns = 12;

/** Words of a status: "no_assembly" is "no assembly". */
const words = (status: string) => status.replace(/_/g, " ");

export function DataTable({ table }: { table: Table }) {
  const [open, setOpen] = useState(false);
  const [sought, setSought] = useState("");
  const [all, setAll] = useState(false);
  const rows = table.data[0]?.length ?? 0;
  const shown = Math.min(rows, mostRows);
  // A closed table is not computed before it is asked for: there may be many, while a mechanism is dragged.
  const heads = useMemo(() => (open ? table.columns.map((c, i) => labelWith(c.label, c.key, unitOf(c.key, largestSize(table.data[i])))) : []), [table, open]);
  const otherUnits = inOtherUnits(table);
  const name = slug(table.name);
  // The first column is the input, by which rows are found: it always stays.
  const parts = sought.toLowerCase().split(/\s+/).filter(Boolean);
  const fits = (i: number) => parts.every((part) => heads[i]?.toLowerCase().includes(part) || table.columns[i].key.toLowerCase().includes(part));
  const found = table.columns.flatMap((_, i) => (i === 0 || fits(i) ? [i] : []));
  const columns = all || parts.length ? found : found.slice(0, mostColumns);
  return (
    <div class="data-table">
      <span class="gets">
        <button type="button" class="get" data-download={`${table.name}.csv`} aria-label={`${table.name} as CSV${otherUnits ? ", in the units shown" : ""}`}
          onClick={() => save(`${name}.csv`, csv(tableInFile(table) ?? table), "text/csv")}>CSV</button>
        {otherUnits && <button type="button" class="get" data-download={`${table.name}, as written.csv`} aria-label={`${table.name}: CSV in SI, as the program writes it`}
          onClick={() => save(`${name}-si.csv`, csv(table), "text/csv")}>CSV in SI</button>}
      </span>
      <details onToggle={(e) => setOpen(e.currentTarget.open)}>
        <summary>{table.name} <span class="note">{rows} rows, {table.columns.length} columns</span></summary>
        {open && table.columns.length > mostColumns && (
          <p class="choose-columns screen-only">
            <label>columns with <input type="search" value={sought} placeholder="force, speed x ..." onInput={(e) => setSought(e.currentTarget.value)} /></label>
            <label><input type="checkbox" checked={all} onChange={(e) => setAll(e.currentTarget.checked)} /> all</label>
            <span class="note" role="status">{columns.length} of {table.columns.length} columns</span>
          </p>
        )}
        {open && (
          <div class="scroll tall" tabIndex={0} role="region" aria-label={table.name}><table class="frozen">
            <thead><tr>{table.names && <th scope="col">name</th>}{columns.map((i) => <th scope="col" class="num">{heads[i]}</th>)}{table.status.length > 0 && <th scope="col">status</th>}</tr></thead>
            <Rows table={table} columns={columns} count={shown} />
          </table></div>
        )}
        {open && shown < rows && <p class="note">The first {shown} rows; the CSV file has them all.</p>}
      </details>
    </div>
  );
}

function Rows({ table, columns, count }: { table: Table; columns: number[]; count: number }) {
  const cells = useMemo(() => table.columns.map((c, i) => cellsOf(c.key, table.data[i])), [table]);
  return (
    <tbody>{Array.from({ length: count }, (_, row) => (
      <tr>
        {table.names && <th scope="row">{table.names[row]}</th>}
        {columns.map((i, k) => (k === 0 && !table.names ? <th scope="row" class="num">{cells[i](row)}</th> : <td class="num">{cells[i](row)}</td>))}
        {table.status.length > 0 && <td class={table.status[row] === "done" ? "" : "defect"}>{words(table.status[row])}</td>}
      </tr>))}
    </tbody>
  );
}
