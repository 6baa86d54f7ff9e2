// SPDX-License-Identifier: BSD-3-Clause
import { expect, test } from "vitest";
import { PathError } from "../src/workbench/path";
import { mostBytes, readPath, requireSize, textOf } from "../src/workbench/path_text";
import { refusal } from "./path_checks";

const slow = 120_000; // ms for texts of megabytes on a machine that is busy
const rest = () => new Promise((resolve) => setTimeout(resolve)); // the test runner reports meanwhile

const bytesOf = (text: string) => Uint8Array.from(text, (c) => c.charCodeAt(0));
const utf16 = (text: string, big: boolean) => Uint8Array.from([...text].flatMap((c) => (big ? [c.charCodeAt(0) >> 8, c.charCodeAt(0) & 255] : [c.charCodeAt(0) & 255, c.charCodeAt(0) >> 8])));

test("the encoding of a file is recognised", () => {
  const text = "x [µm];y\n1,5;2";
  expect(textOf(new TextEncoder().encode(`\ufeff${text}`))).toBe(text);
  expect(textOf(bytesOf(text))).toBe(text); // Windows-1252
  for (const big of [false, true]) {
    expect(textOf(utf16(`\ufeff${text}`, big))).toBe(text);
    expect(textOf(utf16(text, big))).toBe(text);
  }
});

test("files that are not a text are refused by name", () => {
  for (const [head, kind] of [["PK\x03\x04", "Excel workbook or another packed"], ["\xd0\xcf\x11\xe0", "Excel"], ["\x1f\x8b\x08", "SVGZ"], ["%PDF-1.7", "PDF"], ["AC1027\0", "DWG"], ["\x89PNG", "picture"], ["\xff\xd8\xff\xe0", "picture"]])
    expect(refusal(() => textOf(bytesOf(head))), head).toContain(kind);
  expect(refusal(() => readPath(textOf(bytesOf("AutoCAD Binary DXF\r\n\x1a\0\0SECTION\0\xff"))))).toMatch(/binary DXF/);
  expect(refusal(() => readPath(textOf(bytesOf(""))))).toMatch(/is empty/);
  expect(refusal(() => requireSize(mostBytes + 1))).toMatch(/51 MB; at most 50 MB/);
});

const many = 200_000;
const place = (k: number) => [100 * Math.cos(k / many), 50 * Math.sin((2 * k) / many)].map((v) => v.toFixed(4));
const list = (count: number, item: (k: number) => string, between = "") => Array.from({ length: count }, (_, k) => item(k)).join(between);

const numbered = (k: number) => `10\n${place(k)[0]}\n20\n${place(k)[1]}\n`;
test.each([
  ["rows", () => list(many, (k) => place(k).join(";"), "\n")],
  ["lines of path data", () => `M${list(many, (k) => place(k).join(" "), "L")}`],
  ["curves of path data", () => `M0 0${list(many, (k) => `c${k % 7} 1 1 ${k % 5} 2 2`)}`],
  ["polyline of SVG", () => `<polyline points="${list(many, (k) => place(k).join(), " ")}"/>`],
  ["polyline of DXF", () => `0\nLWPOLYLINE\n${list(many, (k) => `${numbered(k)}42\n1\n`)}`],
  ["spline of DXF", () => `0\nSPLINE\n71\n3\n${list(many + 4, (k) => `40\n${k}\n`)}${list(many, numbered)}`],
])("200,000 points are read as %s", async (_, text) => {
  expect(readPath(text()).points).toHaveLength(200);
  await rest();
}, slow);

const count = 20_000;
const lines = (item: (i: number) => string) => list(count, (k) => item((k * 7919) % count));
test.each([
  ["a chain of SVG", () => `<svg>${lines((i) => `<line x1="${i}" x2="${i + 1}"/>`)}</svg>`, ""],
  ["a chain of DXF", () => lines((i) => `0\nLINE\n10\n${i}\n20\n0\n11\n${i + 1}\n21\n0\n`), ""],
  ["a star", () => lines((i) => `M0 0L${Math.cos(i)} ${Math.sin(i)}`), "separate lines"],
  ["lines apart", () => lines((i) => `M${i} 0h.5`), "20000 separate lines"],
])("20,000 lines are joined in a moment: %s", async (_, text, reason) => {
  if (reason) expect(refusal(() => readPath(text()))).toContain(reason);
  else expect(readPath(text())).toMatchObject({ closed: false, points: { length: 200 } });
  await rest();
}, slow);

test("deep, endless and growing texts end with a path or a reason", () => {
  const deep = (count: number) => `<svg>${'<g transform="rotate(1)">'.repeat(count)}<path d="M0 0L4 4"/>${"</g>".repeat(count)}</svg>`;
  expect(readPath(deep(10_000)).closed).toBe(false);
  expect(refusal(() => readPath(deep(200_000)))).toMatch(/within more than 100000 elements/);
  const entities = list(30, (k) => `<!ENTITY a${k + 1} "${`&a${k};`.repeat(10)}">`);
  expect(refusal(() => readPath(`<!DOCTYPE svg [${entities}]><svg><path d="&a30;"/></svg>`))).toMatch(/entity &a30;/);
  const endless = ["<", "<g ", '<a b="', "<!-- ", "<![CDATA[", "<!DOCTYPE [", "<!DOCTYPE ['\"", "M", "M0 0L", "M0 0 ", "0\n", "0\nSECTION\n", "999\n", '"', '";', "x(", "x[ ", ";", "#", "-", "1e", "M1e9", "<path d='M0 0' transform='rotate(", "&#"];
  for (const start of endless) expect(refusal(() => readPath(start.repeat(20_000))), start).not.toBe("");
  const [digits, blanks] = ["9".repeat(200_000), "\n".repeat(200_000)];
  for (const text of [`${digits}x;1\n2;3`, `1;2\n${digits}x;3`, `0${blanks}x`, `M0 0L${digits}x`, `<svg width="${digits}!"/>`, `<rect x="${digits}${blanks}!" width="1"/>`, `<${"a".repeat(200_000)}></b>`, `0\nLINE\n10\n${digits}x\n`])
    expect(refusal(() => readPath(text)).length, text.slice(0, 20)).toBeLessThan(200);
}, slow);

const samples = [
  "M1 1C0 6 6 6 6 0S12-6 12 0Q14 2 16 0T20 0A3 2 30 0120 8h3v-2z", "x_mm;y_mm\n1,5;2\n\"3\";4\n-3;4,25\n", "1.5, 2\n3, 4e1\n-3, 7\n",
  '<?xml version="1.0"?><!DOCTYPE svg [<!ENTITY a "b">]><svg width="9cm" viewBox="0 0 9 9"><g transform="translate(1,2) rotate(3 4 5)"><rect x="1" width="4" height="3" rx="1"/></g><!-- a --></svg>',
  "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n5\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n0\n20\n0\n11\n4\n21\n0\n0\nARC\n10\n4\n20\n1\n40\n1\n50\n270\n51\n90\n0\nENDSEC\n0\nEOF\n",
  "0\nSPLINE\n71\n2\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n41\n1\n41\n2\n41\n1\n10\n0\n20\n0\n10\n4\n20\n4\n10\n8\n20\n0\n",
  "0\nPOLYLINE\n70\n1\n0\nVERTEX\n10\n0\n20\n0\n42\n1\n0\nVERTEX\n10\n4\n20\n0\n0\nVERTEX\n10\n4\n20\n3\n0\nSEQEND\n0\nELLIPSE\n10\n0\n20\n0\n11\n2\n21\n0\n40\n.5\n",
];

test("texts that are cut off or damaged give a path of finite numbers, or a reason", () => {
  let [read, refused] = [0, 0];
  const attempt = (text: string) => {
    try {
      const { points } = readPath(text);
      ++read;
      if (points.length < 2 || points.length > 200 || !points.every((p) => Number.isFinite(p.x) && Number.isFinite(p.y))) throw new Error(`${points.length} points of ${text}`);
    } catch (error) {
      if (!(error instanceof PathError)) throw new Error(`${String(error)} of ${JSON.stringify(text)}`);
      ++refused;
    }
  };
  let state = 1;
  const random = (count: number) => (state = (Math.imul(state, 1103515245) + 12345) >>> 0, (state >>> 8) % count);
  const noise = ["", " ", "\n", "-", ".", "e9", "9", "0", "1e308", "NaN", "<", ">", "\"", "&lt;", ";", ",", "\0", "z", "M", "\n0\n", "(", ")"];
  for (const sample of samples) {
    for (let end = 0; end < sample.length; ++end) attempt(sample.slice(0, end));
    for (let k = 0; k < 1000; ++k) {
      const at = random(sample.length);
      attempt(sample.slice(0, at) + noise[random(noise.length)] + sample.slice(at + random(3)));
    }
  }
  expect(read).toBeGreaterThan(1000);
  expect(refused).toBeGreaterThan(1000);
}, slow);
