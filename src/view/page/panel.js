// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Lights, figures and notes. Texts from outside are set as text, never as HTML.
import {NUM_LAYERS} from "./cloud.js";

const STATES = ["starting", "OK", "degenerate", "coasting", "LOST"];
const STATE_LIGHTS = [null, "green", "amber", "amber", "red"];
const TRUST = ["trusted", "doubtful", "no trust"];
const TRUST_LIGHTS = ["green", "amber", "red"];
const SILENT_S = 1.5;

const fixed = (value, digits = 1) => Number.isFinite(value) ? value.toFixed(digits) : "–";

export class Panel {
  constructor() {
    this.lights = Object.fromEntries([...document.querySelectorAll("#lights li")].map(li => [li.dataset.light, li]));
    this.note = document.getElementById("note");
    this.table = document.querySelector("#figures tbody");
    this.rows = new Map();
  }

  light(name, colour, text) {
    const light = this.lights[name];
    if (light.textContent !== text) light.textContent = text;
    if (colour) light.dataset.colour = colour; else delete light.dataset.colour;
  }

  figure(name, value) {
    let cell = this.rows.get(name);
    if (!cell) {
      const row = this.table.insertRow();
      row.insertCell().textContent = name;
      this.rows.set(name, cell = row.insertCell());
    }
    if (cell.textContent !== value) cell.textContent = value;
  }

  showLink(state) {
    const words = {open: ["green", "connected"], closed: ["red", "reconnecting"], refused: ["red", "token refused"]};
    this.light("link", ...words[state]);
  }

  showStatus({daemon, match, rates_hz: rates, silent_s: silent, refused, runs}) {
    const isSilent = !(silent < SILENT_S);
    if (isSilent) this.light("link", "amber", silent === undefined ? "nothing heard" : "liod is silent");
    else this.light("link", "green", "connected");
    this.figure("odometry", `${fixed(rates.odometry)} + ${fixed(rates.odometry_imu, 0)} Hz`);
    this.figure("clouds", `${fixed(rates.cloud_full > 0 ? rates.cloud_full : rates.cloud)} Hz`);
    if (match) this.figure("match", `${match.matched} of ${match.used}, ${fixed(100 * match.rms_m)} cm`);
    if (!daemon) return;
    this.light("state", isSilent ? null : STATE_LIGHTS[daemon.state], STATES[daemon.state]);
    this.light("trust", TRUST_LIGHTS[daemon.trust], TRUST[daemon.trust]);
    const losses = Object.entries(daemon.losses);
    this.light("losses", losses.length ? "amber" : "green", losses.length ? "losses" : "no losses");
    const told = losses.slice(0, 4).map(([name, count]) => `${count} ${name.replaceAll("_", " ")}`);
    this.note.textContent = [daemon.note, ...told].filter(Boolean).join(" · ");
    const {p50, p99, max} = daemon.latency_ms;
    this.figure("latency", `${fixed(p50)} / ${fixed(p99)} / ${fixed(max)} ms`);
    this.figure("load", `${fixed(daemon.cpu_cores, 2)} cores, ${fixed(daemon.rss_mb, 0)} MB`);
    if (daemon.clock_offset_std_s > 0) {
      this.figure("clock offset", `${fixed(1e3 * daemon.clock_offset_s)} ± ${fixed(1e3 * daemon.clock_offset_std_s)} ms`);
    }
    if (refused) this.figure("refused messages", `${refused}`);
    if (runs > 0) this.figure("runs seen", `${runs + 1}`);
  }

  showPose({position, velocity, std, status, leftOut}, lagMs) {
    this.figure("position", position.map(v => fixed(v)).join("  ") + " m");
    this.figure("speed", `${fixed(Math.hypot(...velocity), 2)} m/s`);
    this.figure("σ", std.map(v => fixed(100 * v)).join("  ") + " cm");
    if (!this.lights.state.dataset.colour) this.light("state", STATE_LIGHTS[status], STATES[status]);
    this.figure("shown after", Math.abs(lagMs) < 1e5 ? `${fixed(lagMs, 0)} ms` : "–");
    this.figure("poses skipped", `${leftOut}`);
  }

  showDrawing(stage, fps) {
    const {map} = stage, all = map.num.toLocaleString("en");
    this.figure("map points", map.numLayers < NUM_LAYERS ? `${map.numLayers}/${NUM_LAYERS} of ${all}` : all);
    this.figure("frames", `${fixed(fps, 0)} / s`);
  }
}
