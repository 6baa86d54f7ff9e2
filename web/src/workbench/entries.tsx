// SPDX-License-Identifier: BSD-3-Clause

// What somebody who comes has, and where that leads: a path to the board, everything else to the examples of its kind.
import { showExamples } from "./gallery";
import { showPath } from "./path_sheet";

const entries: { name: string; text: string; hint: string; act: () => void }[] = [
  { name: "path", text: "a path", hint: "Draw the path of a point and get machines that follow it", act: () => (showPath.value = true) },
  { name: "poses", text: "poses", hint: "Examples that carry a body through given poses", act: () => showExamples("poses") },
  { name: "function", text: "a function", hint: "Examples whose output is a given function of their input", act: () => showExamples("function") },
  { name: "machine", text: "a machine", hint: "Examples of machines that are analysed", act: () => showExamples("analysis") },
  { name: "points", text: "hard points", hint: "Examples of wheel suspensions", act: () => showExamples("suspension") },
];

export function Entries({ chosen }: { chosen?: () => void }) {
  return (
    <nav class="entries" aria-label="Begin with what you have">
      <span>I have</span>
      {entries.map(({ name, text, hint, act }) => (
        <button type="button" key={name} data-entry={name} title={hint} onClick={() => {
          chosen?.();
          act();
        }}>{text}</button>))}
    </nav>
  );
}
