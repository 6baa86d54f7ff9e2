// SPDX-License-Identifier: BSD-3-Clause

// Files that the report gives away.
import type { Num, Scene, Table } from "./data";
import { decimal } from "./decimal";
import { inFile } from "./units";
import { targetErrors } from "./view";

const quote = (text: string) => (/[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);

/** RFC 4180 text of a table: shortest digits that read back the same, missing values empty, status last. */
export function csv(table: Table): string {
  const rows = table.data[0]?.length ?? 0;
  const number = (value: Num | undefined) => (value == null ? "" : decimal(value));
  const lines = [[...(table.names ? ["name"] : []), ...table.columns.map((c) => quote(c.key)), "status"].join(",")];
  for (let row = 0; row < rows; ++row)
    lines.push([...(table.names ? [quote(table.names[row])] : []), ...table.data.map((c) => number(c[row])), quote(table.status[row] ?? "done")].join(","));
  return lines.join("\r\n") + "\r\n";
}

/** True if a table is in other units than those that are shown. */
export const inOtherUnits = (table: Table): boolean => table.columns.some((c) => inFile(c.key, []).key !== c.key);

/** The table in the units that are shown; nothing when it is in them already. */
export function tableInFile(table: Table): Table | undefined {
  if (!inOtherUnits(table)) return undefined;
  const made = table.columns.map((c, i) => inFile(c.key, table.data[i]));
  return { ...table, columns: table.columns.map((c, i) => ({ ...c, key: made[i].key })), data: made.map((column) => column.values) };
}

/** The deviation from each target, as a table. */
export function targetTable(scene: Scene): Table | null {
  const target = scene.targets[0];
  if (!target) return null;
  const columns = { x_m: target.x, y_m: target.y, achieved_x_m: target.achieved_x, achieved_y_m: target.achieved_y, distance_m: targetErrors(target).distance };
  return {
    name: `targets of ${scene.name}`,
    columns: Object.keys(columns).map((key) => ({ key, label: "" })),
    data: Object.values(columns).map((values) => target.x.map((_, i) => values[i] ?? null)),
    status: [],
  };
}

/** A file name made of a title. */
export const slug = (title: string) =>
  title.normalize("NFKD").toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-+|-+$/g, "").slice(0, 60) || "report";

export function save(name: string, content: Blob | string, type = "text/plain"): void {
  const url = URL.createObjectURL(typeof content === "string" ? new Blob([content], { type: `${type};charset=utf-8` }) : content);
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

const styles = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-linecap", "stroke-linejoin", "opacity",
  "font-size", "font-style", "font-weight", "text-anchor", "paint-order", "dominant-baseline"];

/** The drawing as it stands, in the colours of the light theme, as a document of its own. */
export function drawingSvg(drawing: SVGSVGElement): string {
  const root = document.documentElement;
  const theme = root.dataset.theme;
  root.dataset.theme = "light";
  const copy = drawing.cloneNode(true) as SVGSVGElement;
  const from = drawing.querySelectorAll<SVGElement>("*");
  copy.querySelectorAll<SVGElement>("*").forEach((element, i) => {
    const computed = getComputedStyle(from[i]);
    for (const name of styles) element.setAttribute(name, computed.getPropertyValue(name));
    // Their colours are those of the page, which the file does not have.
    for (const name of ["class", "style"]) element.removeAttribute(name);
  });
  if (theme === undefined) delete root.dataset.theme;
  else root.dataset.theme = theme;
  const { width, height } = drawing.getBoundingClientRect();
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", String(Math.round(width)));
  copy.setAttribute("height", String(Math.round(height)));
  copy.setAttribute("font-family", "system-ui, sans-serif");
  for (const name of ["class", "style", "tabindex"]) copy.removeAttribute(name);
  return new XMLSerializer().serializeToString(copy);
}

/** A drawing as pixels. */
export async function pictureOf(svg: string, scale = 1): Promise<HTMLCanvasElement> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = image.naturalWidth * scale;
  canvas.height = image.naturalHeight * scale;
  canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas;
}

export async function png(svg: string): Promise<Blob> {
  const canvas = await pictureOf(svg, 2);
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the picture could not be made")))),
  );
}
