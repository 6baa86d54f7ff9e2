// SPDX-License-Identifier: BSD-3-Clause

// The C++ reference: pages that Doxygen makes of the public headers, for the frame of the manual.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const folder = "reference/cpp";
const plain = (text) => text.replace(/&lt;/g, "<").replace(/&gt;/g, ">").replace(/&quot;/g, '"').replace(/&amp;/g, "&");
const first = (text, pattern) => pattern.exec(text)?.[1] ?? "";

/** The frame of the manual has the title, and its search box the names. */
function bodyOf(html) {
  return html.replace(/<div class="ttc"[^]*?<\/div><\/div>\n/g, "").replace(/<div class="summary">[^]*?<\/div>/, "").replace(/<img src="closed.png"[^>]*>/g, "").replace(/ onclick="[^"]*"/g, "")
    .replace(/<div class="headertitle">[^]*?<\/div><\/div>/, "")
    .replace(/<h2 class="groupheader"> <\/h2>/, "").replace(/<span class="permalink">[^]*?<\/span>/g, "")
    .replace(/<a (?:name="[^"]*" )?id="([^"]*)"(?: name="[^"]*")?><\/a>/g, '<span id="$1"></span>').replace(/ (?:align|valign)="\w+"/g, "")
    .replace(/<div class="fragment">/g, '<div class="fragment" tabindex="0">').replace(/<!--.*?-->/g, "");
}

/** Pages, parts of the library, and what the search finds: functions and types, each with where it is. */
export function cppReference(root) {
  const work = mkdtempSync(join(tmpdir(), "linkwright-cpp-"));
  try {
    const run = spawnSync("python3", ["-B", join(root, "tools/check_reference.py"), "--html", work, root], { encoding: "utf8" });
    if (run.status !== 0) throw new Error(`the C++ reference: ${run.stderr || run.error}`);
    const pages = new Map();
    // Doxygen also makes lists that nothing leads to.
    const wanted = ["index.html"];
    for (const name of wanted) {
      if (pages.has(name)) continue;
      const html = readFileSync(join(work, name), "utf8");
      pages.set(name, { path: `${folder}/${name}`, title: plain(first(html, /<!--title (.*?)-->/)).replace(/ (?:Struct|Class|Concept|Namespace|File|Directory)(?: Template)? Reference$/, ""), html: bodyOf(html) });
      for (const [, to] of html.matchAll(/ href="(?!https?:)([^"#]+\.html)/g)) if (!wanted.includes(to)) wanted.push(to);
    }
    const names = [...readFileSync(join(work, "names.xml"), "utf8").matchAll(/<compound kind="(\w+)"[^]*?<\/compound>/g)];
    const of = (tag, text) => plain(first(text, new RegExp(`<${tag}>(.*?)</${tag}>`)));
    const parts = names.filter(([, kind]) => kind === "group").map(([all]) => ({ path: `${folder}/${of("filename", all)}`, title: of("title", all), header: of("name", all) }));
    const found = [];
    for (const [all, kind] of names) {
      if (["struct", "class", "concept"].includes(kind)) found.push({ at: of("filename", all), title: of("name", all), text: `${kind} of the C++ library` });
      if (kind !== "group") continue;
      for (const [member] of all.matchAll(/<member kind="(?:function|define)">[^]*?<\/member>/g))
        found.push({ at: `${of("anchorfile", member)}#${of("anchor", member)}`, title: of("name", member), text: `${of("type", member)} ${of("name", member)}${of("arglist", member)}`.trim() });
    }
    const search = found.filter(({ at }) => pages.has(at.split("#")[0])).map((f) => ({ ...f, at: `${folder}/${f.at}`, in: "C++", title: f.title.replace(/^linkwright::/, "") }));
    return { pages: [...pages.values()], parts, search };
  } finally {
    rmSync(work, { recursive: true });
  }
}
