// SPDX-License-Identifier: BSD-3-Clause

// Makes the manual, a folder of pages that open from disk:
//   node build.mjs LINKWRIGHT OUT [--workbench workbench.html] [--pictures]
// Texts are docs/manual/*.md; the reference is what the program LINKWRIGHT says of itself, and what Doxygen finds in the headers. With the workbench the mechanisms of
// the lessons are live; with --pictures all examples are drawn, which takes some minutes.
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { deflateRawSync } from "node:zlib";
import { drawings } from "./drawings.mjs";
import { escaped, markdown } from "./markdown.mjs";
import { messageList, requireWords } from "./messages.mjs";
import { referencePages } from "./reference.mjs";

const { positionals, values: options } = parseArgs({ allowPositionals: true, options: { workbench: { type: "string" }, pictures: { type: "boolean" } } });
const [program, out] = positionals.map((p) => resolve(p));
if (!program || !out) {
  console.error("usage: node build.mjs LINKWRIGHT OUT [--workbench workbench.html] [--pictures]");
  process.exit(2);
}
const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const texts = join(root, "docs/manual");

function ask(...words) {
  const run = spawnSync(program, words, { encoding: "utf8", maxBuffer: 1 << 28 });
  if (run.status !== 0) throw new Error(`linkwright ${words.join(" ")}: ${run.stderr || run.error}`);
  return run.stdout;
}
const json = (...words) => JSON.parse(ask(...words));

/** The fragment of an address that opens a study in the workbench. */
const asFragment = (name, text, files = {}) => `#study=${deflateRawSync(JSON.stringify({ name, text, files })).toString("base64url")}`;
const version = ask("--version").trim().split(" ").pop();
const examples = json("examples", "--json");
const examplePath = (name) => ["studies", "suspension", "robots"].map((f) => join(root, "examples", f, `${name}.toml`)).find(existsSync);
const textOf = (name) => {
  const path = examplePath(name);
  if (!path) throw new Error(`there is no example ${name}`);
  return readFileSync(path, "utf8");
};
/** Opens an example by its name, or a study by its text. */
const liveAddress = (name, body) => (body.trim() ? asFragment(name || "study.toml", body) : `#example=${name}`);

/** A page: where it goes, what it is called and what is on it; `section` is the entry of the navigation that it belongs to. */
const pages = [];
const add = (path, section, title, body, { lead = "", live = false, broad = false, cpp = false } = {}) => pages.push({ path, section, title, body, lead, live, broad, cpp });

const listed = (folder) => (existsSync(join(texts, folder)) ? readdirSync(join(texts, folder)).filter((n) => n.endsWith(".md")).sort() : []);
const page = (file) => {
  const path = file.replace(/\.md$/, ".html");
  const depth = "../".repeat(path.split("/").length - 1);
  return { path, ...markdown(readFileSync(join(texts, file), "utf8"), (name, body) => {
    if (!body.trim()) textOf(name);
    return `<p><button type="button" class="live" data-live="${escaped(`${depth}workbench.html${liveAddress(name, body)}`)}">Show it live: ${escaped(name)}</button></p>`;
  }) };
};

const lessons = listed("learn").map((name) => page(`learn/${name}`));
lessons.forEach((lesson, i) => {
  const around = [lessons[i - 1], lessons[i + 1]].map((other, k) => (other ? `<a href="${other.path.replace("learn/", "")}">${k ? `${escaped(other.title)} →` : `← ${escaped(other.title)}`}</a>` : "<span></span>"));
  add(lesson.path, "Learn", lesson.title, `${lesson.html}<nav class="around">${around.join("")}</nav>`, { lead: lesson.lead, live: lesson.html.includes("data-live") });
});
const cards = (items) => `<ul class="cards">${items.map(({ href, title, text, picture }) => `<li><a href="${href}">${picture ?? ""}<b>${escaped(title)}</b>${text ? `<span>${escaped(text)}</span>` : ""}</a></li>`).join("")}</ul>`;
if (lessons.length) add("learn/index.html", "Learn", "Learn", `<p>${lessons.length} lessons of ten minutes, each with the mechanism beside the text.</p>${cards(lessons.map((l, i) => ({ href: l.path.replace("learn/", ""), title: `${i + 1}. ${l.title}`, text: l.lead })))}`);
const theory = listed("theory").map((name) => page(`theory/${name}`));
for (const t of theory) add(t.path, "Theory", t.title, t.html, { lead: t.lead });
if (theory.length) add("theory/index.html", "Theory", "Theory", cards(theory.map((t) => ({ href: t.path.replace("theory/", ""), title: t.title, text: t.lead }))));
for (const [file, section] of [["do.md", "Do"], ["files.md", "Reference"], ["messages.md", "Reference"], ["trust.md", "Trust"], ["faq.md", "FAQ"], ["glossary.md", "Glossary"]])
  if (existsSync(join(texts, file))) {
    const made = page(file);
    if (file === "messages.md") {
      requireWords({ ask, json }, made.html);
      made.html += messageList(root, escaped);
    }
    add(made.path, section, made.title, made.html, { lead: made.lead, broad: section === "Glossary" });
  }

const groups = [...new Set(examples.map((e) => e.group))];
const pictureOf = options.pictures ? drawings(ask, examples.map(({ name }) => examplePath(name))) : new Map();
const card = ({ name, title }) => ({
  href: `workbench.html#example=${name}`, title, text: name,
  picture: pictureOf.has(examplePath(name)) ? `<img src="pictures/${name}.svg" alt="" loading="lazy">` : "",
});
add("gallery.html", "Gallery", "Gallery", groups.map((group) => `<h2>${escaped(group)}</h2>${cards(examples.filter((e) => e.group === group).map(card))}`).join(""),
  { lead: "All examples that come with the program; each opens in the workbench." });

const reference = referencePages({ ask, json, root });
for (const { path, title, html, lead } of reference.pages) add(path, "Reference", title, html, { lead });

const home = existsSync(join(texts, "index.md")) ? page("index.md") : { title: "Linkwright", html: "", lead: "" };
add("index.html", "Home", home.title, home.html, { lead: home.lead, live: home.html.includes("data-live") });

const sections = [["Home", "index.html"], ["Learn", "learn/index.html"], ["Do", "do.html"], ["Gallery", "gallery.html"], ["Reference", "reference/index.html"],
  ["Theory", "theory/index.html"], ["Trust", "trust.html"], ["FAQ", "faq.html"], ["Glossary", "glossary.html"]].filter(([, path]) => pages.some((p) => p.path === path));

function framed({ path, section, title, body, lead, live, broad, cpp }) {
  const depth = "../".repeat(path.split("/").length - 1);
  const nav = sections.map(([name, href]) => `<a href="${depth}${href}"${name === section ? ' aria-current="page"' : ""}>${name}</a>`).join("");
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<link rel="icon" href="data:,">
<title>${escaped(title)}${path === "index.html" ? "" : " - Linkwright"}</title>
${body.includes("<!--formula-->") ? `<link rel="stylesheet" href="${depth}formulas/katex.min.css">\n` : ""}<link rel="stylesheet" href="${depth}page.css">
${cpp ? `<link rel="stylesheet" href="${depth}cpp.css">\n` : ""}</head>
<body data-root="${depth}">
<header><a class="brand" href="${depth}index.html">Linkwright</a><nav aria-label="Manual">${nav}</nav>
<label class="search"><span>Search</span><input type="search" id="search" placeholder="Search" autocomplete="off" aria-controls="found"></label><div id="found" role="status"></div></header>
<main${live ? ' class="beside"' : broad || cpp ? ' class="broad"' : ""}>
<article>
<h1>${escaped(title)}</h1>
${lead ? `<p class="lead">${escaped(lead)}</p>` : ""}
${body}
</article>
${live ? `<aside aria-label="The mechanism"><iframe title="The workbench" id="live" hidden></iframe><p class="note" id="no-live">Press <b>Show it live</b> in the text: the mechanism stands here, to take hold of.</p></aside>` : ""}
</main>
<footer>linkwright ${escaped(version)}</footer>
<script src="${depth}search.js"></script>
<script src="${depth}page.js"></script>
</body>
</html>
`;
}

/** The units of the search: each part of a page from heading to heading. */
function parts({ path, section, title, body, lead }) {
  const plain = (html) => html.replace(/<!--formula-->[^]*?<!--end-->/g, " ").replace(/<[^>]*>/g, " ").replace(/&lt;/g, "<").replace(/&gt;/g, ">").replace(/&quot;/g, '"').replace(/&amp;/g, "&").replace(/\s+/g, " ").trim();
  return body.split(/(?=<h[23] id=)/).map((part, i) => {
    const [, id, heading] = /^<h[23] id="([^"]*)"[^>]*>([^]*?)<\/h/.exec(part) ?? [];
    return { at: id ? `${path}#${id}` : path, in: section, title: heading ? `${title}: ${plain(heading)}` : title, text: `${i ? "" : lead} ${plain(part)}`.slice(0, path === "messages.html" ? 20000 : 4000) };
  });
}

const found = [...pages.flatMap(parts), ...reference.search];
for (const { path, title, html } of reference.cpp) add(path, "Reference", title, html, { cpp: true });

rmSync(out, { recursive: true, force: true });
for (const p of pages) {
  mkdirSync(dirname(join(out, p.path)), { recursive: true });
  writeFileSync(join(out, p.path), framed(p));
}
writeFileSync(join(out, "search.js"), `const manual = ${JSON.stringify(found)};\n`);
for (const name of ["page.css", "cpp.css", "page.js"]) copyFileSync(join(dirname(fileURLToPath(import.meta.url)), name), join(out, name));
const katex = join(root, "web/node_modules/katex/dist");
mkdirSync(join(out, "formulas/fonts"), { recursive: true });
copyFileSync(join(katex, "katex.min.css"), join(out, "formulas/katex.min.css"));
for (const font of readdirSync(join(katex, "fonts")).filter((n) => n.endsWith(".woff2"))) copyFileSync(join(katex, "fonts", font), join(out, "formulas/fonts", font));
if (options.pictures) mkdirSync(join(out, "pictures"));
for (const [path, svg] of pictureOf) writeFileSync(join(out, "pictures", relative(dirname(path), path).replace(/\.toml$/, ".svg")), svg);
if (options.workbench) copyFileSync(options.workbench, join(out, "workbench.html"));
console.log(`${out}/index.html: ${pages.length} pages`);
