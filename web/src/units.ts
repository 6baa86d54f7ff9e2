// Numbers for people: SI in the data, degrees and millimetres on the page.

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

// Longer ones first: each ends with units of its own.
export const suffixes: [string, Unit][] = [
  ["_N_m_per_rad", { factor: 1, symbol: "N m/rad" }],
  ["_rad_per_s3", { factor: 1, symbol: "rad/s³" }],
  ["_rad_per_s2", { factor: 1, symbol: "rad/s²" }],
  ["_rad_per_m2", { factor: 180 / Math.PI, symbol: "°/m²" }],
  ["_rad_per_m", { factor: 180 / Math.PI, symbol: "°/m" }],
  ["_rad_per_s", { factor: 1, symbol: "rad/s" }],
  ["_m_per_s3", { factor: 1, symbol: "m/s³" }],
  ["_m_per_s2", { factor: 1, symbol: "m/s²" }],
  ["_m_per_s", { factor: 1, symbol: "m/s" }],
  ["_kg_per_m3", { factor: 1, symbol: "kg/m³" }],
  ["_kg_m2", { factor: 1, symbol: "kg m²" }],
  ["_m3", { factor: 1, symbol: "m³" }],
  ["_m2", { factor: 1, symbol: "m²" }],
  ["_mm", { factor: 1, symbol: "mm" }],
  ["_deg", { factor: 1, symbol: "°" }],
  ["_rpm", { factor: 1, symbol: "rpm" }],
  ["_rad", { factor: 180 / Math.PI, symbol: "°" }],
  ["_N_per_m", { factor: 1, symbol: "N/m" }],
  ["_N_m", { factor: 1, symbol: "N m" }],
  ["_N", { factor: 1, symbol: "N" }],
  ["_MPa", { factor: 1, symbol: "MPa" }],
  ["_Pa", { factor: 1, symbol: "Pa" }],
  ["_Hz", { factor: 1, symbol: "Hz" }],
  ["_W", { factor: 1, symbol: "W" }],
  ["_J", { factor: 1, symbol: "J" }],
  ["_kg", { factor: 1, symbol: "kg" }],
  ["_s", { factor: 1, symbol: "s" }],
  ["_m", { factor: 1, symbol: "m" }],
];

/** Unit of a key by its suffix; with `size`, the largest of the numbers, lengths below a metre in millimetres, stresses from a hundredth of a megapascal on in megapascals. */
export function unitOf(key: string, size = Infinity): Unit {
  const found = suffixes.find(([suffix]) => key.endsWith(suffix));
  if (!found) return { factor: 1, symbol: "" };
  if (found[0] === "_m" && size < 1) return { factor: 1000, symbol: "mm" };
  if (found[0] === "_Pa" && size >= 1e4 && size < Infinity) return { factor: 1e-6, symbol: "MPa" };
  return found[1];
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
