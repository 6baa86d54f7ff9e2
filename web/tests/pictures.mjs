// SPDX-License-Identifier: BSD-3-Clause

// First screens of reports; called by tools/report_pictures.py, which says what it does.
// node pictures.mjs CHROMIUM FOLDER FLAGS REPORT...
import { mkdirSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { pathToFileURL } from "node:url";
import { launch } from "./scenarios.mjs";

const [executablePath, folder, flags, ...reports] = process.argv.slice(2);
const sizes = [[1366, 768], [390, 844], [1920, 1080]];
const browser = await launch(executablePath);
mkdirSync(folder, { recursive: true });
let hidden = 0;
for (const report of reports)
  for (const [width, height] of sizes) {
    const context = await browser.newContext({ viewport: { width, height }, reducedMotion: "reduce", colorScheme: flags.includes("dark") ? "dark" : "light" });
    const page = await context.newPage();
    await page.goto(pathToFileURL(report).href);
    await page.waitForTimeout(600);
    const name = `${basename(dirname(report))}-${width}`;
    await page.screenshot({ path: join(folder, `${name}.png`), fullPage: flags.includes("whole") });
    const play = page.locator("#play");
    const box = (await play.count()) ? await play.boundingBox() : null;
    if (box && box.y + box.height > height) {
      ++hidden;
      console.log(`${name}: the controls stand at ${Math.round(box.y)} of ${height}`);
    }
    await context.close();
  }
await browser.close();
process.exit(hidden ? 1 : 0);
