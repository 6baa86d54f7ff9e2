// SPDX-License-Identifier: BSD-3-Clause

// All messages of the program, read from its sources: a message is the text in a call of one of a few functions.
// tests/tools/check_one_message.py compares them with those that a user meets.
//   node messages.mjs    prints them as JSON
import { readFileSync, readdirSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

// Functions whose calls contain messages: errors of a study, an option or a file; warnings; reasons for the status of a result;
// errors of a caller of the library.
const sayers = {
  error: /^(?:error|unreadable|refuse|complain|wrong|refuse_shards|problem|require_memory|CheckpointError|fail_at|unknown|mistake|value_error|clash|trouble)$/,
  warning: /^(?:warn|warning|remark|caution)$/,
  reason: /^(?:fail|fails|stop|end_with|give_up)$/,
  library: /^(?:LINKWRIGHT_REQUIRE|ContractError|type_error|contract_failure)$/,
};
// Functions that return an error, or the reason of one.
const returns = { error: /(?:^|_)(?:problem|problems|problem_of|mistake|hint|refusal)$|^(?:member|of_best|of_row|resolve|statistic|unknown|plain_words|start_message)$/, reason: /failure|cause|reason|message|caution|^why|limit_reason|described|free_turn|note_on|singular_home|defect_text/ };

/** Words of C++: texts as they are said, names, and signs. */
function* tokens(source) {
  const word = /\/\/[^\n]*|\/\*[^]*?\*\/|R"(\w*)\(([^]*?)\)\1"|"((?:\\.|[^"\\\n])*)"|'(?:\\.|[^'\\\n])+'|[A-Za-z_]\w*|[0-9][\w.']*|\S/g;
  let previous;
  for (const found of source.matchAll(word)) {
    const [all, , raw, text] = found;
    if (all.startsWith("//") || all.startsWith("/*")) continue;
    if (text !== undefined || raw !== undefined) {
      const said = raw ?? text.replace(/\\(["'\\])/g, "$1").replace(/\\n/g, "\n").replace(/\\u00b0/g, "°");
      if (previous?.said !== undefined) previous.said += said;
      else {
        if (previous) yield previous;
        previous = { said, at: found.index };
      }
      continue;
    }
    if (previous) yield previous;
    previous = { sign: all, at: found.index };
  }
  if (previous) yield previous;
}

const isSentence = (text) => /[a-z]{2}/.test(text) && /\S \S/.test(text.trim());
const shown = (text) => text.replace(/\{\{/g, "\u0001").replace(/\}\}/g, "\u0002").replace(/\{[^{}]*\}/g, "…").replace(/\u0001/g, "{").replace(/\u0002/g, "}").trim();

/** The arguments of a call that begins at an opening bracket: lists of tokens. */
function argumentsOf(all, open) {
  const out = [[]];
  let depth = 0;
  for (let i = open; i < all.length; ++i) {
    const { sign } = all[i];
    if ("([{".includes(sign ?? " ")) ++depth;
    if (")]}".includes(sign ?? " ") && --depth === 0) return { parts: out, end: i };
    if (depth === 1 && sign === ",") out.push([]);
    else if (i > open) out.at(-1).push(all[i]);
  }
  return { parts: out, end: all.length };
}
const sentences = (part) => part.filter((t) => t.said !== undefined && isSentence(t.said)).map((t) => t.said);

/** The messages of one source. */
function said(source) {
  const all = [...tokens(source)];
  const out = [];
  const put = (level, texts, hints) => {
    for (const text of texts) out.push({ level, text: shown(text), hints: hints.map(shown) });
  };
  const opened = []; // brackets around
  const scopes = []; // names of functions around, where their braces open
  let depth = 0;
  for (let i = 0; i < all.length; ++i) {
    const { sign } = all[i];
    if (sign === "{") {
      ++depth;
      // name(...) [const] {
      let k = i - 1;
      while (k > 0 && ["const", "noexcept", "override"].includes(all[k].sign)) --k;
      if (all[k]?.sign === ")") {
        let inner = 0;
        for (; k >= 0; --k) {
          if (all[k].sign === ")") ++inner;
          if (all[k].sign === "(" && --inner === 0) break;
        }
        const name = all[k - 1]?.sign;
        if (name && /^[A-Za-z_]\w*$/.test(name) && !["if", "for", "while", "switch", "catch"].includes(name)) scopes.push({ name, depth });
      }
    } else if (sign === "}") {
      if (scopes.at(-1)?.depth === depth) scopes.pop();
      --depth;
    }
    if ("([{".includes(sign ?? " ")) opened.push(i);
    if (")]}".includes(sign ?? " ")) opened.pop();
    if (sign === "Severity" && opened.length) {
      // A diagnostic that is written out: its text, and how to fix it.
      const telling = argumentsOf(all, opened.at(-1)).parts.map(sentences).filter((s) => s.length);
      put(all[i + 3]?.sign === "warning" ? "warning" : "error", telling[0] ?? [], telling.slice(1).flat());
    }
    if (sign === "return" && all[i + 1]) {
      const name = scopes.at(-1)?.name ?? "";
      const level = Object.keys(returns).find((key) => returns[key].test(name));
      let end = i;
      for (let inner = 0; end < all.length && !(inner === 0 && all[end].sign === ";"); ++end) {
        if ("([{".includes(all[end].sign ?? " ")) ++inner;
        if (")]}".includes(all[end].sign ?? " ")) --inner;
      }
      const body = all.slice(i + 1, end);
      // A message and how to fix it, as {"...", "..."}.
      if (level && body[0]?.sign === "{") {
        const { parts } = argumentsOf(body, 0);
        const telling = parts.map(sentences).filter((s) => s.length);
        put(level, telling[0] ?? [], telling.slice(1).flat());
      } else if (level && !body.some((t) => t.sign === "error" || t.sign === "refuse")) put(level, sentences(body), []);
    }
    if (sign !== "(" || !/^[A-Za-z_]\w*$/.test(all[i - 1]?.sign ?? "")) continue;
    const name = all[i - 1].sign;
    const level = Object.keys(sayers).find((key) => sayers[key].test(name));
    if (!level) continue;
    const telling = argumentsOf(all, i).parts.map(sentences).filter((s) => s.length);
    put(level, telling[0] ?? [], telling.slice(1).flat());
  }
  return out;
}

/** Messages by module: { module, level, text, hints, files }. A text that occurs in several places is listed once. */
export function messages(root) {
  const folder = join(root, "src/linkwright");
  const found = new Map();
  for (const name of readdirSync(folder, { recursive: true }).sort()) {
    if (!/\.(?:cpp|h)$/.test(name) || !name.includes("/") || /platform\/|^wasm\//.test(name)) continue;
    const module = name.split("/")[0];
    for (const { level, text, hints } of said(readFileSync(join(folder, name), "utf8"))) {
      const key = `${module}|${level}|${text}`;
      const own = found.get(key) ?? { module, level, text, hints: [], files: [] };
      own.hints.push(...hints.filter((h) => !own.hints.includes(h)));
      if (!own.files.includes(name)) own.files.push(name);
      found.set(key, own);
    }
  }
  return [...found.values()];
}

const modules = {
  study: "Study files", core: "Tables and memory", planar: "Planar linkages", suspension: "Wheel suspensions", parallel: "Parallel robots", flexible: "Flexible links",
  clearance: "Joint clearance", parameter_study: "Parameter studies", optimise: "Searches", math: "Motion laws and integration", app: "Runs, checkpoints, shards",
  cli: "Command line", serve: "Workbench server", mpi: "Ranks", report: "Reports", python: "Python",
};
const levels = [
  ["error", "Errors", "The study, option or file cannot be used (exit code 2)."],
  ["warning", "Warnings", "A warning concerns a study or its result, which is computed nevertheless."],
  ["reason", "Reasons", "A reason is reported together with the status; it says why a result, or a row of it, is incomplete."],
  ["library", "Broken contracts", "Callers of the C++ and Python libraries get these for an argument that no study can contain (ContractError)."],
];

/** All messages as parts of a page, by level and module; … represents names and numbers. */
export function messageList(root, escaped) {
  const all = messages(root);
  const unknown = all.find(({ module }) => !modules[module]);
  if (unknown) throw new Error(`messages of ${unknown.module} have no heading in web/manual/messages.mjs`);
  const table = (list) => `<div class="table" tabindex="0"><table><thead><tr><th>message</th><th>how to fix it</th></tr></thead><tbody>${list.map(({ text, hints }) => `<tr><td>${escaped(text)}</td><td>${hints.map(escaped).join("<br>")}</td></tr>`).join("\n")}</tbody></table></div>`;
  const part = ([level, title, about]) => {
    const groups = Object.entries(modules).map(([module, name]) => [module, name, all.filter((m) => m.module === module && m.level === level)]).filter(([, , list]) => list.length);
    return `<h2 id="${level}"><a href="#${level}">${title}</a></h2><p>${about} The list is read from the sources. The sign … represents names and numbers, and a message may be composed of several of these texts.</p>${groups.map(([module, name, list]) => `<h3 id="${level}-${module}"><a href="#${level}-${module}">${name}</a></h3>${table(list)}`).join("")}`;
  };
  return levels.map(part).join("");
}

/** Throws when a status, a verdict or an exit code that the program lists is missing in a text about them. */
export function requireWords({ ask, json }, html) {
  const { status, verdict } = json("schema", "result").$defs;
  const codes = [...ask("help").split("Exit codes:")[1].matchAll(/(\d+)\s[a-z]/g)].map((m) => `<td>${m[1]}</td>`);
  const words = [...status.enum, ...verdict.enum].map((word) => `<code>${word}</code>`);
  for (const word of [...words, ...codes]) if (!html.includes(word)) throw new Error(`docs/manual/messages.md does not say what ${word} means`);
}

if (process.argv[1] && resolve(process.argv[1]) === fileURLToPath(import.meta.url)) {
  const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
  console.log(JSON.stringify(messages(root), null, 1));
}
