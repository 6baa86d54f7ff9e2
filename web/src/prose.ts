// Sentences of the program as the page shows them: true minus signs, units as they are written by hand, those that the study speaks in.
import { format, spaced, suffixCalled, unitWords } from "./units";

const superscripts: Record<string, string> = { "2": "²", "3": "³", "4": "⁴" };
/** "m/s2" -> "m/s²", "deg" -> "°". */
export const unitSign = (word: string) =>
  spaced(word.replace(/deg/g, "°").replace(/^um$/, "µm").replace(/(?<=[a-z])[234]\b/g, (digit) => superscripts[digit]));

// The size below which a number comes from rounding, in a sentence about a machine.
const rounding = (word: string) => (word === "um" || word === "µm" ? 1e-6 : word === "mm" ? 1e-9 : 1e-12);
const significant = (digits: string) => Math.max(1, digits.replace(/[-.]/g, "").replace(/^0+/, "").length);
const escaped = (word: string) => word.replace(/[/.]/g, "\\$&");

let made: { words: string[]; pattern: RegExp } | undefined;
function pattern(): RegExp {
  const words = unitWords();
  // "in" is a word of every other sentence.
  if (made?.words !== words) {
    const all = [...new Set(words.filter((word) => word !== "in").flatMap((word) => [word, unitSign(word).replace(/\u202f/g, " ")]))].sort((a, b) => b.length - a.length);
    made = { words, pattern: new RegExp(`(?<![\\w.'"/°-])(-?\\d+(?:\\.\\d+)?)(e[+-]?\\d+)?(?:( ?)(%|${all.map(escaped).join("|")}))?(?![\\w'"/²³⁴]|[.-]\\d)`, "g") };
  }
  return made.pattern;
}

/** One sentence; what stands in backticks or behind "=" is code and stays. */
export function prose(text: string): string {
  return text.replace(pattern(), (all, digits: string, power: string | undefined, _: string, word: string | undefined, at: number) => {
    const before = text.slice(0, at);
    if (/[=`]\s*$/.test(before) || before.split("`").length % 2 === 0) return all;
    const value = Number(digits + (power ?? ""));
    const plain = (v: number, few: number) => (power ? format(v, few) : digits.replace("-", "−"));
    if (word === undefined) return plain(value, significant(digits));
    const found = suffixCalled(word);
    // Only the last of several numbers that share a unit has it: "0.1 to 0.2 m", but not "at B0, 0.2 m".
    const shares = /(^|[^\w.-])-?\d+(\.\d+)?(e[+-]?\d+)?(,| to| and|;| \.\.) $/.test(before);
    const sign = found && found.factor !== 1 && !shares ? spaced(found.symbol) : unitSign(word);
    if (value !== 0 && Math.abs(value) < rounding(word) && word !== "%") return `0${sign.startsWith("°") ? "" : "\u202f"}${sign} (rounding)`;
    const number = found && found.factor !== 1 && !shares ? format(value * found.factor, significant(digits)) : plain(value, significant(digits));
    return `${number}${sign.startsWith("°") ? "" : "\u202f"}${sign}`;
  });
}
