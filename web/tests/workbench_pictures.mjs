// SPDX-License-Identifier: BSD-3-Clause

// Pictures of the workbench; called by tools/workbench_pictures.py, which says what it does.
// node workbench_pictures.mjs LINKWRIGHT CHROMIUM FOLDER [NAME...]
import { spawn } from "node:child_process";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { launch } from "./scenarios.mjs";

const [program, executablePath, folder, ...names] = process.argv.slice(2);
const server = spawn(program, ["serve"], { stdio: ["ignore", "pipe", "inherit"] });
process.on("exit", () => server.kill());
const address = /^open (\S+)/.exec(await new Promise((done) => server.stdout.once("data", (bytes) => done(bytes.toString()))))[1];

const settled = (page) => page.locator("#took").waitFor();
async function choose(page, example) {
  await page.locator("#examples").click();
  await page.locator(".gallery input").fill(example);
  await page.locator(`[data-example="${example}"]`).click();
  await page.waitForFunction((name) => document.querySelector(".bar .name").textContent === name, `${example}.toml`);
  await settled(page);
}
/** On the board: a geared five-bar with a traced place of a link, a spring with a damper, and a force. */
async function sketch(page) {
  await page.locator("#draw").click();
  const at = (x, y) => page.locator("#board").evaluate((svg, [x, y]) => {
    const m = svg.getScreenCTM();
    return { x: m.a * x + m.e, y: -m.d * y + m.f };
  }, [x, y]);
  const press = async (x, y) => {
    const { x: left, y: top } = await at(x, y);
    await page.mouse.click(left, top);
  };
  for (const [tool, ...places] of [["link", [-50, -60], [-80, 10], [0, 90], [90, 20], [60, -60]], ["ground", [-50, -60], [60, -60]], ["drive", [-50, -60]], ["gear", [-50, -60], [60, -60]],
    ["trace", [-41, 49]], ["spring", [45, 55], [120, 120]], ["damper", [45, 55], [120, 120]], ["force", [0, 90]]]) {
    await page.locator(`[data-tool="${tool}"]`).click();
    for (const [x, y] of places) await press(x, y);
  }
}
const screens = {
  start: async () => {},
  gallery: async (page) => {
    await page.locator("#examples").click();
    await page.locator(".example svg").nth(1).waitFor();
  },
  draw: sketch,
  path: async (page) => {
    await page.locator('[data-entry="path"]').click();
    await page.locator("#path-paste").click();
    await page.locator("#path-text").fill("M -50 30 H 50 A 50 55 0 0 0 -50 30 Z");
    await page.locator("#path-use").click();
    await page.locator(".found").first().waitFor();
  },
  error: async (page) => {
    await page.locator("#tab-text").click();
    const text = page.locator("textarea.study");
    await text.fill((await text.inputValue()).replace(/kind( *)= "analysis"/, 'kind$1= "analyse"'));
    await page.locator(".problems li").first().waitFor();
  },
  search: (page) => choose(page, "fourbar-18-points"),
  poses: (page) => choose(page, "loading-arm"),
  suspension: async (page) => {
    await choose(page, "sweep");
    await page.locator("#tab-points").click();
  },
  robot: (page) => choose(page, "packing-line"),
};
const sizes = { laptop: { viewport: { width: 1366, height: 768 } }, phone: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } };

const browser = await launch(executablePath);
mkdirSync(folder, { recursive: true });
let wide = 0;
for (const [screen, prepare] of Object.entries(screens).filter(([name]) => !names.length || names.includes(name)))
  for (const [size, options] of Object.entries(sizes))
    for (const colorScheme of ["light", "dark"]) {
      const context = await browser.newContext({ ...options, colorScheme, reducedMotion: "reduce" });
      const page = await context.newPage();
      page.setDefaultTimeout(60_000);
      await page.goto(address);
      await page.locator("#drawing .pose").waitFor();
      await settled(page);
      await prepare(page);
      await page.waitForTimeout(500);
      const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      if (over > 0) {
        ++wide;
        console.log(`${screen}-${size}: ${over} px too wide`);
      }
      await page.screenshot({ path: join(folder, `${screen}-${size}-${colorScheme}.png`) });
      await context.close();
    }
await browser.close();
process.exit(wide ? 1 : 0);
