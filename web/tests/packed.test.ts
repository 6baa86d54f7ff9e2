// SPDX-License-Identifier: BSD-3-Clause

// The small form of the data: the bytes are those that the program writes (tests/report/packed_test.cpp).
import { describe, expect, it } from "vitest";
import { decimal, jsonNumber } from "../src/decimal";
import { inflate, parseWith, textWith, unpackLists } from "../src/packed";

const bytes = (hex: string) => Uint8Array.from(hex.match(/../g) ?? [], (pair) => parseInt(pair, 16));

/** The bytes of doubles and of whole numbers in the order in which the program keeps them, for any order of differences. */
function pack(values: bigint[], order: number, width: 4 | 8): Uint8Array {
  const bits = 8 * width;
  let left = [...values];
  for (let k = 0; k < order; ++k) left = left.map((v, i) => (i > 0 ? v - left[i - 1] : v));
  const zigzag = left.map((v) => BigInt.asIntN(bits, v)).map((v) => BigInt.asUintN(bits, (v << 1n) ^ (v < 0n ? -1n : 0n)));
  return Uint8Array.from(Array.from({ length: width }, (_, byte) => zigzag.map((v) => Number((v >> BigInt(8 * byte)) & 255n))).flat());
}
const bitsOf = (value: number) => new BigUint64Array(new Float64Array([value]).buffer)[0];

describe("the small form of the data", () => {
  it("is raw deflate in base64", async () => {
    expect(new TextDecoder().decode(await inflate("y8nMyy4vykzPKMnBwgIA"))).toBe("linkwrightlinkwrightlinkwright");
    expect((await inflate("AwA=")).byteLength).toBe(0);
  });
  it("has whole numbers of decimals", () => {
    expect(unpackLists([[8, 2, 1]], bytes(`000a000000000000${"0".repeat(48)}`))).toEqual([[0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5]]);
    expect(unpackLists([[8, 0, 2]], bytes("31ff78577857785700ff05020502050200ff00000000000000ff000000000000"))).toEqual([[-0.25, null, 7, -3, 7, -3, 7, -3]]);
  });
  it("has doubles, bit for bit, whatever the order of differences", () => {
    const values = [0.1, -0.1, 1e300, -0, NaN, 5e-324, 2 ** 52, -1 / 3, Math.PI];
    for (let order = 0; order <= 4; ++order)
      expect(unpackLists([[values.length, order, null]], pack(values.map(bitsOf), order, 8))[0]).toEqual(values.map((v) => (Number.isNaN(v) ? null : v)));
    const wholes = [2147483647n, -2147483647n, 0n, -1n, 65536n, 12345678n];
    for (let order = 0; order <= 4; ++order)
      expect(unpackLists([[wholes.length, order, 9]], pack(wholes, order, 4))[0]).toEqual(wholes.map((v) => Number(v) / 1e9));
  });
  it("stands where the lists were", () => {
    const lists = [[1, null, 1e-5]];
    const text = '{"a": {"":0},"b": "{\\"\\":0}"}';
    expect(parseWith(lists, text)).toEqual({ a: lists[0], b: '{"":0}' });
    expect(textWith(lists, text)).toBe('{"a": [1.0, null, 1e-05],"b": "{\\"\\":0}"}');
  });
});

describe("numbers in files", () => {
  // Numbers as fmt writes them: {} of fmt 9.
  const written: [number, string][] = [[0, "0"], [-0, "-0"], [12, "12"], [0.1, "0.1"], [1e-4, "0.0001"], [1.5e-5, "1.5e-05"], [-1e-300, "-1e-300"],
    [1e15, "1000000000000000"], [1e16, "1e+16"], [123456789012345680000, "1.2345678901234568e+20"], [1 / 3, "0.3333333333333333"], [5e-324, "5e-324"]];
  it("have the digits and the powers of the program", () => {
    for (const [value, text] of written) expect(decimal(value)).toBe(text);
  });
  it("show in JSON that they are no integers", () => {
    expect([1, 1e16, 0.5, null, -0].map(jsonNumber)).toEqual(["1.0", "1e+16", "0.5", "null", "-0.0"]);
  });
});
