// SPDX-License-Identifier: BSD-3-Clause

// A scene as an AutoCAD R12 drawing.
import { extentOf, isSymbol, symbolLines } from "./arrows";
import type { Scene } from "./data";
import { isSpatial } from "./grid";
import { analyse, placeAt, type Place } from "./motion";
import { beyond, helix, wheelCircle } from "./space_view";

const mm = (metres: number) => Number((metres * 1000).toPrecision(9));

/** Group codes and values of a drawing, in lines of text. */
class Drawing {
  private readonly out: string[] = [];

  constructor(private readonly spatial: boolean) {}

  put(...pairs: (string | number)[]): void {
    this.out.push(...pairs.map(String));
  }
  /** The coordinates of a place; `first` is the group code of x. */
  at(first: number, p: Place): void {
    this.put(first, mm(p.x), first + 10, mm(p.y), first + 20, mm(p.z ?? 0));
  }
  point(layer: string, p: Place): void {
    this.put(0, "POINT", 8, layer);
    this.at(10, p);
  }
  line(layer: string, a: Place, b: Place): void {
    this.put(0, "LINE", 8, layer);
    this.at(10, a);
    this.at(11, b);
  }
  circle(layer: string, p: Place, radius: number): void {
    this.put(0, "CIRCLE", 8, layer);
    this.at(10, p);
    this.put(40, mm(radius));
  }
  polyline(layer: string, places: Place[], closed: boolean): void {
    this.put(0, "POLYLINE", 8, layer, 66, 1, 10, 0, 20, 0, 30, 0, 70, (closed ? 1 : 0) + (this.spatial ? 8 : 0));
    for (const p of places) {
      this.put(0, "VERTEX", 8, layer);
      this.at(10, p);
      if (this.spatial) this.put(70, 32);
    }
    this.put(0, "SEQEND", 8, layer);
  }
  text(layer: string, p: Place, height: number, words: string): void {
    this.put(0, "TEXT", 8, layer);
    this.at(10, p);
    this.put(40, mm(height), 1, words.replace(/[^\x20-\x7e]/g, "?"));
  }
  written = () => this.out.join("\n") + "\n";
}

/** The scene at a sample, with symbols of this size (m). */
interface Subject {
  scene: Scene;
  sample: number;
  spatial: boolean;
  symbol: number;
}

/** The scene at a sample in millimetres, scale 1:1: the same layers as the program writes. */
export function dxf(scene: Scene, sample: number): string {
  const spatial = isSpatial(scene);
  const to = new Drawing(spatial);
  const subject = { scene, sample, spatial, symbol: Math.max(extentOf(scene) ?? 0.1, 1e-6) / 100 };
  header(to, scene);
  for (const body of scene.bodies) drawBody(to, subject, body);
  if (spatial) drawWheels(to, subject);
  else drawCircles(to, subject);
  drawJoints(to, subject);
  drawTraces(to, scene);
  if (!spatial) drawTargets(to, subject);
  to.put(0, "ENDSEC", 0, "EOF");
  return to.written();
}

/** The part before the entities: units, types of lines and layers. */
function header(to: Drawing, scene: Scene): void {
  to.put(999, "linkwright: units are millimetres, scale 1:1", 0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1009", 0, "ENDSEC");
  to.put(0, "SECTION", 2, "TABLES", 0, "TABLE", 2, "LTYPE", 70, 2);
  to.put(0, "LTYPE", 2, "CONTINUOUS", 70, 0, 3, "Solid line", 72, 65, 73, 0, 40, 0);
  to.put(0, "LTYPE", 2, "DASHDOT", 70, 0, 3, "Dash dot", 72, 65, 73, 4, 40, 10, 49, 6, 49, -2, 49, 0, 49, -2, 0, "ENDTAB");
  const layers: [string, number, string][] = [
    ["GROUND", 8, "DASHDOT"], ["LINKS", 5, "CONTINUOUS"], ["JOINTS", 7, "CONTINUOUS"], ["TRACE", 3, "CONTINUOUS"], ["TARGETS", 1, "CONTINUOUS"],
  ];
  if (scene.bodies.some((b) => b.style === "axis")) layers.push(["AXES", 1, "DASHDOT"]);
  if (scene.discs?.length) layers.push(["WHEELS", 8, "CONTINUOUS"]);
  to.put(0, "TABLE", 2, "LAYER", 70, layers.length);
  for (const [name, colour, type] of layers) to.put(0, "LAYER", 2, name, 70, 0, 62, colour, 6, type);
  to.put(0, "ENDTAB", 0, "ENDSEC", 0, "SECTION", 2, "ENTITIES");
}

function drawBody(to: Drawing, { scene, sample, spatial, symbol }: Subject, body: Scene["bodies"][number]): void {
  if (body.style === "gap" || body.run) return;
  const places = body.points.map((p) => placeAt(scene, p, sample)).filter((p): p is Place => p !== null);
  if (places.length < body.points.length) return;
  const layer = body.style === "ground" || body.style === "guide" ? "GROUND" : "LINKS";
  if (body.style === "axis") {
    const on = beyond(places);
    for (let i = 1; i < on.length; ++i) to.line("AXES", on[i - 1], on[i]);
  } else if (body.style === "plate" && places.length > 2) to.polyline(layer, places, true);
  else
    for (let i = 1; i < places.length; ++i)
      if (spatial && body.style === "spring") to.polyline(layer, helix(places[i - 1], places[i], 6 * symbol), false);
      else if (isSymbol(body.style) && !spatial) for (const stroke of symbolLines(body.style, places[i - 1], places[i], 3 * symbol)) to.polyline(layer, stroke, false);
      else to.line(layer, places[i - 1], places[i]);
}

function drawWheels(to: Drawing, { scene, sample }: Subject): void {
  for (const disc of scene.discs ?? [])
    for (const side of [-0.5, 0, 0.5]) {
      const rim = wheelCircle(scene, disc, sample, side * disc.width, 72);
      if (rim.length) to.polyline("WHEELS", rim, true);
    }
}

function drawCircles(to: Drawing, { scene, sample }: Subject): void {
  for (const { centre, rim } of scene.circles) {
    const [c, r] = [placeAt(scene, centre, sample), placeAt(scene, rim, sample)];
    if (c && r) to.circle("LINKS", c, Math.hypot(r.x - c.x, r.y - c.y));
  }
}

function drawJoints(to: Drawing, { scene, sample, spatial, symbol }: Subject): void {
  for (const joint of scene.joints) {
    const p = placeAt(scene, joint.point, sample);
    if (!p) continue;
    if (spatial) to.point("JOINTS", p);
    else to.circle("JOINTS", p, symbol);
    to.text("JOINTS", { ...p, x: p.x + 1.5 * symbol, y: p.y + 1.5 * symbol }, 2 * symbol, joint.name);
    if (joint.style === "ground_pivot" && !spatial)
      to.polyline("GROUND", [p, { x: p.x - 2 * symbol, y: p.y - 3 * symbol }, { x: p.x + 2 * symbol, y: p.y - 3 * symbol }], true);
  }
}

/** Traces over the whole motion, broken where the mechanism cannot be assembled. */
function drawTraces(to: Drawing, scene: Scene): void {
  const { ok } = analyse(scene);
  for (const trace of scene.traces) {
    if (trace.run) continue;
    let run: Place[] = [];
    let whole = true;
    const flush = (closed: boolean) => {
      if (run.length > 1) to.polyline("TRACE", run, closed);
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
}

function drawTargets(to: Drawing, { scene, symbol }: Subject): void {
  for (const target of scene.targets)
    target.x.forEach((x, i) => {
      const y = target.y[i];
      if (x === null || y == null) return;
      to.point("TARGETS", { x, y });
      to.circle("TARGETS", { x, y }, symbol / 2);
    });
}
