// SPDX-License-Identifier: BSD-3-Clause

// The tags of an XML text, one after the other. Entities are not expanded but for characters, so that no text grows while it is read.
import { PathError } from "./path";

export interface Tag {
  kind: "begin" | "end" | "alone"; // <a>, </a>, <a/>
  name: string; // without its prefix
  line: number; // from 1
  /** The value of an attribute; undefined where it is not given. */
  value: (key: string) => string | undefined;
}

const characters = new Map([["lt", "<"], ["gt", ">"], ["amp", "&"], ["quot", '"'], ["apos", "'"]]);

/** The text of an attribute, with references to characters replaced. */
function decoded(text: string, line: number): string {
  if (!text.includes("&")) return text;
  return text.replace(/&(#x[\da-f]{1,6}|#\d{1,7}|\w+);/gi, (_, name: string) => {
    const character = characters.get(name);
    if (character !== undefined) return character;
    const code = /^#x/i.test(name) ? parseInt(name.slice(2), 16) : name.startsWith("#") ? parseInt(name.slice(1), 10) : NaN;
    if (!(code <= 0x10ffff)) throw new PathError(`Line ${line} refers to the entity &${name.slice(0, 20)};, which is not replaced here.`, "Save the file as plain SVG, without entities of its own.");
    return String.fromCodePoint(code);
  });
}

/** The position behind a declaration <!DOCTYPE ...>, with its own declarations in brackets; -1 where it does not end. */
function afterDeclaration(text: string, from: number): number {
  const mark = /<!--|["'[\]>]/g;
  mark.lastIndex = from;
  let depth = 0;
  for (let found = mark.exec(text); found; found = mark.exec(text)) {
    if (found[0] === "[") ++depth;
    else if (found[0] === "]") --depth;
    else if (found[0] === ">") {
      if (depth <= 0) return mark.lastIndex;
    } else {
      const closing = found[0] === "<!--" ? "-->" : found[0];
      const end = text.indexOf(closing, mark.lastIndex);
      if (end < 0) return -1;
      mark.lastIndex = end + closing.length;
    }
  }
  return -1;
}

/** The position behind a comment, a declaration or an instruction that begins here; null where a tag begins, -1 where it does not end. */
function afterAside(text: string, at: number): number | null {
  const until = (closing: string) => {
    const end = text.indexOf(closing, at);
    return end < 0 ? -1 : end + closing.length;
  };
  if (text.startsWith("<!--", at)) return until("-->");
  if (text.startsWith("<![CDATA[", at)) return until("]]>");
  if (text.startsWith("<?", at)) return until("?>");
  if (text.startsWith("<!", at)) return afterDeclaration(text, at + 2);
  return null;
}

const longestName = 40; // characters
// The parts of a tag; each is looked for at a given position.
const head = /<(\/?)([^\s/<>"'=]+)/y;
const attribute = /\s+([^\s/<>"'=]+)\s*=\s*(["'])/y;
const tail = /\s*(\/?)>/y;

/** The tag that begins here, and the position behind it; null where it is damaged. */
function tagAt(text: string, at: number, line: number): { tag: Tag; end: number } | null {
  head.lastIndex = at;
  const begin = head.exec(text);
  if (!begin) return null;
  const values = new Map<string, [number, number]>();
  let end = head.lastIndex;
  for (;;) {
    attribute.lastIndex = end;
    const found = attribute.exec(text);
    if (!found) break;
    const close = text.indexOf(found[2], attribute.lastIndex);
    if (close < 0) return null;
    values.set(found[1], [attribute.lastIndex, close]);
    end = close + 1;
  }
  tail.lastIndex = end;
  const last = tail.exec(text);
  if (!last) return null;
  const value = (key: string) => {
    const range = values.get(key);
    return range && decoded(text.slice(...range), line);
  };
  return { tag: { kind: begin[1] ? "end" : last[1] ? "alone" : "begin", name: begin[2].replace(/^.*:/, "").slice(0, longestName), line, value }, end: tail.lastIndex };
}

export function* tagsOf(text: string): Generator<Tag> {
  let [line, next] = [1, text.indexOf("\n")];
  const lineOf = (at: number) => {
    for (; next >= 0 && next < at; next = text.indexOf("\n", next + 1)) ++line;
    return line;
  };
  for (let at = text.indexOf("<"); at >= 0; at = text.indexOf("<", at)) {
    const aside = afterAside(text, at);
    const found = aside === null ? tagAt(text, at, lineOf(at)) : null;
    const end = aside ?? found?.end ?? -1;
    if (end < 0) throw new PathError(`“${text.slice(at, at + 20).trim()}” in line ${lineOf(at)} is not closed, or is damaged.`, "Copy or save the file once more: a part of it is missing.");
    if (found) yield found.tag;
    at = end;
  }
}
