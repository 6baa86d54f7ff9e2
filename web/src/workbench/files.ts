// SPDX-License-Identifier: BSD-3-Clause

// Files that users open or drop: studies, the tables that they read, and the reports and results that were made of
// studies.
import { oneStudy, type JsonObject } from "../data";
import { unpackReport } from "../packed";

interface Dropped {
  name: string;
  text: string;
}
const isReport = ({ name }: Dropped) => /\.html?$/i.test(name);

async function studyOfReport({ name, text }: Dropped): Promise<Dropped> {
  const page = new DOMParser().parseFromString(text, "text/html");
  if (!page.getElementById("view-data")) throw new Error(`${name} is no report of Linkwright`);
  const { view } = await unpackReport((id) => page.getElementById(id)!.textContent!);
  const study = oneStudy(view);
  if (!study) throw new Error(`${name} is of several studies: open one of them`);
  return { name: name.replace(/html?$/i, "toml"), text: study };
}

function studyOf({ name, text }: Dropped): Dropped {
  if (/^\s*\{/.test(text)) {
    try {
      const { study } = JSON.parse(text) as JsonObject;
      if (study) return { name, text: JSON.stringify(study, null, 2) };
    } catch {
      // The engine says where it is wrong.
    }
  }
  return { name, text };
}

/** The study among some files, and the tables beside it. */
export async function sortOut(files: Dropped[]): Promise<{ study: Dropped | null; tables: Record<string, string> }> {
  const own = files.find((f) => /\.toml$/i.test(f.name)) ?? files.find((f) => /\.json$/i.test(f.name));
  const report = files.find(isReport);
  const tables = Object.fromEntries(files.filter((f) => f !== own && !isReport(f)).map((f) => [f.name, f.text]));
  return { study: own ? studyOf(own) : report ? await studyOfReport(report) : null, tables };
}
