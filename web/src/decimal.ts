// SPDX-License-Identifier: BSD-3-Clause

// Numbers in files, as the program writes them: the fewest digits that read back the same.

/** The number as in CSV: "0.5", "1e-05", "1e+16". */
export function decimal(value: number): string {
  if (Object.is(value, -0)) return "-0";
  const size = Math.abs(value);
  // The digits are those of JavaScript; only where powers of ten begin, and how they look, differs.
  if (size !== 0 && (size < 1e-4 || size >= 1e16))
    return value.toExponential().replace(/e([+-])(\d)$/, "e$10$2");
  return String(value);
}

/** The number as in JSON: "1.0" for a whole number, null for a missing one. */
export function jsonNumber(value: number | null): string {
  if (value === null) return "null";
  const text = decimal(value);
  return /[.e]/.test(text) ? text : `${text}.0`;
}
