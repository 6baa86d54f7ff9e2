import { render } from "preact";
import { Banner, Changes, Checks, Comparisons, Data, Errors, Parameters, Remarks, Reproduce, Runs, SolutionPicker, Solutions } from "./panels";
import { Machine } from "./player";
import { Fronts, Plots } from "./plots";
import { keepStills } from "./space_stage";
import { scene, start } from "./state";
import "./viewer.css";

function Report() {
  return (
    <>
      <Banner />
      {scene.value ? (
        <div class="hero">
          <Machine />
          <div class="aside"><SolutionPicker /><Errors /><Checks /></div>
        </div>
      ) : (
        <Checks />
      )}
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
render(<Report />, app);
app.hidden = false;
plain.remove();
