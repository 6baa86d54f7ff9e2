// SPDX-License-Identifier: BSD-3-Clause
import { render } from "preact";
import { follow } from "./link";
import type { Carried } from "./data";
import { Report } from "./report";
import { keepStills } from "./space_stage";
import { load, start } from "./state";
import "./viewer.css";

declare const linkwright: Carried; // by boot.ts

// Should anything go wrong before the report stands, the form without scripts stays on the page.
const app = document.getElementById("app")!;
const plain = document.getElementById("static")!;
keepStills(plain);
load(linkwright);
start();
follow();
addEventListener("hashchange", follow);
render(<Report />, app);
app.hidden = false;
plain.remove();
