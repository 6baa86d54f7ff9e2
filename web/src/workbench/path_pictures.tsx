// SPDX-License-Identifier: BSD-3-Clause

// Pictures of machines that move together, drawn as the pictures of the gallery are.
import { effect, signal } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import type { Scene } from "../data";
import type { Motion } from "../motion";
import type { Size } from "../view";
import { pictureOf, viewBox } from "./thumbnail";

const turn = 5; // s
/** The share of a turn at which all pictures are. */
const phase = signal(0.15);
export const moving = signal(!matchMedia("(prefers-reduced-motion: reduce)").matches);
/** The pictures are on the screen. */
export const watched = signal(false);

let frame = 0;
effect(() => {
  cancelAnimationFrame(frame);
  if (!moving.value || !watched.value) return;
  let before = performance.now();
  const next = (now: number) => {
    phase.value = (phase.peek() + Math.min(0.1, Math.max(0, now - before) / 1000) / turn) % 1;
    before = now;
    frame = requestAnimationFrame(next);
  };
  frame = requestAnimationFrame(next);
});

/** A fractional sample for a share of a turn; a motion without a full turn swings. */
export function positionAt({ samples, runs, fullTurn }: Motion, share: number): number {
  if (fullTurn) return share * (samples - 1);
  const [first, last] = runs[0] ?? [0, 0];
  return first + (last - first) * (1 - Math.abs(1 - 2 * share));
}

export function Moving({ scene, size, label }: { scene: Scene; size: Size; label: string }) {
  const svg = useRef<SVGSVGElement>(null);
  const pose = useRef<SVGGElement>(null);
  const picture = useMemo(() => pictureOf(scene, size), [scene, size]);
  useEffect(() => {
    if (!picture) return undefined;
    const seen = signal(true); // pictures that are scrolled away stand still
    const observer = new IntersectionObserver((entries) => (seen.value = entries.some((e) => e.isIntersecting)));
    observer.observe(svg.current!);
    const end = effect(() => {
      if (seen.value) pose.current!.innerHTML = picture.pose(positionAt(picture.motion, phase.value));
    });
    return () => {
      end();
      observer.disconnect();
    };
  }, [picture]);
  return (
    <svg ref={svg} class="thumbnail" viewBox={viewBox(size)} role="img" aria-label={label}>
      {picture && <><g dangerouslySetInnerHTML={{ __html: picture.under }} /><g dangerouslySetInnerHTML={{ __html: picture.over }} /><g ref={pose} class="moving" /></>}
    </svg>
  );
}
