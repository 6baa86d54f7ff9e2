// What users open or drop: studies, the tables that they read, and the reports and results that were made of studies.
import { oneStudy, type JsonObject } from "../data";
import { unpackReport } from "../packed";
import type { Document } from "./document";

interface Dropped {
  name: string;
  text: string;
}

async function studyOfReport({ name, text }: Dropped): Promise<Document> {
  const page = new DOMParser().parseFromString(text, "text/html");
  if (!page.getElementById("view-data")) throw new Error(`${name} is no report of Linkwright`);
  const { view } = await unpackReport((id) => page.getElementById(id)!.textContent!);
  const study = oneStudy(view);
  if (!study) throw new Error(`${name} is of several studies: open one of them`);
  return { name: name.replace(/html?$/i, "toml"), text: study, files: {} };
}

function studyOf({ name, text }: Dropped): Document {
  if (/^\s*\{/.test(text)) {
    try {
      const { study } = JSON.parse(text) as JsonObject;
      if (study) return { name, text: JSON.stringify(study, null, 2), files: {} };
    } catch {
      // The engine says where it is wrong.
    }
  }
  return { name, text, files: {} };
}

/** The study among some files, with the others beside it; of tables alone, only these. */
export async function sortOut(files: Dropped[]): Promise<{ study: Document | null; tables: Record<string, string> }> {
  const is = (ending: RegExp) => files.find((f) => ending.test(f.name));
  const report = is(/\.html?$/i);
  const own = is(/\.toml$/i) ?? is(/\.json$/i);
  const chosen = own ?? report;
  const tables = Object.fromEntries(files.filter((f) => f !== chosen).map((f) => [f.name, f.text]));
  if (!chosen) return { study: null, tables };
  const study = own ? studyOf(own) : await studyOfReport(report!);
  return { study: { ...study, files: tables }, tables };
}
