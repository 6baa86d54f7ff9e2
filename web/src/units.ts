// SPDX-License-Identifier: BSD-3-Clause

// Numbers for people: SI in the data, on the page the units that the program chose for it.
import type { Num, ShownSuffix } from "./data";

let suffixes: ShownSuffix[] = [];
/** The units of the report; before this, numbers have none. */
export function useUnits(shown: ShownSuffix[]): void {
  suffixes = shown.map((s) => ({ ...s, symbol: spaced(s.symbol) }));
}
/** Words that belong together: "N m". */
export const spaced = (words: string) => words.replace(/ /g, "\u202f");
const suffixOf = (key: string) => suffixes.find((s) => key.endsWith(s.suffix));

const missing = "–";

/** `digits` significant digits without trailing zeros; a true minus sign. */
export function format(value: number | null | undefined, digits = 6): string {
  if (value === null || value === undefined || Number.isNaN(value)) return missing;
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e-4 && size < 10 ** Math.max(digits, 6)
    ? String(Number(value.toPrecision(digits)))
    : Number(value.toPrecision(digits)).toExponential().replace("e+", "e");
  const [mantissa, exponent] = text.split("e");
  const power = exponent === undefined ? "" : `×10${[...exponent].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)])).join("")}`;
  return mantissa.replace("-", "−") + power;
}

export interface Unit {
  factor: number; // display = SI * factor
  symbol: string;
}

/** Unit of a key by its suffix; where no unit was chosen, with `size`, the largest of the numbers, lengths below a metre in millimetres, stresses from a hundredth of a megapascal on in megapascals. */
export function unitOf(key: string, size = Infinity): Unit {
  const found = suffixOf(key);
  if (!found) return { factor: 1, symbol: "" };
  if (found.by_size && found.suffix === "_m" && size < 1) return { factor: 1000, symbol: "mm" };
  if (found.by_size && found.suffix === "_Pa" && size >= 1e4 && size < Infinity) return { factor: 1e-6, symbol: "MPa" };
  return { factor: found.factor, symbol: found.symbol };
}

/** A key and its numbers in files of the units that are shown: "_rpm" for "_rad_per_s". */
export function inFile(key: string, values: Num[]): { key: string; values: Num[] } {
  const found = suffixOf(key);
  if (!found || found.key === found.suffix) return { key, values };
  const [multiply, divide, back, by] = found.steps;
  return { key: key.slice(0, -found.suffix.length) + found.key, values: values.map((v) => (v === null ? null : (((v * multiply) / divide) * back) / by)) };
}

/** "crank_angle_rad" -> "crank angle". */
export function nameOf(key: string): string {
  const found = suffixOf(key);
  return (found ? key.slice(0, -found.suffix.length) : key).replace(/_/g, " ");
}

export const largestSize = (values: Num[]) => values.reduce<number>((most, v) => Math.max(most, Math.abs(v ?? 0)), 0);

// Less than this share of the largest number of a column is its rounding.
const rounding = 1e-14;
/** Texts of a column of a table, by rows: six digits in the unit that is shown, 0 for what is only rounding. */
export function cellsOf(key: string, values: Num[]): (row: number) => string {
  const size = largestSize(values);
  const unit = unitOf(key, size);
  return (row) => {
    const v = values[row] ?? null;
    return format(v !== null && Math.abs(v) < rounding * size ? 0 : v !== null ? v * unit.factor : null);
  };
}

/** Name or label of a column with the unit in which it is shown: "crank angle (°)". */
export function labelWith(label: string, key: string, unit: Unit): string {
  const bare = (label || nameOf(key)).replace(/\s*[([][^()[\]]*[)\]]\s*$/, "");
  return unit.symbol ? `${bare} (${unit.symbol})` : label || bare;
}

export const quantity = (key: string, value: number | null, digits = 6): string => {
  const unit = unitOf(key, value === null ? Infinity : Math.abs(value));
  if (value === null) return missing;
  const text = format(value * unit.factor, digits);
  return unit.symbol ? `${text}${unit.symbol === "°" ? "" : "\u202f"}${unit.symbol}` : text;
};

/** Unit for lengths of a drawing of this size (m). */
export const lengthUnit = (size: number): Unit => unitOf("_m", size);
