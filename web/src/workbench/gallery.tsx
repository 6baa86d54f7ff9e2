// SPDX-License-Identifier: BSD-3-Clause

// The examples and templates to begin with.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Example } from "./engine";
import { pictures } from "./pictures";
import { catalogue, open } from "./session";
import { small, viewBox } from "./thumbnail";

export const showGallery = signal(false);
const words = signal("");

/** Opens the gallery with the examples that have these words. */
export function showExamples(with_: string): void {
  words.value = with_;
  showGallery.value = true;
}

const Card = ({ example }: { example: Example }) => (
  <button type="button" class="example" data-example={example.name} onClick={() => {
    open({ name: `${example.name}.toml`, text: example.text, files: example.beside });
    showGallery.value = false;
  }}>
    <svg class="thumbnail" viewBox={viewBox(small)} aria-hidden="true" dangerouslySetInnerHTML={{ __html: pictures().examples[example.name] ?? "" }} />
    <b>{example.title}</b>
    <small>{example.name}</small>
  </button>
);

/** The card next to this one in a direction: along the row, or the nearest one of the row above or below. */
function neighbour(cards: HTMLElement[], from: HTMLElement, key: string): HTMLElement | undefined {
  const at = cards.indexOf(from);
  if (key === "ArrowLeft" || key === "ArrowRight") return cards[at + (key === "ArrowRight" ? 1 : -1)];
  const box = from.getBoundingClientRect();
  const rows = cards.map((card) => ({ card, box: card.getBoundingClientRect() }))
    .filter((c) => (key === "ArrowDown" ? c.box.top >= box.bottom : c.box.bottom <= box.top));
  const row = key === "ArrowDown" ? Math.min(...rows.map((c) => c.box.top)) : Math.max(...rows.map((c) => c.box.top));
  return rows.filter((c) => c.box.top === row).sort((a, b) => Math.abs(a.box.left - box.left) - Math.abs(b.box.left - box.left))[0]?.card;
}

/** Arrows go from card to card, down from the search to the first one and up to it again; Enter in the search opens the first. */
function onGalleryKey(event: KeyboardEvent): void {
  const dialog = event.currentTarget as HTMLElement;
  const target = event.target as HTMLElement;
  const cards = [...dialog.querySelectorAll<HTMLElement>(".example")];
  // A browser would only empty the search at the first Escape.
  if (event.key === "Escape") showGallery.value = false;
  else if (target instanceof HTMLInputElement) {
    if (event.key === "ArrowDown") cards[0]?.focus();
    else if (event.key === "Enter") cards[0]?.click();
    else return;
  } else {
    if (!event.key.startsWith("Arrow") || !target.classList.contains("example")) return;
    (neighbour(cards, target, event.key) ?? (event.key === "ArrowUp" ? dialog.querySelector("input") : null))?.focus();
  }
  event.preventDefault();
}

export function Gallery() {
  const box = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    if (showGallery.value) box.current?.showModal();
    else box.current?.close();
  }, [showGallery.value]);
  const all = catalogue.value?.examples ?? [];
  const asked = words.value.toLowerCase().split(/\s+/).filter(Boolean);
  const found = all.filter((e) => asked.every((w) => [w, w.length > 3 ? w.replace(/(ie)?e?s$/, "") : w].some((s) => `${e.name} ${e.title} ${e.group} ${e.words}`.toLowerCase().includes(s))));
  const groups = [...new Set(found.map((e) => e.group))];
  return (
    <dialog class="gallery" ref={box} aria-label="Examples" onClose={() => {
      showGallery.value = false;
      words.value = "";
    }} onKeyDown={onGalleryKey}>
      <header>
        <h2>Begin with</h2>
        <input type="search" placeholder="leg, suspension, quick return" aria-label="Search the examples" value={words.value} onInput={(e) => (words.value = e.currentTarget.value)} />
        <button type="button" onClick={() => (showGallery.value = false)}>Close</button>
      </header>
      {showGallery.value && groups.map((group) => (
        <section>
          <h3>{group}</h3>
          <div class="examples">{found.filter((e) => e.group === group).map((e) => <Card key={e.name} example={e} />)}</div>
        </section>
      ))}
      {found.length === 0 && <p>{catalogue.value ? "No example has these words." : "The examples are being read."}</p>}
    </dialog>
  );
}
