// Unpacks what the report carries, and then starts the viewer. Should anything go wrong, the form without scripts stays on the page.
import { inflate, parseWith, textWith, unpackLists } from "./packed";

const carried = (id: string) => inflate(document.getElementById(id)!.textContent!);

async function boot(): Promise<void> {
  const scripts = [...document.querySelectorAll('script[type="text/plain"][id$="-script"]')].map((script) => script.id);
  const [numbers, ...texts] = await Promise.all(["numbers", "numbers-index", "result-data", "view-data", ...scripts].map(carried));
  const [index, result, view, ...codes] = texts.map((bytes) => new TextDecoder().decode(bytes));
  const lists = unpackLists(JSON.parse(index), new Uint8Array(numbers));
  // `linkwright` is what the viewer reads (data.ts).
  Object.assign(globalThis, {
    linkwright: { view: parseWith(lists, view), result: parseWith(lists, result), resultText: () => textWith(lists, result) },
  });
  for (const code of codes) {
    const script = document.createElement("script");
    script.textContent = code;
    document.body.append(script);
  }
}

void boot().finally(() => document.documentElement.classList.remove("starting"));
