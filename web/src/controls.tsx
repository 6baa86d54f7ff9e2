// SPDX-License-Identifier: BSD-3-Clause
import type { Signal } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";

export const toggle = (flag: Signal<boolean>) => (flag.value = !flag.value);

export function Switch({ flag, text, hint }: { flag: Signal<boolean>; text: string; hint: string }) {
  return (
    <button type="button" class="switch" aria-pressed={flag.value} title={hint} onClick={() => toggle(flag)}>{text}</button>
  );
}

/** Says over the stage it stands on that the wheel zooms with Ctrl: without, the wheel scrolls the page, here as elsewhere. */
export function WheelHint() {
  const box = useRef<HTMLParagraphElement>(null);
  const [shown, setShown] = useState(false);
  useEffect(() => {
    const stage = box.current!.parentElement!;
    let timer: ReturnType<typeof setTimeout>;
    const wheel = (event: WheelEvent) => {
      setShown(!event.ctrlKey && !event.metaKey);
      clearTimeout(timer);
      timer = setTimeout(() => setShown(false), 1500);
    };
    stage.addEventListener("wheel", wheel, { capture: true, passive: true });
    return () => {
      clearTimeout(timer);
      stage.removeEventListener("wheel", wheel, { capture: true });
    };
  }, []);
  return <p ref={box} class={shown ? "wheel-hint shown" : "wheel-hint"} aria-hidden="true">Ctrl + wheel zooms</p>;
}

/** Button that copies a text; one that changes is asked for when it is pressed. */
export function Copy({ text, label }: { text: string | (() => string); label?: string }) {
  const [done, setDone] = useState(false);
  const copy = async () => {
    await navigator.clipboard.writeText(typeof text === "string" ? text : text());
    setDone(true);
    setTimeout(() => setDone(false), 1500);
  };
  return <button type="button" class="copy screen-only" aria-label={done ? undefined : label} onClick={() => copy().catch(() => setDone(false))}>{done ? "copied" : "copy"}</button>;
}

/** Arrows, Home and End move the focus along what a list, a menu or a toolbar holds. */
export function moveFocus(event: KeyboardEvent, of: string): void {
  const all = [...(event.currentTarget as HTMLElement).querySelectorAll<HTMLElement>(of)];
  const now = all.indexOf(event.target as HTMLElement);
  const end = all.length - 1;
  const to = ({ ArrowDown: now + 1, ArrowRight: now + 1, ArrowUp: now < 0 ? end : now - 1, ArrowLeft: now < 0 ? end : now - 1, Home: 0, End: end } as Record<string, number>)[event.key];
  if (to === undefined || end < 0 || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  event.stopPropagation();
  all[(to + all.length) % all.length].focus();
}
