// SPDX-License-Identifier: BSD-3-Clause

// The place where the study is saved: the file that the program was started with, while that one is edited, or a
// download.
import { computed, signal } from "@preact/signals";
import { save } from "../exports";
import { document_ } from "./document";
import { saveFile, type Ask, type Opened } from "./server_engine";

export const opened = signal<{ file: Opened; ask: Ask } | null>(null);
const ours = computed(() => (opened.value?.file.name === document_.value.name ? opened.value : null));
/** The file on disk has another text than the study here. */
export const unsaved = computed(() => ours.value !== null && ours.value.file.text !== document_.value.text);

/** Saves the study; what is to be said about it. */
export async function saveStudy(): Promise<string> {
  const { name, text } = document_.peek();
  const to = ours.peek();
  if (!to) {
    save(name, text);
    return "";
  }
  try {
    opened.value = { ...to, file: await saveFile(to.ask, to.file, text) };
    return `${name} saved`;
  } catch (error) {
    // Nothing is lost: what the file does not take is a download.
    save(name, text);
    return `${error instanceof Error ? error.message : error}: saved as a download instead`;
  }
}

addEventListener("beforeunload", (event) => {
  if (unsaved.peek()) event.preventDefault();
});
