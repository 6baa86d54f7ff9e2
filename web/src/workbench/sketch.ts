// A linkage as it is drawn with the pointer: pins and links in one position, in millimetres; and the study that it makes.

export interface Pin {
  x: number;
  y: number;
  ground: boolean;
  /** Direction of the guide of a slider on this pin (deg); null = there is none. */
  guide: number | null;
  traced: boolean;
}
export interface Sketch {
  pins: Pin[];
  links: number[][]; // pins of each
  drive: number | null; // the pin on the ground, or on a guide, that is driven
}

export const blank: Sketch = { pins: [], links: [], drive: null };

/** "A", "B", ..., "Z", "A1", ... */
export const pinName = (i: number) => String.fromCharCode(65 + (i % 26)) + (i < 26 ? "" : String(Math.floor(i / 26)));

/** Ground, links and sliders on a pin: the bodies that meet there. */
function bodiesAt(sketch: Sketch, i: number): string[] {
  const { ground, guide } = sketch.pins[i];
  const links = sketch.links.flatMap((pins, k) => (pins.includes(i) ? [linkName(k)] : []));
  return [...(guide !== null ? [`slider ${pinName(i)}`] : ground ? ["ground"] : []), ...links];
}
const linkName = (k: number) => `link ${k + 1}`;

/** Degrees of freedom by counting: three for each link and slider, less two for each pin between two bodies and each guide. */
export function freedom(sketch: Sketch): number {
  const sliders = sketch.pins.filter((p) => p.guide !== null).length;
  const pins = sketch.pins.reduce((sum, _, i) => sum + Math.max(0, bodiesAt(sketch, i).length - 1), 0);
  return 3 * (sketch.links.length + sliders) - 2 * (pins + sliders);
}

/** What is still missing before it moves; "" = nothing. */
export function missing(sketch: Sketch): string {
  if (!sketch.links.length) return "Draw a link: press where its pins are.";
  if (!sketch.pins.some((p) => p.ground || p.guide !== null)) return "Fix a pin to the ground, or put it on a guide.";
  const loose = sketch.pins.findIndex((_, i) => bodiesAt(sketch, i).length === 0);
  if (loose >= 0) return `Pin ${pinName(loose)} is on no link.`;
  const free = freedom(sketch);
  if (free < 1) return "It cannot move: there are more pins than links leave room for.";
  if (free > 1) return `It moves in ${free} ways: close it with a link, a pin to the ground or a guide, so that one is left.`;
  if (sketch.drive === null) return "Choose the pin that is driven.";
  return "";
}

/** Without a pin, and the links and the drive that were on it; links of one pin go as well. */
export function withoutPin(sketch: Sketch, i: number): Sketch {
  const shift = (k: number) => (k > i ? k - 1 : k);
  return {
    pins: sketch.pins.filter((_, k) => k !== i),
    links: sketch.links.map((pins) => pins.filter((k) => k !== i).map(shift)).filter((pins) => pins.length > 1),
    drive: sketch.drive === null || sketch.drive === i ? null : shift(sketch.drive),
  };
}

const number = (value: number) => String(Number(value.toFixed(4)));
const place = ({ x, y }: Pin) => `[${number(x)}, ${number(y)}]`;
const body = (name: string, points: string[]) => `[[mechanism.body]]\nname      = "${name}"\npoints_mm = { ${points.join(", ")} }\n`;

/** The study of a sketch of which nothing is missing: its motion over a turn or a stroke. */
export function studyOf(sketch: Sketch, title = "My linkage"): string {
  const { pins, links, drive } = sketch;
  const point = (i: number) => `${pinName(i)} = ${place(pins[i])}`;
  const all = pins.map((_, i) => i);
  const parts = [
    body("ground", all.filter((i) => pins[i].ground || pins[i].guide !== null).map(point)),
    ...links.map((on, k) => body(linkName(k), on.map(point))),
    ...all.filter((i) => pins[i].guide !== null).map((i) => body(`slider ${pinName(i)}`, [point(i)])),
  ];
  for (const i of all) {
    const [first, ...others] = bodiesAt(sketch, i);
    others.forEach((other, k) =>
      parts.push(`[[mechanism.joint]]\nname   = "${pinName(i)}${k ? ` ${k + 1}` : ""}"\nfirst  = "${first}.${pinName(i)}"\nsecond = "${other}.${pinName(i)}"\n`));
    if (pins[i].guide !== null)
      parts.push(`[[mechanism.joint]]\nname          = "guide ${pinName(i)}"\ntype          = "prismatic"\nfirst         = "ground.${pinName(i)}"\nsecond        = "slider ${pinName(i)}.${pinName(i)}"\ndirection_deg = ${number(pins[i].guide!)}\n`);
  }
  const traces = all.flatMap((i) => {
    const on = links.findIndex((l) => l.includes(i));
    return pins[i].traced && on >= 0 ? [`[[trace]]\npoint = "${linkName(on)}.${pinName(i)}"\n`] : [];
  });
  // From the drawn position on: once round, or as far as it assembles to both sides.
  const guided = drive !== null && pins[drive].guide !== null;
  const driven = drive === null ? [] : [guided ? `[[drive]]\njoint          = "guide ${pinName(drive)}"\nspeed_mm_per_s = 100.0\n` : `[[drive]]\njoint     = "${pinName(drive)}"\nspeed_rpm = 60.0\n`,
    `[sweep]\ntype  = "grid"\nrange = "assembled"\n`];
  return [`schema = 1\nkind   = "analysis"\ntitle  = "${title}"\n\n[mechanism]\ntype  = "planar.linkage"\ndrawn = true\n`, ...parts, ...driven, ...traces,
    // Nothing that is drawn has a mass.
    `[output]\nquantities = ["position", "rates", "transmission_angle"]\n`].join("\n");
}
