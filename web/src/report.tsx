// All that is shown of a study, in one order for reports and the workbench.
import { Banner, Changes, Checks, Comparisons, Data, Errors, Facts, Parameters, Remarks, Reproduce, Runs, SolutionPicker, Solutions } from "./panels";
import { Machine } from "./player";
import { Fronts, Plots } from "./plots";
import { nowhere, revision, scene } from "./state";

export function Report() {
  revision.value; // everything below is drawn anew with new data
  return (
    <>
      <Banner />
      <div class={scene.value && !nowhere ? "hero" : "hero alone"}>
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
