// What users open or drop: studies, the tables that they read, and the reports and results that were made of studies.
import type { JsonObject } from "../data";
import { unpackReport } from "../packed";
import type { Document } from "./document";

interface Dropped {
  name: string;
  text: string;
}

const asStudy = (name: string, result: JsonObject): Document => {
  if (typeof result.study !== "object") throw new Error(`${name} holds no study`);
  return { name: name.replace(/(\.result)?\.(html?|json)$/i, ".json"), text: JSON.stringify(result.study, null, 2), files: {} };
};

async function studyOfReport({ name, text }: Dropped): Promise<Document> {
  const page = new DOMParser().parseFromString(text, "text/html");
  if (!page.getElementById("result-data")) throw new Error(`${name} is no report of Linkwright`);
  const { result, resultText } = await unpackReport((id) => page.getElementById(id)!.textContent!);
  if (!result) throw new Error(`${name} was written without its data: open the result.json beside it, or the study`);
  return asStudy(name, JSON.parse(resultText()));
}

function studyOf({ name, text }: Dropped): Document {
  if (/^\s*\{/.test(text)) {
    try {
      const read = JSON.parse(text);
      if (read.study) return asStudy(name, read);
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
