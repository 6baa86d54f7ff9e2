// SPDX-License-Identifier: BSD-3-Clause

// A button that unfolds a list of choices. Enter or a press opens it and the focus goes in, arrows move, Escape leads back to the button.
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { moveFocus } from "./controls";

export function Menu({ label, title, kind = "", id, busy = false, children }: { label: string; title?: string; kind?: string; id?: string; busy?: boolean; children: ComponentChildren }) {
  const box = useRef<HTMLDetailsElement>(null);
  const button = () => box.current!.querySelector("summary")!;
  const close = () => {
    box.current!.open = false;
    button().focus();
  };
  useEffect(() => {
    const outside = (event: Event) => {
      if (!box.current!.contains(event.target as Node)) box.current!.open = false;
    };
    for (const type of ["pointerdown", "focusin"]) document.addEventListener(type, outside);
    return () => {
      for (const type of ["pointerdown", "focusin"]) document.removeEventListener(type, outside);
    };
  }, []);
  return (
    <details class={`menu ${kind}`} id={id} ref={box} onToggle={() => box.current!.open && box.current!.querySelector<HTMLElement>(".choices button")?.focus({ preventScroll: true })} onKeyDown={(e) => {
      if (e.key === "Escape" && box.current!.open) {
        e.stopPropagation();
        e.preventDefault();
        close();
      } else if (box.current!.open) moveFocus(e, ".choices button");
      else if (e.key === "ArrowDown") {
        e.preventDefault();
        box.current!.open = !busy;
      }
    }}>
      <summary aria-disabled={busy} title={title} onClick={(e) => busy && e.preventDefault()}>{label}</summary>
      {/* The chosen entry may take the focus itself. */}
      <div class="choices" onClickCapture={(e) => (e.target as HTMLElement).closest("button") && close()}>{children}</div>
    </details>
  );
}
