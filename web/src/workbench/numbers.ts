// SPDX-License-Identifier: BSD-3-Clause

// The numbers, choices and switches of a study, in groups as its tables have them, each with its key.
import type { Json, JsonObject } from "../data";
import { nameOf, unitOf } from "../units";
import { places } from "./loads";
import { ruleAt, type Rule } from "./schema";

export interface Entry {
  key: string;  // key of the study
  label: string;
  value: number | string | boolean | { min: number; max: number };
  rule: Rule | null;  // rule of the schema for it
}
/** Rows of two numbers that rows can be added to: points, or a table of a function. */
export interface List {
  key: string;
  label: string;
  columns: [string, string];
  rows: number[][];
}
export interface Group {
  title: string;
  path: string;  // path of its table
  entries: Entry[];
  lists: List[];
}

const axes = ["x", "y", "z"];
const isNumbers = (value: Json): value is number[] => Array.isArray(value) && value.length > 0 && value.length <= 3 && value.every((v) => typeof v === "number");
/** Lists of lengths and forces go by coordinates, those of angles or without a unit by number. */
const isPlace = (key: string) => /^([µmkc]?m(\/s²?)?|k?N( m)?)$/.test(unitOf(unitKey(key)).symbol);
const isRange = (value: Json): value is { min: number; max: number } =>
  value !== null && typeof value === "object" && !Array.isArray(value) && Object.keys(value).length === 2 && typeof value.min === "number" && typeof value.max === "number";

/** The numbers of a whole study, except those for what only says how results are written and checked. */
export function numbersOf(study: JsonObject, schema: JsonObject | null = null): Group[] {
  const groups: Group[] = [];
  const rule = (key: string) => ruleAt(schema, study, key);
  /** The numbers of a table and of the tables in it; a list of tables gives a group an entry. */
  function table(values: JsonObject, path: string, title: string): void {
    const own: Entry[] = [];
    const group: Group = { title, path, entries: own, lists: [] };
    groups.push(group);
    const add = (key: string, label: string, value: Json) => {
      if (typeof value === "number" || isRange(value)) own.push({ key, label, value, rule: rule(key) });
      else if (isNumbers(value)) value.forEach((v, i) => own.push({ key: `${key}[${i}]`, label: `${label} ${isPlace(key) ? axes[i] : i + 1}`, value: v, rule: rule(key) }));
      else if (typeof value === "string" || typeof value === "boolean") {
        const found = rule(key);
        const named = places(study, key).map((place) => ({ value: place, help: "" }));
        if (found && (found.choices || found.flag)) own.push({ key, label, value, rule: found });
        else if (found && named.length) own.push({ key, label, value, rule: { ...found, choices: named } });
      }
    };
    for (const [name, value] of Object.entries(values)) {
      const key = path ? `${path}.${name}` : name;
      if (Array.isArray(value) && value.some((v) => v !== null && typeof v === "object" && !Array.isArray(v)))
        value.forEach((v, i) => {
          const entry = v as JsonObject;
          table(entry, `${key}[${i}]`, `${name.replace(/_/g, " ")} ${typeof entry.name === "string" ? entry.name : i + 1}`);
        });
      else if (Array.isArray(value) && value.length > 0 && value.every((v) => isNumbers(v) && v.length === 2))
        group.lists.push({ key, label: nameOf(name), columns: ["x", "y"], rows: value as number[][] });
      else if (Array.isArray(value) && value.length > 0 && value.every(isNumbers))
        value.forEach((v, i) => add(`${key}[${i}]`, `${nameOf(name)} ${i + 1}`, v));
      else if (value !== null && typeof value === "object" && !Array.isArray(value) && !isRange(value))
        // Points by name, or tables: what has a unit in its own name holds values that have none.
        if (Object.keys(value).length > 0 && Object.values(value).every((v) => typeof v === "number" || isNumbers(v)) && unitOf(name).symbol !== "")
          for (const [n, v] of Object.entries(value)) add(`${key}.${n}`, n, v);
        else table(value, key, name.replace(/_/g, " "));
      else add(key, nameOf(name), value);
    }
  }
  for (const [name, value] of Object.entries(study)) {
    if (["output", "check"].includes(name) || value === null || typeof value !== "object") continue;
    if (Array.isArray(value)) table({ [name]: value }, "", name);
    else table(value, name, name.replace(/_/g, " "));
  }
  return groups.filter((g) => g.entries.length > 0 || g.lists.length > 0);
}

export interface PointRow {
  key: string;  // key of the list of three
  owner: string; // "link front arm"
  name: string; // "body"
  entries: Entry[]; // x, y and z
}

/** The points in space of a study. */
export const pointsOf = (groups: Group[]): PointRow[] =>
  groups.flatMap(({ title, entries }) => entries.flatMap((first, i) => {
    const [, key] = /^(.*)\[0\]$/.exec(first.key) ?? [];
    const three = entries.slice(i, i + 3);
    const symbol = key ? unitOf(unitKey(key)).symbol : "";
    return key && /^[µmkc]?m$/.test(symbol) && three.length === 3 && three.every((e, k) => e.key === `${key}[${k}]`) && !/direction|axis/.test(key)
      ? [{ key, owner: title, name: first.label.replace(/ x$/, ""), entries: three }] : [];
  }));

/** The key that carries the unit: the last one on the way that has one. */
export const unitKey = (key: string) => key.split(".").map((part) => part.replace(/\[\d+\]/g, "")).reverse().find((part) => unitOf(part).symbol !== "") ?? "";
