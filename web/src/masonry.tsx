// SPDX-License-Identifier: BSD-3-Clause

// Cards of diagrams in columns, each as high as its content, with no room left below it.
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";

const gap = 14; // px between cards, as in viewer.css

/** The column of each card: the one that is shortest so far, the left one of equals; -1 = across all of them. */
export function columnsOf(cards: { height: number; wide: boolean }[], count: number): number[] {
  const heights = new Array<number>(count).fill(0);
  return cards.map(({ height, wide }) => {
    // A card is worth a column of its own only when that one is shorter by more than a line of a legend.
    const line = 30;
    const column = wide ? -1 : heights.findIndex((h) => h <= Math.min(...heights) + line);
    if (wide) heights.fill(Math.max(...heights) + height);
    else heights[column] += height;
    return column;
  });
}

/** A card stays in its column as long as the columns are as wide, however its legend grows. */
export function Masonry({ children }: { children: ComponentChildren }) {
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const grid = box.current!;
    let width = 0;
    let known: Element[] = [];
    const lay = () => {
      const cards = [...grid.children] as HTMLElement[];
      const heights = cards.map((card) => card.offsetHeight + gap);
      if (grid.clientWidth !== width || cards.length !== known.length || cards.some((card, i) => card !== known[i])) {
        [width, known] = [grid.clientWidth, cards];
        grid.classList.remove("packed"); // so that there are as many columns as cards have room for
        const count = getComputedStyle(grid).gridTemplateColumns.split(" ").length;
        const sizes = cards.map((card, i) => ({ height: heights[i], wide: card.querySelector(".map.several") !== null }));
        columnsOf(sizes, count).forEach((column, i) => cards[i].style.setProperty("--column", column < 0 ? "1 / -1" : String(column + 1)));
        grid.classList.add("packed");
      }
      cards.forEach((card, i) => card.style.setProperty("--rows", String(heights[i])));
    };
    const sizes = new ResizeObserver(lay);
    const watch = () => {
      sizes.disconnect();
      for (const card of [grid, ...grid.children]) sizes.observe(card);
      lay();
    };
    const cards = new MutationObserver(watch);
    cards.observe(grid, { childList: true });
    watch();
    return () => {
      sizes.disconnect();
      cards.disconnect();
    };
  }, []);
  return <div class="grid-2" ref={box}>{children}</div>;
}
