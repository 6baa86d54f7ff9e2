// SPDX-License-Identifier: BSD-3-Clause
import { expect, test } from "vitest";
import { freedom, missing } from "../src/workbench/mobility";
import { blank, elementName, jointsAt, pinName, radiiOf, studyOf, valueOf, wheelsOf, withoutPin, type ElementKind, type Pin, type Sketch, type SketchElement } from "../src/workbench/sketch";
import { gripAt, pitchOf, tipOf, tools, type Outcome, type Press } from "../src/workbench/tools";

const pinned = (x: number, y: number, more: Partial<Pin> = {}): Pin => ({ x, y, ground: false, guide: null, traced: false, ...more });
const on = (kind: ElementKind, pins: number[], values: Record<string, number> = {}, joint = 0): SketchElement => ({ kind, pins, joint, values });
const sliderCrank: Sketch = { pins: [pinned(0, 0, { ground: true }), pinned(0, 50), pinned(140, 20, { guide: 0 }), pinned(70, 60, { traced: true })], links: [[0, 1], [1, 2, 3]], elements: [on("drive", [0])] };
const fourBar: Sketch = { pins: [pinned(0, 0, { ground: true }), pinned(20, 40), pinned(110, 70), pinned(120, 0, { ground: true })], links: [[0, 1], [1, 2], [2, 3]], elements: [on("drive", [0])] };
const fiveBar: Sketch = { pins: [pinned(0, 0, { ground: true }), pinned(0, 40), pinned(50, 90), pinned(100, 30), pinned(100, 0, { ground: true })], links: [[0, 1], [1, 2], [2, 3], [3, 4]], elements: [on("drive", [0])] };
const withMore = (s: Sketch, ...more: SketchElement[]): Sketch => ({ ...s, elements: [...s.elements, ...more] });

test("a sketch says what it lacks until it moves", () => {
  expect(missing(blank)).toMatch(/Draw a link/);
  const bar = { ...blank, pins: [pinned(0, 0), pinned(0, 50)], links: [[0, 1]] };
  expect(missing(bar)).toMatch(/to the ground/);
  const crank = { ...bar, pins: [pinned(0, 0, { ground: true }), bar.pins[1]] };
  expect(freedom(crank)).toBe(1);
  expect(missing(crank)).toMatch(/driven/);
  expect(missing(withMore(crank, on("drive", [0])))).toBe("");
  expect(missing(withMore(crank, on("drive", [1])))).toBe("The drive has no second link, slider or ground on its pin.");
  const open = { ...sliderCrank, pins: sliderCrank.pins.map((p) => ({ ...p, guide: null })) };
  expect(freedom(open)).toBe(2);
  expect(missing(open)).toMatch(/2 ways/);
  const stiff = { pins: [pinned(0, 0, { ground: true }), pinned(10, 0, { ground: true }), pinned(5, 5)], links: [[0, 2], [1, 2]], elements: [on("drive", [0])] };
  expect(missing(stiff)).toMatch(/cannot move/);
  expect(missing({ ...sliderCrank, pins: [...sliderCrank.pins, pinned(1, 1)] })).toBe("Pin E is on no link.");
  expect(missing({ ...fourBar, pins: fourBar.pins.map((p, i) => (i === 1 ? { ...p, x: 0, y: 0 } : p)) })).toBe("A and B of link 1 lie in one place: move one of them.");
  expect([freedom(sliderCrank), missing(sliderCrank)]).toEqual([1, ""]);
});

test("freedoms are not only counted", () => {
  // A triangle of bars that is held twice, and a bar that hangs loose: the count alone says 1.
  const p = [pinned(0, 0, { ground: true }), pinned(60, 0, { ground: true }), pinned(30, 40), pinned(90, 60), pinned(120, 10)];
  const mixed: Sketch = { pins: p, links: [[0, 2], [1, 2], [0, 1], [2, 3], [3, 4]], elements: [] };
  expect(freedom(mixed)).toBe(1);
  expect(missing(mixed)).toMatch(/held twice while others are loose/);
  // Drawn in line with its crank, the coupler cannot be pushed by the rocker.
  const line: Sketch = { pins: [pinned(0, 0, { ground: true }), pinned(30, 40), pinned(90, 120), pinned(150, 0, { ground: true })], links: [[0, 1], [1, 2], [2, 3]], elements: [on("drive", [3])] };
  expect(missing(line)).toMatch(/dead point/);
  expect(missing({ ...line, elements: [on("drive", [0])] })).toBe("");
  // A drive of one part of the ground does not drive the rest.
  const still: Sketch = { pins: [pinned(0, 0, { ground: true }), pinned(60, 0, { ground: true }), pinned(30, 40), pinned(60, 80)], links: [[0, 2], [1, 2], [2, 3]], elements: [on("drive", [0])] };
  expect(missing(still)).toBe("Pin A cannot drive it: what it joins does not move against each other.");
  expect(missing({ ...still, elements: [on("drive", [2], {}, 1)] })).toBe("");
});

test("a drive is on a pin of the ground, on a guide or between links", () => {
  for (const [pin, joint, words] of [[1, 0, 'joint     = "B"\nspeed_rpm = 60'], [2, 0, 'joint          = "guide C"\nspeed_mm_per_s = 100'], [2, 1, 'joint     = "C"\nspeed_rpm = 60']] as const) {
    const driven = { ...sliderCrank, pins: sliderCrank.pins.map((p, i) => (i === 1 ? { ...p, x: 30, y: 40 } : p)), elements: [on("drive", [pin], {}, joint)] };
    expect(missing(driven)).toBe("");
    expect(studyOf(driven)).toContain(`[[drive]]\n${words}`);
  }
  // Three links on a pin: a press goes from one to the next, and off.
  const three: Sketch = { pins: [pinned(0, 0, { ground: true }), pinned(50, 0), pinned(90, 30), pinned(90, -30)], links: [[0, 1], [1, 2], [1, 3]], elements: [] };
  let s = three;
  const driven = () => s.elements.map((e) => jointsAt(s, e.pins[0])[e.joint].second);
  for (const expected of [["link 2"], ["link 3"], []]) {
    s = press(s, "drive", 50, 0).sketch;
    expect(driven()).toEqual(expected);
  }
  expect(press(press(three, "drive", 50, 0).sketch, "drive", 0, 0).sketch.elements).toEqual([on("drive", [0])]);
});

test("gears take a freedom, and turn links that have one carrier", () => {
  expect(freedom(fiveBar)).toBe(2);
  const geared = withMore(fiveBar, on("gear", [0, 4], { ratio: -2 }));
  expect([freedom(geared), missing(geared)]).toEqual([1, ""]);
  expect(wheelsOf(geared, geared.elements[1])).toEqual({ first: "link 1", second: "link 4", carrier: "ground" });
  const [first, second] = radiiOf(geared, geared.elements[1]);
  expect([first, second].map((r) => Math.round(r * 1e6) / 1e6)).toEqual([66.666667, 33.333333]);
  expect(studyOf(geared)).toContain('[[mechanism.joint]]\nname    = "gear 1"\ntype    = "gear"\nfirst   = "link 1"\nsecond  = "link 4"\ncarrier = "ground"\nratio   = -2\n');
  // The same press once more makes a second link on the pin the wheel.
  const two: Sketch = { pins: [...fiveBar.pins, pinned(-40, 60)], links: [...fiveBar.links, [0, 5]], elements: [] };
  let s = two;
  const wheels: string[] = [];
  for (let k = 0; k < 3; ++k) {
    s = press(s, "gear", 100, 0, 0).sketch;
    wheels.push(wheelsOf(s, s.elements[0])!.first);
  }
  expect(wheels).toEqual(["link 1", "link 5", "link 1"]);
  // A planet on its arm, round a wheel that is the ground.
  const planet: Sketch = { pins: [pinned(0, 0, { ground: true }), pinned(60, 0), pinned(60, 25, { traced: true })], links: [[0, 1], [1, 2]], elements: [on("drive", [0]), on("gear", [0, 1], { ratio: -3 })] };
  expect([freedom(planet), missing(planet)]).toEqual([1, ""]);
  expect(wheelsOf(planet, planet.elements[1])).toEqual({ first: "ground", second: "link 2", carrier: "link 1" });
  expect(missing(withMore(fourBar, on("gear", [0, 2])))).toBe("Gear 1 needs two pins on one link, or on the ground, each with a link that is its wheel.");
  expect(missing({ ...fiveBar, elements: [on("drive", [1]), on("gear", [0, 4])] })).toMatch(/cannot be followed from the drive/);
});

test("springs and loads are computed on links without mass", () => {
  const loaded = withMore(fourBar, on("spring", [1, 3], { stiffness_N_per_mm: 2 }), on("torsion_spring", [2]), on("force", [2], { x_N: 30, y_N: -40 }));
  expect(missing(loaded)).toBe("");
  const text = studyOf(loaded);
  expect(text).toContain('[[mechanism.spring]]\nname               = "spring 1"\nfirst              = "link 1.B"\nsecond             = "link 3.D"\nstiffness_N_per_mm = 2\ndamping_N_s_per_m  = 0\nfree_length_mm     = 107.703296\n');
  expect(text).toContain('first                 = "link 2"\nsecond                = "link 3"\nstiffness_N_m_per_rad = 1');
  expect(text).toContain('point   = "link 2.C"\nforce_N = [30, -40]');
  expect(text.match(/mass_kg/g)).toHaveLength(3);
  expect(text).toContain('quantities = ["position", "rates", "reactions", "drive", "transmission_angle"]');
  expect(studyOf(fourBar)).not.toMatch(/mass_kg|reactions/);
  expect(missing(withMore(fourBar, on("spring", [0, 3])))).toBe("Spring 1 has both ends on the ground, where it does nothing.");
  expect(missing(withMore(fourBar, on("spring", [0, 1])))).toBe("Spring 1 has both ends on link 1, where it does nothing.");
  expect(missing(withMore({ ...fourBar, pins: [...fourBar.pins, pinned(9, 9, { ground: true })] }, on("force", [4])))).toBe("Force 1 acts on the ground, where it does nothing.");
  expect(missing(withMore({ ...fourBar, pins: [...fourBar.pins, pinned(9, 9)], links: [[0, 1, 4], [1, 2], [2, 3]] }, on("torsion_spring", [4])))).toMatch(/two bodies that turn/);
});

test("a sketch makes a study with its pins, guides and drive", () => {
  const text = studyOf(sliderCrank);
  expect(text).toContain("points_mm = { B = [0, 50], C = [140, 20], D = [70, 60] }");
  expect(text).toContain('first  = "ground.A"\nsecond = "link 1.A"');
  expect(text).toContain('first         = "ground.C"\nsecond        = "slider C.C"\ndirection_deg = 0');
  expect(text).toContain('joint     = "A"\nspeed_rpm = 60');
  expect(text).toContain('point = "link 2.D"');
  // Three bodies on a pin are two joints.
  const three: Sketch = { pins: [pinned(0, 0, { ground: true }), pinned(1, 0), pinned(2, 0), pinned(3, 1)], links: [[0, 1], [1, 2], [1, 3]], elements: [] };
  expect(studyOf(three)).toContain('name   = "B 2"\nfirst  = "link 1.B"\nsecond = "link 3.B"');
});

test("a pin goes with its links and what is on it", () => {
  expect(withoutPin(sliderCrank, 0)).toEqual({ pins: sliderCrank.pins.slice(1), links: [[0, 1, 2]], elements: [] });
  expect(withoutPin(sliderCrank, 3)).toEqual({ pins: sliderCrank.pins.slice(0, 3), links: [[0, 1], [1, 2]], elements: [on("drive", [0])] });
  const loaded = withMore(fourBar, on("spring", [1, 3]), on("force", [2]), on("force", [1]));
  expect(withoutPin(loaded, 1).elements).toEqual([on("drive", [0]), on("force", [1])]);
  expect(elementName(loaded, loaded.elements[3])).toBe("force 2");
  expect([pinName(0), pinName(25), pinName(26), pinName(53)]).toEqual(["A", "Z", "A1", "B2"]);
});

const place = (x: number, y: number, more: Partial<Press> = {}): Press => ({ x, y, reach: 6, grid: 10, more: false, ...more });
function press(s: Sketch, tool: string, x: number, y: number, from: number | null = null, more: Partial<Press> = {}): Outcome {
  return tools.find((t) => t.name === tool)!.press(s, place(x, y, more), from) ?? { sketch: s };
}

test("any place of a link is traced", () => {
  // On a bar the point lies on its line, whatever the grid says.
  const bar = press(fourBar, "trace", 41, 46).sketch;
  expect(bar.links[1]).toEqual([1, 2, 4]);
  const { x, y } = bar.pins[4];
  expect(Math.abs((x - 20) * 30 - (y - 40) * 90)).toBeLessThan(2);
  expect(missing(bar)).toBe("");
  expect(studyOf(bar)).toContain('[[trace]]\npoint = "link 2.E"');
  // Inside a plate it lies on the grid.
  const plate = press({ ...fourBar, pins: [...fourBar.pins, pinned(60, 120)], links: [[0, 1], [1, 2, 4], [2, 3]] }, "trace", 62, 78).sketch;
  expect(plate.pins[5]).toEqual(pinned(60, 80, { traced: true }));
  // It is dragged, and goes as it came; elsewhere there is nothing to trace.
  const { drag } = press(fourBar, "trace", 41, 46);
  expect(drag!(bar, place(52, 48)).pins[4]).toMatchObject({ x: 50, y: 50 });
  expect(press(bar, "trace", x, y).sketch).toEqual(fourBar);
  expect(press(bar, "erase", x, y).sketch).toEqual(fourBar);
  expect(press(fourBar, "trace", 60, -80).sketch).toBe(fourBar);
  expect(press(fourBar, "trace", 20, 40).sketch.pins[1].traced).toBe(true);
});

test("a spring goes from point to point, the paper is the ground, and a damper joins it", () => {
  const first = press(fourBar, "spring", 65, 55);
  expect(first.from).toBe(4);
  expect(first.sketch.links[1]).toEqual([1, 2, 4]);
  const second = press(first.sketch, "spring", 61, -79, 4);
  expect(second.from).toBe(null);
  expect(second.sketch.pins[5]).toEqual(pinned(60, -80, { ground: true }));
  expect(second.sketch.elements[1]).toEqual(on("spring", [4, 5], { stiffness_N_per_mm: 1 }));
  const damped = press(second.sketch, "damper", 65, 55, 5).sketch;
  expect(damped.elements.slice(1)).toEqual([on("spring", [4, 5], { stiffness_N_per_mm: 1, damping_N_s_per_m: 100 })]);
  expect(missing(damped)).toBe("");
  expect(press(damped, "erase", 61, -40).sketch.elements).toEqual(fourBar.elements);
});

test("a force is aimed by a drag, and taken hold of by its tip", () => {
  const { sketch, drag } = press(fourBar, "force", 110, 70);
  expect(sketch.elements[1]).toEqual(on("force", [2]));
  expect([valueOf(sketch, sketch.elements[1], "x_N"), valueOf(sketch, sketch.elements[1], "y_N")]).toEqual([0, -50]);
  const aimed = drag!(sketch, place(141, 29));
  expect(aimed.elements[1].values).toEqual({ x_N: 30, y_N: -40 });
  expect(gripAt(aimed, place(139, 32))!(aimed, place(110, 130)).elements[1].values).toEqual({ x_N: 0, y_N: 60 });
  const strong = { ...aimed, elements: [on("force", [2], { x_N: 3000, y_N: 4000 })] };
  expect(tipOf(strong, strong.elements[0])).toEqual({ x: 110 + 72, y: 70 + 96 });
});

test("the mark where gears touch is dragged along their centres", () => {
  const first = press(fiveBar, "gear", 0, 0);
  const geared = press(first.sketch, "gear", 100, 0, first.from!).sketch;
  const gear = geared.elements[1];
  expect([gear.kind, gear.pins, pitchOf(geared, gear)]).toEqual(["gear", [0, 4], { x: 50, y: 0 }]);
  const dragged = gripAt(geared, place(51, 2))!(geared, place(75, 9));
  expect(dragged.elements[1].values.ratio).toBeCloseTo(-3, 9);
  // Beyond a centre the one wheel has its teeth inside.
  expect(gripAt(geared, place(51, 2))!(geared, place(200, 0)).elements[1].values.ratio).toBeCloseTo(2, 9);
});

test("a link is erased with the points that nothing else holds", () => {
  const s = press(withMore(press(fourBar, "trace", 65, 55).sketch, on("spring", [4, 3])), "erase", 35, 45).sketch;
  expect(s).toEqual({ pins: fourBar.pins, links: [[0, 1], [2, 3]], elements: fourBar.elements });
});
