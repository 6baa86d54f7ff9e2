// What the reader has chosen; the data of the report never change.
import { computed, effect, signal } from "@preact/signals";
import { readResult, readView, type Scene } from "./data";
import { advance, analyse, isAssembled, type Motion } from "./motion";
import { readLog } from "./log";

export const view = readView();
export const result = readResult();
export const runs = readLog(result.log);

const motions = view.scenes.map(analyse);
export const sceneIndex = signal(0);
export const scene = computed<Scene | undefined>(() => view.scenes[sceneIndex.value]);
export const motion = computed<Motion>(() => motions[sceneIndex.value] ?? { samples: 0, input: [], ok: [], runs: [], fullTurn: false });

const calm = matchMedia("(prefers-reduced-motion: reduce)");
export const position = signal(0);
export const direction = signal<1 | -1>(1);
export const playing = signal(false);
export const held = signal(false); // a pointer scrubs: the motion waits
export const speed = signal(1);
export const bounce = signal(false);

export const showTrace = signal(true);
export const showSpeed = signal(false);
export const showTargets = signal(true);
export const showGhosts = signal(false);
export const showLabels = signal(true);
export const whisker = signal<number | "auto">("auto");

// Changes whenever the colours on the page do: plots are painted, not styled.
export const theme = signal(0);
for (const query of ["(prefers-color-scheme: dark)", "print"])
  matchMedia(query).addEventListener("change", () => theme.value++);
export let printing = false;
const print = (now: boolean) => {
  printing = now;
  if (now) document.documentElement.dataset.theme = "light";
  else delete document.documentElement.dataset.theme;
  theme.value++;
};
addEventListener("beforeprint", () => print(true));
addEventListener("afterprint", () => print(false));

export function showScene(index: number): void {
  if (index < 0 || index >= view.scenes.length) return;
  const m = motions[index];
  sceneIndex.value = index;
  bounce.value = !m.fullTurn;
  if (!isAssembled(m, position.value)) position.value = m.runs[0]?.[0] ?? 0;
}

/** Shows a place of the motion; the animation stops. */
export function scrub(to: number): void {
  playing.value = false;
  position.value = to;
}

export function start(): void {
  showScene(0);
  playing.value = motion.value.runs.length > 0 && !calm.matches;
  let frame = 0;
  effect(() => {
    cancelAnimationFrame(frame);
    if (!playing.value || held.value) return;
    let before = performance.now();
    const turn = (now: number) => {
      // A tab that slept does not leap. At normal speed the whole input range takes five seconds.
      const seconds = Math.min(0.1, Math.max(0, now - before) / 1000);
      before = now;
      const next = advance(motion.peek(), { position: position.peek(), direction: direction.peek() }, (seconds * speed.peek()) / 5, bounce.peek());
      position.value = next.position;
      direction.value = next.direction;
      frame = requestAnimationFrame(turn);
    };
    frame = requestAnimationFrame(turn);
  });
}
