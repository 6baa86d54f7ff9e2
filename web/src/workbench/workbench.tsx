// SPDX-License-Identifier: BSD-3-Clause

// The workbench: a study, its mechanism to take hold of, and all that comes of it, while it is changed.
import { decompress } from "fzstd";
import { render } from "preact";
import { signal } from "@preact/signals";
import { Switch } from "../controls";
import { Menu } from "../menu";
import { bytesOf, inflate } from "../packed";
import { Report } from "../report";
import * as state from "../state";
import "../report.css";
import "../viewer.css";
import "./workbench.css";
import "./lists.css";
import "./path.css";
import { asFragment, begin, canRedo, canUndo, copies, document_, fromFragment, kept, redo, replace, undo, type Document } from "./document";
import { Draw, showDraw } from "./draw";
import { Entries } from "./entries";
import { workerEngine, type Catalogue, type Engine, type Example, type Progress } from "./engine";
import { sortOut } from "./files";
import { Gallery, showGallery } from "./gallery";
import { opened, saveStudy, unsaved } from "./opened";
import { Panel } from "./panel";
import { PathDialog } from "./path_dialog";
import { connectSearch } from "./path_search";
import { pictures } from "./pictures";
import { isPoses } from "./points";
import { asks, openedFile, serverEngine, takeToken, type Opened, type Ask } from "./server_engine";
import { adding, busy, catalogue, compareWithNow, connect, editing, ending, open, progress, shown, stop, stopped, takePoints, targetKey, took, trouble, waiting } from "./session";

const said = signal("");

async function share(): Promise<void> {
  history.replaceState(null, "", await asFragment(document_.value));
  try {
    await navigator.clipboard.writeText(location.href);
    said.value = "link copied";
  } catch {
    said.value = "the link is in the address";
  }
}

async function copyAs(form: keyof typeof copies): Promise<void> {
  try {
    await navigator.clipboard.writeText(copies[form](document_.value));
    said.value = `${form} copied`;
  } catch {
    said.value = "not copied: the browser keeps the clipboard";
  }
}

async function keepStudy(): Promise<void> {
  said.value = await saveStudy();
}

async function openFiles(list: FileList): Promise<void> {
  try {
    const { study, tables } = await sortOut(await Promise.all([...list].map(async (f) => ({ name: f.name, text: await f.text() }))));
    if (study) return open({ ...study, files: tables });
    const [name, ...more] = Object.keys(tables);
    if (targetKey.value && !more.length && !document_.value.text.includes(name)) return await takePoints(name, tables[name]);
    // The files that the present study reads.
    replace({ ...document_.value, files: { ...document_.value.files, ...tables } });
  } catch (error) {
    stopped.value = error instanceof Error ? error.message : String(error);
  }
}

const best = ({ best }: Progress) => (Number.isFinite(best) ? `, best ${best.toPrecision(4)}` : "");

function State() {
  if (trouble.value) return <span class="state bad" role="alert">{trouble.value}</span>;
  if (stopped.value) return <span class="state bad" id="stopped" role="status">{stopped.value}</span>;
  if (waiting.value)
    return (
      <span class="state busy" role="status">
        {ending.value ? "taking the best so far" : progress.value ? `${progress.value.stage.replace(/_/g, " ")} ${Math.round(100 * progress.value.fraction)} %${best(progress.value)}` : "running"}
        <button type="button" id="stop" title={ending.value ? "End at once, without an answer" : "End with the best so far"} onClick={stop}>{ending.value ? "Drop" : "Stop"}</button>
      </span>
    );
  const ms = (value: number) => `${value < 10 ? value.toFixed(1) : Math.round(value)} ms`;
  return <span class="state" role="status" id={busy.value ? undefined : "took"} title={took.value ? `${ms(took.value.engine)} in the engine, ${ms(took.value.whole)} from the question to the page` : undefined}>{said.value || (took.value ? ms(took.value.engine) : "")}</span>;
}

function Bar() {
  return (
    <header class="bar bench-bar" aria-label="Workbench">
      <b class="brand">Linkwright</b>
      <button type="button" id="examples" onClick={() => (showGallery.value = true)}>Examples</button>
      <button type="button" id="draw" onClick={() => (showDraw.value = true)}>Draw</button>
      <label class="button">Open<input type="file" multiple accept=".toml,.json,.html,.csv,.txt" aria-label="Open a study and the tables it reads, a report, or target points" onChange={(e) => {
        if (e.currentTarget.files?.length) void openFiles(e.currentTarget.files);
        e.currentTarget.value = "";
      }} /></label>
      <button type="button" id="save" title="Save the study (Ctrl S)" onClick={() => void keepStudy()}>Save</button>
      <button type="button" id="undo" disabled={!canUndo.value} title="Undo (Ctrl Z)" onClick={undo}>Undo</button>
      <button type="button" id="redo" disabled={!canRedo.value} title="Redo (Ctrl Y)" onClick={redo}>Redo</button>
      <button type="button" id="compare" aria-pressed={state.behind.value !== null} disabled={!shown.value} title="Keep the curves of now in the diagrams, behind those of what is changed; once more lets them go" onClick={compareWithNow}>Compare</button>
      <button type="button" id="share" title="Copy a link that holds the study" onClick={() => void share()}>Share</button>
      <Menu id="copy" label="Copy as" title="Copy what runs this study: a command for a terminal, or a program">
        {(Object.keys(copies) as (keyof typeof copies)[]).map((form) => <button type="button" key={form} data-copy={form} onClick={() => void copyAs(form)}>{form}</button>)}
      </Menu>
      <span class="together"><Switch flag={editing} text="Change lengths" hint="Dragging a pin changes the links on it, or the pivot alone with Alt; off: dragging moves the mechanism" />{targetKey.value && <Switch flag={adding} text={isPoses(targetKey.value) ? "Add poses" : "Add points"} hint={isPoses(targetKey.value) ? "Press for one more pose, and drag to turn it; Alt and a press on the origin of a pose removes it" : "Press for one more target point, or drag to draw the whole path; Alt and a press on a point removes it"} />}</span>
      <span class={unsaved.value ? "name unsaved" : "name"}>{document_.value.text && document_.value.name}</span>
      <span class="spring" />
      <State />
    </header>
  );
}

/** The contents of the page until the engine answers; the page has it from the start, so that it is seen at once. */
const opening = document.querySelector(".opening")?.innerHTML ?? '<p class="note">The engine starts.</p>';

function Workbench() {
  return (
    <>
      <Bar />
      <Entries />
      <div class="bench">
        <main class="page">{shown.value ? <Report /> : <div class="opening" dangerouslySetInnerHTML={{ __html: opening }} />}</main>
        <Panel />
      </div>
      <Gallery />
      <Draw />
      <PathDialog />
    </>
  );
}

function onKey(event: KeyboardEvent): void {
  if (!event.ctrlKey && !event.metaKey) return;
  const writing = event.target instanceof HTMLTextAreaElement;
  const key = event.key.toLowerCase();
  const act = key === "s" ? () => void keepStudy()
    : writing ? undefined : key === "z" ? (event.shiftKey ? redo : undo) : key === "y" ? redo : undefined;
  if (!act) return;
  event.preventDefault();
  act();
}

const asDocument = (e: Example) => ({ name: `${e.name}.toml`, text: e.text, files: e.beside });

/** The study that an address asks for: the one that it holds, or an example by its name. */
async function asked(hash: string, known: Promise<Catalogue>): Promise<Document | null> {
  const name = /^#example=([\w-]+)$/.exec(hash)?.[1];
  const example = name && (await known).examples.find((e) => e.name === name);
  return example ? asDocument(example) : fromFragment(hash);
}

/** After the page has been painted; a page in the background is not. */
const painted = () => new Promise((resolve) => (document.hidden ? resolve(null) : requestAnimationFrame(() => setTimeout(resolve))));

/** The source of answers for this page: the engine that it carries, or the program that serves it. */
interface Source {
  engine: () => Engine;
  file: { file: Opened; ask: Ask } | null;
}
async function source(): Promise<Source> {
  const wasm = document.getElementById("engine-wasm");
  const script = document.getElementById("engine-script");
  if (wasm instanceof HTMLLinkElement) {
    // Not every host knows the type of the engine, which compiling while it comes asks for.
    const module = await fetch(wasm.href).then((r) => r.arrayBuffer()).then((bytes) => WebAssembly.compile(bytes));
    return { engine: () => workerEngine(module, (script as HTMLLinkElement).href), file: null };
  }
  if (wasm) {
    // Browsers unpack deflate themselves, but that makes the page a quarter larger.
    const [module, code] = await Promise.all([WebAssembly.compile(decompress(bytesOf(wasm.textContent!)) as BufferSource), inflate(script!.textContent!)]);
    const address = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
    return { engine: () => workerEngine(module, address), file: null };
  }
  const ask = asks(takeToken());
  const file = await openedFile(ask);
  return { engine: () => serverEngine(ask), file: file && { file, ask } };
}

async function main(): Promise<void> {
  document.addEventListener("keydown", onKey);
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    if (event.dataTransfer?.files.length) void openFiles(event.dataTransfer.files);
  });
  render(<Workbench />, document.getElementById("app")!);
  await painted();
  const { engine: make, file } = await source();
  const [engine, second] = [make(), make()];
  connect(engine, second);
  connectSearch(make);
  // By the second engine, while the first one runs the study.
  const known = second.catalogue();
  const shared = await asked(location.hash, known);
  if (!shared) opened.value = file;
  const own = file && { name: file.file.name, text: file.file.text, files: {} };
  const { name, text } = pictures().first;
  begin(shared ?? own ?? kept() ?? { name: `${name}.toml`, text, files: {} });
  addEventListener("hashchange", () => void asked(location.hash, known).then((study) => study && open(study)));
  state.start();
  catalogue.value = await known;
}

main().catch((error: unknown) => (trouble.value = `The engine cannot be started: ${error instanceof Error ? error.message : error}`));
