import type { Signal } from "@preact/signals";
import { useState } from "preact/hooks";

export const toggle = (flag: Signal<boolean>) => (flag.value = !flag.value);

export function Switch({ flag, text, hint }: { flag: Signal<boolean>; text: string; hint: string }) {
  return (
    <button type="button" class="switch" aria-pressed={flag.value} title={hint} onClick={() => toggle(flag)}>{text}</button>
  );
}

/** Button that copies a text; one that changes is asked for when it is pressed. */
export function Copy({ text }: { text: string | (() => string) }) {
  const [done, setDone] = useState(false);
  const copy = async () => {
    await navigator.clipboard.writeText(typeof text === "string" ? text : text());
    setDone(true);
    setTimeout(() => setDone(false), 1500);
  };
  return <button type="button" class="copy screen-only" onClick={() => copy().catch(() => setDone(false))}>{done ? "copied" : "copy"}</button>;
}
