// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Plots of the last minute or of all: velocity, biases and NIS, over the time since the first row.
import {STATE_VALUES} from "./frames.js";

const COLOURS = ["#ff6b6b", "#51cf66", "#4dabf7"], DEG = 180 / Math.PI;
const REDRAW_MS = 250, WINDOW_S = 60, MAX_DRAWN = 1500;
const CHARTS = [
  {title: "velocity [m/s]", columns: ["vx", "vy", "vz"], factor: 1},
  {title: "gyro bias [°/s]", columns: ["gx", "gy", "gz"], factor: DEG},
  {title: "accelerometer bias [m/s²]", columns: ["ax", "ay", "az"], factor: 1},
  {title: "NIS of a match (6 is right)", columns: ["nis"], factor: 1, isLog: true},
];

export class Plots {
  constructor(root) {
    this.root = root;
    this.generation = 0;
    this.clear();
    this.charts = CHARTS.map(chart => ({...chart, plot: this.make(chart)}));
    root.addEventListener("click", () => { this.showsAll = !this.showsAll; this.isDirty = true; });
    setInterval(() => this.draw(), REDRAW_MS);
    addEventListener("resize", () => this.resize());
  }

  make({title, columns, isLog}) {
    const ink = "#9aa3ad", axis = {stroke: ink, grid: {stroke: "#ffffff12"}, ticks: {show: false}, font: "11px system-ui"};
    const lines = columns.map((_, i) => ({stroke: columns.length > 1 ? COLOURS[i] : "#ffd43b", width: 1.3,
      points: {show: false}}));
    return new uPlot({title, width: this.width(), height: 112, series: [{}, ...lines], cursor: {show: false},
      legend: {show: false}, axes: [{...axis, size: 20}, {...axis, size: 48}],
      scales: {x: {time: false}, y: isLog ? {distr: 3} : {}}}, [[], ...columns.map(() => [])], this.root);
  }
  width() { return Math.max(160, this.root.clientWidth - 14); }
  resize() {
    for (const {plot} of this.charts) plot.setSize({width: this.width(), height: 112});
  }

  clear() {
    this.times = [];
    this.columns = Object.fromEntries(STATE_VALUES.map(name => [name, []]));
  }

  add({generation, first, rows}) {
    if (generation !== this.generation || first !== this.times.length) this.clear();
    this.generation = generation;
    for (const [t, ...values] of rows) {
      this.times.push(t);
      STATE_VALUES.forEach((name, i) => this.columns[name].push(values[i]));
    }
    this.isDirty = true;
  }

  draw() {
    if (!this.isDirty || this.root.hidden) return;
    this.isDirty = false;
    const {times} = this, end = times.length;
    let begin = 0;
    if (!this.showsAll) {
      begin = end;
      while (begin > 0 && times[begin - 1] > times[end - 1] - WINDOW_S) --begin;
    }
    const stride = Math.max(1, Math.ceil((end - begin) / MAX_DRAWN));
    const picked = (values, map) => {
      const out = [];
      for (let i = begin; i < end; i += stride) out.push(map(values[i]));
      return out;
    };
    const t = picked(times, v => v);
    for (const {plot, columns, factor, isLog} of this.charts) {
      const y = v => isLog ? (v > 0 ? Math.max(0.05, v) : null) : factor * v;
      plot.setData([t, ...columns.map(name => picked(this.columns[name], y))]);
    }
  }
}
