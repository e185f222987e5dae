// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Starts the page. `lioView` on the window is for tests, and for whoever is curious.
import {readFrame} from "./frames.js";
import {Link} from "./link.js";
import {Panel} from "./panel.js";
import {Plots} from "./plots.js";
import {Stage} from "./stage.js";
import {TimelineBar} from "./timeline.js";

const byId = id => document.getElementById(id);
const seen = {frames: 0, bytes: 0, poses: 0, scans: 0, lagMs: 0, hello: null, status: null, timeline: null, pose: null};

function makeStage() {
  try {
    return new Stage(byId("stage"));
  } catch {
    hint("This browser draws no WebGL: figures and plots are shown without the map.");
    return null;
  }
}

function hint(text) {
  byId("hint").textContent = text;
  byId("hint").hidden = !text;
}

const stage = makeStage();
const panel = new Panel();
const plots = new Plots(byId("plots"));
const timeline = new TimelineBar(message => link.send(message));

const take = {
  hello(hello) {
    seen.hello = hello;
    document.title = `lio-view: ${hello.source}`;
  },
  map(map) { stage?.map.add(map); },
  path(path) { stage?.path.add(path); },
  scan(scan) {
    ++seen.scans;
    stage?.scan.set(scan.points);
  },
  pose(pose) {
    ++seen.poses;
    seen.pose = pose;
    seen.lagMs = Date.now() - 1000 * pose.received;
    stage?.setPose(pose);
    panel.showPose(pose, seen.hello?.is_live ? seen.lagMs : NaN);
  },
  states(states) { plots.add(states); },
  status(status) {
    seen.status = status;
    panel.showStatus(status);
  },
  timeline(state) {
    seen.timeline = state;
    timeline.show(state);
  },
};

const link = new Link({
  onFrame(buffer) {
    ++seen.frames;
    seen.bytes += buffer.byteLength;
    readFrame(buffer, take);
    stage?.touch();
  },
  onState(state) {
    panel.showLink(state);
    const hints = {closed: "lio-view does not answer. Trying again …",
      refused: "lio-view wants its token: open the address that it told, with ?token=…"};
    if (stage) hint(hints[state] || "");
  },
});

const tools = {
  follow: on => { if (stage) stage.follows = on; },
  above: on => stage?.look(on ? 1 : 0),
  map: on => { if (stage) stage.map.group.visible = on; },
  scan: on => { if (stage) stage.scan.group.visible = on; },
  plots: on => { byId("plots").hidden = !on; plots.isDirty = on; if (on) plots.resize(); },
  figures: on => { byId("figures").hidden = byId("note").hidden = !on; },
};
function setTool(name, on) {
  document.querySelector(`[data-tool="${name}"]`).setAttribute("aria-pressed", String(on));
  tools[name](on);
  stage?.touch();
}
for (const button of document.querySelectorAll("[data-tool]")) {
  button.addEventListener("click", () => setTool(button.dataset.tool, button.getAttribute("aria-pressed") !== "true"));
}
if (innerWidth <= 700) for (const name of ["plots", "figures"]) setTool(name, false);

let lastDrawn = 0, lastTime = performance.now();
setInterval(() => {
  if (!stage) return;
  const now = performance.now();
  panel.showDrawing(stage, 1000 * (stage.numDrawn - lastDrawn) / (now - lastTime));
  lastDrawn = stage.numDrawn;
  lastTime = now;
}, 1000);

window.lioView = {seen, stage, link, plots, setTool};
