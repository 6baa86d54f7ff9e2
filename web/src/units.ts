// Numbers for people: SI in the data, degrees and millimetres on the page.
import { suffixes } from "./suffixes";

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

/** Unit of a key by its suffix; with `size`, the largest of the numbers, lengths below a metre in millimetres, stresses from a hundredth of a megapascal on in megapascals. */
export function unitOf(key: string, size = Infinity): Unit {
  const found = suffixes.find(([suffix]) => key.endsWith(suffix));
  if (!found) return { factor: 1, symbol: "" };
  const [suffix, factor, symbol] = found;
  if (suffix === "_m" && size < 1) return { factor: 1000, symbol: "mm" };
  if (suffix === "_Pa" && size >= 1e4 && size < Infinity) return { factor: 1e-6, symbol: "MPa" };
  return { factor, symbol };
}

/** "crank_angle_rad" -> "crank angle". */
export function nameOf(key: string): string {
  const found = suffixes.find(([suffix]) => key.endsWith(suffix));
  return (found ? key.slice(0, -found[0].length) : key).replace(/_/g, " ");
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

export const lengthUnit = (size: number): Unit => (size < 1 ? { factor: 1000, symbol: "mm" } : { factor: 1, symbol: "m" });
