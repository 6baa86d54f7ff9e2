// SPDX-License-Identifier: BSD-3-Clause

// Exports of the report at the present position.
import { useState } from "preact/hooks";
import { gif, hasVideo, webm } from "./animation";
import { dxf } from "./dxf";
import { drawingSvg, png, save, slug } from "./exports";
import { oneStudy, type Design } from "./data";
import { fragment } from "./link";
import { Menu } from "./menu";
import { pack } from "./packed";
import { isAssembled } from "./motion";
import { space, still } from "./space_stage";
import { designShown, goOn, motion, position, scene, spatial, view } from "./state";

// In space the drawing is the three views of the printed page, and the picture what is on the screen.
const svg = () => (spatial.value ? new XMLSerializer().serializeToString(still()!) : drawingSvg(document.querySelector<SVGSVGElement>("#drawing")!));
const picture = () => (spatial.value && space.value ? space.value.picture() : png(svg()));
const sample = () => {
  const at = Math.round(position.value);
  return isAssembled(motion.value, at) ? at : (motion.value.runs[0]?.[0] ?? 0);
};

/** The address shows the link too, for where the clipboard is out of reach. */
async function copyLink(): Promise<string> {
  history.replaceState(null, "", fragment());
  await navigator.clipboard.writeText(location.href);
  return "link copied";
}

/** The page of the workbench is looked for beside the report. */
async function openWorkbench(name: string): Promise<void> {
  window.open(`workbench.html#study=${await pack(JSON.stringify({ name: `${name}.toml`, text: oneStudy(view) }))}`);
}

async function copyDesign(design: Design): Promise<string> {
  await navigator.clipboard.writeText(design.toml);
  return "study copied";
}

export function ExportMenu() {
  const [said, say] = useState("");
  const [busy, setBusy] = useState(false);
  const name = slug(view.title);
  const design = designShown.value;
  /** Runs a choice, and what went wrong is said beside the menu. */
  const choose = async (act: () => string | void | Promise<string | void>) => {
    setBusy(true);
    try {
      say((await act()) ?? "");
    } catch (error) {
      say(`not possible: ${error instanceof Error ? error.message : error}`);
    }
    setBusy(false);
  };
  const film = (make: typeof gif, type: string) => async () =>
    save(`${name}.${type}`, await make((share) => say(`${type === "gif" ? "GIF" : "WebM"} ${Math.round(100 * share)} %`)));
  const moves = motion.value.samples > 1 && motion.value.runs.length > 0 && (!spatial.value || space.value !== null);
  return (
    <>
      <span class="said" role="status">{said}</span>
      <Menu label="Export" busy={busy}>
        <button type="button" data-export="link" onClick={() => choose(copyLink)}>Copy link to this position</button>
        <button type="button" class="get" data-download="svg" onClick={() => choose(() => save(`${name}.svg`, svg(), "image/svg+xml"))}>Drawing (SVG)</button>
        <button type="button" class="get" data-download="png" onClick={() => choose(async () => save(`${name}.png`, await picture()))}>Picture (PNG)</button>
        <button type="button" class="get" data-download="dxf" onClick={() => choose(() => save(`${name}.dxf`, dxf(scene.value!, sample()), "application/dxf"))}>Drawing (DXF, 1:1 mm)</button>
        {moves && <button type="button" class="get" data-download="gif" onClick={() => choose(film(gif, "gif"))}>Animation (GIF)</button>}
        {moves && hasVideo() && <button type="button" class="get" data-download="webm" onClick={() => choose(film(webm, "webm"))}>Animation (WebM)</button>}
        {design && <button type="button" class="get" data-download="design" onClick={() => choose(() => save(`${design.name}.toml`, design.toml))}>Study of this design</button>}
        {design && <button type="button" data-export="design" onClick={() => choose(() => copyDesign(design))}>Copy the study of this design</button>}
        {view.files.map((file) => <button type="button" class="get" data-download={file.name} onClick={() => choose(() => save(file.name, file.text))}>Points: {file.name}</button>)}
        {oneStudy(view) && !goOn.now && <button type="button" data-export="workbench" title="Opens workbench.html in the folder of this report; the workbench opens reports, too" onClick={() => choose(() => openWorkbench(name))}>Open in the workbench</button>}
      </Menu>
    </>
  );
}
