import { render } from "preact";
import { Banner, Changes, Checks, Comparisons, Data, Errors, Facts, Parameters, Remarks, Reproduce, Runs, SolutionPicker, Solutions } from "./panels";
import { follow } from "./link";
import { Machine } from "./player";
import { Fronts, Plots } from "./plots";
import { keepStills } from "./space_stage";
import { nowhere, scene, start } from "./state";
import "./viewer.css";

function Report() {
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

// Should anything go wrong before the report stands, the form without scripts stays on the page.
const app = document.getElementById("app")!;
const plain = document.getElementById("static")!;
keepStills(plain);
start();
follow();
addEventListener("hashchange", follow);
render(<Report />, app);
app.hidden = false;
plain.remove();
