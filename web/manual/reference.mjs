// SPDX-License-Identifier: BSD-3-Clause

// The reference: what the program says of itself, as pages.
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { cppReference } from "./cpp.mjs";
import { escaped, slug } from "./markdown.mjs";

const pathOf = (kind) => `reference/${kind.replace(/[/.]/g, "-")}.html`;
const units = { rad: "rad", m: "m" };
/** "kg_m2" as engineers write it. */
const unitOf = (unit) => units[unit] ?? unit.replace(/_per_/g, "/").replace(/_/g, " ").replace(/(?<=[a-z])2\b/g, "²").replace(/(?<=[a-z])3\b/g, "³").replace(/(?<=[a-z])4\b/g, "⁴");
const number = (value) => (Number.isInteger(value) && Math.abs(value) < 1e6 ? String(value) : Number(value).toPrecision(6).replace(/\.?0+(e|$)/, "$1").replace("e+", "e"));
const huge = 1e9; // such bounds only keep nonsense out

const forms = (node) => [node, ...(node.anyOf ?? []), ...(node.oneOf ?? [])];
const part = (node, has) => forms(node).find(has);

/** The values that a key may have, in words. */
function valueOf(node) {
  const words = (node.oneOf ?? []).filter((w) => typeof w.const === "string");
  if (words.length) return words.map((w) => `<code>"${escaped(w.const)}"</code>${w.description ? ` ${escaped(w.description)}` : ""}`).join("<br>");
  if (node.enum) return node.enum.map((w) => `<code>${escaped(JSON.stringify(w))}</code>`).join(", ");
  if (node.const !== undefined) return `<code>${escaped(JSON.stringify(node.const))}</code>`;
  const ranged = forms(node).some((f) => f.properties?.min && f.properties?.max);
  const list = part(node, (f) => f.type === "array");
  const named = part(node, (f) => f.type === "object" && f.additionalProperties && !f.properties);
  const plain = part(node, (f) => ["number", "integer", "boolean", "string"].includes(f.type));
  const bounds = (n) => {
    const low = n.exclusiveMinimum !== undefined ? `&gt; ${number(n.exclusiveMinimum)}` : n.minimum !== undefined && n.minimum > -huge ? `≥ ${number(n.minimum)}` : "";
    const high = n.exclusiveMaximum !== undefined ? `&lt; ${number(n.exclusiveMaximum)}` : n.maximum !== undefined && n.maximum < huge ? `≤ ${number(n.maximum)}` : "";
    return [low, high].filter(Boolean).join(", ");
  };
  const out = [];
  if (plain) out.push(`${{ number: "number", integer: "whole number", boolean: "<code>true</code> or <code>false</code>", string: "text" }[plain.type]}${bounds(plain) ? ` ${bounds(plain)}` : ""}`);
  if (ranged) out.push("<code>{ min, max }</code>");
  if (list) {
    const items = list.items ?? {};
    const count = list.minItems !== undefined && list.minItems === list.maxItems ? `${list.minItems} ` : "";
    out.push(items.properties ? "list of tables" : `list of ${count}${valueOf(items) || "values"}`);
  }
  if (named) out.push(`names with ${typeof named.additionalProperties === "object" ? valueOf(named.additionalProperties) || "tables" : "values"}`);
  return out.join(", or ") || (part(node, (f) => f.properties) ? "table" : "");
}

/** Rows of a table of keys, and those of the tables in it. */
function rows(node, path, depth, out) {
  const table = part(node, (f) => f.properties && !(f.properties.min && f.properties.max));
  const needed = new Set(forms(node).flatMap((f) => f.required ?? []));
  for (const [name, own] of Object.entries(table?.properties ?? {})) {
    const list = part(own, (f) => f.type === "array" && f.items?.properties);
    const below = list ? list.items : own;
    const nested = part(below, (f) => f.properties && !(f.properties.min && f.properties.max));
    const start = own.default !== undefined && typeof own.default !== "object" ? `<code>${escaped(JSON.stringify(own.default))}</code>` : Array.isArray(own.default) && own.default.length < 5 ? `<code>${escaped(JSON.stringify(own.default))}</code>` : needed.has(name) ? "required" : "";
    const key = list ? `[[${path}${name}]]` : nested && depth === 0 ? `[${path}${name}]` : name;
    out.push(`<tr class="depth-${depth}"><td><code>${escaped(key)}</code></td><td>${own.unit ? escaped(unitOf(own.unit)) : ""}</td><td>${nested && !plainForm(own) ? (list ? "tables" : "table") : valueOf(own)}</td><td>${start}</td><td>${escaped(own.description ?? "")}</td></tr>`);
    if (nested && depth < 4) rows(below, `${path}${name}.`, depth + 1, out);
    // Forms that differ by their type.
    if (depth < 4) for (const form of (below.oneOf ?? []).filter((f) => f.properties?.type?.const ?? f.properties?.method?.const)) {
      const choice = form.properties.type ? "type" : "method";
      const { [choice]: word, ...more } = form.properties;
      out.push(`<tr class="depth-${depth + 1}"><td colspan="5">with <code>${choice} = "${escaped(word.const)}"</code>${form.description ? `: ${escaped(form.description)}` : ""}</td></tr>`);
      rows({ ...form, properties: more }, `${path}${name}.`, depth + 2, out);
    }
  }
  return out;
}
const plainForm = (node) => forms(node).some((f) => ["number", "integer", "string", "boolean"].includes(f.type));

const keyTable = (schema) => `<div class="table" tabindex="0"><table><thead><tr><th>key</th><th>unit</th><th>value</th><th>default</th><th>meaning</th></tr></thead><tbody>${rows(schema, "", 0, []).join("\n")}</tbody></table></div>`;

/** The columns of the tables that a study of a kind gives, by running its template for a moment. */
function columns(ask, kind) {
  const folder = mkdtempSync(join(tmpdir(), "linkwright-reference-"));
  try {
    ask("new", kind, join(folder, "study.toml"));
    try {
      ask("run", join(folder, "study.toml"), "--out", folder, "--quiet", "--time-limit", "3", "--set", 'output.formats=["json"]');
    } catch {
      // A check that fails because the run was cut short.
    }
    if (!readdirSync(folder).includes("result.json")) return "";
    const { tables } = JSON.parse(readFileSync(join(folder, "result.json"), "utf8"));
    const seen = new Set();
    return tables.filter((t) => !/-\d+$/.test(t.name)).map((t) => {
      const own = t.columns.filter((c) => !seen.has(`${t.name}.${c.key}`));
      for (const c of own) seen.add(`${t.name}.${c.key}`);
      return `<h3 id="table-${slug(t.name)}"><a href="#table-${slug(t.name)}">${escaped(t.name)}</a></h3><div class="table" tabindex="0"><table><thead><tr><th>column</th><th>meaning</th></tr></thead><tbody>${own.map((c) => `<tr><td><code>${escaped(c.key)}</code></td><td>${escaped(c.label ?? "")}</td></tr>`).join("")}</tbody></table></div>`;
    }).join("");
  } finally {
    rmSync(folder, { recursive: true });
  }
}

function kindPage(ask, { name, summary, group }) {
  const schema = JSON.parse(ask("schema", name));
  const template = ask("new", name, "-");
  const heading = (id, text) => `<h2 id="${id}"><a href="#${id}">${text}</a></h2>`;
  const result = columns(ask, name);
  return {
    path: pathOf(name), title: name, lead: summary,
    html: `<p>${escaped(group)}. <a href="${"../"}workbench.html">Open the workbench</a>, or write a first study with <code>linkwright new ${escaped(name)}</code>, as below. On this page: <a href="#keys">keys</a>${result ? `, <a href="#columns">tables of the result</a>` : ""}.</p>
<pre tabindex="0"><code class="toml">${escaped(template)}</code></pre>
${heading("keys", "Keys")}
<p>Lengths, angles and other quantities carry their unit in the name of the key: <code>crank_mm</code> is <code>crank_m</code> in another unit.</p>
${keyTable(schema)}
${schema.absent ? `${heading("absent", "What is not here")}<p>What studies of a related kind have, and why these have not.</p><div class="table" tabindex="0"><table><thead><tr><th>key</th><th>reason</th></tr></thead><tbody>${schema.absent.map(({ key, reason }) => `<tr><td><code>${escaped(key)}</code></td><td>${escaped(reason)}</td></tr>`).join("")}</tbody></table></div>` : ""}
${result ? `${heading("columns", "Tables of the result")}<p>Of the study above; names of joints and bodies are those of the study.</p>${result}` : ""}`,
  };
}

function commandPage(ask) {
  const of = (name) => `<h2 id="${name}"><a href="#${name}">${name}</a></h2><pre tabindex="0"><code>${escaped(ask("help", name))}</code></pre>`;
  const all = ask("help");
  const commands = [...all.matchAll(/^ {2}([a-z]+) {2,}/gm)].map((m) => m[1]).filter((name) => name !== "help");
  return { path: "reference/commands.html", title: "Commands", lead: "The command line.", html: `<pre tabindex="0"><code>${escaped(all)}</code></pre>${commands.map(of).join("")}` };
}

/** Public classes and functions of a file of the Python package: how each is called, its fields, and its docstring. */
function pythonItems(text) {
  const items = [];
  let owner = "";
  // "class Name(Base):" and "def name(...) -> ...:", at most one level deep, with the docstring that follows.
  for (const found of text.matchAll(/^( {4})?(class|def) (\w+)([^]*?):\n(?:\s*"""([^]*?)"""\n)?/gm)) {
    const [all, indent, word, name, rest, said = ""] = found;
    if (!indent) owner = word === "class" ? name : "";
    if (name.startsWith("_") || owner.startsWith("_") || (indent && !owner)) continue;
    const call = `${word === "class" ? "class " : indent ? `${owner}.` : ""}${name}${rest}`.replace(/\(self(?:, )?/, "(").replace(/\s+/g, " ");
    const fields = word === "class" ? /^(?:\s*\n)*((?: {4}\w+: .*\n)*)/.exec(text.slice(found.index + all.length))[1].trimEnd() : "";
    if (said) items.push({ code: fields ? `${call}\n${fields}` : call, said });
  }
  return items;
}

function pythonPage(root) {
  const folder = join(root, "python/linkwright");
  const inLine = (text) => escaped(text.replace(/\s+/g, " ").trim()).replace(/`([^`]+)`/g, "<code>$1</code>");
  const paragraphs = (said) => said.split(/\n\s*\n/).map((p) => `<p>${inLine(p)}</p>`).join("");
  const part = (file) => {
    const text = readFileSync(join(folder, file), "utf8");
    const name = file.replace(".py", "");
    const [, about = ""] = /^"""([^]*?)"""/m.exec(text) ?? [];
    const items = pythonItems(text).map(({ code, said }) => `<pre tabindex="0"><code>${escaped(code)}</code></pre>${paragraphs(said)}`);
    return `<h2 id="${name}"><a href="#${name}">${name}</a></h2>${paragraphs(about)}${items.join("")}`;
  };
  const files = ["studies.py", "planar.py", "suspension.py", "parallel.py", "optimise.py", "rows.py", "errors.py"];
  return { path: "reference/python.html", title: "Python", lead: "The package linkwright: what stands in linkwright.planar, linkwright.suspension and linkwright.parallel is called by that name, all else as linkwright.NAME.", html: files.map(part).join("") };
}

export function referencePages({ ask, json, root }) {
  const kinds = json("catalogue", "--json");
  const pages = kinds.map((kind) => kindPage(ask, kind));
  const { pages: cpp, parts, search } = cppReference(root);
  const result = { path: "reference/result.html", title: "result.json", lead: "What a run writes for programs.", html: keyTable(JSON.parse(ask("schema", "result"))) };
  const groups = [...new Set(kinds.map((k) => k.group))];
  const list = (items) => `<ul>${items.map(({ path, title, lead }) => `<li><a href="${path.replace("reference/", "")}">${escaped(title)}</a>${lead ? `: ${escaped(lead)}` : ""}</li>`).join("")}</ul>`;
  const command = commandPage(ask);
  const python = pythonPage(root);
  const index = {
    path: "reference/index.html", title: "Reference", lead: "What the program says of itself: keys, columns, commands, files, functions.",
    html: `${groups.map((group) => `<h2 id="${slug(group)}">${escaped(group)}</h2>${list(kinds.filter((k) => k.group === group).map((k) => pages[kinds.indexOf(k)]))}`).join("")}
<h2 id="program">Program and files</h2>${list([command, { path: "../files.html", title: "Files of a run" }, result, { path: "../messages.html", title: "Messages", lead: "statuses, exit codes, and every text that the program can say" }])}<h2 id="libraries">Python and C++</h2>${list([python, { ...cpp[0], lead: "all public functions and types" }, ...parts.map(({ path, title, header }) => ({ path, title: `C++: ${title}`, lead: `linkwright/${header}.h` }))])}`,
  };
  return { pages: [index, ...pages, command, result, python], cpp, search };
}
