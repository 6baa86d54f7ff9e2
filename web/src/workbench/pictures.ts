// SPDX-License-Identifier: BSD-3-Clause

// The pictures that the page carries to show before its engine answers, drawn when it was built (draw_examples.mjs).
export interface Pictures {
  examples: Record<string, string>;  // contents of the <svg> of each, by its name
  first: { name: string; title: string; text: string }; // the study that the page opens with
}
let read: Pictures | undefined;
export const pictures = (): Pictures => (read ??= JSON.parse(document.getElementById("pictures")!.textContent!) as Pictures);
