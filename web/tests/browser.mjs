// SPDX-License-Identifier: BSD-3-Clause

// Opens the sample reports from disk in a headless browser without network and uses them as a reader would.
// node browser.mjs SAMPLES CHROMIUM PYTHON CHECK_DXF [SCREENSHOTS]; ONLY=WORDS in the environment picks tests by their names
/* global linkwright */
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { briefly, launch, runAll } from "./scenarios.mjs";

const [samples, executablePath, python, checkDxf, pictures] = process.argv.slice(2);
const url = (name) => pathToFileURL(resolve(samples, name)).href;
const browser = await launch(executablePath, briefly);

async function open(name, options = {}, before, argument) {
  const context = await browser.newContext({ viewport: { width: 1360, height: 900 }, offline: true, acceptDownloads: true, ...options });
  const page = await context.newPage();
  if (before) await page.addInitScript(before, argument);
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => /^(file|blob|data):/.test(request.url()) || errors.push(`asks for ${request.url()}`));
  await page.goto(url(name));
  // The viewer stands once the data are unpacked; where it cannot, the form without scripts stays.
  if (options.javaScriptEnabled !== false) await page.locator("#static").waitFor({ state: "detached", timeout: 10_000 }).catch(() => {});
  return { page, errors, close: () => context.close() };
}

const tests = [];
const test = (name, run) => tests.push({ name, run });
const position = (page) => page.locator("#drawing .pose").getAttribute("data-position").then(Number);
const crank = (page) => page.locator('.pose [data-body="crank"] .bar').getAttribute("d");
// The page forbids eval, so that its state is asked for from here.
async function until(what) {
  for (const end = Date.now() + 10_000; Date.now() < end; await new Promise((resolve) => setTimeout(resolve, 30))) if (await what()) return;
  assert.fail(`never happened: ${what}`);
}
/** A value that is seen becomes this: a click's answer is drawn when the browser comes to it. */
async function equal(read, expected, message) {
  for (const end = Date.now() + 10_000; Date.now() < end; await new Promise((resolve) => setTimeout(resolve, 30)))
    if (Object.is(await read(), expected)) return;
  assert.equal(await read(), expected, message);
}
async function matches(read, expected, message) {
  for (const end = Date.now() + 10_000; Date.now() < end; await new Promise((resolve) => setTimeout(resolve, 30)))
    if (expected.test(await read())) return;
  assert.match(await read(), expected, message);
}
const marker = (page, plot) => page.locator(`[data-plot="${plot}"] .now`).evaluate((e) => new DOMMatrix(getComputedStyle(e).transform).e);
const pause = async (page) => {
  if ((await page.locator("#play").getAttribute("aria-label")) === "Pause") await page.locator("#play").click();
};
async function download(page, key) {
  if (await page.locator(`.menu:not([open]) [data-download="${key}"]`).count()) await page.locator(".menu summary").click();
  const [file] = await Promise.all([page.waitForEvent("download", { timeout: 120_000 }), page.locator(`[data-download="${key}"]`).first().click()]);
  return { name: file.suggestedFilename(), path: await file.path() };
}

test("the report stands, complete and without errors", async () => {
  const { page, errors, close } = await open("report.html");
  await page.waitForSelector("#drawing .pose");
  await equal(() => page.locator("#static").count(), 0);
  await matches(() => page.locator("h1").innerText(), /Four-bar through 18 points/);
  await matches(() => page.locator(".verdict").innerText(), /2 of 2 checks passed/);
  for (const [part, count] of [["#drawing .link", 3], [".joint", 5], [".target", 18], [".worst", 2], [".chart canvas", 3], ["#solutions tbody tr", 3],
    ["#parameters tbody tr", 8], ["#published tbody tr", 2], [".dots circle", 12], [".remarks li", 1], [".facts > div", 9]])
    await equal(() => page.locator(part).count(), count, part);
  await equal(() => page.locator("#parameters", { hasText: "at upper bound" }).count(), 1);
  assert.deepEqual(errors, []);
  await close();
});

test("it moves at once, pauses and plays", async () => {
  const { page, close } = await open("report.html");
  const before = await crank(page);
  await until(async () => (await crank(page)) !== before);
  await page.locator("#play").click();
  const still = await crank(page);
  await page.waitForTimeout(200);
  await equal(() => crank(page), still);
  await page.locator("body").press(" ");
  await until(async () => (await crank(page)) !== still);
  await close();
});

test("links keep their length while it moves", async () => {
  const { page, close } = await open("report.html");
  const length = () => page.locator('.pose [data-body="crank"] .bar').evaluate((e) => e.getTotalLength());
  await pause(page);
  const before = await length();
  for (let i = 0; i < 5; ++i) await page.locator("body").press("Shift+ArrowRight");
  assert.ok(Math.abs((await length()) - before) < 0.05, "coordinates are rounded to a hundredth of a pixel");
  await close();
});

test("scrubbing changes the pose, the numbers and the cursors of the plots", async () => {
  const { page, close } = await open("report.html");
  await page.locator("#scrub").fill("90");
  await equal(() => position(page), 90);
  await equal(() => page.locator("#input-value").innerText(), "90.0°");
  await matches(() => page.locator('[data-plot="coupler"] .legend').innerText(), /coupler point x [0-9.]+ m/);
  const [pose, cursor] = [await crank(page), await marker(page, "transmission")];
  await page.locator("#scrub").fill("180");
  await until(async () => (await crank(page)) !== pose);
  const width = await page.locator('[data-plot="transmission"] .u-over').evaluate((e) => e.clientWidth);
  assert.ok(Math.abs((await marker(page, "transmission")) - cursor - width / 4) < 2, "a quarter of the turn is a quarter of the plot");
  await close();
});

test("pointing at a plot moves the mechanism there", async () => {
  const { page, close } = await open("report.html");
  await pause(page);
  const over = page.locator('[data-plot="transmission"] .u-over');
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  await page.mouse.move(box.x + box.width * 0.5, box.y + 40);
  await page.mouse.move(box.x + box.width * 0.75, box.y + 40);
  await until(async () => Math.abs((await position(page)) - 270) < 3);
  await close();
});

test("keys step, toggle and zoom", async () => {
  const { page, close } = await open("report.html");
  await page.locator("#scrub").fill("10");
  await page.locator("body").press("ArrowRight");
  await page.locator("body").press("Shift+ArrowRight");
  await equal(() => position(page), 21);
  await page.locator("body").press("g");
  await equal(() => page.locator(".ghosts > g").count(), 12);
  await page.locator("body").press("t");
  await equal(() => page.locator(".traces").count(), 0);
  await page.locator("body").press("t");
  await page.locator("body").press("v");
  await until(async () => (await page.locator(".trace.speed").count()) > 5);
  const pose = await crank(page);
  await page.locator("body").press("+");
  await until(async () => (await crank(page)) !== pose);
  await page.locator("body").press("0");
  await equal(() => crank(page), pose);
  await close();
});

test("what only catches the pointer is not seen", async () => {
  const { page, close } = await open("report.html", { reducedMotion: "reduce" });
  for (const joint of ["A", "C"])
    assert.deepEqual(await page.locator(`[data-joint="${joint}"] .reach`).evaluate((e) => [getComputedStyle(e).fill, getComputedStyle(e).stroke]), ["none", "none"]);
  await close();
});

test("whiskers can be magnified", async () => {
  const { page, close } = await open("report.html");
  const length = () => page.locator(".whisker").first().evaluate((e) => e.getTotalLength());
  await page.locator("#whisker").selectOption("1");
  const one = await length();
  await page.locator("#whisker").selectOption("10");
  assert.ok(Math.abs((await length()) / one - 10) < 0.2);
  await close();
});

test("a joint can be dragged along its motion", async () => {
  const { page, close } = await open("report.html");
  await page.locator("#scrub").fill("30");
  const box = await page.locator('[data-joint="A"] circle').first().boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 40, y - 20, { steps: 5 });
  await page.mouse.up();
  await until(async () => (await position(page)) > 35);
  await close();
});

test("solutions and exports are chosen by keyboard", async () => {
  const { page, errors, close } = await open("report.html", { reducedMotion: "reduce" });
  const focused = () => page.evaluate(() => document.activeElement.dataset.solution ?? document.activeElement.dataset.export ?? document.activeElement.tagName);
  await page.locator('[data-solution="0"]').focus();
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowDown");
  await equal(focused, "2");
  await page.keyboard.press("ArrowUp");
  await equal(focused, "1");
  await page.keyboard.press("Enter");
  await equal(() => page.locator('[data-solution="1"]').getAttribute("aria-checked"), "true");
  await page.locator(".menu summary").focus();
  await page.keyboard.press("Enter");
  await equal(focused, "link");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("ArrowDown");
  await equal(focused, "link");
  await page.keyboard.press("Escape");
  await equal(focused, "SUMMARY");
  await equal(() => page.locator(".menu").evaluate((e) => e.open), false);
  assert.deepEqual(errors, []);
  await close();
});

test("another solution can be shown; what does not assemble is hatched", async () => {
  const { page, errors, close } = await open("report.html");
  await equal(() => page.locator(".gap").count(), 0);
  await page.locator('[data-solution="2"]').click();
  await matches(() => page.locator(".title-block").innerText(), /double rocker/);
  await until(async () => (await page.locator(".gap").count()) >= 1);
  await matches(() => page.locator("#h-parameters").innerText(), /solution 3/);
  await equal(() => page.locator('[data-plot="transmission"] canvas').count(), 1);
  const missing = await page.evaluate(() => linkwright.view.scenes[2].status.indexOf("no_assembly"));
  await page.locator("#scrub").fill(String(missing));
  await matches(() => page.locator(".title-block").innerText(), /no assembly/);
  await equal(() => page.locator("#drawing .link").count(), 1);
  await page.locator("#solutions tbody tr").first().locator("button.link").click();
  await equal(() => page.locator(".gap").count(), 0);
  assert.deepEqual(errors, []);
  await close();
});

test("downloads have their content", async () => {
  const { page, errors, close } = await open("report.html");
  await pause(page);
  const table = await download(page, "motion of solution-1.csv");
  assert.equal(table.name, "motion-of-solution-1.csv");
  const lines = readFileSync(table.path, "utf8").trimEnd().split("\r\n");
  assert.equal(lines[0], "crank_angle_deg,coupler_x_m,coupler_y_m,transmission_angle_deg,status");
  assert.equal(lines.length, 362);
  // Bit for bit what the program writes, although the report carries it in another form.
  const written = await download(page, "motion of solution-1, as written.csv");
  assert.equal(readFileSync(written.path, "utf8"), readFileSync(join(samples, "motion of solution-1.csv"), "utf8"));
  assert.equal(readFileSync((await download(page, "result.json")).path, "utf8"), readFileSync(join(samples, "report.json"), "utf8"));
  assert.match(readFileSync((await download(page, "study.toml")).path, "utf8"), /^schema = 1/);
  const drawn = readFileSync((await download(page, "svg")).path, "utf8");
  assert.match(drawn, /^<svg[^]*<\/svg>$/);
  assert.doesNotMatch(drawn, /var\(--/);
  assert.match(drawn, /stroke="rgb\(0, 114, 178\)"/, "the crank has its colour");
  assert.equal(readFileSync((await download(page, "png")).path).subarray(1, 4).toString(), "PNG");
  const drawing = await download(page, "dxf");
  assert.equal(execFileSync(python, [checkDxf, drawing.path], { encoding: "utf8" }).trim(), "ok");
  assert.deepEqual(errors, []);
  await close();
});

test("everything is in the units of the study", async () => {
  const { page, errors, close } = await open("units.html", { reducedMotion: "reduce" });
  for (const summary of await page.locator(".data-table summary").all()) await summary.click();
  const heads = await page.locator(".data-table thead th").allInnerTexts();
  const axes = await page.locator(".legend").allInnerTexts();
  for (const text of [...heads, ...axes, await page.locator(".title-block").innerText()]) assert.doesNotMatch(text, /\brad\b|\bm(\/s²?)?\)|\d m\b/);
  assert.match(heads.join(", "), /\(mm\)/);
  const table = page.locator("[data-download$='.csv']").first();
  const name = (await table.getAttribute("data-download")).replace(/\.csv$/, "");
  assert.equal(readFileSync((await download(page, `${name}.csv`)).path, "utf8"), readFileSync(join(samples, "units.csv"), "utf8"));
  assert.deepEqual(errors, []);
  await close();
  const still = await open("units.html", { javaScriptEnabled: false });
  assert.doesNotMatch(await still.page.locator("#static").innerText(), /\(m\)|\(rad/);
  await still.close();
});

test("of wide tables the columns are chosen, and the first one stays", async () => {
  const { page, errors, close } = await open("diagrams.html", { viewport: { width: 390, height: 844 }, reducedMotion: "reduce" });
  const wide = page.locator(".data-table", { hasText: /1[3-9] columns|[2-9]\d columns/ }).first();
  await wide.locator("summary").click();
  await equal(() => wide.locator("thead th").count(), 12);
  await wide.locator("input[type=checkbox]").check();
  await until(async () => (await wide.locator("thead th").count()) > 12);
  const all = await wide.locator("thead th").count();
  const first = wide.locator("tbody tr").first().locator("th, td").first();
  const before = await first.boundingBox();
  await wide.locator(".scroll").evaluate((e) => (e.scrollLeft = 300));
  assert.ok(Math.abs((await first.boundingBox()).x - before.x) < 1.5, "the first column stays in sight");
  await wide.locator("input[type=search]").fill("wave");
  await until(async () => (await wide.locator("thead th").count()) < all);
  const found = await wide.locator("thead th").allInnerTexts();
  assert.ok(found.length >= 2 && found.length < all && found.slice(1).every((head) => /wave/i.test(head)), found.join(", "));
  await matches(() => wide.locator("[role=status]").innerText(), new RegExp(`^${found.length} of ${all} columns$`));
  assert.deepEqual(errors, []);
  await close();
});

test("it prints in light colours and returns to the screen", async () => {
  const { page, errors, close } = await open("report.html", { colorScheme: "dark" });
  const width = await page.locator(".chart canvas").first().evaluate((e) => e.clientWidth);
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  await equal(() => page.locator("html").getAttribute("data-theme"), "light");
  await equal(() => page.locator(".uplot").first().evaluate((e) => e.clientWidth), 300);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  await equal(() => page.locator(".chart canvas").first().evaluate((e) => e.clientWidth), width);
  assert.equal((await page.pdf({ format: "A4" })).subarray(0, 4).toString(), "%PDF");
  assert.deepEqual(errors, []);
  await close();
});

test("reduced motion is respected", async () => {
  const { page, close } = await open("report.html", { reducedMotion: "reduce" });
  await until(async () => /transmission angle [0-9.]+ °/.test(await page.locator('[data-plot="transmission"] .legend').innerText()));
  const before = await position(page);
  await page.waitForTimeout(250);
  await equal(() => position(page), before);
  await close();
});

// Rows of the table that the report carries; components of an arrow on the screen in pixels, y up.
const rows = (page) => page.evaluate(() => linkwright.result.tables[0].data);
const tipOf = async (page, pick) => {
  const [x, y] = (await page.locator(`#drawing [data-pick="${pick}"]`).getAttribute("data-tip")).split(" ").map(Number);
  return [x, -y];
};
const keyOf = async (page, quantity) => {
  const key = page.locator(`[data-key="${quantity}"]`);
  return Number(await key.getAttribute("data-length")) / Number(await key.getAttribute("data-value"));
};

test("arrows follow the scrubber and match the table", async () => {
  const { page, errors, close } = await open("simulation.html", { reducedMotion: "reduce" });
  const [, x, y] = await rows(page);
  const pixels = await keyOf(page, "force");
  for (const row of [0, 35, 120]) {
    await page.locator("#scrub").fill(String(row));
    const tip = await tipOf(page, "vector 0");
    // Pixels are written to a thousandth.
    assert.ok(Math.abs(tip[0] - x[row] * pixels) < 2e-3 && Math.abs(tip[1] - y[row] * pixels) < 2e-3, `${tip} in row ${row}`);
  }
  await equal(() => page.locator("#drawing .moment .shaft").count(), 2); // the couple and its key
  await equal(() => page.locator('#drawing [data-pick="vector 1"]').count(), 1);
  for (const part of ["symbol.guide", "symbol.spring", "circle"]) await equal(() => page.locator(`#drawing .${part}`).count(), 1, part);
  assert.deepEqual(errors, []);
  await close();
});

test("arrows are switched and scaled one quantity at a time", async () => {
  const { page, close } = await open("simulation.html", { reducedMotion: "reduce" });
  await page.locator("#scrub").fill("20");
  const arrows = (quantity) => page.locator(`.vectors .arrow.${quantity}`).count();
  await equal(async () => `${await arrows("force")} ${await arrows("velocity")}`, "2 0");
  await page.locator("body").press("w");
  await equal(async () => `${await arrows("force")} ${await arrows("velocity")}`, "2 1");
  const [force, speed] = [await tipOf(page, "vector 0"), await tipOf(page, "vector 2")];
  const tops = await page.locator(".arrow-bar button").evaluateAll((all) => all.map((e) => e.getBoundingClientRect().top));
  assert.ok(tops.length > 0 && Math.max(...tops) - Math.min(...tops) < 1, `switches in one row: ${tops}`);
  await page.locator('[data-scale="force"]').fill("1");
  const twice = await tipOf(page, "vector 0");
  assert.ok(Math.abs(twice[0] - 2 * force[0]) < 5e-3 && Math.abs(twice[1] - 2 * force[1]) < 5e-3);
  assert.deepEqual(await tipOf(page, "vector 2"), speed);
  await matches(() => page.locator('[data-scale="force"]').getAttribute("aria-valuetext"), /^×2, the arrow in the key is \d+ N$/);
  await matches(() => page.locator('[data-key="force"]').textContent(), /force \d+ N/);
  await page.locator("body").press("f");
  await equal(async () => `${await arrows("force")} ${await arrows("velocity")}`, "0 1");
  await equal(() => page.locator("[data-key]").count(), 1);
  await close();
});

test("arrows and joints tell their values to pointers and keys", async () => {
  const { page, errors, close } = await open("simulation.html", { reducedMotion: "reduce", permissions: ["clipboard-read", "clipboard-write"] });
  await page.locator("#scrub").fill("25");
  await page.locator('#drawing [data-pick="vector 1"] .head').hover({ force: true });
  await matches(() => page.locator("#picked").innerText(), /weight of the slider[^]*10\u202fN[^]*−90°/);
  await page.locator('#drawing [data-pick="vector 1"] .head').click({ force: true });
  await page.mouse.move(2, 2);
  await equal(() => page.locator("#picked button").count(), 2);
  await page.locator("body").press("Escape");
  await equal(() => page.locator("#picked").count(), 0);
  // A joint tells where it is and all that acts there.
  await page.locator('#drawing [data-pick="joint 2"] .reach').hover({ force: true });
  await matches(() => page.locator("#picked").innerText(), /^B\nx 282\.84, y 0 mm[^]*weight[^]*velocity of B/);
  await page.mouse.move(2, 2);
  // The same by keys: the table of values, and a row of it.
  await page.locator(".values summary").focus();
  await page.keyboard.press("Enter");
  const row = page.locator(".values tbody tr").first();
  await matches(() => row.innerText(), /crank on rod at A\s+36\.056\u202fN\s+20\u202fN\s+30\u202fN\s+56\.31°/);
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await equal(() => row.locator("button").getAttribute("aria-pressed"), "true");
  // It stands at the upper right of the drawing, as wide as its words.
  const [card, stage] = [await page.locator("#picked").boundingBox(), await page.locator(".stage").boundingBox()];
  assert.ok(card.width > 120 && card.width < 0.63 * stage.width, `the card is ${card.width} wide`);
  assert.ok(Math.abs(stage.x + stage.width - card.x - card.width - 10) < 2 && Math.abs(card.y - stage.y - 10) < 2, JSON.stringify({ card, stage }));
  await page.locator("#picked .copy").click();
  await equal(() => page.evaluate(() => navigator.clipboard.readText()),
    "crank on rod at A at time 0.25\u202fs\ncrank on rod at A: 36.056\u202fN (x 20\u202fN, y 30\u202fN, direction 56.31°)");
  await page.locator(".values .copy").click();
  await matches(() => page.evaluate(() => navigator.clipboard.readText()), /^at time 0\.25\u202fs\nname\tsize\tx\ty\tdirection\ncrank on rod/);
  assert.deepEqual(errors, []);
  await close();
});

test("polar diagrams have equal axes and follow the animation both ways", async () => {
  const { page, close } = await open("simulation.html", { reducedMotion: "reduce" });
  const [, x, y] = await rows(page);
  const box = await page.locator('[data-plot="polar"] .curve').evaluate((e) => ({ width: e.getBBox().width, height: e.getBBox().height }));
  assert.ok(Math.abs(box.width - box.height) < 0.1, "a circle is a circle");
  await page.locator("#scrub").fill("30");
  const dot = page.locator('[data-plot="polar"] .at');
  assert.ok(Math.abs(Number(await dot.getAttribute("data-x")) - x[30]) < 1e-6 && Math.abs(Number(await dot.getAttribute("data-y")) - y[30]) < 1e-6);
  // A quarter of a turn has gone by when the force points straight up from its middle.
  const svg = page.locator('[data-plot="polar"] .polar > svg');
  await svg.scrollIntoViewIfNeeded();
  const curve = await page.locator('[data-plot="polar"] .curve').boundingBox();
  await page.mouse.move(curve.x + curve.width / 2 + 2, curve.y + 1);
  await until(async () => Math.abs(((await position(page)) % 100) - 25) < 2);
  await close();
});

test("compared mechanisms have the look and the name of their curves", async () => {
  const { page, errors, close } = await open("compared.html");
  await page.waitForSelector("#drawing .other");
  const look = (e) => `${getComputedStyle(e).stroke} ${getComputedStyle(e).strokeDasharray}`;
  const looks = (all) => page.locator(all).evaluateAll((elements) => elements.map((e) => `${getComputedStyle(e).stroke} ${getComputedStyle(e).strokeDasharray}`));
  const curves = await looks('[data-plot="height"] .legend path');
  assert.equal(new Set(curves).size, 3);
  assert.deepEqual(await looks(".stage ~ .runs path"), curves);
  assert.deepEqual(await page.locator(".stage ~ .runs li").allInnerTexts(), ["short", "middle", "long"]);
  for (const [run, name] of [[1, "middle"], [2, "long"]])
    await equal(() => page.locator(`#drawing .pose [data-body="crank of ${name}"], #drawing .plates [data-body="crank of ${name}"]`).evaluate(look), curves[run]);
  await equal(() => page.locator("#drawing .link").count(), 1);
  // Dots where there are few values, steps where there are many: in the same colours.
  const few = page.locator('[data-plot="few_m"]');
  await until(async () => (await few.locator(".dots circle").count()) === 12);
  assert.deepEqual(await few.locator(".runs li").allInnerTexts(), ["short", "middle", "long"]);
  await equal(() => few.locator(".dots circle").last().evaluate((e) => getComputedStyle(e).fill), curves[2].replace(/\) .*/, ")"));
  assert.deepEqual(await looks('[data-plot="many_m"] .legend path'), curves);
  await matches(() => page.locator('[data-plot="many_m"] .legend').innerText(), /short[\s\S]*middle[\s\S]*long/);
  assert.deepEqual(errors, []);
  await close();
});

test("maps have equal axes and are read by pointer and by keys", async () => {
  const { page, errors, close } = await open("maps.html");
  const card = page.locator('[data-plot="slices"]');
  assert.deepEqual(await card.locator("figcaption").allInnerTexts(), ["z −900 mm", "z −800 mm", "z −700 mm", "z −500 mm"]);
  const box = await card.locator(".cells").nth(2).evaluate((e) => ({ width: e.getBBox().width, height: e.getBBox().height }));
  assert.ok(Math.abs(box.width - box.height) < 0.1, "a square grid is a square");
  const cells = await card.locator(".cells").nth(2).boundingBox();
  await page.mouse.move(cells.x + cells.width / 2, cells.y + cells.height / 2);
  // In the middle of every slice: 1 - distance / 0.4 m.
  await until(async () => (await card.locator("figcaption b").allInnerTexts()).join() === "0.5,0.75,1,0.5");
  await matches(() => card.locator(".read").innerText(), /^x 0 mm, y 0 mm: /);
  await equal(() => card.locator(".mark-at").count(), 4);
  await page.mouse.move(0, 0);
  await until(async () => (await card.locator(".at").count()) === 0);
  const alone = page.locator('[data-plot="slice"]');
  await alone.locator(".map").focus();
  for (const key of ["ArrowLeft", "ArrowLeft", "ArrowUp"]) await page.keyboard.press(key);
  await equal(() => alone.locator(".read").innerText(), `x −50 mm, y 50 mm: ${(1 - Math.hypot(0.05, 0.05) / 0.4).toFixed(4)}`);
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("Shift+ArrowRight");
  await equal(() => alone.locator(".read").innerText(), "x 500 mm, y 50 mm: no value");
  await page.keyboard.press("Escape");
  await equal(() => alone.locator(".at").count(), 0);
  assert.deepEqual(errors, []);
  await close();
});

test("maps are zoomed together and by themselves keep equal axes", async () => {
  const { page, errors, close } = await open("maps.html", { reducedMotion: "reduce" });
  const card = page.locator('[data-plot="slices"]');
  const map = card.locator("svg[role=img] > svg.cells").nth(2);
  await map.scrollIntoViewIfNeeded();
  const views = () => card.locator("svg.cells").evaluateAll((all) => all.map((e) => e.getAttribute("viewBox").split(" ").map(Number)));
  const [whole] = await views();
  const zoomed = async (share) => {
    const shown = await views();
    return shown.every((v) => Math.abs(v[2] / whole[2] - share) < 0.03 && Math.abs(v[3] / whole[3] - share) < 0.03);
  };
  const box = await map.boundingBox();
  await page.mouse.move(box.x + box.width * 0.25, box.y + box.height * 0.25);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.75, box.y + box.height * 0.75, { steps: 4 });
  await until(async () => (await card.locator(".drag").count()) === 1);
  await page.mouse.up();
  await until(() => zoomed(0.5));
  await equal(() => card.locator(".drag").count(), 0);
  // Values lie where they are seen: the middle stays the middle, the corner is half as far from it.
  await page.mouse.move(box.x + box.width * 0.5, box.y + box.height * 0.5);
  await until(async () => (await card.locator(".read").innerText()).startsWith("x 0 mm, y 0 mm: "));
  await card.locator(".reset").click();
  await until(() => zoomed(1));
  await page.mouse.move(box.x + box.width * 0.5, box.y + box.height * 0.5);
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, -280);
  await page.keyboard.up("Control");
  await until(async () => !(await zoomed(1)));
  await map.dblclick();
  await until(() => zoomed(1));
  // Keys move the part to the place that is read.
  await card.locator(".map").focus();
  for (let i = 0; i < 2; ++i) await page.keyboard.press("+");
  await until(() => zoomed(1 / 2.25));
  const [before] = await views();
  for (let i = 0; i < 2; ++i) await page.keyboard.press("Shift+ArrowRight");
  await until(async () => (await views())[0][0] > before[0]);
  await page.keyboard.press("0");
  await until(() => zoomed(1));
  assert.deepEqual(errors, []);
  await close();
});

test("what is drawn as a picture can be reached by keys", async () => {
  for (const [name, pictures] of [["report.html", ["#drawing", "svg.dots"]], ["simulation.html", ["#drawing", ".polar > svg"]]]) {
    const { page, close } = await open(name, { reducedMotion: "reduce" });
    for (const picture of pictures) {
      await page.locator(picture).first().focus();
      assert.ok(await page.locator(picture).first().evaluate((e) => e === document.activeElement), picture);
    }
    await close();
  }
});

test("dots are zoomed", async () => {
  const { page, errors, close } = await open("report.html", { reducedMotion: "reduce" });
  const dots = page.locator("svg.dots").first();
  await dots.scrollIntoViewIfNeeded();
  const ends = () => dots.locator("text").allTextContents().then((all) => all.slice(0, 3));
  const whole = await ends();
  const box = await dots.boundingBox();
  await page.mouse.move(box.x + box.width * 0.02, box.y + 20);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.5, box.y + 24, { steps: 4 });
  await page.mouse.up();
  await until(async () => (await ends())[2] !== whole[2]);
  assert.equal((await ends())[0], whole[0], "the lower end stays");
  await dots.focus();
  await page.keyboard.press("0");
  await until(async () => (await ends()).join() === whole.join());
  await page.keyboard.press("+");
  await until(async () => (await page.locator(".diagram:has(.dots) .reset").count()) === 1);
  await page.locator(".diagram:has(.dots) .reset").click();
  await until(async () => (await ends()).join() === whole.join());
  assert.deepEqual(errors, []);
  await close();
});

test("long facts begin with their value", async () => {
  const { page, errors, close } = await open("report.html", { reducedMotion: "reduce" });
  const fact = page.locator(".aside .facts > div", { hasText: "largest distance" });
  await matches(() => fact.locator("dd").innerText(), /^40\.1\smm at point 7; root mean square of all points 22\.4\smm$/);
  await matches(() => fact.locator("small").innerText(), /^\s*at point 7; root/);
  assert.deepEqual(errors, []);
  await close();
});

test("cards of diagrams stand close in columns", async () => {
  const { page, errors, close } = await open("diagrams.html", { reducedMotion: "reduce", viewport: { width: 1366, height: 768 } });
  const gaps = () => page.locator(".grid-2.packed").first().evaluate((grid) => {
    const columns = new Map();
    for (const card of grid.children) {
      const box = card.getBoundingClientRect();
      columns.set(box.left, [...(columns.get(box.left) ?? []), box]);
    }
    return [columns.size, ...[...columns.values()].flatMap((boxes) => boxes.sort((a, b) => a.top - b.top).slice(1).map((b, i) => b.top - boxes[i].bottom))];
  });
  await until(async () => {
    const [count, ...between] = await gaps();
    return count > 1 && between.length > 0 && between.every((g) => g > 8 && g < 20);
  });
  await page.setViewportSize({ width: 390, height: 844 });
  await until(async () => (await gaps())[0] === 1);
  assert.deepEqual(errors, []);
  await close();
});

test("time runs as it does", async () => {
  const { page, close } = await open("simulation.html");
  await pause(page);
  await page.clock.install({ time: 0 });
  await page.clock.pauseAt(1000);
  await page.locator("#scrub").fill("0");
  await equal(() => page.locator("#input-value").innerText(), "0.000 s");
  const run = async (speed) => {
    await page.locator("#speed").selectOption(speed);
    const before = await position(page);
    await page.locator("#play").click();
    await page.clock.runFor(500);
    await page.locator("#play").click();
    return (await position(page)) - before;
  };
  // Half a second is 50 samples, less the frame in which it starts and the one in which it ends.
  const once = await run("1");
  assert.ok(once > 44 && once < 52, `${once} samples at 1×`);
  const slowly = await run("0.1");
  assert.ok(slowly > 4.4 && slowly < 5.2, `${slowly} samples at 0.1×`);
  await close();
});

test("many bars stay clear", async () => {
  const { page, errors, close } = await open("simulation.html", { reducedMotion: "reduce" });
  await page.locator('[data-solution="1"]').click();
  await equal(() => page.locator("#drawing .link").count(), 81);
  assert.ok((await page.locator("#drawing .link .bar").first().evaluate((e) => parseFloat(getComputedStyle(e).strokeWidth))) < 5);
  await equal(() => page.locator("#drawing .joint text").count(), 0);
  await page.locator("body").press("n");
  await equal(() => page.locator("#drawing .joint text").count(), 82);
  assert.deepEqual(errors, []);
  await close();
});

/** Waits until the charts are painted. */
const settledChart = (page) => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));

const label = (page, name) => page.locator(`.space-labels [data-name="${name}"]`).evaluate((e) => {
  const { e: x, f: y } = new DOMMatrix(getComputedStyle(e).transform);
  return { x, y };
});
const frames = (page) => page.locator("#space canvas").getAttribute("data-frames").then(Number);
/** Waits until the drawing in space stands still. */
const settled = async (page) => {
  for (let before = -1, now = await frames(page); before !== now; before = now, now = await frames(page)) await page.waitForTimeout(150);
};

/** Colours of the canvas of a chart along a column, as a share of its drawn width; ends are shares of the height. */
const inked = (page, plot, share, from, to) => page.locator(`[data-plot="${plot}"]`).evaluate((card, [share, from, to]) => {
  const [canvas, over] = [card.querySelector("canvas"), card.querySelector(".u-over")];
  const scale = canvas.width / canvas.clientWidth;
  const x = Math.round((over.offsetLeft + share * (over.clientWidth - 1)) * scale);
  const [top, bottom] = [from, to].map((v) => Math.round((over.offsetTop + v * over.clientHeight) * scale));
  const { data } = canvas.getContext("2d").getImageData(x - 2, top, 5, bottom - top);
  let count = 0;
  // The curves are coloured, the grid is grey.
  for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 128 && Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 60) ++count;
  return count;
}, [share, from, to]);

test("curves over a turn go from its beginning to its end", async () => {
  const { page, errors, close } = await open("diagrams.html", { reducedMotion: "reduce", colorScheme: "light" });
  await page.locator('[data-plot="angle"] canvas').waitFor();
  await settledChart(page);
  await equal(() => inked(page, "angle", 0, 0.02, 0.85), 0, "no spike at the beginning");
  assert.ok((await inked(page, "angle", 0.005, 0.85, 1)) > 0, "it begins at the bottom");
  assert.ok((await inked(page, "angle", 0.997, 0, 0.15)) > 0, "it ends at the top");
  await page.locator("#scrub").fill("360");
  await matches(() => page.locator('[data-plot="angle"] .legend').innerText(), /360 °/);
  assert.deepEqual(errors, []);
  await close();
});

test("curves with a legend can be told apart, others tell their names", async () => {
  const { page, errors, close } = await open("diagrams.html", { reducedMotion: "reduce" });
  for (const [plot, count] of [["seven", 6], ["roses", 6]]) {
    const looks = await page.locator(`[data-plot="${plot}"] .legend path`).evaluateAll((all) => all.map((e) => `${getComputedStyle(e).stroke} ${getComputedStyle(e).strokeDasharray}`));
    assert.equal(looks.length, count);
    assert.equal(new Set(looks).size, count, looks.join("; "));
  }
  const card = page.locator('[data-plot="nine"]');
  await matches(() => card.locator(".chooser summary").innerText(), /^9 curves, 6 with a name; point at one, or choose$/);
  await equal(() => card.locator(".legend > span").count(), 6);
  await card.locator(".chooser summary").click();
  await card.locator(".chooser button", { hasText: "none" }).click();
  await equal(() => card.locator(".legend").count(), 0);
  await card.getByLabel("wave 8").check();
  await matches(() => card.locator(".legend").innerText(), /^wave 8/);
  await card.locator(".chooser button", { hasText: "all" }).click();
  await equal(() => card.locator(".legend path").count(), 9);
  const all = await card.locator(".legend path").evaluateAll((paths) => paths.map((e) => `${getComputedStyle(e).stroke} ${getComputedStyle(e).strokeDasharray}`));
  assert.equal(new Set(all).size, 9, all.join("; "));
  const over = card.locator(".u-over");
  // The diagram is made again with its new curves: what is scrolled to may be the old one.
  await until(() => over.scrollIntoViewIfNeeded({ timeout: 1000 }).then(() => true, () => false));
  const box = await over.boundingBox();
  const names = new Set();
  for (let k = 1; k < 12; ++k) {
    await page.mouse.move(box.x + box.width * 0.5, box.y + (box.height * k) / 12);
    const name = card.locator(".curve-name");
    if (await name.isVisible()) names.add((await name.innerText()).replace(/:.*/, ""));
  }
  assert.ok(names.size >= 5, [...names].join("; "));
  for (const name of names) assert.match(name, /^wave \d$/);
  await page.mouse.move(2, 2);
  await until(async () => !(await card.locator(".curve-name").isVisible()));
  assert.deepEqual(errors, []);
  await close();
});

/** Numbers on the axes of a chart are painted; its scales are seen by the values at the ends of its width. */
const zoomTo = async (page, over, from, to) => {
  const box = await over.boundingBox();
  await page.mouse.move(box.x + box.width * from, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * to, box.y + 64, { steps: 4 });
  await page.mouse.up();
};

test("diagrams are zoomed and moved by pointer and by keys", async () => {
  const { page, errors, close } = await open("report.html", { reducedMotion: "reduce" });
  const card = page.locator('[data-plot="transmission"]');
  const over = card.locator(".u-over");
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  const at = async (share) => {
    await page.mouse.move(box.x + box.width * share, box.y + 90);
    await page.waitForTimeout(60);
    return position(page);
  };
  await equal(() => card.locator(".reset").count(), 0);
  await zoomTo(page, over, 0.25, 0.5);
  // A quarter of the turn is as wide as the whole diagram now, and the mechanism still follows.
  await until(async () => Math.abs((await at(0.02)) - 92) < 4);
  assert.ok(Math.abs((await at(0.98)) - 178) < 4);
  await page.keyboard.down("Shift");
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.48, box.y + 90, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up("Shift");
  await until(async () => Math.abs((await at(0.5)) - 180) < 4);
  await card.locator(".reset").click();
  await equal(() => card.locator(".reset").count(), 0);
  await until(async () => Math.abs((await at(0.75)) - 270) < 4);
  await zoomTo(page, over, 0.25, 0.5);
  await over.dblclick({ position: { x: 100, y: 50 } });
  await equal(() => card.locator(".reset").count(), 0);
  await equal(() => card.locator(".mark-line").count(), 0);
  await card.locator(".chart").focus();
  const before = await position(page);
  await page.keyboard.press("+");
  await equal(() => card.locator(".reset").count(), 1);
  await page.keyboard.press("ArrowRight");
  await equal(() => position(page), before, "the arrow belongs to the diagram that is zoomed");
  await page.keyboard.press("0");
  await equal(() => card.locator(".reset").count(), 0);
  await page.keyboard.press("ArrowRight");
  await until(async () => (await position(page)) !== before);
  assert.deepEqual(errors, []);
  await close();
});

test("a fixed cursor shows differences", async () => {
  const { page, errors, close } = await open("diagrams.html", { reducedMotion: "reduce" });
  const card = page.locator('[data-plot="angle"]');
  const over = card.locator(".u-over");
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  await page.mouse.click(box.x + box.width * 0.25, box.y + 40);
  await page.mouse.move(box.x + box.width * 0.75, box.y + 40);
  await until(async () => /^A (89|90|91) ° → B (269|27[01])(\.\d+)? °: Δ 1(79|8[01])(\.\d+)? °/.test(await card.locator(".mark-line").innerText()));
  await matches(() => card.locator(".legend").innerText(), /(269|27[01])(\.\d+)? ° \(Δ 1(79|8[01])(\.\d+)? °\)/);
  await until(async () => await card.locator(".fixed").isVisible());
  await card.locator(".chart").focus();
  await page.keyboard.press("Escape");
  await equal(() => card.locator(".mark-line").count(), 0);
  await until(async () => !(await card.locator(".fixed").isVisible()));
  assert.doesNotMatch(await card.locator(".legend").innerText(), /Δ/);
  assert.deepEqual(errors, []);
  await close();
});

test("costs that are zero up to rounding have a diagram", async () => {
  const { page, errors, close } = await open("diagrams.html", { reducedMotion: "reduce", colorScheme: "light" });
  for (const plot of ["errors", "convergence"]) {
    const card = page.locator(`[data-plot="${plot}"]`);
    await card.locator("canvas").waitFor();
    await matches(() => card.innerText(), /below 1×10⁻¹⁶ of the largest/, plot);
    await until(async () => (await inked(page, plot, 0.5, 0, 1)) > 0);
  }
  assert.deepEqual(errors, []);
  await close();
});

test("a spatial scene moves with both inputs, and so do its diagrams", async () => {
  const { page, errors, close } = await open("spatial.html", { reducedMotion: "reduce" });
  await page.waitForSelector("#space canvas");
  await equal(() => page.locator("#second-value").innerText(), "0\u202fmm");
  await page.locator("body").press("2"); // from behind: z is up and y to the left
  await page.locator("#scrub").fill("0");
  await settled(page);
  const [low, fixed] = [await label(page, "W"), await label(page, "LF")];
  await page.locator("#scrub").fill("40");
  await settled(page);
  const high = await label(page, "W");
  assert.ok(low.y - high.y > 60, `the wheel rises by ${low.y - high.y} pixels`);
  assert.deepEqual(await label(page, "LF"), fixed);
  await equal(() => page.locator("#input-value").innerText(), "80 mm");
  const before = await label(page, "TI");
  await equal(() => page.locator('[data-plot="toe"] .chart').getAttribute("data-present"), "rack 0 mm");
  await page.locator("#second").focus();
  await page.keyboard.press("ArrowRight");
  await settled(page);
  await equal(() => page.locator("#second-value").innerText(), "20\u202fmm");
  assert.ok(before.x - (await label(page, "TI")).x > 5, "the rack moves to the left");
  await equal(() => page.locator("#scrub").inputValue(), "40"); // the arrow key belongs to the second slider
  await equal(() => page.locator('[data-plot="toe"] .chart').getAttribute("data-present"), "rack 20 mm");
  await matches(() => page.locator('[data-plot="steer"]').innerText(), /41 curves[^]*strong: wheel travel 80 mm/);
  const cursor = await marker(page, "steer");
  await page.locator("body").press(",");
  await page.locator("body").press(",");
  await until(async () => (await marker(page, "steer")) < cursor - 40);
  assert.deepEqual(errors, []);
  await close();
});

test("pointing at a diagram over the second input moves it there", async () => {
  const { page, close } = await open("spatial.html", { reducedMotion: "reduce" });
  const over = page.locator('[data-plot="steer"] .u-over');
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  await page.mouse.move(box.x + box.width * 0.5, box.y + 40);
  await page.mouse.move(box.x + box.width * 0.98, box.y + 40);
  await until(async () => (await page.locator("#second").inputValue()) === "4");
  await close();
});

test("space is drawn only when something changes", async () => {
  const { page, errors, close } = await open("spatial.html", { reducedMotion: "reduce" });
  await page.waitForSelector("#space canvas");
  await settled(page);
  const idle = await frames(page);
  await page.waitForTimeout(500);
  await equal(() => frames(page), idle);
  const at = await label(page, "ST");
  await page.locator("#space").focus();
  await page.keyboard.press("ArrowLeft");
  await settled(page);
  assert.notDeepEqual(await label(page, "ST"), at);
  await equal(() => page.locator("#scrub").inputValue(), "0");
  await page.keyboard.press("0");
  await settled(page);
  assert.deepEqual(await label(page, "ST"), at);
  const box = await page.locator("#space").boundingBox();
  await page.mouse.move(box.x + 60, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 160, box.y + 230, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  assert.notDeepEqual(await label(page, "ST"), at);
  await page.locator('[data-view="top"]').click();
  await equal(() => page.locator("#parallel").getAttribute("aria-pressed"), "true");
  await page.locator("body").press("p");
  await equal(() => page.locator("#parallel").getAttribute("aria-pressed"), "false");
  assert.deepEqual(errors, []);
  await close();
});

test("joints in space tell their coordinates to pointers and keys", async () => {
  const { page, errors, close } = await open("spatial.html", { reducedMotion: "reduce", permissions: ["clipboard-read", "clipboard-write"] });
  await page.locator("#scrub").fill("20");
  await settled(page);
  const [box, at] = [await page.locator("#space").boundingBox(), await label(page, "LF")];
  await page.mouse.click(box.x + at.x - 9, box.y + at.y + 20);
  await page.mouse.move(2, 2);
  await matches(() => page.locator("#picked").innerText(), /^LF\nx 210, y 380, z −100 mm/);
  await page.locator("#picked .copy").click();
  await equal(() => page.evaluate(() => navigator.clipboard.readText()), "LF at wheel travel 0\u202fmm, rack 0\u202fmm: x 210, y 380, z −100 mm");
  await page.locator("body").press("Escape");
  await page.locator(".positions summary").click();
  await matches(() => page.locator(".positions tbody tr").nth(4).innerText(), /L\s+10\s+720\s+−125/);
  await page.locator(".positions .copy").click();
  await matches(() => page.evaluate(() => navigator.clipboard.readText()), /^at wheel travel 0[^]*joint\tx \(mm\)\ty \(mm\)\tz \(mm\)\nLF\t210\t380\t−100\n/);
  assert.deepEqual(errors, []);
  await close();
});

test("spatial drawings can be taken along", async () => {
  const { page, errors, close } = await open("spatial.html", { reducedMotion: "reduce" });
  await page.locator("#scrub").fill("20");
  await settled(page);
  assert.match(readFileSync((await download(page, "svg")).path, "utf8"), /^<svg[^]*rear view[^]*top view[^]*<\/svg>$/);
  const picture = readFileSync((await download(page, "png")).path);
  assert.equal(picture.subarray(1, 4).toString(), "PNG");
  assert.ok(picture.length > 15_000, "there is something on the picture");
  const drawing = await download(page, "dxf");
  assert.equal(execFileSync(python, [checkDxf.replace("check_dxf", "check_spatial_dxf"), drawing.path], { encoding: "utf8" }).trim(), "ok");
  assert.deepEqual(errors, []);
  await close();
});

/** The picture of a scene in space as PNG, in a browser whose WebGL has the name of this device. */
async function spatialPicture(device) {
  const { page, errors, close } = await open("spatial.html", { reducedMotion: "reduce" }, (name) => {
    const parameter = WebGL2RenderingContext.prototype.getParameter;
    WebGL2RenderingContext.prototype.getParameter = function (what) {
      return what === 0x9246 ? name : parameter.call(this, what); // UNMASKED_RENDERER_WEBGL
    };
    if (name === "") HTMLCanvasElement.prototype.getContext = new Proxy(HTMLCanvasElement.prototype.getContext, { apply: (target, self, [kind, ...rest]) => (kind.startsWith("webgl") ? null : Reflect.apply(target, self, [kind, ...rest])) });
  }, device);
  await page.waitForSelector("#space canvas");
  await settled(page);
  const kind = await page.evaluate(() => (document.querySelector("#space canvas").getContext("2d") ? "plane" : "webgl"));
  const names = await page.locator(".space-labels span:not([hidden])").evaluateAll((all) => all.map((e) => e.style.transform));
  const shot = await page.locator("#space canvas").screenshot({ animations: "disabled" });
  /** The darkness of each of 8 x 6 fields against paper, on average; 1 = black. */
  const fields = await page.evaluate(async (data) => {
    const picture = await createImageBitmap(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))]));
    const canvas = Object.assign(document.createElement("canvas"), { width: picture.width, height: picture.height });
    const context = canvas.getContext("2d");
    context.drawImage(picture, 0, 0);
    const { data: pixels } = context.getImageData(0, 0, canvas.width, canvas.height);
    const darkness = new Array(48).fill(0);
    for (let y = 0; y < canvas.height; ++y)
      for (let x = 0; x < canvas.width; ++x) {
        const i = 4 * (y * canvas.width + x);
        const off = (k) => Math.abs(pixels[i + k] - pixels[4 * (canvas.width + 1) * 9 + k]) / 765;
        darkness[8 * Math.floor((6 * y) / canvas.height) + Math.floor((8 * x) / canvas.width)] += ((off(0) + off(1) + off(2)) * 48) / (canvas.width * canvas.height);
      }
    return darkness;
  }, shot.toString("base64"));
  assert.deepEqual(errors, []);
  await close();
  return { kind, names, fields };
}

test("without a graphics card space is painted in the plane, and looks the same", async () => {
  const [card, computed, none] = [await spatialPicture("ANGLE (NVIDIA, RTX)"), await spatialPicture("ANGLE (Google, SwiftShader driver)"), await spatialPicture("")];
  assert.deepEqual([card.kind, computed.kind, none.kind], ["webgl", "plane", "plane"]);
  assert.deepEqual(computed.names, card.names);
  assert.deepEqual(none.fields, computed.fields);
  assert.ok(Math.max(...card.fields) > 0.2, "something is drawn");
  card.fields.forEach((dark, k) => assert.ok(Math.abs(dark - computed.fields[k]) < 0.03 + 0.2 * dark, `field ${k}: ${dark} by the card, ${computed.fields[k]} in the plane`));
});

test("in print there are three fixed views", async () => {
  const printed = await open("spatial.html", { reducedMotion: "reduce" });
  assert.ok(!(await printed.page.locator(".still").isVisible()));
  await printed.page.emulateMedia({ media: "print" });
  assert.ok(await printed.page.locator(".still svg").first().isVisible());
  await printed.close();
});

test("no accessibility violations", async () => {
  const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
  for (const [name, options] of [["report.html", {}], ["simulation.html", {}], ["simulation.html", { colorScheme: "dark" }], ["simulation.html", { viewport: { width: 390, height: 844 } }],
    ["spatial.html", {}], ["spatial.html", { colorScheme: "dark" }], ["spatial.html", { viewport: { width: 390, height: 844 } }],
    ["diagrams.html", {}], ["maps.html", {}], ["maps.html", { colorScheme: "dark" }], ["maps.html", { viewport: { width: 390, height: 844 } }],
    ["compared.html", {}], ["compared.html", { colorScheme: "dark" }], ["compared.html", { viewport: { width: 390, height: 844 } }]]) {
    const { page, close } = await open(name, { reducedMotion: "reduce", ...options });
    if (name === "simulation.html") {
      await page.locator("body").press("w");
      await page.locator(".values summary").click();
      await page.locator(".values tbody button").first().click();
    }
    if (name === "spatial.html") for (const summary of await page.locator(".values summary").all()) await summary.click();
    if (await page.locator(".menu").count()) await page.locator(".menu summary").click();
    await page.addScriptTag({ content: axe });
    const violations = await page.evaluate(() => axe.run(document, { resultTypes: ["violations"] }).then((found) => found.violations));
    assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`), [], `${name} ${JSON.stringify(options)}`);
    await close();
  }
});

test("without scripts a spatial scene is seen from three sides", async () => {
  const { page, close } = await open("spatial.html", { javaScriptEnabled: false });
  await equal(() => page.locator("#static .view").count(), 3);
  await equal(() => page.locator('#static [data-scene="0"] .wheel').count(), 3);
  assert.deepEqual([await page.locator("#static .band").count(), await page.locator("#static .baseline").count()], [1, 5]);
  await close();
});

test("without scripts there are drawings and tables", async () => {
  const { page, close } = await open("report.html", { javaScriptEnabled: false });
  await equal(() => page.locator("#static figure:not(.diagrams figure) svg").count(), 3);
  assert.ok(await page.locator("#static figure svg").first().isVisible());
  assert.ok((await page.locator("#static table").count()) > 6);
  assert.ok(!(await page.locator("#app").isVisible()));
  await page.goto(url("simulation.html"));
  await equal(() => page.locator("#static .arrow.force").count(), 3); // two and the key
  await equal(() => page.locator("#static .diagrams svg").count(), 2);
  await equal(() => page.locator("#static .diagrams .origin").count(), 1);
  await page.goto(url("maps.html"));
  await equal(() => page.locator("#static .diagrams .map .cells").count(), 5);
  // In the units of the page with scripts.
  await page.goto(url("report.html"));
  await matches(() => page.locator("#static .diagrams").textContent(), /crank angle \(°\)/);
  assert.doesNotMatch(await page.locator("#static .diagrams").textContent(), /\(rad\)/);
  await close();
});

test("title, answer and figures are read before the viewer stands", async () => {
  // Unpacking never comes to its end.
  const { page, close } = await open("report.html", {}, () => { Promise.all = () => new Promise(() => {}); });
  for (const seen of ["#static h1", "#static .headline", "#static .facts dd >> nth=0"]) assert.ok(await page.locator(seen).isVisible(), seen);
  for (const hidden of ["#static .first svg", "#static .diagrams", "#static h2 >> nth=0"]) assert.ok(!(await page.locator(hidden).first().isVisible()), hidden);
  await close();
});

test("what cannot be unpacked leaves the form without scripts on the page", async () => {
  for (const broken of ["delete window.DecompressionStream", "window.atob = () => { throw new Error('no base64'); }"]) {
    const { page, close } = await open("report.html", {}, broken);
    await until(async () => (await page.locator("html").getAttribute("class")) === "");
    assert.ok(await page.locator("#static figure svg").first().isVisible());
    assert.ok(!(await page.locator("#app").isVisible()));
    await close();
  }
});

test("hostile text stays text", async () => {
  for (const javaScriptEnabled of [true, false]) {
    const { page, errors, close } = await open("hostile.html", { javaScriptEnabled });
    await matches(() => page.locator("h1").innerText(), /<script>/);
    await equal(() => page.locator("img").count(), 0);
    if (javaScriptEnabled) await equal(() => page.evaluate(() => document.body.dataset.broken), undefined);
    assert.deepEqual(errors, []);
    await close();
  }
});

test("a result without anything still makes a report", async () => {
  const { page, errors, close } = await open("empty.html");
  await matches(() => page.locator(".verdict").innerText(), /do not reach each other/);
  assert.deepEqual(errors, []);
  await close();
});

const screens = [[1366, 768], [390, 844]];
test("the first screen has the verdict, the mechanism and its controls", async () => {
  for (const [width, height] of screens)
    for (const name of ["report.html", "simulation.html", "spatial.html", "diagrams.html"]) {
      const { page, close } = await open(name, { reducedMotion: "reduce", viewport: { width, height } });
      const bottom = async (part) => page.locator(part).first().evaluate((e) => e.getBoundingClientRect().bottom);
      for (const part of ["#play", "#scrub", ".stage"]) assert.ok((await bottom(part)) <= height, `${part} of ${name} ends at ${await bottom(part)} of ${height}`);
      assert.ok((await page.locator(".stage").boundingBox()).height <= 0.6 * height + 1);
      const strip = await page.locator("header.verdict").boundingBox();
      assert.ok(strip.height <= (width < 500 ? 200 : 80), `the verdict of ${name} takes ${strip.height}`);
      assert.ok((await page.locator("header.verdict h1").innerText()).length > 0);
      assert.ok((await page.locator("header.verdict .headline").innerText()).length > 0);
      const [stage, facts] = [await page.locator(".machine").boundingBox(), page.locator(".aside .facts")];
      if (width > 940 && (await facts.count())) assert.ok((await facts.boundingBox()).x > stage.x + stage.width, "facts stand beside the mechanism");
      await page.locator(".menu summary").click();
      const choices = await page.locator(".choices").boundingBox();
      assert.ok(choices.x >= 0 && choices.x + choices.width <= width && choices.y >= 0, `the choices of ${name} stand at ${choices.x}, ${choices.y}`);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${name} is too wide for ${width}`);
      await close();
    }
});

test("the study of a design can be taken along", async () => {
  const { page, errors, close } = await open("report.html", { reducedMotion: "reduce", permissions: ["clipboard-read", "clipboard-write"] });
  const clipboard = () => page.evaluate(() => navigator.clipboard.readText());
  const rows = page.locator("#solutions tbody tr");
  await equal(() => rows.locator("[data-design]").count(), 2, "the third solution has none");
  // The export of any solution, whichever is drawn.
  const [file] = await Promise.all([page.waitForEvent("download"), page.locator('[data-design="1"]').click()]);
  assert.match(file.suggestedFilename(), /^2-[a-z0-9.-]+\.toml$/);
  const text = readFileSync(await file.path(), "utf8");
  assert.match(text, /^#:schema \.\/analysis-planar\.four_bar\.schema\.json\n# Solution 2 of "Four-bar through 18 points of a closed path", found by /);
  assert.match(text, /\n\[mechanism\]\ntype = "planar\.four_bar"\n/);
  await equal(() => rows.nth(0).getAttribute("class"), "current", "which does not change what is drawn");
  await rows.nth(1).locator(".copy").click();
  await until(async () => (await clipboard()) === text);
  // The export of the one that is drawn.
  await page.locator('[data-solution="1"]').click();
  assert.equal(await readFileSync((await download(page, "design")).path, "utf8"), text);
  await page.evaluate(() => navigator.clipboard.writeText(""));
  await page.locator(".menu summary").click();
  await page.locator('[data-export="design"]').click();
  await until(async () => (await page.locator(".said").innerText()) === "study copied");
  await equal(() => clipboard(), text);
  await page.locator('[data-solution="2"]').click();
  await page.locator(".menu summary").click();
  await equal(() => page.locator('[data-download="design"], [data-export="design"]').count(), 0);
  assert.deepEqual(errors, []);
  await close();
});

test("the title block names what is drawn", async () => {
  const { page, close } = await open("report.html", { reducedMotion: "reduce" });
  await matches(() => page.locator(".title-block").innerText(), /mechanism\s+Four-bar through 18 points/i);
  await close();
});

test("a link leads to the place it was taken from", async () => {
  for (const [name, second] of [["report.html", false], ["spatial.html", true]]) {
    const { page, errors, close } = await open(name, { reducedMotion: "reduce", permissions: ["clipboard-read", "clipboard-write"] });
    if (!second) await page.locator('[data-solution="1"]').click();
    await page.locator("#scrub").fill("33");
    if (second) await page.locator("body").press(".");
    const shown = () => page.locator(".title-block").innerText();
    const before = await shown();
    await page.locator(".menu summary").click();
    await page.locator('[data-export="link"]').click();
    await until(async () => (await page.locator(".said").innerText()) === "link copied");
    const link = await page.evaluate(() => navigator.clipboard.readText());
    assert.match(link, second ? /#scene=[^&]+&input=[^&]+&second=/ : /#scene=solution-2&input=[^&]+$/);
    await page.goto("about:blank");
    await page.goto(link);
    await page.locator("#scrub").waitFor();
    await equal(() => shown(), before);
    await equal(() => page.locator("#scrub").inputValue(), "33");
    await equal(() => page.locator("#play").getAttribute("aria-label"), "Play");
    // In the same page too.
    await page.locator("#scrub").fill("5");
    await page.evaluate(() => (location.hash = "#section"));
    await equal(() => page.locator("#scrub").inputValue(), "5", "other fragments are not for the mechanism");
    await page.evaluate((to) => (location.href = to), link);
    await until(async () => (await shown()) === before);
    assert.deepEqual(errors, []);
    await close();
  }
});

test("the motion can be taken along as GIF and as WebM", async () => {
  for (const name of ["simulation.html", "spatial.html"]) {
    const { page, errors, close } = await open(name, { reducedMotion: "reduce", viewport: { width: 500, height: 500 } });
    await page.locator("#speed").selectOption("10");
    if ((await page.getByText("⇄").getAttribute("aria-pressed")) === "true") await page.locator("body").press("b");
    await page.locator("#scrub").fill("7");
    const picture = readFileSync((await download(page, "gif")).path);
    assert.equal(picture.subarray(0, 6).toString(), "GIF89a");
    // Graphic control extensions, one a picture.
    const pictures = picture.toString("latin1").split("\x21\xf9\x04").length - 1;
    assert.ok(pictures >= 12, `${pictures} pictures`);
    await equal(() => page.locator("#scrub").inputValue(), "7", "the report stands where it stood");
    const film = readFileSync((await download(page, "webm")).path);
    assert.equal(film.subarray(0, 4).toString("hex"), "1a45dfa3");
    assert.ok(film.length > 5000, `${film.length} bytes`);
    assert.deepEqual(errors, []);
    await close();
  }
});

test("the stage fills the screen and gives it back", async () => {
  const { page, errors, close } = await open("report.html", { reducedMotion: "reduce" });
  const height = () => page.locator(".stage").evaluate((e) => e.clientHeight);
  const before = await height();
  await page.locator("#full-screen").click();
  await until(async () => (await height()) > before + 50);
  await page.locator("body").press("m");
  await until(async () => (await height()) === before);
  assert.deepEqual(errors, []);
  await close();
});

test("the wheel says how it zooms, and the menu closes on Escape", async () => {
  for (const [name, stage] of [["report.html", "#drawing"], ["spatial.html", "#space"]]) {
    const { page, errors, close } = await open(name, { reducedMotion: "reduce" });
    const opacity = () => page.locator(".wheel-hint").evaluate((e) => Number(getComputedStyle(e).opacity));
    await equal(() => opacity(), 0);
    await page.locator(stage).hover();
    await page.mouse.wheel(0, 10);
    await until(async () => (await opacity()) === 1);
    await until(async () => (await opacity()) === 0);
    await page.locator(".menu summary").click();
    await until(async () => await page.locator(".choices").isVisible());
    await page.keyboard.press("Escape");
    await until(async () => !(await page.locator(".choices").isVisible()));
    await equal(() => page.evaluate(() => document.activeElement.textContent), "Export");
    assert.deepEqual(errors, []);
    await close();
  }
});

test("paper shows what is folded on the screen", async () => {
  const { page, errors, close } = await open("simulation.html", { reducedMotion: "reduce" });
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  await until(async () => (await page.locator(".values tbody tr").count()) > 0);
  await equal(() => page.locator("details:not([open], .menu, .data-table details)").count(), 0);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  await equal(() => page.locator("#app details[open]").count(), 0);
  assert.deepEqual(errors, []);
  await close();
});

test("where nothing assembles the report says so once", async () => {
  const { page, errors, close } = await open("nowhere.html", { reducedMotion: "reduce" });
  const text = await page.locator("#app").innerText();
  assert.match(text, /Nothing to draw: the mechanism assembles at no input\./);
  for (const once of ["361 of 361 positions do not assemble", "the rocker is too short"]) assert.equal(text.split(once).length, 2, once);
  assert.doesNotMatch(text, /No values/);
  for (const part of ["#drawing", "#play", '[data-plot="angle"]', ".menu"]) await equal(() => page.locator(part).count(), 0, part);
  assert.deepEqual(errors, []);
  await close();
});

if (pictures)
  test("pictures", async () => {
    mkdirSync(pictures, { recursive: true });
    const shots = { light: {}, dark: { colorScheme: "dark" }, narrow: { viewport: { width: 400, height: 850 } }, static: { javaScriptEnabled: false } };
    for (const [name, options] of Object.entries(shots)) {
      const { page, close } = await open("report.html", { reducedMotion: "reduce", ...options });
      if (name !== "static") await page.locator("#scrub").fill("62");
      if (name === "dark") for (const key of ["g", "v"]) await page.locator("body").press(key);
      await page.waitForTimeout(200);
      await page.screenshot({ path: join(pictures, `${name}.png`), fullPage: true });
      if (name === "light") {
        await page.emulateMedia({ media: "print" });
        await page.setViewportSize({ width: 703, height: 1000 });
        await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
        await page.waitForTimeout(300);
        await page.screenshot({ path: join(pictures, "print.png"), fullPage: true });
        await page.evaluate(() => dispatchEvent(new Event("afterprint")));
        await page.emulateMedia({ media: "screen" });
        await page.setViewportSize({ width: 1360, height: 900 });
        await page.locator('[data-solution="2"]').click();
        await page.locator("#scrub").fill("40");
        await page.screenshot({ path: join(pictures, "gaps.png") });
      }
      await close();
    }
  });

const failed = await runAll(tests);
await browser.close();
process.exit(failed ? 1 : 0);
