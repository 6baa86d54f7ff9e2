// SPDX-License-Identifier: BSD-3-Clause

// All that is shown of a study, in one order for reports and the workbench.
import { Banner, Changes, Checks, Comparisons, Data, Errors, Facts, Parameters, Remarks, Reproduce, Runs, SolutionPicker, Solutions } from "./panels";
import { Machine } from "./player";
import { Fronts, Plots } from "./plots";
import { drawn, paced } from "./state";

export function Report() {
  paced.value; // all words, tables and diagrams are made anew with new data; the mechanism follows by itself, at once
  return (
    <>
      <Banner />
      <div class={drawn.value ? "hero" : "hero alone"}>
        <Machine />
        <div class="aside"><Facts /><SolutionPicker /><Errors /><Checks /></div>
      </div>
      <Fronts />
      <Changes />
      <Plots />
      <Solutions />
      <Parameters />
      <Runs />
      <Comparisons />
      <Remarks />
      <Data />
      <Reproduce />
    </>
  );
}
