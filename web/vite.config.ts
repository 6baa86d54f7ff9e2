// SPDX-License-Identifier: BSD-3-Clause
import { defineConfig, type UserConfig } from "vite";

// Each bundle carries the notices that the licences of its parts ask for.
const notices = (parts: string) => `/*! Linkwright report viewer. Contains:
${parts}
The MIT License: Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
documentation files (the "Software"), to deal in the Software without restriction, including without limitation the rights to
use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the
Software is furnished to do so, subject to the following conditions: The above copyright notice and this permission notice shall
be included in all copies or substantial portions of the Software. THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY
KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND
NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER
IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER
DEALINGS IN THE SOFTWARE. */`;

const viewer = {
  entry: "src/main.tsx",
  name: "linkwrightReport",
  file: "viewer",
  parts: "Preact, (c) 2015-present Jason Miller; @preact/signals, (c) 2022-present Preact Team; uPlot, (c) 2022 Leon Sorokin; gifenc, (c) 2017 Matt DesLauriers.",
};
// What draws scenes in space is large, and only reports that have one carry it.
const space = { entry: "src/space.ts", name: "linkwrightSpace", file: "space", parts: "three.js, (c) 2010-2026 three.js authors." };
// What unpacks these and the data of the report.
const boot = { entry: "src/boot.ts", name: "linkwrightBoot", file: "boot", parts: "" };

// The workbench, and what runs beside it.
const workbench = {
  entry: "src/workbench/workbench.tsx",
  name: "linkwrightWorkbench",
  file: "workbench",
  parts: `${viewer.parts.slice(0, -1)}; fzstd, (c) 2020 Arjun Barrett.`,
};
const worker = { entry: "src/workbench/worker.ts", name: "linkwrightWorker", file: "worker", parts: "" };
const bundles: Record<string, typeof viewer> = { space, boot, workbench, worker };

// One script and one style sheet that run from disk in any current browser.
export default defineConfig(({ mode }) => {
  const bundle = bundles[mode] ?? viewer;
  return {
    define: { "process.env.NODE_ENV": '"production"' },
    esbuild: { jsx: "automatic", jsxImportSource: "preact", legalComments: "inline" },
    build: {
      target: "es2020",
      reportCompressedSize: false,
      lib: { entry: bundle.entry, name: bundle.name, formats: ["iife"], fileName: () => `${bundle.file}.js`, cssFileName: bundle.file },
      rollupOptions: { output: { banner: bundle.parts && notices(bundle.parts) } },
    },
    // A test reads the units of the printed form.
    server: { fs: { allow: [".."] } },
    test: { include: ["tests/*.test.ts"], setupFiles: ["tests/units.ts"] },
  } as UserConfig;
});
