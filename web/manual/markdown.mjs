// SPDX-License-Identifier: BSD-3-Clause

// Markdown of the manual: headings that can be linked to, formulas, live mechanisms.
import katex from "katex";
import { Marked } from "marked";

export const escaped = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;").replace(/"/g, "&quot;");
export const slug = (text) => text.toLowerCase().replace(/<[^>]*>/g, "").replace(/&[a-z]+;/g, "").replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "");

// The comments are for the search, which leaves formulas out.
const formula = (tex, displayMode) => `<!--formula-->${katex.renderToString(tex, { displayMode, throwOnError: true })}<!--end-->`;
const display = {
  name: "display", level: "block", start: (source) => source.indexOf("$$"),
  tokenizer: (source) => {
    const found = /^\$\$([^]+?)\$\$(?:\n|$)/.exec(source);
    return found && { type: "display", raw: found[0], tex: found[1].trim() };
  },
  renderer: ({ tex }) => `<p class="formula" tabindex="0">${formula(tex, true)}</p>\n`,
};
const inline = {
  name: "inline", level: "inline", start: (source) => source.indexOf("$"),
  tokenizer: (source) => {
    const found = /^\$\$([^$]+?)\$\$|^\$((?:\\.|[^$\\\n])+?)\$(?![\d])/.exec(source);
    return found && { type: "inline", raw: found[0], tex: (found[1] ?? found[2]).trim(), shown: found[1] !== undefined };
  },
  renderer: ({ tex, shown }) => formula(tex, shown),
};

/** Title, lead and body of a text. `live(name, body)` makes the button of a live mechanism. */
export function markdown(text, live) {
  const [, title, rest] = /^# (.+)\n([^]*)$/.exec(text) ?? [];
  if (!title) throw new Error(`a text begins with its title: ${text.slice(0, 60)}`);
  const [, lead, body] = /^\s*> (.+)\n([^]*)$/.exec(rest) ?? [null, "", rest];
  const used = new Map();
  const marked = new Marked({
    extensions: [display, inline],
    renderer: {
      heading({ tokens, depth }) {
        const inner = this.parser.parseInline(tokens);
        const own = slug(inner);
        const count = (used.get(own) ?? 0) + 1;
        used.set(own, count);
        const id = count > 1 ? `${own}-${count}` : own;
        return `<h${depth} id="${id}"><a href="#${id}">${inner}</a></h${depth}>\n`;
      },
      code({ text: code, lang = "" }) {
        const [kind, ...words] = lang.split(" ");
        if (kind === "live") return live(words.join(" "), code);
        return `<pre tabindex="0"><code class="${escaped(kind)}">${escaped(code)}\n</code></pre>\n`;
      },
      link({ href, tokens }) {
        const to = /^[a-z]+:/.test(href) ? href : href.replace(/\.md(#|$)/, ".html$1");
        return `<a href="${escaped(to)}">${this.parser.parseInline(tokens)}</a>`;
      },
    },
  });
  return { title, lead, html: marked.parse(body).replace(/<table>/g, '<div class="table" tabindex="0"><table>').replace(/<\/table>/g, "</table></div>") };
}
