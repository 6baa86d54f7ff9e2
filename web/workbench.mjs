// SPDX-License-Identifier: BSD-3-Clause

// Puts the workbench together:
//   node workbench.mjs SCRIPTS_FOLDER OUT.html ENGINE_FOLDER    one page with the engine inside, to be opened from disk
//   node workbench.mjs SCRIPTS_FOLDER OUT.html.gz               one page without, to be served by the program, which is the engine
//   node workbench.mjs SCRIPTS_FOLDER OUT/ ENGINE_FOLDER        a folder of files for any web host, which browsers keep one by one
// SCRIPTS_FOLDER has workbench.js, workbench.css, space.js, pictures.json (draw_examples.mjs) and, for those with an engine, worker.js;
// ENGINE_FOLDER engine.js and engine.wasm.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { deflateRawSync, gzipSync } from "node:zlib";

const [scripts, out, engine] = process.argv.slice(2);
const read = (folder, name) => readFileSync(`${folder}/${name}`);
const packed = (bytes) => deflateRawSync(bytes, { level: 9 }).toString("base64");
// Level 22 saves a kilobyte more, but asks for a window so long that fzstd takes eight times as long to unpack it.
const packedTight = (bytes) => execFileSync("zstd", ["-19", "--stdout", "--quiet"], { input: bytes, maxBuffer: 1 << 28 }).toString("base64");
// A script ends at the first "</script", wherever that stands.
const inline = (name) => `\n${read(scripts, name).toString("utf8").replace(/<\/(script)/gi, "<\\/$1")}\n`;
const folder = out.endsWith("/");
const own = [inline("space.js"), inline("workbench.js")];
const workerScript = engine && Buffer.concat([read(engine, "engine.js"), Buffer.from("\n"), read(scripts, "worker.js")]);

const carried = !engine ? ""
  : folder ? `<link id="engine-wasm" rel="preload" as="fetch" crossorigin href="engine.wasm">
<link id="engine-script" rel="prefetch" href="engine.js">
` : `<script type="text/plain" id="engine-wasm">${packedTight(read(engine, "engine.wasm"))}</script>
<script type="text/plain" id="engine-script">${packed(workerScript)}</script>
`;
// What is seen until the engine answers: the study that a page with an engine in it opens with, unless it opens with another one.
const pictures = read(scripts, "pictures.json").toString("utf8").replaceAll("<", "\\u003c");
const { picture, viewBox, ...first } = JSON.parse(pictures).first;
const title = first.title.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
const opening = engine ? `<div class="opening">
<header class="verdict"><div class="words"><h1>${title}</h1><p class="headline" role="status">The engine starts.</p></div></header>
<div class="hero alone"><section class="card" aria-label="Mechanism"><svg viewBox="${viewBox}" class="thumbnail" role="img" aria-label="${title}">${picture}</svg></section></div>
</div>` : "";
const unless = `
try {
  const { text } = JSON.parse(localStorage.getItem("linkwright.workbench")) ?? {};
  if (/^#(study|example)=/.test(location.hash) || (text && text !== JSON.parse(document.getElementById("pictures").textContent).first.text)) document.querySelector(".opening").remove();
} catch {
  // nowhere to keep a study
}
`;
const hash = (script) => `'sha256-${createHash("sha256").update(script).digest("base64")}'`;
// The worker of the engine inherits what the page allows; a page without one allows its own two scripts and its own server.
const allowed = folder ? `script-src 'self' 'wasm-unsafe-eval' ${hash(unless)}; worker-src 'self'; connect-src 'self'`
  : engine ? "script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:"
    : `script-src ${own.map(hash).join(" ")}; connect-src 'self'`;
const style = folder ? '<link rel="stylesheet" href="workbench.css">' : `<style>
${read(scripts, "workbench.css").toString("utf8")}</style>`;
const code = folder ? '<script src="space.js"></script>\n<script src="workbench.js"></script>' : own.map((script) => `<script>${script}</script>`).join("\n");

const page = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; ${allowed}; style-src ${folder ? "'self' " : ""}'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'">
<link rel="icon" href="data:,">
<title>Linkwright workbench</title>
${style}
</head>
<body>
<noscript><p>The workbench needs JavaScript${engine ? " and WebAssembly" : ""}.</p></noscript>
<div id="app"><header class="bar bench-bar"><b class="brand">Linkwright</b></header><div class="bench"><main class="page">${opening}</main><aside class="panel"></aside></div></div>
<script type="application/json" id="pictures">${pictures}</script>
${engine ? `<script>${unless}</script>` : ""}
${carried}${code}
</body>
</html>
`;
if (folder) {
  rmSync(out, { recursive: true, force: true });
  mkdirSync(out, { recursive: true });
  for (const name of ["space.js", "workbench.js", "workbench.css"]) copyFileSync(`${scripts}/${name}`, out + name);
  copyFileSync(`${engine}/engine.wasm`, `${out}engine.wasm`);
  writeFileSync(`${out}engine.js`, workerScript);
  writeFileSync(`${out}index.html`, page);
} else {
  writeFileSync(out, out.endsWith(".gz") ? gzipSync(page, { level: 9 }) : page);
  console.log(`${out}: ${(page.length / 1e6).toFixed(2)} MB, ${(gzipSync(page, { level: 9 }).length / 1e6).toFixed(2)} MB as a web server sends it`);
}
