// SPDX-License-Identifier: BSD-3-Clause

// What the animation of reports costs: names of files, one a line, come in; for each [median, 95 %, processor]
// ms of script a frame go out, a line each. The first two go by the clock, the last is the mean time of the processor, which others that use it leave alone.
// node frame_cost.mjs CHROMIUM < NAMES
// Script is what runs in callbacks of animation frames and follows from them at once; style, layout and painting come on top and depend on the machine.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const frames = 90; // of a report, after as many as it takes to warm up
const warm = 20;
const browser = await chromium.launch({
  executablePath: process.argv[2],
  args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, offline: true });
// Callbacks of one frame have one time stamp.
await context.addInitScript(() => {
  const costs = new Map();
  const request = globalThis.requestAnimationFrame.bind(globalThis);
  globalThis.requestAnimationFrame = (run) =>
    request((time) => {
      const from = performance.now();
      // Parts drawn again are so in microtasks, of which some call for others.
      const later = (turns) => queueMicrotask(() => (turns > 0 ? later(turns - 1) : costs.set(time, (costs.get(time) ?? 0) + performance.now() - from)));
      run(time);
      later(3);
    });
  globalThis.frameCosts = costs;
});
const at = (values, share) => values.sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];
for (const name of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
  const page = await context.newPage();
  const session = await context.newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const script = async () => (await session.send("Performance.getMetrics")).metrics.find((m) => m.name === "ScriptDuration").value;
  page.setDefaultTimeout(120_000);
  await page.goto(pathToFileURL(name).href);
  await page.locator("#app h1").waitFor();
  const play = page.locator("#play");
  let costs = [];
  let processor = 0;
  if ((await play.count()) && (await play.isEnabled())) {
    if ((await play.getAttribute("aria-label")) === "Play") await play.click();
    await page.mouse.move(2, 2); // away from diagrams, which hold the motion
    const played = async (count) => {
      for (const end = Date.now() + 30_000; Date.now() < end && costs.length < count; await page.waitForTimeout(200))
        costs = await page.evaluate(() => [...globalThis.frameCosts.values()]);
      return [costs.length, await script()];
    };
    const [[n, from], [m, to]] = [await played(warm), await played(warm + frames)];
    processor = m > n ? ((to - from) / (m - n)) * 1e3 : 0;
  }
  const counted = costs.slice(warm, warm + frames);
  console.log(JSON.stringify(counted.length ? [at(counted, 0.5), at(counted, 0.95), processor] : [0, 0, 0]));
  await page.close();
}
await browser.close();
