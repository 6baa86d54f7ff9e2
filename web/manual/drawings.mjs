// SPDX-License-Identifier: BSD-3-Clause

// Small drawings of studies, as the program makes them.
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const seconds = "4"; // for each; what is found by then is drawn

/** By the path of each study: its first drawing. */
export function drawings(ask, paths) {
  const made = new Map();
  const folder = mkdtempSync(join(tmpdir(), "linkwright-manual-"));
  for (const [i, path] of paths.entries()) {
    const out = join(folder, String(i));
    try {
      ask("run", path, "--out", out, "--quiet", "--time-limit", seconds, "--set", 'output.formats=["svg"]');
    } catch {
      // A study whose check fails when it is cut short is drawn all the same.
    }
    let names = [];
    try {
      names = readdirSync(out).filter((n) => n.endsWith(".svg")).sort();
    } catch {
      continue;
    }
    if (names.length) made.set(path, readFileSync(join(out, names[0]), "utf8"));
  }
  rmSync(folder, { recursive: true });
  return made;
}
