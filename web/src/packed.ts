// SPDX-License-Identifier: BSD-3-Clause

// The small form in which a report carries its data; the program writes it (src/linkwright/report/packed.h).
import { jsonNumber } from "./decimal";

export type Num = number | null;

export function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  // A loop: the engine of the workbench is millions of characters, over which an iterator takes a tenth of a second.
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** The bytes that base64 of raw deflate encodes. */
export async function inflate(base64: string): Promise<ArrayBuffer> {
  return new Response(new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).arrayBuffer();
}

type Entry = [count: number, order: number, decimals: number | null];
const missingWhole = -(2 ** 31);

const toUrl = (base64: string) => base64.replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
const fromUrl = (text: string) => text.replace(/-/g, "+").replace(/_/g, "/");

/** A text as part of an address. */
export async function pack(text: string): Promise<string> {
  const packed = await new Response(new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"))).arrayBuffer();
  return toUrl(btoa(Array.from(new Uint8Array(packed), (b) => String.fromCharCode(b)).join("")));
}
export const unpack = async (packed: string) => new TextDecoder().decode(await inflate(fromUrl(packed)));

/** Lists of numbers from their bytes: see NumberPack. */
export function unpackLists(index: Entry[], bytes: Uint8Array): Num[][] {
  let at = 0;
  return index.map(([count, order, decimals]) => {
    const words = decimals === null ? 2 : 1;
    const [low, high] = [0, 1].map((word) => {
      const out = new Uint32Array(word < words ? count : 0);
      for (let byte = 0; byte < 4; ++byte) for (let i = 0; i < out.length; ++i) out[i] |= bytes[at++] << (8 * byte);
      return out;
    });
    const odd = (i: number) => -(low[i] & 1);
    for (let i = 0; i < count; ++i) {
      const sign = odd(i);
      low[i] = ((low[i] >>> 1) | (words === 2 ? high[i] << 31 : 0)) ^ sign;
      if (words === 2) high[i] = (high[i] >>> 1) ^ sign;
    }
    for (let k = 0; k < order; ++k)
      for (let i = 1; i < count; ++i) {
        const sum = low[i] + low[i - 1];
        low[i] = sum;
        if (words === 2) high[i] += high[i - 1] + (sum > 0xffffffff ? 1 : 0);
      }
    if (decimals !== null) {
      const power = Number(`1e${decimals}`); // exact, which 10 ** n need not be
      return Array.from(new Int32Array(low.buffer), (whole) => (whole === missingWhole ? null : whole / power));
    }
    const both = new DataView(new ArrayBuffer(8));
    return Array.from({ length: count }, (_, i) => {
      both.setUint32(0, high[i]);
      both.setUint32(4, low[i]);
      const value = both.getFloat64(0);
      return Number.isNaN(value) ? null : value;
    });
  });
}

// A text in JSON escapes its quotes, and the program writes no member without a name.
const place = /\{"":(\d+)\}/g;

/** A text of JSON whose long lists were taken out. */
export const parseWith = (lists: Num[][], text: string) =>
  JSON.parse(text, (_, value) => (typeof value?.[""] === "number" ? lists[value[""]] : value));

/** The same text with its lists, as the program writes files. */
export const textWith = (lists: Num[][], text: string) => text.replace(place, (_, i) => `[${lists[i].map(jsonNumber).join(", ")}]`);

/** The contents of a report, from the texts of its elements. */
export async function unpackReport(textOf: (id: string) => string) {
  const [numbers, ...texts] = await Promise.all(["numbers", "numbers-index", "result-data", "view-data"].map((id) => inflate(textOf(id))));
  const [index, result, view] = texts.map((bytes) => new TextDecoder().decode(bytes));
  const lists = unpackLists(JSON.parse(index), new Uint8Array(numbers));
  return { view: parseWith(lists, view), result: parseWith(lists, result), resultText: () => textWith(lists, result) };
}
