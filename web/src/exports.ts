// Files that the report gives away.
import { extentOf, isSymbol, symbolLines } from "./arrows";
import type { Num, Scene, Table } from "./data";
import { decimal } from "./decimal";
import { isSpatial } from "./grid";
import { analyse, placeAt, type Place } from "./motion";
import { beyond, helix, wheelCircle } from "./space_view";
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

/** The scene at a sample as an AutoCAD R12 drawing in millimetres, scale 1:1: the same layers as the program writes. */
export function dxf(scene: Scene, sample: number): string {
  const out: string[] = [];
  const spatial = isSpatial(scene);
  const put = (...pairs: (string | number)[]) => out.push(...pairs.map(String));
  const mm = (metres: number) => Number((metres * 1000).toPrecision(9));
  const at = (first: number, p: Place) => put(first, mm(p.x), first + 10, mm(p.y), first + 20, mm(p.z ?? 0));
  const line = (layer: string, a: Place, b: Place) => {
    put(0, "LINE", 8, layer);
    at(10, a);
    at(11, b);
  };
  const circle = (layer: string, p: Place, radius: number) => {
    put(0, "CIRCLE", 8, layer);
    at(10, p);
    put(40, mm(radius));
  };
  const polyline = (layer: string, places: Place[], closed: boolean) => {
    put(0, "POLYLINE", 8, layer, 66, 1, 10, 0, 20, 0, 30, 0, 70, (closed ? 1 : 0) + (spatial ? 8 : 0));
    for (const p of places) {
      put(0, "VERTEX", 8, layer);
      at(10, p);
      if (spatial) put(70, 32);
    }
    put(0, "SEQEND", 8, layer);
  };
  const symbol = Math.max(extentOf(scene) ?? 0.1, 1e-6) / 100;
  put(999, "linkwright: units are millimetres, scale 1:1", 0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1009", 0, "ENDSEC");
  put(0, "SECTION", 2, "TABLES", 0, "TABLE", 2, "LTYPE", 70, 2);
  put(0, "LTYPE", 2, "CONTINUOUS", 70, 0, 3, "Solid line", 72, 65, 73, 0, 40, 0);
  put(0, "LTYPE", 2, "DASHDOT", 70, 0, 3, "Dash dot", 72, 65, 73, 4, 40, 10, 49, 6, 49, -2, 49, 0, 49, -2, 0, "ENDTAB");
  const layers: [string, number, string][] = [
    ["GROUND", 8, "DASHDOT"], ["LINKS", 5, "CONTINUOUS"], ["JOINTS", 7, "CONTINUOUS"], ["TRACE", 3, "CONTINUOUS"], ["TARGETS", 1, "CONTINUOUS"],
  ];
  if (scene.bodies.some((b) => b.style === "axis")) layers.push(["AXES", 1, "DASHDOT"]);
  if (scene.discs?.length) layers.push(["WHEELS", 8, "CONTINUOUS"]);
  put(0, "TABLE", 2, "LAYER", 70, layers.length);
  for (const [name, colour, type] of layers) put(0, "LAYER", 2, name, 70, 0, 62, colour, 6, type);
  put(0, "ENDTAB", 0, "ENDSEC", 0, "SECTION", 2, "ENTITIES");
  for (const body of scene.bodies) {
    if (body.style === "gap" || body.run) continue;
    const places = body.points.map((p) => placeAt(scene, p, sample)).filter((p): p is Place => p !== null);
    if (places.length < body.points.length) continue;
    const layer = body.style === "ground" || body.style === "guide" ? "GROUND" : "LINKS";
    if (body.style === "axis") {
      const on = beyond(places);
      for (let i = 1; i < on.length; ++i) line("AXES", on[i - 1], on[i]);
    } else if (body.style === "plate" && places.length > 2) polyline(layer, places, true);
    else
      for (let i = 1; i < places.length; ++i)
        if (spatial && body.style === "spring") polyline(layer, helix(places[i - 1], places[i], 6 * symbol), false);
        else if (isSymbol(body.style) && !spatial) for (const stroke of symbolLines(body.style, places[i - 1], places[i], 3 * symbol)) polyline(layer, stroke, false);
        else line(layer, places[i - 1], places[i]);
  }
  for (const disc of spatial ? (scene.discs ?? []) : [])
    for (const side of [-0.5, 0, 0.5]) {
      const rim = wheelCircle(scene, disc, sample, side * disc.width, 72);
      if (rim.length) polyline("WHEELS", rim, true);
    }
  for (const { centre, rim } of spatial ? [] : scene.circles) {
    const [c, r] = [placeAt(scene, centre, sample), placeAt(scene, rim, sample)];
    if (c && r) circle("LINKS", c, Math.hypot(r.x - c.x, r.y - c.y));
  }
  for (const joint of scene.joints) {
    const p = placeAt(scene, joint.point, sample);
    if (!p) continue;
    if (spatial) {
      put(0, "POINT", 8, "JOINTS");
      at(10, p);
    } else circle("JOINTS", p, symbol);
    put(0, "TEXT", 8, "JOINTS");
    at(10, { ...p, x: p.x + 1.5 * symbol, y: p.y + 1.5 * symbol });
    put(40, mm(2 * symbol), 1, joint.name.replace(/[^\x20-\x7e]/g, "?"));
    if (joint.style === "ground_pivot" && !spatial)
      polyline("GROUND", [p, { x: p.x - 2 * symbol, y: p.y - 3 * symbol }, { x: p.x + 2 * symbol, y: p.y - 3 * symbol }], true);
  }
  const { ok } = analyse(scene);
  for (const trace of scene.traces) {
    if (trace.run) continue;
    let run: Place[] = [];
    let whole = true;
    const flush = (closed: boolean) => {
      if (run.length > 1) polyline("TRACE", run, closed);
      run = [];
    };
    scene.input.forEach((_, i) => {
      const p = placeAt(scene, trace.point, i);
      if (p && ok[i]) run.push(p);
      else {
        whole = false;
        flush(false);
      }
    });
    flush(trace.closed && whole);
  }
  for (const target of spatial ? [] : scene.targets)
    target.x.forEach((x, i) => {
      const y = target.y[i];
      if (x === null || y == null) return;
      put(0, "POINT", 8, "TARGETS");
      at(10, { x, y });
      circle("TARGETS", { x, y }, symbol / 2);
    });
  put(0, "ENDSEC", 0, "EOF");
  return out.join("\n") + "\n";
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
