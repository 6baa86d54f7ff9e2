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
