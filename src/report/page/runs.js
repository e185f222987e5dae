// The runs of the page, on one clock and in one frame; and what all parts of the page need.
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const byId = id => document.getElementById(id);
const COLOURS = ["#2563c9", "#d9480f", "#2b8a3e", "#9c36b5", "#5c6773", "#c92a2a"];
const STATUS = ["init", "ok", "degenerate", "coasting", "lost"];
const TRUST = ["yes", "doubtful", "no"];
const TRUTH_COLOUR = "#111", PATH_COLOUR = "#d6336c";
const runs = data.runs || [data], isMany = runs.length > 1;
runs.forEach((run, i) => { run.colour = isMany ? COLOURS[i % COLOURS.length] : PATH_COLOUR; });

function element(name, text, className) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  return made;
}

const number = (value, digits) => value === null || value === undefined ? "–" : value.toFixed(digits);
const hasPath = run => run.path && run.path.t && run.path.t.length > 1;

function indexAt(times, t) {
  let low = 0, high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] < t) low = middle; else high = middle;
  }
  return t - times[low] < times[high] - t ? low : high;
}

// All tables of a run that have times of their own.
function timedTables(run) {
  const truth = run.truth || {};
  return [run.scans, run.states, run.path, truth.path, truth.errors].filter(part => part && part.t);
}

function timeOf(some) {
  let low = Infinity, high = -Infinity;
  for (const run of some) {
    for (const {t} of timedTables(run)) {
      if (t.length) [low, high] = [Math.min(low, t[0]), Math.max(high, t[t.length - 1])];
    }
    for (const [t] of run.notices) {
      if (low < Infinity) [low, high] = [Math.min(low, t), Math.max(high, t)];
    }
  }
  return low < high ? [low, high] : [low === Infinity ? 0 : low, (low === Infinity ? 0 : low) + 1];
}
const wholeTime = () => timeOf(runs);

// Runs of one recording are put on the clock of the first. Others begin at zero, each by itself;
// returns whether there are any.
function useOneClock() {
  const [, duration] = timeOf([runs[0]]);
  let isOwn = false;
  for (const run of runs.slice(1)) {
    const later = Number(run.begin) - Number(runs[0].begin);
    if (!(Math.abs(later) < duration)) { isOwn = true; continue; }
    for (const part of timedTables(run)) part.t = part.t.map(t => t + later);
    for (const notice of run.notices) notice[0] += later;
  }
  return isOwn;
}

// Each run has a map of its own. If the truth tells how they lie, all are moved into that of the
// first: p_first = T_first_truth * inverse(T_run_truth) * p_run, all of them turns about z.
function useOneFrame() {
  const joinOf = run => run.truth && run.truth.joined;
  const first = joinOf(runs[0]);
  for (const run of runs.slice(1)) {
    const own = joinOf(run);
    if (!first || !own || !hasPath(run)) continue;
    const turn = first.yaw_rad - own.yaw_rad, c = Math.cos(turn), s = Math.sin(turn);
    const {x, y, z} = run.path;
    x.forEach((_, i) => {
      const dx = x[i] - own.shift_m[0], dy = y[i] - own.shift_m[1];
      x[i] = first.shift_m[0] + c * dx - s * dy;
      y[i] = first.shift_m[1] + s * dx + c * dy;
      z[i] += first.shift_m[2] - own.shift_m[2];
    });
  }
}
