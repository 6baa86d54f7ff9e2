// SPDX-License-Identifier: BSD-3-Clause

// The shapes of an SVG file as one path in mm: with the transforms of their groups, the scale of the page, and the y axis upwards.
import type { Place } from "../motion";
import { PathError, type Path } from "./path";
import { onePath, type Part } from "./path_join";
import { commandsOf, numbersIn, stepsOf, svgParts, type Command } from "./path_svg";
import { tagsOf, type Tag } from "./path_xml";

/** Coefficients a b c d e f of x' = a x + c y + e, y' = b x + d y + f. */
type Matrix = readonly [number, number, number, number, number, number];

const identity: Matrix = [1, 0, 0, 1, 0, 0];
/** The map of `inner`, followed by that of `outer`. */
const times = ([a, b, c, d, e, f]: Matrix, [p, q, r, s, t, u]: Matrix): Matrix => [a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, a * t + c * u + e, b * t + d * u + f];
const translation = (x: number, y: number): Matrix => [1, 0, 0, 1, x, y];
function rotation(degrees: number): Matrix {
  const [cos, sin] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  return [cos, sin, -sin, cos, 0, 0];
}
const tangent = (degrees: number) => Math.tan((degrees * Math.PI) / 180);

/** The functions of the attribute transform, with the counts of numbers that they take. */
const functions = new Map<string, { counts: number[]; matrix: (n: number[]) => Matrix }>(Object.entries({
  matrix: { counts: [6], matrix: ([a, b, c, d, e, f]) => [a, b, c, d, e, f] },
  translate: { counts: [1, 2], matrix: ([x, y = 0]) => translation(x, y) },
  scale: { counts: [1, 2], matrix: ([x, y = x]) => [x, 0, 0, y, 0, 0] },
  rotate: { counts: [1, 3], matrix: ([angle, x = 0, y = 0]) => times(times(translation(x, y), rotation(angle)), translation(-x, -y)) },
  skewX: { counts: [1], matrix: ([angle]) => [1, 0, tangent(angle), 1, 0, 0] },
  skewY: { counts: [1], matrix: ([angle]) => [1, tangent(angle), 0, 1, 0, 0] },
}));

/** The name of an element in messages. */
const nameOf = (tag: Tag): string => `<${tag.name}> in line ${tag.line}`;

function transformOf(tag: Tag): Matrix {
  const text = (tag.value("transform") ?? "").trim();
  if (/(?:^|[;\s])transform\s*:/.test(tag.value("style") ?? "") || (text && tag.value("transform-origin") !== undefined))
    throw new PathError(`${nameOf(tag)} has a transform of its style sheet, which is not applied here.`, "Write it as an attribute, for example transform=\"rotate(30)\", or save the file as plain SVG.");
  const form = /(\w+)\s*\(([^()]*)\)[\s,]*/y;
  let matrix = identity;
  for (let at = 0; at < text.length && text !== "none"; at = form.lastIndex) {
    form.lastIndex = at;
    const [, name, numbers] = form.exec(text) ?? [];
    const found = functions.get(name ?? "");
    const values = found ? numbersIn(numbers!, `the transform ${name} of ${nameOf(tag)}`) : [];
    if (!found?.counts.includes(values.length))
      throw new PathError(`The transform “${text.slice(at, at + 30)}” of ${nameOf(tag)} cannot be read.`, "Transforms are matrix with 6 numbers, translate and scale with 1 or 2, rotate with 1 or 3, skewX and skewY with 1.");
    matrix = times(matrix, found.matrix(values));
  }
  return matrix;
}

/** mm of the units of lengths. */
const units = new Map([["mm", 1], ["cm", 10], ["in", 25.4], ["pt", 25.4 / 72], ["pc", 25.4 / 6], ["q", 0.25]]);
const pixel = 25.4 / 96; // mm

/** A length: its number, and the mm of its unit; null where it is in px or without a unit. */
function measured(tag: Tag, key: string): { value: number; unit: number | null } | null {
  const text = tag.value(key)?.trim();
  if (text === undefined || text === "" || text === "auto") return null;
  const [, number, unit] = /^([-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?)\s*([a-z]*)$/i.exec(text) ?? [];
  const factor = units.get(unit?.toLowerCase()) ?? null;
  if (number === undefined || (factor === null && unit !== "" && unit.toLowerCase() !== "px"))
    throw new PathError(`${key} = “${text.slice(0, 30)}” of ${nameOf(tag)} is not a length.`, "Lengths are numbers, alone or with px, mm, cm, in, pt, pc or Q; percentages have to be converted.");
  return { value: Number(number), unit: factor };
}

/** The map of a viewBox to an area of this size; a size that is null follows the other one. */
function fitted(tag: Tag, width: number | null, height: number | null): Matrix | null {
  const text = tag.value("viewBox");
  if (text === undefined || (width === null && height === null)) return null;
  const [x, y, w, h, ...more] = numbersIn(text, `the viewBox of ${nameOf(tag)}`);
  if (!(w > 0 && h > 0) || more.length) throw new PathError(`The viewBox “${text.slice(0, 30)}” of ${nameOf(tag)} is not four numbers with a positive width and height.`, "Write the left and the upper edge, the width and the height, for example viewBox=\"0 0 210 297\", or remove it.");
  const [across, down] = [(width ?? (height! * w) / h) / w, (height ?? (width! * h) / w) / h];
  const aspect = tag.value("preserveAspectRatio") ?? "";
  if (aspect.includes("none")) return times([across, 0, 0, down, 0, 0], translation(-x, -y));
  const scale = aspect.includes("slice") ? Math.max(across, down) : Math.min(across, down);
  const [, alongX = "Mid", alongY = "Mid"] = /x(M\w\w)Y(M\w\w)/.exec(aspect) ?? [];
  const share = (align: string) => (align === "Min" ? 0 : align === "Max" ? 1 : 0.5);
  return times([scale, 0, 0, scale, share(alongX) * w * (across - scale), share(alongY) * h * (down - scale)], translation(-x, -y));
}

/** The page: its scale, and the user units of 1 mm in lengths that have a unit. */
interface Page {
  matrix: Matrix;
  perMillimetre: number;
}

/** The page of the outermost <svg>. Only sizes in mm, cm, in and the like scale it; numbers alone are mm. */
function pageOf(tag: Tag): Page {
  const size = (key: string) => {
    if (/%\s*$/.test(tag.value(key) ?? "")) return null;
    const found = measured(tag, key);
    return found?.unit && found.value > 0 ? found.value * found.unit : null;
  };
  const [width, height] = [size("width"), size("height")];
  if (width === null && height === null) return { matrix: identity, perMillimetre: 1 };
  const [across, , , down] = fitted(tag, width, height) ?? [pixel, 0, 0, pixel];
  return { matrix: [across, 0, 0, down, 0, 0], perMillimetre: 1 / pixel };
}

/** Coordinates and radii of an element in user units. */
function lengthOf(tag: Tag, key: string, { perMillimetre }: Page): number | null {
  const found = measured(tag, key);
  return found && found.value * (found.unit === null ? 1 : found.unit * perMillimetre);
}

/** The path data of a shape; "" for one that is not drawn. */
function dataOf(tag: Tag, page: Page): string {
  const at = (key: string) => lengthOf(tag, key, page) ?? 0;
  switch (tag.name) {
    case "path": {
      const data = (tag.value("d") ?? "").trim();
      return data === "none" ? "" : data;
    }
    case "line": return `M${at("x1")} ${at("y1")}L${at("x2")} ${at("y2")}`;
    case "polyline":
    case "polygon": {
      const numbers = numbersIn(tag.value("points") ?? "", `points of ${nameOf(tag)}`);
      if (numbers.length % 2) throw new PathError(`${nameOf(tag)} has ${numbers.length} numbers, which are not pairs of coordinates.`, "Copy its attribute points once more: a number is missing, or there is one too many.");
      return numbers.length ? `M${numbers.join(" ")}${tag.name === "polygon" ? "Z" : ""}` : "";
    }
    case "rect": return roundedBox(at("x"), at("y"), at("width"), at("height"), lengthOf(tag, "rx", page), lengthOf(tag, "ry", page));
    case "circle": return ring(at("cx"), at("cy"), at("r"), at("r"));
    case "ellipse": {
      const [rx, ry] = [lengthOf(tag, "rx", page), lengthOf(tag, "ry", page)];
      return ring(at("cx"), at("cy"), rx ?? ry ?? 0, ry ?? rx ?? 0);
    }
    default: return "";
  }
}

/** An ellipse of four arcs, from its point on the positive x axis on. */
function ring(x: number, y: number, rx: number, ry: number): string {
  if (!(rx > 0 && ry > 0)) return "";
  const to = (px: number, py: number) => `A${rx} ${ry} 0 0 1 ${px} ${py}`;
  return `M${x + rx} ${y}${to(x, y + ry)}${to(x - rx, y)}${to(x, y - ry)}${to(x + rx, y)}Z`;
}

/** A rectangle; a radius that is not given is the other one, and none is larger than half of its side. */
function roundedBox(x: number, y: number, width: number, height: number, first: number | null, second: number | null): string {
  if (!(width > 0 && height > 0)) return "";
  const [rx, ry] = [Math.min(Math.max(first ?? second ?? 0, 0), width / 2), Math.min(Math.max(second ?? first ?? 0, 0), height / 2)];
  if (!(rx > 0 && ry > 0)) return `M${x} ${y}h${width}v${height}h${-width}Z`;
  const to = (px: number, py: number) => `A${rx} ${ry} 0 0 1 ${px} ${py}`;
  const [right, bottom] = [x + width, y + height];
  return `M${x + rx} ${y}H${right - rx}${to(right, y + ry)}V${bottom - ry}${to(right - rx, bottom)}H${x + rx}${to(x, bottom - ry)}V${y + ry}${to(x + rx, y)}Z`;
}

const names = ["path", "line", "polyline", "polygon", "rect", "circle", "ellipse"];
/** Elements whose contents are not drawn where they are written. */
const stores = ["defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata"];

const deepest = 100_000; // elements within each other

/** An element with its children: their map to mm, and whether they are drawn. */
interface Level {
  tag: Tag;
  matrix: Matrix;
  drawn: boolean;
}

/** The map from an element's coordinates to mm; of the outermost <svg>, that is the page's. */
function levelOf(tag: Tag, outer: Level | undefined, page: Page): Level {
  const hidden = stores.includes(tag.name) || tag.value("display") === "none" || /(?:^|[;\s])display\s*:\s*none/.test(tag.value("style") ?? "");
  if (hidden || outer?.drawn === false) return { tag, matrix: identity, drawn: false };
  const matrix = times(outer?.matrix ?? page.matrix, transformOf(tag));
  if (tag.name !== "svg" || !outer) return { tag, matrix, drawn: true };
  const at = (key: string) => (/%\s*$/.test(tag.value(key) ?? "") ? null : lengthOf(tag, key, page));
  const inner = fitted(tag, at("width"), at("height")) ?? identity;
  return { tag, matrix: times(times(matrix, translation(at("x") ?? 0, at("y") ?? 0)), inner), drawn: true };
}

/** A shape with its commands. */
interface Shape extends Level {
  commands: Command[];
}

function shapeOf(level: Level, page: Page): Shape | null {
  const data = dataOf(level.tag, page);
  try {
    return data ? { ...level, commands: commandsOf(data) } : null;
  } catch (error) {
    throw error instanceof PathError ? new PathError(`${nameOf(level.tag)}: ${error.message}`, error.hint) : error;
  }
}

/** The lines that a shape draws, in mm with the y axis upwards. */
function partsOf({ tag, matrix: [a, b, c, d, e, f], commands }: Shape, steps: number): Part[] {
  const mapped = ({ x, y }: Place): Place => ({ x: a * x + c * y + e, y: -(b * x + d * y + f) || 0 });
  const parts = svgParts(commands, steps);
  return parts.map(({ points, closed }, k) => ({ points: points.map(mapped), closed, name: parts.length > 1 ? `part ${k + 1} of ${nameOf(tag)}` : nameOf(tag) }));
}

/** The shapes that are drawn, and the names of other elements that draw something. */
function shapesOf(text: string): { drawn: Shape[]; others: string[] } {
  const drawn: Shape[] = [];
  const open: Level[] = [];
  const others = new Set<string>();
  let page: Page = { matrix: identity, perMillimetre: 1 };
  for (const tag of tagsOf(text)) {
    if (tag.kind === "end") {
      const begin = open.pop()?.tag;
      if (begin?.name !== tag.name) throw new PathError(`</${tag.name}> in line ${tag.line} ends ${begin ? nameOf(begin) : "an element that does not begin"}.`, "Save the file again: an element in it is not closed.");
      continue;
    }
    if (tag.name === "svg" && !open.length) page = pageOf(tag);
    const level = levelOf(tag, open[open.length - 1], page);
    const shape = level.drawn && names.includes(tag.name) ? shapeOf(level, page) : null;
    if (shape) drawn.push(shape);
    else if (level.drawn && ["use", "text", "image"].includes(tag.name)) others.add(`<${tag.name}>`);
    if (tag.kind === "begin") open.push(level);
    if (open.length > deepest) throw new PathError(`${nameOf(tag)} lies within more than ${deepest} elements.`, "Ungroup the drawing, and save the file again.");
  }
  const cut = open.find(({ tag }) => tag.name === "svg");
  if (cut) throw new PathError(`The file ends before </svg>, which closes ${nameOf(cut.tag)}.`, "Copy or save the file once more: its end is missing.");
  return { drawn, others: [...others] };
}

/** The one line that an SVG file draws. */
export function svgFile(text: string): Path {
  const { drawn, others } = shapesOf(text);
  const only = others.length ? `, only ${others.join(", ")}` : "";
  if (!drawn.length) throw new PathError(`The SVG file draws none of ${names.map((name) => `<${name}>`).join(", ")}${only}.`, "Convert texts and clones to paths in the drawing program (“Object to path”, “Unlink clone”), and save the file again.");
  const steps = stepsOf(drawn.map(({ commands }) => commands));
  return onePath(drawn.flatMap((shape) => partsOf(shape, steps)), "The SVG file", "Delete the others, or join them end to end, or paste the attribute d of one path.");
}
