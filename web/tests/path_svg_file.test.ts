// SPDX-License-Identifier: BSD-3-Clause
import { expect, test } from "vitest";
import { boxOf, lengthOf } from "../src/workbench/path";
import { svgFile } from "../src/workbench/path_svg_file";
import { refusal, rounded } from "./path_checks";

/** The points of a file that holds these elements. */
const drawn = (elements: string, attributes = "") => svgFile(`<?xml version="1.0"?>\n<svg xmlns="http://www.w3.org/2000/svg" ${attributes}>\n${elements}\n</svg>\n`);
const points = (elements: string, attributes = "") => rounded(drawn(elements, attributes).points);

test("every shape of SVG is a path, with the y axis upwards", () => {
  expect(points('<path d="M0 0L4 4"/>')).toEqual([[0, 0], [4, -4]]);
  expect(points('<line x1="1" y1="2" x2="3"/>')).toEqual([[1, -2], [3, 0]]);
  expect(points("<polyline points='0,0 4,0 4,3'/>")).toEqual([[0, 0], [4, 0], [4, -3]]);
  expect(drawn('<polygon points="0 0 4 0 4 3"/>')).toMatchObject({ closed: true });
  expect(points('<rect x="1" y="2" width="4" height="3"/>')).toEqual([[1, -2], [5, -2], [5, -5], [1, -5]]);
  const circle = drawn('<circle cx="10" cy="20" r="5"/>');
  expect(circle.closed).toBe(true);
  for (const p of circle.points) expect(Math.hypot(p.x - 10, p.y + 20)).toBeCloseTo(5, 9);
  expect(lengthOf(circle)).toBeCloseTo(10 * Math.PI, 1);
  const ellipse = drawn('<ellipse cx="1" cy="1" rx="4" ry="2"/>').points;
  for (const p of ellipse) expect(((p.x - 1) / 4) ** 2 + ((p.y + 1) / 2) ** 2).toBeCloseTo(1, 9);
  expect(boxOf(ellipse)).toEqual({ x: -3, y: -3, width: 8, height: 4 });
});

test("rectangles have round corners, at most half of a side", () => {
  const straight = 2 * (10 - 4) + 2 * (6 - 4);
  for (const radii of ['rx="2"', 'ry="2"', 'rx="2" ry="2"']) expect(lengthOf(drawn(`<rect width="10" height="6" ${radii}/>`)), radii).toBeCloseTo(straight + 4 * Math.PI, 2);
  const disc = drawn('<rect width="6" height="6" rx="9"/>').points;
  for (const p of disc) expect(Math.hypot(p.x - 3, p.y + 3)).toBeCloseTo(3, 9);
});

test("transforms of elements and groups are applied from the inside to the outside", () => {
  const of = (transform: string) => points(`<line transform="${transform}" x1="1" y1="0" x2="1" y2="1"/>`);
  expect(of("translate(3)")).toEqual([[4, 0], [4, -1]]);
  expect(of("translate(3,4)")).toEqual([[4, -4], [4, -5]]);
  expect(of("scale(2)")).toEqual([[2, 0], [2, -2]]);
  expect(of("scale(2 -3)")).toEqual([[2, 0], [2, 3]]);
  expect(of("rotate(90)")).toEqual([[0, -1], [-1, -1]]); // x' = -y, y' = x, and then upwards
  expect(of("rotate(180 1 1)")).toEqual([[1, -2], [1, -1]]);
  expect(of("skewX(45)")).toEqual([[1, 0], [2, -1]]); // x' = x + y
  expect(of("skewY(45)")).toEqual([[1, -1], [1, -2]]);
  expect(of("matrix(1 2 3 4 5 6)")).toEqual([[6, -8], [9, -12]]);
  expect(of("translate(10 20) scale(2),rotate(90)")).toEqual([[10, -22], [8, -22]]);
  expect(of("rotate(90) scale(2) translate(10 20)")).toEqual([[-40, -22], [-42, -22]]);
  expect(points('<g transform="translate(10 20)"><g/><g transform="scale(2)"><line transform="rotate(90)" x1="1" y1="0" x2="1" y2="1"/></g></g>')).toEqual([[10, -22], [8, -22]]);
  // A circle in a scaled group is an ellipse.
  expect(boxOf(drawn('<g transform="scale(3 1)"><circle r="2"/></g>').points)).toMatchObject({ width: 12, height: 4 });
});

test("a page with a size in mm, cm or inches has a scale; numbers alone are mm", () => {
  const line = '<line x1="0" y1="0" x2="96" y2="48"/>';
  for (const [attributes, x, y] of [
    ["", 96, 48], ['viewBox="0 0 50 50"', 96, 48], ['width="500" height="500px" viewBox="0 0 50 50"', 96, 48], ['width="100%" height="100%" viewBox="0 0 50 50"', 96, 48],
    ['width="210mm" height="297mm" viewBox="0 0 420 594"', 48, 24], ['width="2cm" height="2cm" viewBox="0 0 10 10"', 192, 96], ['width="1in" viewBox="0,0,96,96"', 25.4, 12.7],
    ['height="72pt" viewBox="0 0 96 96"', 25.4, 12.7], ['width="9in" height="9in"', 25.4, 12.7],
    ['width="20mm" height="10mm" viewBox="0 0 10 10"', 96, 48], // the smaller scale of the two
    ['width="20mm" height="10mm" viewBox="0 0 10 10" preserveAspectRatio="none"', 192, 48],
  ] as const) expect(points(line, attributes)[1], attributes).toEqual([x, -y]);
  // Lengths with a unit keep it where the page has a scale of its own.
  expect(boxOf(drawn('<rect width="40mm" height="2cm"/>', 'width="1in" height="1in"').points)).toMatchObject({ width: expect.closeTo(40, 9), height: expect.closeTo(20, 9) });
  expect(boxOf(drawn('<rect width="40mm" height="2cm"/>').points)).toMatchObject({ width: 40, height: 20 });
});

test("a drawing within the drawing has its own place and scale", () => {
  expect(points('<svg x="10" y="20" width="40" height="20" viewBox="5 5 10 10"><line x1="5" y1="5" x2="15" y2="15"/></svg>')).toEqual([[20, -20], [40, -40]]);
  expect(points('<svg x="10" y="20"><line x2="1" y2="1"/></svg>')).toEqual([[10, -20], [11, -21]]);
});

test("only elements that are drawn are taken, whatever surrounds them", () => {
  const text = '<path d="M9 9L1 2"/>';
  for (const hidden of [`<defs>${text}</defs>`, `<clipPath id="a">${text}</clipPath>`, `<g display="none">${text}</g>`, `<g style="fill:red; display: none">${text}</g>`, `<!-- ${text} don't -->`, `<style><![CDATA[ a > b ${text}]]></style>`, `<metadata><a:b>${text}</a:b></metadata>`])
    expect(points(`${hidden}<path d="M0 0L4 4"/>`), hidden).toEqual([[0, 0], [4, -4]]);
  expect(points(`<svg:g inkscape:label="a > b"><svg:path sodipodi:d="M7 7L8 8" d='M0 0&#10;L4&#x20;4'/></svg:g>`)).toEqual([[0, 0], [4, -4]]);
  expect(rounded(svgFile('\ufeff<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "x.dtd" [ <!-- don\'t ]> --> <!ENTITY ns "a]>b"> ]>\n<svg xmlns:x="&ns;"><path d="M0 0L4 4"/></svg>').points)).toHaveLength(2);
  expect(rounded(svgFile('<path d="M0 0L4 4"/>').points)).toHaveLength(2);
});

test("shapes that meet end to end are one path", () => {
  const chain = drawn('<line x1="0" y1="0" x2="4" y2="0"/><path d="M4 3L4 0"/><polyline points="4,3 0,3"/>');
  expect(chain.closed).toBe(false);
  expect(lengthOf(chain)).toBe(11);
  expect(drawn('<path d="M0 0H4V3"/><path d="M0 0L4 3"/>')).toMatchObject({ closed: true, points: { length: 3 } });
  expect(refusal(() => drawn('<path d="M0 0H30"/>\n<circle cy="9" r="1"/>\n<path d="M0 50h5m3 0h2"/>'))).toBe(
    "The SVG file has 4 separate lines: <path> in line 3 (30 mm long), <circle> in line 4 (6.28 mm long), part 1 of <path> in line 5 (5 mm long), …; a traced point can follow only one.");
});

test("files that are damaged or hold no path are refused with the place and the way out", () => {
  expect(refusal(() => drawn("<text>a</text><use href='#a'/>"))).toMatch(/draws none of <path>, .*, only <text>, <use>/);
  expect(refusal(() => drawn('<path d="M0 0L1 1"/>\n<path d="M0 0L5"/>'))).toMatch(/<path> in line 4: The command L has 1 number/);
  expect(refusal(() => drawn('<polyline points="0 0 1"/>'))).toMatch(/<polyline> in line 3 has 3 numbers, which are not pairs/);
  expect(refusal(() => drawn('<polyline points="0 0 1 x"/>'))).toMatch(/“x” after points of <polyline> in line 3 is not a number/);
  expect(refusal(() => drawn('<circle r="5%"/>'))).toMatch(/r = “5%” of <circle> in line 3 is not a length/);
  expect(refusal(() => drawn('<circle r="5constructor"/>'))).toMatch(/is not a length/);
  for (const transform of ["turn(3)", "rotate(1 2)", "scale(1", "constructor(1)", "matrix(1 2 3)"]) expect(refusal(() => drawn(`<g transform="${transform}"><circle r="1"/></g>`)), transform).toMatch(/^The transform “.*” of <g> in line 3 cannot be read/);
  expect(refusal(() => drawn('<g style="transform:rotate(3deg)"><circle r="1"/></g>'))).toMatch(/transform of its style sheet/);
  expect(refusal(() => drawn('<circle r="1"/>', 'width="1in" viewBox="0 0 0 5"'))).toMatch(/The viewBox “0 0 0 5” of <svg> in line 2/);
  expect(refusal(() => drawn('<g><path d="M0 0L1 1"/></a>'))).toMatch(/<\/a> in line 3 ends <g> in line 3/);
  expect(refusal(() => svgFile("</g>"))).toMatch(/ends an element that does not begin/);
  expect(refusal(() => svgFile('<svg>\n<path d="M0 0L1 1"/>'))).toMatch(/ends before <\/svg>, which closes <svg> in line 1/);
  for (const cut of ['<svg>\n<path d="M0 0L1', "<svg>\n<!-- a", "<svg>\n<path d=", "<svg>\n<![CDATA[", "<svg>\n<!DOCTYPE [ <!ENTITY a 'b"]) expect(refusal(() => svgFile(cut)), cut).toMatch(/in line 2 is not closed, or is damaged/);
  expect(refusal(() => drawn('<path d="&shape;"/>'))).toMatch(/Line 3 refers to the entity &shape;/);
  expect(refusal(() => drawn('<path d="M0 0L1 1" transform="scale(1e300) scale(1e300)"/>'))).toMatch(/A coordinate of <path> in line 3 is not a finite number/);
  expect(refusal(() => drawn('<path d="M0 0L1 1" transform="scale(0)"/>'))).toMatch(/at the same place/);
});
