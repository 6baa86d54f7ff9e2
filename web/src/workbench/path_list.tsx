// SPDX-License-Identifier: BSD-3-Clause

// The machines that were found, best first: they move, two of them can be compared, and one can be opened.
import { computed, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { Switch } from "../controls";
import type { Size } from "../view";
import { replace } from "./document";
import { ended, machines, round, rounds, share, startSearch, stopSearch, type Machine } from "./path_search";
import { moving, Moving } from "./path_pictures";
import { sheet, showPath } from "./path_sheet";
import { small } from "./thumbnail";

/** The machines that are compared, at most two; they stay when the list is replaced. */
const chosen = signal<Machine[]>([]);
const compared = computed(() => (machines.value.length ? chosen.value : []));
const half: Size = { width: 560, height: 440 };

const same = (machine: Machine) => (other: Machine) => other.study === machine.study;

function choose(machine: Machine, on: boolean): void {
  const others = chosen.value.filter((m) => !same(machine)(m));
  chosen.value = on ? [...others, machine].slice(-2) : others;
}

/** Opens the machine as a study of its own, with the path behind it. */
function openMachine({ name, study }: Machine): void {
  const { path } = sheet.value;
  stopSearch();
  showPath.value = false;
  replace({ name, text: study, files: {}, stroke: path ? { points_mm: path.points.map(({ x, y }) => [x, y]), closed: path.closed } : undefined });
}

const Numbers = ({ machine }: { machine: Machine }) => (
  <dl>{machine.numbers.map(({ label, text }) => <div key={label}><dt>{label}</dt><dd>{text}</dd></div>)}</dl>
);

function Card({ machine }: { machine: Machine }) {
  const { place, label, scene, defects } = machine;
  const name = `machine ${place}, ${label}`;
  return (
    <li class="found" data-machine={place}>
      <Moving scene={scene} size={small} label={`Machine ${place}: ${label}`} />
      <h3>{place}. {label}</h3>
      <Numbers machine={machine} />
      {defects.length > 0 && <p class="note">{defects.join(", ")}</p>}
      <div class="acts">
        <button type="button" class="main" data-open={place} aria-label={`Open ${name}`} onClick={() => openMachine(machine)}>Open</button>
        <label><input type="checkbox" data-compare={place} aria-label={`Compare ${name}`} checked={compared.value.some(same(machine))} onChange={(e) => choose(machine, e.currentTarget.checked)} /> Compare</label>
      </div>
    </li>
  );
}

/** Two machines side by side, at the same angle of the crank. */
function Comparison() {
  const two = compared.value;
  const box = useRef<HTMLElement>(null);
  useEffect(() => box.current?.scrollIntoView({ block: "nearest" }), [two]);
  if (two.length < 2) return two.length ? <p class="note" role="status">Choose a second machine to compare the two.</p> : null;
  const labels = [...new Set(two.flatMap((m) => m.numbers.map((n) => n.label)))];
  return (
    <section ref={box} class="comparison" aria-label="Comparison">
      <div class="two">{two.map((m, k) => <Moving key={k} scene={m.scene} size={half} label={m.label} />)}</div>
      <table>
        <thead><tr><td />{two.map((m, k) => <th key={k} scope="col">{m.label}</th>)}</tr></thead>
        <tbody>{labels.map((label) => <tr key={label}><th scope="row">{label}</th>{two.map((m, k) => <td key={k}>{m.numbers.find((n) => n.label === label)?.text ?? "–"}</td>)}</tr>)}</tbody>
        <tfoot><tr><td />{two.map((m, k) => <td key={k}><button type="button" class="main" onClick={() => openMachine(m)}>Open</button></td>)}</tr></tfoot>
      </table>
      <button type="button" onClick={() => (chosen.value = [])}>End the comparison</button>
    </section>
  );
}

/** The state of the search, in words and as a bar. */
function Progress() {
  const now = round.value;
  const count = machines.value.length;
  if (!sheet.value.path) return <p class="note" id="path-state" role="status">Draw a path on the board. The machines that follow it appear here.</p>;
  const found = count === 1 ? "1 machine" : `${count} machines`;
  return (
    <div class="progress">
      <p id="path-state" role="status" data-ended={ended.value}>{now === null ? `${found} found.` : `${count ? `${found} so far. ` : ""}Run ${now + 1} of ${rounds.length} takes ${rounds[now]} s.`}</p>
      <progress max={rounds.length} value={now === null ? ended.value : now + share.value} aria-label="Progress of the search" />
      {now === null ? <button type="button" id="path-again" onClick={startSearch}>Search again</button> : <button type="button" id="path-stop" onClick={stopSearch}>Stop</button>}
      <Switch flag={moving} text="Move" hint="The pictures move" />
    </div>
  );
}

export function PathList() {
  return (
    <section class="machines" aria-label="Machines">
      <Progress />
      <Comparison />
      <ol>{machines.value.map((m) => <Card key={m.place} machine={m} />)}</ol>
    </section>
  );
}
