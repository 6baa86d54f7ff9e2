// SPDX-License-Identifier: BSD-3-Clause

// Runs every template or example of the program and opens its report in a headless browser without network: no error may appear,
// what the diagrams draw must be told apart, and readers with aids must find their way.
// node reports.mjs templates|examples LINKWRIGHT FOLDER CHROMIUM
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";
import { briefly, launch, runAll } from "./scenarios.mjs";

const [what, program, folder, executablePath] = process.argv.slice(2);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const call = promisify(execFile);
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const list = async (...words) => JSON.parse((await call(program, [...words, "--json"])).stdout).map((one) => one.name);
const names = await (what === "templates" ? list("catalogue") : list("examples"));
assert.ok(names.length > (what === "templates" ? 20 : 80), "the list is short");

/** Makes the report of a study; one that ends without an answer has one, too. */
async function make(name) {
  const plain = name.replaceAll("/", "-");
  const study = join(resolve(folder), `${plain}.toml`);
  if (what === "templates") writeFileSync(study, (await call(program, ["new", name, "-"])).stdout);
  else await call(program, ["examples", "--copy", name], { cwd: folder });
  const words = ["run", study, "--out", join(folder, plain), "--time-limit", "5", "--set", "output.formats=['html']"];
  await call(program, words, { maxBuffer: 1 << 24 }).catch((error) => {
    if (error.code !== 1 && error.code !== 3 && error.code !== 4) throw error;
  });
  return pathToFileURL(resolve(folder, plain, "report.html")).href;
}

const browser = await launch(executablePath, briefly);
const context = await browser.newContext({ viewport: { width: 1366, height: 900 }, offline: true, reducedMotion: "reduce", bypassCSP: true });

/** A page, and what goes wrong in it. */
async function open() {
  const page = await context.newPage();
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => /^(file|blob|data):/.test(request.url()) || errors.push(`asks for ${request.url()}`));
  page.setDefaultTimeout(120_000); // a busy machine draws slowly
  return { page, errors };
}

async function look({ page, errors }, url) {
  await page.goto(url);
  await page.locator("#app h1").waitFor();
  const last = await page.locator("#scrub").count();
  if (last) for (const end of ["max", "min"]) await page.locator("#scrub").evaluate((e, end) => ((e.value = e[end]), e.dispatchEvent(new Event("input", { bubbles: true }))), end);
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  assert.deepEqual(errors, []);
  // A card without a picture is one that broke.
  const cards = await page.locator(".card.plot").evaluateAll((all) => all.map((card) => ({
    plot: card.dataset.plot,
    drawn: card.querySelector("canvas, svg, .note") !== null,
    looks: [...card.querySelectorAll(".legend path")].map((e) => `${getComputedStyle(e).stroke} ${getComputedStyle(e).strokeDasharray}`),
  })));
  for (const { plot, drawn, looks } of cards) {
    assert.ok(drawn, `${plot} is empty`);
    assert.equal(new Set(looks).size, looks.length, `${plot}: curves that look the same`);
  }
  await page.evaluate(axe);
  const found = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }).then(({ violations }) => violations));
  const grave = found.filter((v) => v.impact === "serious" || v.impact === "critical");
  assert.deepEqual(grave.map((v) => `${v.id}: ${v.nodes.map((n) => n.html.slice(0, 160)).join(" | ")}`), []);
}

// While one is looked at, the next is computed.
const made = [];
const begin = (i) => {
  if (i < names.length && !made[i]) (made[i] = make(names[i])).catch(() => {});
  return made[i];
};
// One report after the other in the same page, whose process is then started once; after a fault comes a new one.
let opened;
const failed = await runAll(names.map((name, i) => ({
  name,
  run: async () => {
    const report = begin(i);
    begin(i + 1);
    const url = await report;
    opened ??= await open();
    try {
      await look(opened, url);
    } catch (error) {
      await opened.page.close();
      opened = undefined;
      throw error;
    }
  },
})));
await browser.close();
process.exit(failed ? 1 : 0);
