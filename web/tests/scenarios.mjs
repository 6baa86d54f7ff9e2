// SPDX-License-Identifier: BSD-3-Clause

// The common part of the browser tests: how the browser is started, and how scenarios run.
import { chromium } from "playwright-core";

// The suggestions of the address bar, two pages that Chromium loads for each window though nobody sees them, and a process that waits
// for a next page cost as much as a report. Then comes the list of Playwright, which this one replaces.
const withoutFeatures = ["WebUIOmniboxPopup", "WebUIOmniboxAimPopup", "SpareRendererForSitePerProcess", "ImprovedCookieControls", "LazyFrameLoading",
  "GlobalMediaControls", "DestroyProfileOnBrowserClose", "MediaRouter", "DialMediaRouteProvider", "AcceptCHFrame", "AutoExpandDetailsElement",
  "CertificateTransparencyComponentUpdater", "AvoidUnnecessaryBeforeUnloadCheckSync", "Translate", "HttpsUpgrades", "PaintHolding",
  "ThirdPartyStoragePartitioning", "LensOverlay", "PlzDedicatedWorker"];

/** A browser without network, sandbox and graphics card; WebGL is computed. `more`: further switches of Chromium. */
export const launch = (executablePath, more = []) => chromium.launch({
  executablePath,
  args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    `--disable-features=${withoutFeatures.join()}`, ...more],
});

/** For pages that are looked at once and closed: to compile their functions with optimisation costs more than it saves. */
export const briefly = ["--js-flags=--no-opt,--no-maglev"];

/** Runs scenarios {name, run} one after the other and tells of each; returns how many failed. One that fails is tried once more, and
 *  told as unsteady if it then passes: a browser on a machine that stalls misses a moment now and then, a fault stays.
 *  ONLY=WORDS in the environment picks scenarios by their names. */
export async function runAll(scenarios) {
  const chosen = scenarios.filter(({ name }) => name.includes(process.env.ONLY ?? ""));
  let failed = 0;
  for (const { name, run } of chosen) {
    const begin = Date.now();
    const problems = [];
    while (problems.length < 2)
      try {
        await run();
        break;
      } catch (error) {
        problems.push(error.stack);
      }
    if (problems.length === 2) ++failed;
    const said = ["ok      ", "UNSTEADY", "FAILED  "][problems.length];
    console.log([`${said} ${name} (${((Date.now() - begin) / 1000).toFixed(1)} s)`, ...problems].join("\n"));
  }
  console.log(failed ? `${failed} of ${chosen.length} failed` : `all ${chosen.length} passed`);
  return failed;
}
