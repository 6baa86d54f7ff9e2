// SPDX-License-Identifier: BSD-3-Clause

// Makes the manual and reads it as a stranger would: all links lead somewhere, what is to be run runs, search and the mechanisms
// beside the text work from disk without a network, and readers with aids find their way.
// node manual.mjs LINKWRIGHT WORKBENCH FOLDER CHROMIUM; ONLY=WORDS in the environment picks tests by their names
import assert from "node:assert/strict";
import { execFile, execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { promisify } from "node:util";
import { briefly, launch, runAll } from "./scenarios.mjs";

const [program, workbench, out, executablePath] = process.argv.slice(2).map((p) => resolve(p));
const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const texts = join(root, "docs/manual");
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const call = promisify(execFile);
execFileSync("node", [join(root, "web/manual/build.mjs"), program, out, "--workbench", workbench], { stdio: "inherit" });

const below = (folder, end) => readdirSync(folder, { recursive: true }).filter((n) => n.endsWith(end)).sort();
const pages = below(out, ".html").filter((n) => n !== "workbench.html");
const browser = await launch(executablePath, briefly);
async function open(name, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1366, height: 900 }, offline: true, reducedMotion: "reduce", bypassCSP: true, ...options });
  const page = await context.newPage();
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => /^(file|blob|data):/.test(request.url()) || errors.push(`asks for ${request.url()}`));
  await page.goto(pathToFileURL(join(out, name)).href);
  return { page, errors, close: () => context.close() };
}

const tests = [];
const test = (name, run) => tests.push({ name, run });

test("all parts are there", () => {
  const kinds = JSON.parse(execFileSync(program, ["catalogue", "--json"], { encoding: "utf8" })).map((k) => k.name);
  for (const kind of kinds) assert.ok(pages.includes(`reference/${kind.replace(/[/.]/g, "-")}.html`), kind);
  for (const name of ["index", "gallery", "reference/index", "reference/commands", "reference/result", "reference/python", "reference/cpp/index", "reference/cpp/group__planar"]) assert.ok(pages.includes(`${name}.html`), name);
  for (const file of below(texts, ".md")) assert.ok(pages.includes(file.replace(/\.md$/, ".html")), file);
});

test("all links lead somewhere", () => {
  const anchors = new Map(pages.map((p) => [p, new Set([...readFileSync(join(out, p), "utf8").matchAll(/ id="([^"]*)"/g)].map((m) => m[1]))]));
  const lost = [];
  for (const page of pages)
    for (const [, href] of readFileSync(join(out, page), "utf8").matchAll(/ (?:href|src|data-live)="([^"]*)"/g)) {
      if (/^(?:https?|data|mailto):/.test(href)) continue;
      const [path, anchor] = href.replace(/&amp;/g, "&").split("#");
      const to = path ? relative(out, resolve(out, dirname(page), path)) : page;
      if (!existsSync(join(out, to)) || statSync(join(out, to)).isDirectory()) lost.push(`${page}: ${href}`);
      else if (anchor && anchors.has(to) && !anchors.get(to).has(decodeURIComponent(anchor))) lost.push(`${page}: ${href}, no such part`);
    }
  assert.deepEqual(lost, []);
});

/** The runnable parts of a text: studies with their names, and commands. */
function runnable(file) {
  const blocks = [...readFileSync(join(texts, file), "utf8").matchAll(/^```(toml|sh) run\n([^]*?)^```$/gm)].map(([, word, code]) => ({ word, code }));
  const studies = blocks.filter((b) => b.word === "toml").map(({ code }, i) => ({ name: /^# file: (\S+)/.exec(code)?.[1] ?? `study-${i + 1}.toml`, code }));
  return { studies, commands: blocks.filter((b) => b.word === "sh").map((b) => b.code) };
}

for (const file of below(texts, ".md")) {
  const { studies, commands } = runnable(file);
  if (!studies.length && !commands.length) continue;
  test(`what ${file} gives to run runs`, async () => {
    const folder = `${out}-run/${file.replace(/\W/g, "-")}`;
    rmSync(folder, { recursive: true, force: true });
    mkdirSync(folder, { recursive: true });
    const options = { cwd: folder, maxBuffer: 1 << 26, timeout: 120_000, env: { ...process.env, PATH: `${dirname(program)}:${process.env.PATH}` } };
    for (const { name, code } of studies) writeFileSync(join(folder, name), code);
    for (const { name } of studies)
      await call(program, ["run", name, "--out", `${name}.out`], options).catch((e) => assert.fail(`${name}: exit code ${e.code}\n${e.stdout}${e.stderr}`));
    for (const command of commands) await call("bash", ["-euc", command], options).catch((e) => assert.fail(`${command}: exit code ${e.code}\n${e.stdout}${e.stderr}`));
  });
}

test("search finds keys, words and nothing, without a network", async () => {
  const { page, errors, close } = await open("index.html");
  await page.locator("#search").fill("transmission angle");
  assert.ok((await page.locator("#found a").count()) > 3);
  await page.locator("#search").fill("crank_rotates_fully");
  assert.match(await page.locator("#found a").first().getAttribute("href"), /reference\//);
  // The text of a message leads to it.
  await page.locator("#search").fill("a quote is not closed");
  assert.ok((await page.locator("#found a").evaluateAll((links) => links.map((l) => l.getAttribute("href")))).some((href) => /messages\.html#error-/.test(href)));
  await page.locator("#search").fill("nosuchwordanywhere");
  assert.match(await page.locator("#found").innerText(), /Nothing has all of/);
  // Arrows go along what is found, Escape leads back.
  const focused = () => page.evaluate(() => document.activeElement.id || document.activeElement.getAttribute("href"));
  await page.locator("#search").fill("jacobian");
  const [first, second] = await page.locator("#found a").evaluateAll((links) => links.map((l) => l.getAttribute("href")));
  await page.keyboard.press("ArrowDown");
  assert.equal(await focused(), first);
  await page.keyboard.press("ArrowDown");
  assert.equal(await focused(), second);
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("ArrowUp");
  assert.equal(await focused(), "search");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Escape");
  assert.equal(await focused(), "search");
  assert.equal(await page.locator("#found a").count(), 0);
  await page.locator("#search").fill("jacobian");
  await page.locator("#search").press("Enter");
  await page.waitForURL((url) => !url.href.endsWith("index.html"));
  assert.deepEqual(errors, []);
  await close();
});

for (const name of ["index.html", ...pages.filter((n) => /^learn\/0?1\b/.test(n))])
  test(`the mechanism of ${name} moves beside the text`, async () => {
    const { page, errors, close } = await open(name);
    await page.locator(".live").first().click();
    await page.frameLocator("#live").locator("#drawing .pose").waitFor({ timeout: 60_000 });
    assert.deepEqual(errors, []);
    await close();
  });

test("all pages stand in both schemes, on a phone, and for readers with aids", async () => {
  const faults = [];
  const { page, errors, close } = await open("index.html");
  // The workbench beside a text has tests of its own.
  await page.route("**/workbench.html*", (route) => route.fulfill({ contentType: "text/html", body: "<!doctype html><title>-</title>" }));
  // The hundreds of pages of types and lists that Doxygen makes are all of one form.
  for (const name of pages.filter((n) => !n.startsWith("reference/cpp/") || /\/(?:index|group__(?:optimise|parameter__study)|structlinkwright_1_1Table)\.html$/.test(n))) {
    await page.goto(pathToFileURL(join(out, name)).href);
    await page.evaluate(axe);
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
      const violations = await page.evaluate(() => axe.run({ exclude: ["iframe"] }, { runOnly: ["wcag2a", "wcag2aa"], preload: false, resultTypes: ["violations"] }).then((found) => found.violations));
      faults.push(...violations.map((v) => `${name} (${colorScheme}): ${v.id}: ${v.nodes[0].html.slice(0, 120)}`));
    }
    for (const width of [390, 1366]) {
      await page.setViewportSize({ width, height: 844 });
      if ((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) > 0) faults.push(`${name} is wider than ${width} pixels`);
    }
  }
  await close();
  assert.deepEqual([...faults, ...errors], []);
});

const failed = await runAll(tests);
await browser.close();
process.exit(failed ? 1 : 0);
