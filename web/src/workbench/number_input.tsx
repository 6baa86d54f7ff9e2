// SPDX-License-Identifier: BSD-3-Clause

// One number of the study, to be typed or stepped.
import { signal } from "@preact/signals";
import { format, unitOf } from "../units";
import { unitKey, type Entry } from "./numbers";
import { edit } from "./session";

export const refused = signal(""); // the key of a number that cannot be what was typed, and why
const round = (value: number) => Number(value.toPrecision(7));

/** A number in the unit that the page shows. `part`: of a range; `size`: by which its unit is chosen, else by its own. */
export function NumberInput({ entry, value, part, label, size = Math.abs(value) }: { entry: Entry; value: number; part?: "min" | "max"; label: string; size?: number }) {
  const { key, rule } = entry;
  const unit = unitOf(unitKey(key), size);
  const shown = round(value * unit.factor);
  const own = part ? `${key}.${part}` : key;
  const give = (next: number) => {
    const to = next / unit.factor;
    const low = rule?.least !== undefined && (rule.open ? to <= rule.least : to < rule.least);
    if (low || (rule?.most !== undefined && to > rule.most)) {
      refused.value = `${key}: ${low ? `more than ${rule!.open ? "" : "or "}${format(rule!.least! * unit.factor)}` : `at most ${format(rule!.most! * unit.factor)}`}${unit.symbol && ` ${unit.symbol}`}`;
      return false;
    }
    refused.value = "";
    edit([{ key, value: part ? { ...(entry.value as { min: number; max: number }), [part]: to } : to }]);
    return true;
  };
  return (
    <input type="number" step="any" value={String(shown)} data-key={own} aria-label={label} onChange={(e) => {
      const next = Number(e.currentTarget.value);
      if (next === shown && e.currentTarget.value !== "") return;
      if (e.currentTarget.value === "" || !Number.isFinite(next) || !give(next)) e.currentTarget.value = String(shown);
    }} onKeyDown={(e) => {
      // A tenth of the digit before the last; with shift ten times as much.
      if (e.key !== "ArrowUp" && e.key !== "ArrowDown") return;
      e.preventDefault();
      const step = 10 ** (Math.floor(Math.log10(Math.abs(shown) || 1)) - 2) * (e.shiftKey ? 10 : 1);
      give(shown + (e.key === "ArrowUp" ? step : -step));
    }} />
  );
}
