// SPDX-License-Identifier: BSD-3-Clause

// One cycle of the motion as a moving picture, as it plays in the report.
import { applyPalette, GIFEncoder, quantize } from "gifenc";
import { drawingSvg, pictureOf } from "./exports";
import { advance, spanOf, type Motion, type Play } from "./motion";
import { space } from "./space_stage";
import * as state from "./state";

const rate = 20; // pictures a second
const most = 200; // pictures
const widest = 800; // px

/** Positions of one cycle at even steps of time: once round, or there and back. */
export function cycle(motion: Motion, seconds: number, bounce: boolean): number[] {
  if (!motion.runs.length) return [];
  const share = 1 / Math.min(most, Math.max(12, Math.round(seconds * rate)));
  const out: number[] = [];
  let play: Play = { position: motion.runs[0][0], direction: 1 };
  do {
    out.push(play.position);
    const next = advance(motion, play, share, bounce);
    if (bounce ? next.direction > play.direction : next.position <= play.position) break;
    play = next;
  } while (out.length < 2 * most);
  return out;
}

const nextFrame = () => new Promise((resolve) => requestAnimationFrame(resolve));

const nextTask = () => new Promise((resolve) => setTimeout(resolve));

/** Plays the cycle and hands over one picture after the other; then the report stands where it stood. */
async function play(take: (picture: HTMLCanvasElement, index: number) => void | Promise<void>, progress: (share: number) => void): Promise<void> {
  const motion = state.motion.value;
  const seconds = (motion.timed ? spanOf(motion) : 5) / state.speed.value;
  const positions = cycle(motion, seconds, state.bounce.value);
  const before = { position: state.position.value, playing: state.playing.value };
  state.playing.value = false;
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  try {
    for (const [i, position] of positions.entries()) {
      state.position.value = position;
      await (space.value ? nextTask() : nextFrame()); // the page is drawn in frames, space when it is asked for
      const picture = space.value ? space.value.frame() : await pictureOf(drawingSvg(document.querySelector<SVGSVGElement>("#drawing")!));
      if (i === 0) {
        const scale = Math.min(1, widest / picture.width);
        // Videos have an even number of pixels.
        for (const side of ["width", "height"] as const) canvas[side] = 2 * Math.round((picture[side] * scale) / 2);
      }
      context.drawImage(picture, 0, 0, canvas.width, canvas.height);
      await take(canvas, i);
      progress((i + 1) / positions.length);
    }
  } finally {
    state.position.value = before.position;
    state.playing.value = before.playing;
  }
}

export async function gif(progress: (share: number) => void): Promise<Blob> {
  const out = GIFEncoder();
  let palette: number[][] = [];
  await play((picture, i) => {
    const { data, width, height } = picture.getContext("2d")!.getImageData(0, 0, picture.width, picture.height);
    // The colours of the first picture are those of all.
    if (i === 0) palette = quantize(data, 256);
    out.writeFrame(applyPalette(data, palette), width, height, { palette: i === 0 ? palette : undefined, delay: 1000 / rate });
  }, progress);
  out.finish();
  return new Blob([out.bytes()], { type: "image/gif" });
}

export const hasVideo = () => typeof MediaRecorder !== "undefined" && MediaRecorder.isTypeSupported("video/webm");

/** A recorder takes what it sees at the pace at which it sees it: all pictures are made before it starts. */
export async function webm(progress: (share: number) => void): Promise<Blob> {
  const pictures: ImageBitmap[] = [];
  await play(async (picture) => void pictures.push(await createImageBitmap(picture)), (share) => progress(share / 2));
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [pictures[0].width, pictures[0].height];
  const context = canvas.getContext("2d")!;
  context.drawImage(pictures[0], 0, 0);
  const recorder = new MediaRecorder(canvas.captureStream(rate), { mimeType: "video/webm", videoBitsPerSecond: 4e6 });
  const parts: Blob[] = [];
  recorder.ondataavailable = (event) => parts.push(event.data);
  const stopped = new Promise((resolve) => (recorder.onstop = resolve));
  recorder.start();
  for (const [i, picture] of pictures.entries()) {
    context.drawImage(picture, 0, 0);
    await new Promise((resolve) => setTimeout(resolve, 1000 / rate));
    picture.close();
    progress((1 + (i + 1) / pictures.length) / 2);
  }
  recorder.stop();
  await stopped;
  return new Blob(parts, { type: "video/webm" });
}
