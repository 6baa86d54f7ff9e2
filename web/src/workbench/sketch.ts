// SPDX-License-Identifier: BSD-3-Clause

// A linkage as it is drawn with the pointer, in one position, in millimetres: points on links, and what holds, drives and loads them;
// and the study that it makes.

export interface Place {
  x: number;
  y: number;
}
/** A point that is drawn: a pin where bodies meet, or a point of one body alone. */
export interface Pin extends Place {
  ground: boolean;
  /** Direction of the guide of a slider on this pin (deg); null = there is none. */
  guide: number | null;
  traced: boolean;
}

export type ElementKind = "drive" | "gear" | "spring" | "torsion_spring" | "force";
/** A machine element or load on the points of a sketch. */
export interface SketchElement {
  kind: ElementKind;
  pins: number[];
  /** The index of a joint or body: for a drive or torsion spring among the joints at its pin, for a gear among the bodies there, its
   *  wheels. */
  joint: number;
  /** By the keys that a study has for them; what is left out begins as the kind says. */
  values: Record<string, number>;
}

export interface Sketch {
  pins: Pin[];
  links: number[][]; // pins of each
  elements: SketchElement[];
}

export const blank: Sketch = { pins: [], links: [], elements: [] };

/** "A", "B", ..., "Z", "A1", ... */
export const pinName = (i: number) => String.fromCharCode(65 + (i % 26)) + (i < 26 ? "" : String(Math.floor(i / 26)));
const linkName = (k: number) => `link ${k + 1}`;
export const sliderName = (i: number) => `slider ${pinName(i)}`;

/** The bodies that meet at a point: a slider or the ground, then links. */
export function bodiesAt({ pins, links }: Sketch, i: number): string[] {
  const { ground, guide } = pins[i];
  return [...(guide !== null ? [sliderName(i)] : ground ? ["ground"] : []), ...links.flatMap((on, k) => (on.includes(i) ? [linkName(k)] : []))];
}
/** The links and sliders. */
export const movingBodies = ({ pins, links }: Sketch): string[] =>
  [...links.map((_, k) => linkName(k)), ...pins.flatMap((p, i) => (p.guide === null ? [] : [sliderName(i)]))];
/** The body that what is put on a point acts on: a link, where there is one. */
export function bodyOf(sketch: Sketch, i: number): string {
  const [first, second] = bodiesAt(sketch, i);
  return first?.startsWith("link") ? first : (second ?? first ?? "ground");
}

export interface Joint {
  name: string;
  slides: boolean;
  first: string;
  second: string;
}
/** The joints at a point: its guide, and a pin between its first body and each other. */
export function jointsAt(sketch: Sketch, i: number): Joint[] {
  const [first, ...others] = bodiesAt(sketch, i);
  const name = pinName(i);
  return [...(sketch.pins[i].guide === null ? [] : [{ name: `guide ${name}`, slides: true, first: "ground", second: sliderName(i) }]),
    ...others.map((second, k) => ({ name: k ? `${name} ${k + 1}` : name, slides: false, first, second }))];
}
export const jointOf = (sketch: Sketch, { pins, joint }: SketchElement): Joint | undefined => jointsAt(sketch, pins[0])[joint];

/** The two bodies that a gear couples, and the one that carries their axes; null where the points have none. Where several bodies could be
 *  the wheel, links come first, and `joint` counts the choices. */
export function wheelsOf(sketch: Sketch, { pins: [i, j], joint }: SketchElement): { first: string; second: string; carrier: string } | null {
  const [at, there] = [bodiesAt(sketch, i), bodiesAt(sketch, j)];
  const carrier = at.find((body) => there.includes(body));
  const wheels = (bodies: string[]) => bodies.filter((body) => body !== carrier && !body.startsWith("slider")).sort((a, b) => Number(a === "ground") - Number(b === "ground"));
  const pairs = wheels(at).flatMap((first) => wheels(there).filter((second) => second !== first).map((second) => ({ first, second })));
  return carrier && pairs.length ? { ...pairs[joint % pairs.length], carrier } : null;
}
/** Radii of its pitch circles (mm), negative away from the other centre: their sum is the distance of the centres. */
export function radiiOf(sketch: Sketch, gear: SketchElement): [number, number] {
  const [a, b] = gear.pins.map((i) => sketch.pins[i]);
  const [distance, ratio] = [Math.hypot(b.x - a.x, b.y - a.y), valueOf(sketch, gear, "ratio")];
  return [(-ratio / (1 - ratio)) * distance, distance / (1 - ratio)];
}

export const driveOf = ({ elements }: Sketch) => elements.find((e) => e.kind === "drive");
const distanceOf = ({ pins }: Sketch, [i, j]: number[]) => Math.hypot(pins[i].x - pins[j].x, pins[i].y - pins[j].y);

/** A number of an element: its key in a study, between what it may lie, and what it is where nothing else is said. */
export interface ElementNumber {
  key: string;
  label: string;
  unit: string;
  least: number;
  start: (sketch: Sketch, element: SketchElement) => number;
}
/** No number that is typed may be larger. */
export const most = 1e6;
interface Kind {
  word: string;
  /** Its table in a study. */
  table: string;
  numbers: (sketch: Sketch, element: SketchElement) => ElementNumber[];
  /** The other lines of its table. */
  lines: (sketch: Sketch, element: SketchElement) => Line[];
  /** The problem of the element at its place; "" = nothing. */
  problem: (sketch: Sketch, element: SketchElement) => string;
}
const number = (key: string, label: string, unit: string, start: number | ElementNumber["start"], least = -most): ElementNumber =>
  ({ key, label, unit, least, start: typeof start === "number" ? () => start : start });
const point = (sketch: Sketch, i: number) => `${bodyOf(sketch, i)}.${pinName(i)}`;
const sharedBody = (sketch: Sketch, [i, j]: number[]) => bodiesAt(sketch, i).find((body) => bodiesAt(sketch, j).includes(body));

export const kinds: Record<ElementKind, Kind> = {
  drive: {
    word: "drive",
    table: "drive",
    numbers: (s, e) => [jointOf(s, e)?.slides ? number("speed_mm_per_s", "speed", "mm/s", 100) : number("speed_rpm", "speed", "rpm", 60)],
    lines: (s, e) => [["joint", jointOf(s, e)!.name]],
    problem: (s, e) => (jointOf(s, e) ? "" : "has no second link, slider or ground on its pin"),
  },
  gear: {
    word: "gear",
    table: "mechanism.joint",
    numbers: () => [number("ratio", "ratio", "", -1)],
    lines: (s, e) => Object.entries({ type: "gear", ...wheelsOf(s, e)! }),
    problem: (s, e) => (!wheelsOf(s, e) ? "needs two pins on one link, or on the ground, each with a link that is its wheel" : valueOf(s, e, "ratio") === 0 ? "has the ratio 0" : ""),
  },
  spring: {
    word: "spring",
    table: "mechanism.spring",
    numbers: () => [number("stiffness_N_per_mm", "stiffness", "N/mm", 0, 0), number("damping_N_s_per_m", "damping", "N s/m", 0, 0),
      number("free_length_mm", "free length", "mm", (s, e) => distanceOf(s, e.pins), 0)],
    lines: (s, e) => [["first", point(s, e.pins[0])], ["second", point(s, e.pins[1])]],
    problem: (s, e) => {
      const shared = sharedBody(s, e.pins);
      return shared ? `has both ends on ${shared === "ground" ? "the ground" : shared}, where it does nothing` : distanceOf(s, e.pins) < least ? "has both ends in one place" : "";
    },
  },
  torsion_spring: {
    word: "torsion spring",
    table: "mechanism.torsion_spring",
    numbers: () => [number("stiffness_N_m_per_rad", "stiffness", "N m/rad", 1, 0), number("damping_N_m_s_per_rad", "damping", "N m s/rad", 0, 0), number("free_angle_deg", "free angle", "°", 0)],
    lines: (s, e) => [["first", jointOf(s, e)!.first], ["second", jointOf(s, e)!.second]],
    problem: (s, e) => (jointOf(s, e)?.slides === false ? "" : "needs a pin with two bodies that turn against each other"),
  },
  force: {
    word: "force",
    table: "mechanism.force",
    numbers: () => [number("x_N", "x", "N", 0), number("y_N", "y", "N", -50)],
    lines: (s, e) => [["point", point(s, e.pins[0])]],
    problem: (s, e) => (bodyOf(s, e.pins[0]) === "ground" ? "acts on the ground, where it does nothing" : ""),
  },
};
/** mm: what lies closer is one place in a study. */
export const least = 1e-3;

export const valueOf = (sketch: Sketch, element: SketchElement, key: string): number =>
  element.values[key] ?? kinds[element.kind].numbers(sketch, element).find((n) => n.key === key)!.start(sketch, element);
/** "spring 2"; there is one drive. */
export function elementName({ elements }: Sketch, element: SketchElement): string {
  const { word } = kinds[element.kind];
  return element.kind === "drive" ? word : `${word} ${elements.filter((e) => e.kind === element.kind).indexOf(element) + 1}`;
}

/** Without a point, and what was on it; links of one point go as well. */
export function withoutPin({ pins, links, elements }: Sketch, i: number): Sketch {
  const shift = (k: number) => (k > i ? k - 1 : k);
  return {
    pins: pins.filter((_, k) => k !== i),
    links: links.map((on) => on.filter((k) => k !== i).map(shift)).filter((on) => on.length > 1),
    elements: elements.filter((e) => !e.pins.includes(i)).map((e) => ({ ...e, pins: e.pins.map(shift) })),
  };
}

const digits = (value: number) => String(Number(value.toFixed(4)));
const place = ({ x, y }: Place) => `[${digits(x)}, ${digits(y)}]`;
const quoted = (text: string) => `"${text}"`;
type Line = [key: string, value: string];
/** A table of a study, its values one below the other. */
function table(name: string, lines: Line[]): string {
  const width = Math.max(...lines.map(([key]) => key.length));
  return `${name}\n${lines.map(([key, value]) => `${key.padEnd(width)} = ${value}\n`).join("")}`;
}
function elementTable(sketch: Sketch, element: SketchElement): string {
  const { table: list, numbers, lines } = kinds[element.kind];
  const values = numbers(sketch, element).map(({ key }): Line => [key, String(Number(valueOf(sketch, element, key).toPrecision(9)))]);
  const name: Line[] = element.kind === "drive" ? [] : [["name", quoted(elementName(sketch, element))]];
  const vector: Line[] = [["force_N", `[${values.map(([, value]) => value).join(", ")}]`]];
  return table(`[[${list}]]`, [...name, ...lines(sketch, element).map(([key, word]): Line => [key, quoted(word)]), ...(element.kind === "force" ? vector : values)]);
}

const loads: ElementKind[] = ["spring", "torsion_spring", "force"];

/** The study of a sketch of which nothing is missing: its motion over a turn or a stroke, and the forces of its springs and loads. */
export function studyOf(sketch: Sketch, title = "My linkage"): string {
  const { pins, links, elements } = sketch;
  const loaded = elements.some((e) => loads.includes(e.kind));
  const all = pins.map((_, i) => i);
  const body = (name: string, on: number[]) => {
    const massless: Line[] = loaded && name !== "ground" ? [["mass_kg", "0.0"]] : [];
    return table("[[mechanism.body]]", [["name", quoted(name)], ["points_mm", `{ ${on.map((i) => `${pinName(i)} = ${place(pins[i])}`).join(", ")} }`], ...massless]);
  };
  const joint = (i: number) => ({ name, slides, first, second }: Joint) => {
    const ends: Line[] = [["first", quoted(`${first}.${pinName(i)}`)], ["second", quoted(`${second}.${pinName(i)}`)]];
    return table("[[mechanism.joint]]", slides ? [["name", quoted(name)], ["type", quoted("prismatic")], ...ends, ["direction_deg", digits(pins[i].guide!)]] : [["name", quoted(name)], ...ends]);
  };
  const tables = (chosen: (kind: ElementKind) => boolean) => elements.filter((e) => chosen(e.kind)).map((e) => elementTable(sketch, e));
  return [`schema = 1\nkind   = "analysis"\ntitle  = "${title}"\n\n[mechanism]\ntype  = "planar.linkage"\ndrawn = true\n`,
    body("ground", all.filter((i) => pins[i].ground || pins[i].guide !== null)),
    ...links.map((on, k) => body(linkName(k), on)),
    ...all.filter((i) => pins[i].guide !== null).map((i) => body(sliderName(i), [i])),
    ...all.flatMap((i) => jointsAt(sketch, i).map(joint(i))),
    ...tables((kind) => kind !== "drive"),
    ...tables((kind) => kind === "drive"),
    // From the drawn position on: once round, or as far as it assembles to both sides.
    table("[sweep]", [["type", quoted("grid")], ["range", quoted("assembled")]]),
    ...all.filter((i) => pins[i].traced && bodyOf(sketch, i) !== "ground").map((i) => table("[[trace]]", [["point", quoted(point(sketch, i))]])),
    // Nothing that is drawn has a mass: forces are those of springs and loads alone.
    table("[output]", [["quantities", JSON.stringify(["position", "rates", ...(loaded ? ["reactions", "drive"] : []), "transmission_angle"]).replace(/,/g, ", ")]]),
  ].join("\n");
}
