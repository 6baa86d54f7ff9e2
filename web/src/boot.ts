// SPDX-License-Identifier: BSD-3-Clause

// Unpacks what the report carries, and then starts the viewer. Should anything go wrong, the form without scripts stays on the page.
import { inflate, unpackReport } from "./packed";

const textOf = (id: string) => document.getElementById(id)!.textContent!;

async function boot(): Promise<void> {
  const scripts = [...document.querySelectorAll('script[type="text/plain"][id$="-script"]')].map((script) => script.id);
  const [linkwright, codes] = await Promise.all([unpackReport(textOf), Promise.all(scripts.map((id) => inflate(textOf(id))))]);
  Object.assign(globalThis, { linkwright }); // for data.ts
  for (const code of codes) {
    const script = document.createElement("script");
    script.textContent = new TextDecoder().decode(code);
    document.body.append(script);
  }
}

void boot().finally(() => document.documentElement.classList.remove("starting"));
