// How long reports take to open: names of files, one a line, come in; for each
// [first paint, viewer] in ms goes out, a line each, medians of three.
// node load_times.mjs CHROMIUM < NAMES
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { launch } from "./scenarios.mjs";

const browser = await launch(process.argv[2]);
const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, offline: true, reducedMotion: "reduce" });
// The moment at which the viewer takes the place of the form without scripts.
await context.addInitScript(() => {
  new MutationObserver((_, observer) => {
    const app = document.getElementById("app");
    if (!app || app.hidden) return;
    performance.mark("viewer");
    observer.disconnect();
  }).observe(document, { subtree: true, childList: true, attributes: true, attributeFilter: ["hidden"] });
});
const middle = (values) => values.sort((a, b) => a - b)[1];
for (const name of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
  const runs = [];
  for (let i = 0; i < 3; ++i) {
    const page = await context.newPage();
    page.setDefaultTimeout(120_000);
    await page.goto(pathToFileURL(name).href);
    await page.locator("#app h1").waitFor();
    let times = [];
    while (times.length < 2)
      times = await page.evaluate(() => ["first-contentful-paint", "viewer"].flatMap((name) => performance.getEntriesByName(name).map((e) => e.startTime)));
    runs.push(times);
    await page.close();
  }
  console.log(JSON.stringify([0, 1].map((k) => middle(runs.map((run) => run[k])))));
}
await browser.close();
