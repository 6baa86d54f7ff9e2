// SPDX-License-Identifier: BSD-3-Clause

// The program as the engine of a page that it serves itself (`linkwright serve`), and the file that it was started with.
import type { JsonObject } from "../data";
import { withNumbers, readAnswer, Stopped, type Catalogue, type Engine, type Progress } from "./engine";

/** The token comes in the fragment of the address, which stays in the browser, and is kept for reloads and other tabs. */
export function takeToken(): string {
  const place = "linkwright.token";
  const given = /^#token=(\w+)$/.exec(location.hash)?.[1];
  try {
    if (given) localStorage.setItem(place, given);
    else return localStorage.getItem(place) ?? "";
  } catch {
    // nowhere to keep it
  }
  if (given) history.replaceState(null, "", location.pathname);
  return given ?? "";
}

/** Asks the server that the page is from. What it refuses is an error with its words. */
export type Ask = (method: string, path: string, body?: string, more?: RequestInit) => Promise<Response>;
export const asks = (token: string): Ask => async (method, path, body, more) => {
  const asked = { method, body, cache: "no-store" as const, ...more, headers: { Authorization: `Bearer ${token}`, ...more?.headers } };
  const response = await fetch(path, asked).catch((error: unknown) => {
    throw more?.signal?.aborted ? error : new Error("the program does not answer; is linkwright serve still running?");
  });
  if (!response.ok) throw new Error((await response.text()) || `the server answers ${response.status}`);
  return response;
};

/** The frames of an answer as they come: two lengths in four bytes each, numbers in eight, a document. */
async function frames(response: Response, take: (json: string, numbers: Float64Array) => void): Promise<void> {
  const reader = response.body!.getReader();
  let parts: Uint8Array[] = [];
  let size = 0;
  const joined = () => {
    const all = new Uint8Array(size);
    let at = 0;
    for (const part of parts) {
      all.set(part, at);
      at += part.length;
    }
    parts = [all];
    return all;
  };
  let wanted = 8;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value);
    size += value.length;
    while (size >= wanted) {
      const all = joined();
      const [json, numbers] = new Uint32Array(all.buffer, 0, 2);
      const end = 8 + 8 * numbers + json;
      wanted = end;
      if (size < end) break;
      take(new TextDecoder().decode(all.subarray(end - json, end)), new Float64Array(all.buffer, 8, numbers));
      parts = [all.slice(end)];
      size -= end;
      wanted = 8;
    }
  }
}

/** Its runs are those of one tab: the next ends the one before. */
export function serverEngine(ask: Ask): Engine {
  const tab = Array.from(crypto.getRandomValues(new Uint8Array(16)), (b) => b.toString(16).padStart(2, "0")).join("");
  let count = 0;
  let running: AbortController | null = null;
  const cancel = () => void ask("POST", "/cancel", `${tab}.${count}`).catch(() => {});
  return {
    catalogue: async () => withNumbers(await (await ask("GET", "/catalogue")).text(), new Float64Array()) as unknown as Catalogue,
    schema: async (kind) => (await (await ask("GET", `/schema/${kind}`)).json()) as JsonObject | null,
    run: async ({ text, edits = [], files = {}, seconds = 0 }, progress) => {
      const own = (running = new AbortController());
      try {
        const body = JSON.stringify({ run: `${tab}.${++count}`, text, edits: edits.length ? JSON.stringify({ edits }) : "", files, seconds });
        let last: { json: string; numbers: Float64Array } | null = null;
        await frames(await ask("POST", "/run", body, { signal: own.signal }), (json, numbers) => {
          if (json.startsWith('{"progress":')) progress?.((JSON.parse(json) as { progress: Progress }).progress);
          else last = { json, numbers };
        });
        if (!last) throw new Error("the program ended in the middle of its answer");
        const { json, numbers } = last as { json: string; numbers: Float64Array };
        return readAnswer(json, numbers);
      } catch (error) {
        throw own.signal.aborted ? new Stopped("stopped") : error;
      }
    },
    kept: () => [], // its threads share a run
    finish: cancel,
    stop: () => {
      running?.abort();
      cancel();
    },
  };
}

export interface Opened {
  name: string;
  text: string;
  version: string;
}

/** The file that the server was started with, if there is one. */
export async function openedFile(ask: Ask): Promise<Opened | null> {
  const answer = await ask("GET", "/study");
  return answer.status === 204 ? null : ((await answer.json()) as Opened);
}

/** Writes it, unless somebody else has changed it since; what it is then. */
export async function saveFile(ask: Ask, file: Opened, text: string): Promise<Opened> {
  const saved = await ask("PUT", "/study", text, { headers: { "If-Match": `"${file.version}"` } });
  return { ...file, text, version: ((await saved.json()) as { version: string }).version };
}
