// SPDX-License-Identifier: BSD-3-Clause

// Lists of points and tables of functions: rows to be typed, added, taken out, and pasted from a spreadsheet.
import * as state from "../state";
import { unitOf } from "../units";
import { NumberInput } from "./number_input";
import { unitKey, type Group, type List } from "./numbers";
import type { Edit } from "./engine";
import { nextRow, pastedRows } from "./points";
import { canonical, pacedStudy, schema, tryEdit } from "./session";
import { nodeAt } from "./schema";

function Rows({ list: { key, label, columns, rows } }: { list: List }) {
  const size = Math.max(...rows.flat().map(Math.abs));
  const { symbol, factor } = unitOf(unitKey(key), size);
  return (
    <table class="rows" data-list={key} onPaste={(e) => {
      const pasted = pastedRows(e.clipboardData?.getData("text") ?? "", factor);
      if (!pasted) return;
      e.preventDefault();
      const at = [...e.currentTarget.tBodies[0].rows].findIndex((row) => row.contains(e.target as Node));
      const from = pasted.length > 1 && at > 0 ? at : 0;
      tryEdit([{ key, value: pasted.length === 1 ? rows.map((row, i) => (i === at ? pasted[0] : row)) : [...rows.slice(0, from), ...pasted] }]);
    }}>
      <caption>{label}</caption>
      <thead><tr><td />{columns.map((c) => <th scope="col">{c}{symbol && <small> {symbol}</small>}</th>)}<td /></tr></thead>
      <tbody>
        {rows.map((row, i) => (
          <tr key={i}>
            <th scope="row">{i + 1}</th>
            {row.map((value, k) => <td key={k}><NumberInput entry={{ key: `${key}[${i}][${k}]`, label, value, rule: null }} value={value} size={size} label={`${label} ${i + 1}, ${columns[k]}`} /></td>)}
            <td><button type="button" class="out" disabled={rows.length < 3} aria-label={`Remove row ${i + 1} of ${label}`} title="Remove this row" onClick={() => tryEdit([{ key, value: rows.filter((_, other) => other !== i) }])}>×</button></td>
          </tr>))}
      </tbody>
      <tfoot><tr><td colSpan={4}><button type="button" data-grow={key} title="Rows of a spreadsheet can be pasted, too" onClick={() => tryEdit([{ key, value: [...rows, nextRow(rows)] }])}>Add a row</button></td></tr></tfoot>
    </table>
  );
}

const knots = 11; // rows that a formula becomes

/** A formula as rows of a table: what is wanted of the output over x. */
function asTable(path: string): Edit[] {
  const table = state.result.tables.find((t) => t.columns.some((c) => c.key === "x") && t.columns.some((c) => c.key.startsWith("wanted_")));
  if (!table) return [];
  const column = (is: (key: string) => boolean) => table.data[table.columns.findIndex((c) => is(c.key))];
  const [x, wanted] = [column((key) => key === "x"), column((key) => key.startsWith("wanted_"))];
  const rows = Array.from({ length: knots }, (_, k) => Math.round((k * (x.length - 1)) / (knots - 1))).map((i) => [x[i] ?? NaN, wanted[i] ?? NaN].map((v) => Number(v.toPrecision(6))));
  const target = canonical.value!.target as Record<string, unknown>;
  const without = ["function", "exponent", "coefficients", "x"].filter((name) => name in target).map((name): Edit => ({ key: `${path}.${name}`, value: null }));
  return rows.flat().every(Number.isFinite) ? [...without, { key: `${path}.table`, value: rows.sort((a, b) => a[0] - b[0]) }] : [];
}

/** The lists of a group, and a table in the place of a formula. */
export function Lists({ group: { path, lists } }: { group: Group }) {
  const study = pacedStudy.value;
  const target = study?.target as Record<string, unknown> | undefined;
  const formula = path === "target" && target?.function !== undefined && nodeAt(schema.value, study!, "target.table") !== null;
  return (
    <>
      {lists.map((list) => <Rows key={list.key} list={list} />)}
      {formula && <button type="button" id="as-table" title="The function as rows that can be changed one by one" onClick={() => tryEdit(asTable(path))}>Turn the function into a table</button>}
    </>
  );
}
