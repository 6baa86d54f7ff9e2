// Runs every template of the program and opens its report in a headless browser without network: no error may appear, and what
// the diagrams draw must be told apart.
// node templates.mjs LINKWRIGHT FOLDER CHROMIUM
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdirSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";
import { chromium } from "playwright-core";

const [program, folder, executablePath] = process.argv.slice(2);
const call = promisify(execFile);
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const kinds = JSON.parse((await call(program, ["catalogue", "--json"])).stdout).map((one) => one.name);
assert.ok(kinds.length > 20, "the catalogue is short");

/** Makes the report of a template; a study that ends without an answer has one, too. */
async function make(kind) {
  const name = kind.replaceAll("/", "-");
  const study = join(folder, `${name}.toml`);
  writeFileSync(study, (await call(program, ["new", kind, "-"])).stdout);
  const words = ["run", study, "--out", join(folder, name), "--time-limit", "5", "--set", "output.formats=['html']"];
  await call(program, words, { maxBuffer: 1 << 24 }).catch((error) => {
    if (error.code !== 1 && error.code !== 3 && error.code !== 4) throw error;
  });
  return pathToFileURL(resolve(folder, name, "report.html")).href;
}

const browser = await chromium.launch({
  executablePath,
  args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const context = await browser.newContext({ viewport: { width: 1366, height: 900 }, offline: true, reducedMotion: "reduce" });

async function look(kind) {
  const url = await make(kind);
  const page = await context.newPage();
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => /^(file|blob|data):/.test(request.url()) || errors.push(`asks for ${request.url()}`));
  page.setDefaultTimeout(120_000); // a busy machine draws slowly
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
  await page.close();
  return cards.length;
}

let failures = 0;
for (const kind of kinds) {
  try {
    console.log(`ok      ${kind}: ${await look(kind)} diagrams`);
  } catch (error) {
    ++failures;
    console.log(`FAILED  ${kind}\n${error.stack}`);
  }
}
await browser.close();
process.exit(failures ? 1 : 0);
