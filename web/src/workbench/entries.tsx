// SPDX-License-Identifier: BSD-3-Clause

// The row of beginnings: a path leads to the board, everything else to the examples of its kind.
import { showExamples } from "./gallery";
import { showPath } from "./path_sheet";

const entries: { name: string; text: string; hint: string; act: () => void }[] = [
  { name: "path", text: "a path", hint: "Draw the path of a point and get machines that follow it", act: () => (showPath.value = true) },
  { name: "poses", text: "poses", hint: "Examples that carry a body through given poses", act: () => showExamples("guide a body") },
  { name: "function", text: "a function", hint: "Examples whose output is a given function of their input", act: () => showExamples("generate a function") },
  { name: "machine", text: "a machine", hint: "Examples of machines that are analysed", act: () => showExamples("find motion and forces") },
  { name: "points", text: "hard points", hint: "Examples of wheel suspensions", act: () => showExamples("wheel suspensions") },
];

export function Entries() {
  return (
    <nav class="entries" aria-label="Begin with what you have">
      <span>I have:</span>
      {entries.map(({ name, text, hint, act }) => (
        <button type="button" key={name} data-entry={name} title={hint} onClick={act}>{text}</button>))}
    </nav>
  );
}
