// SPDX-License-Identifier: BSD-3-Clause

// Search, and the live mechanism beside a text. Plain script: pages open from disk.
/* global manual */
"use strict";
(() => {
  const root = document.body.dataset.root;
  const box = document.getElementById("search");
  const found = document.getElementById("found");
  const most = 12;

  /** Each word counts where it stands; all of them have to be there. */
  function rank(words, part) {
    let sum = 0;
    for (const word of words) {
      const inTitle = part.title.toLowerCase().indexOf(word);
      const inText = part.text.toLowerCase().indexOf(word);
      if (inTitle < 0 && inText < 0) return 0;
      sum += inTitle >= 0 ? 10 : 1;
    }
    // The list of messages names every key; what explains one comes first.
    const lists = part.at.startsWith("messages.html") ? 0.1 : 1;
    return (lists * sum) / Math.sqrt(part.title.length);
  }
  function excerpt(words, text) {
    const at = Math.max(0, text.toLowerCase().indexOf(words[0]) - 40);
    return `${at ? "…" : ""}${text.slice(at, at + 150)}…`;
  }
  function search() {
    found.textContent = "";
    const words = box.value.toLowerCase().split(/\s+/).filter((w) => w.length > 1);
    document.body.classList.toggle("searching", words.length > 0);
    if (!words.length) return;
    const all = manual.map((part) => ({ part, rank: rank(words, part) })).filter((f) => f.rank > 0).sort((a, b) => b.rank - a.rank);
    const list = document.createElement("ul");
    for (const { part } of all.slice(0, most)) {
      const link = document.createElement("a");
      link.href = root + part.at;
      const [title, where, text] = ["b", "small", "span"].map((e) => document.createElement(e));
      [title.textContent, where.textContent, text.textContent] = [part.title, part.in, excerpt(words, part.text)];
      link.append(title, where, text);
      list.append(document.createElement("li"));
      list.lastChild.append(link);
    }
    const said = document.createElement("p");
    said.textContent = all.length ? `${all.length} found` : `Nothing has all of: ${words.join(", ")}`;
    found.append(said, list);
  }
  box.addEventListener("input", search);
  // Arrows go down to what is found and up again, Enter opens it, Escape leads back to an empty search.
  function onKey(event) {
    const all = [box, ...found.querySelectorAll("a")];
    const way = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (event.key === "Escape") {
      box.value = "";
      search();
      box.focus();
    } else if (event.key === "Enter" && event.target === box) all[1]?.click();
    else if (way) all[Math.min(all.length - 1, Math.max(0, all.indexOf(event.target) + way))].focus();
    else return;
    event.preventDefault();
  }
  for (const part of [box, found]) part.addEventListener("keydown", onKey);
  document.addEventListener("keydown", (event) => {
    if (event.key !== "/" || event.target instanceof HTMLInputElement) return;
    event.preventDefault();
    box.focus();
  });
  found.addEventListener("click", (event) => {
    if (!event.target.closest("a")) return;
    box.value = "";
    setTimeout(search);
  });

  const frame = document.getElementById("live");
  for (const button of document.querySelectorAll(".live"))
    button.addEventListener("click", () => {
      document.getElementById("no-live").hidden = true;
      frame.hidden = false;
      frame.src = button.dataset.live;
      for (const other of document.querySelectorAll(".live")) other.setAttribute("aria-pressed", String(other === button));
      if (matchMedia("(max-width: 900px)").matches) frame.scrollIntoView();
    });
  // On a phone it would lie over the text, and be loaded by those who only read.
  if (matchMedia("(min-width: 901px)").matches) document.querySelector(".live")?.click();
})();
