// SPDX-License-Identifier: BSD-3-Clause

// How long reports and the workbench take to open: names of files, one a line, come in; for each goes out a line of times in ms, medians
// of three: [first paint, viewer] of a report, [first paint, engine unpacked, engine compiled, first study drawn] of a workbench.
// node load_times.mjs CHROMIUM < NAMES
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { launch } from "./scenarios.mjs";

const browser = await launch(process.argv[2]);
const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, offline: true, reducedMotion: "reduce" });
await context.addInitScript(() => {
  // The moments at which the viewer takes the place of the form without scripts, and at which the workbench has its first answer.
  const moments = { viewer: () => document.querySelector("#app.page:not([hidden])"), answered: () => document.querySelector("#app #drawing .pose") };
  new MutationObserver(() => {
    for (const [name, there] of Object.entries(moments))
      if (!performance.getEntriesByName(name).length && there()) performance.mark(name);
  }).observe(document, { subtree: true, childList: true, attributes: true, attributeFilter: ["hidden"] });
  const compile = WebAssembly.compile;
  WebAssembly.compile = (...bytes) => {
    performance.mark("unpacked");
    return compile(...bytes).finally(() => performance.mark("compiled"));
  };
});
const middle = (values) => values.sort((a, b) => a - b)[1];
for (const name of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
  const runs = [];
  for (let i = 0; i < 3; ++i) {
    const page = await context.newPage();
    page.setDefaultTimeout(120_000);
    await page.goto(pathToFileURL(name).href);
    const moments = ["first-contentful-paint", ...((await page.locator("#engine-wasm").count()) ? ["unpacked", "compiled", "answered"] : ["viewer"])];
    let times = [];
    while (times.length < moments.length)
      times = await page.evaluate((names) => names.flatMap((name) => performance.getEntriesByName(name).slice(0, 1).map((e) => e.startTime)), moments);
    runs.push(times);
    // Every opening is the first one.
    await page.evaluate(() => localStorage.clear());
    await page.close();
  }
  console.log(JSON.stringify(runs[0].map((_, k) => middle(runs.map((run) => run[k])))));
}
await browser.close();
