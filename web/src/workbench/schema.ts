// SPDX-License-Identifier: BSD-3-Clause

// The rules of a kind's JSON Schema for a key of its studies.
import type { Json, JsonObject } from "../data";

export interface Rule {
  help: string;
  least?: number; // in the unit of the key
  most?: number;
  open: boolean; // the least itself is none
  choices?: { value: string; help: string }[];
  flag: boolean;
  free: boolean; // a number that a search may choose between bounds
  count: number;  // count of numbers in a list; 0 = one number
  start?: Json; // default
}

const isTable = (value: Json | undefined): value is JsonObject => value !== null && typeof value === "object" && !Array.isArray(value);
const tables = (value: Json | undefined): JsonObject[] => (Array.isArray(value) ? value.filter(isTable) : []);
export const stepsOf = (key: string) => key.match(/[^.[\]]+/g) ?? [];

/** The forms that a value may have, those first that agree with the words in it. */
function forms(node: JsonObject, value: Json | undefined): JsonObject[] {
  const all = [node, ...tables(node.anyOf), ...tables(node.oneOf)];
  const agrees = (form: JsonObject) =>
    !isTable(form.properties) || !isTable(value) || Object.entries(form.properties).every(([key, v]) => !isTable(v) || v.const === undefined || v.const === value[key]);
  return [...all.filter(agrees), ...all.filter((form) => !agrees(form))];
}

function below(node: JsonObject, step: string, value: Json | undefined): JsonObject | null {
  for (const form of forms(node, value)) {
    const own = isTable(form.properties) ? form.properties[step] : undefined;
    const found = own ?? (/^\d+$/.test(step) ? form.items : form.additionalProperties);
    if (isTable(found)) return found;
  }
  return null;
}

/** The part of a schema that a key of a study falls under; null = it says nothing of it. */
export function nodeAt(schema: JsonObject | null, study: JsonObject, key: string): JsonObject | null {
  let node = schema;
  let value: Json | undefined = study;
  for (const step of stepsOf(key)) {
    if (!node) return null;
    node = below(node, step, value);
    value = value !== null && typeof value === "object" ? (value as Record<string, Json>)[step] : undefined;
  }
  return node;
}

const numberIn = (node: JsonObject) => forms(node, undefined).find((form) => form.type === "number" || form.type === "integer");

export function ruleOf(node: JsonObject): Rule {
  const one = numberIn(node);
  const list = forms(node, undefined).find((form) => form.type === "array" && isTable(form.items) && form.minItems === form.maxItems && numberIn(form.items));
  const number = one ?? (list && numberIn(list.items as JsonObject));
  const words = tables(node.oneOf).filter((c) => typeof c.const === "string");
  const bound = (name: string) => (typeof number?.[name] === "number" ? (number[name] as number) : undefined);
  return {
    help: typeof node.description === "string" ? node.description : "",
    least: bound("minimum") ?? bound("exclusiveMinimum"),
    most: bound("maximum") ?? bound("exclusiveMaximum"),
    open: bound("exclusiveMinimum") !== undefined,
    choices: words.length ? words.map((c) => ({ value: c.const as string, help: String(c.description ?? "") })) : undefined,
    flag: node.type === "boolean",
    free: one !== undefined && tables(node.anyOf).some((form) => isTable(form.properties) && "min" in form.properties && "max" in form.properties),
    count: one || !list ? 0 : Number(list.minItems ?? 0),
    start: node.default,
  };
}

/** The last study and the rules of the schema for it. They stay valid for a study that differs by its numbers alone, as while
 *  something is dragged. */
interface Said {
  schema: JsonObject | null;
  shape: string;
  rules: Map<string, Rule | null>;
  absent: Map<string, Absent[]>;
}
let last: Said = { schema: null, shape: "", rules: new Map(), absent: new Map() };
const shapes = new WeakMap<JsonObject, string>();
function saidOf(schema: JsonObject | null, study: JsonObject): Said {
  let shape = shapes.get(study);
  if (shape === undefined) shapes.set(study, (shape = JSON.stringify(study, (_, value: Json) => (typeof value === "number" ? 0 : value))));
  if (last.schema !== schema || last.shape !== shape) last = { schema, shape, rules: new Map(), absent: new Map() };
  return last;
}
function onceFor<T>(known: Map<string, T>, key: string, make: () => T): T {
  if (!known.has(key)) known.set(key, make());
  return known.get(key)!;
}

/** The rule of a key of a study. */
export const ruleAt = (schema: JsonObject | null, study: JsonObject, key: string): Rule | null =>
  onceFor(saidOf(schema, study).rules, key, () => {
    const node = nodeAt(schema, study, key);
    return node && ruleOf(node);
  });

export interface Absent {
  key: string;
  name: string;
  rule: Rule;
  start: Json;
}
/** Numbers, choices and flags that a table of the study may have and has not: with what they begin. */
export const absent = (schema: JsonObject | null, study: JsonObject, path: string): Absent[] =>
  onceFor(saidOf(schema, study).absent, path, () => findAbsent(schema, study, path));

function findAbsent(schema: JsonObject | null, study: JsonObject, path: string): Absent[] {
  const node = nodeAt(schema, study, path);
  const table = stepsOf(path).reduce<Json | undefined>((at, step) => (at !== null && typeof at === "object" ? (at as Record<string, Json>)[step] : undefined), study);
  if (!node || !isTable(table)) return [];
  const known = forms(node, table).find((form) => isTable(form.properties));
  return Object.entries((known?.properties ?? {}) as JsonObject).flatMap(([name, own]) => {
    if (name in table || !isTable(own)) return [];
    const rule = ruleOf(own);
    if (!rule.choices && !rule.flag && !numberIn(own) && !rule.count) return [];
    const number = rule.least !== undefined && (rule.least > 0 || rule.open) ? Math.max(1, rule.least) : 0;
    const start = rule.start ?? (rule.choices ? rule.choices[0].value : rule.flag ? false : rule.count ? Array<number>(rule.count).fill(0) : number);
    return [{ key: path ? `${path}.${name}` : name, name, rule, start }];
  });
}
