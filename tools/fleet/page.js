// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Draws the page of a fleet from the JSON in it: tables that sort, and one plot.
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const columns = data.table.columns;
const at = Object.fromEntries(columns.map((name, index) => [name, index]));
const rows = data.table.rows;
const colours = ["#888888", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const significance = 0.05;

const names = {
  ape_m: ["APE", "m"], ape_max_m: ["APE max", "m"], ape_deg: ["APE", "deg"],
  drift_percent: ["drift", "%"], drift_deg_per_100m: ["drift", "deg/100 m"],
  rpe_1s_m: ["RPE 1 s", "m"], end_m: ["end", "m"], end_percent: ["end", "%"],
  coverage_ratio: ["coverage", "1"], path_m: ["path", "m"], duration_s: ["duration", "s"],
  nees_pose: ["NEES pose", "per dof"], nees_position: ["NEES position", "per dof"],
  nees_rotation: ["NEES rotation", "per dof"], num_rejected: ["rejected", "scans"],
  scan_median_ms: ["scan median", "ms"], scan_p99_ms: ["scan p99", "ms"],
  rss_peak_mb: ["memory", "MB"], run_cpu_s: ["CPU", "s"], run_wall_s: ["time", "s"],
};
const textColumns = new Set(["drive", "group", "system", "kind", "status", "trust", "causes",
  "said"]);
const verdictClass = { yes: "good", doubtful: "dim", no: "bad", done: "", failed: "bad",
  "no pose": "bad", absent: "dim", unfinished: "bad", "no truth": "dim",
  "not scored": "dim" };

function element(tag, text, className) {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  return made;
}

function shown(value) {
  if (value === null || value === undefined) return "";
  if (typeof value !== "number") return value;
  if (Number.isInteger(value)) return String(value);
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-3 ? value.toExponential(2) : value.toPrecision(3);
}

function shownP(value) {
  return value < 0.001 ? value.toExponential(1) : value.toFixed(3);
}

function heading(name) {
  const [word, unit] = names[name] || [name, ""];
  const cell = element("th", word, textColumns.has(name) ? "text" : "");
  if (unit) cell.append(element("small", unit));
  return cell;
}

function addRow(table, cells, tag = "td") {
  const row = table.insertRow();
  for (const [text, className] of cells) row.append(element(tag, text, className));
  return row;
}

function median(values) {
  const sorted = values.filter((value) => value !== null).sort((a, b) => a - b);
  if (!sorted.length) return null;
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

function counts(found) {
  return Object.entries(found).filter(([name]) => name !== "-")
    .map(([name, number]) => `${number} ${name}`).join(", ");
}

function showSystems() {
  const table = document.getElementById("systems");
  const figures = ["ape_m", "drift_percent", "end_percent", "nees_pose", "scan_median_ms",
    "run_cpu_s", "rss_peak_mb"];
  const head = table.insertRow();
  for (const word of ["system", "runs", "trust"]) head.append(element("th", word, "text"));
  for (const name of figures) {
    const cell = heading(name);
    cell.append(element("small", "median (max)"));
    head.append(cell);
  }
  for (const entry of data.summary) {
    const cells = [[entry.system + (entry.system === data.baseline ? " (baseline)" : ""), "text"],
      [counts(entry.status), "text"], [counts(entry.trust), "text"]];
    for (const name of figures) {
      const found = entry.figures[name];
      cells.push([found ? `${shown(found.median)} (${shown(found.max)})` : ""]);
    }
    addRow(table, cells);
  }
}

function judged(found) {
  if (found.holm_p === undefined) return ["too few pairs", "text dim"];
  if (found.holm_p >= significance) return ["no difference shown", "text dim"];
  return found.signed_rank_sum < 0 ? ["better", "text good"] : ["worse", "text bad"];
}

function showPaired() {
  const table = document.getElementById("paired");
  addRow(table, ["system", "figure", "pairs", "better", "worse", "ratio", "difference", "p", "Holm",
    "sign", "verdict"].map((word, index) => [word, index < 2 || index > 9 ? "text" : ""]), "th");
  for (const entry of data.summary) {
    for (const [figure, found] of Object.entries(entry.against_baseline || {})) {
      if (!found.num_pairs) continue;
      const p = (value) => [value === undefined ? "" : shownP(value)];
      const name = figure === "nees_pose" ? "|ln NEES|" : (names[figure] || [figure]).join(" ");
      addRow(table, [[entry.system, "text"], [name, "text"], [found.num_pairs],
        [shown(found.num_better)], [shown(found.num_worse)], [shown(found.median_ratio)],
        [shown(found.median_difference)], p(found.wilcoxon_p), p(found.holm_p), p(found.sign_p),
        judged(found)]);
    }
  }
}

function systemsInOrder() {
  const all = data.summary.map((entry) => entry.system);
  return [data.baseline, ...all.filter((name) => name !== data.baseline)];
}

function valuesOf(system, figure) {
  return rows.filter((row) => row[at.system] === system && row[at[figure]] !== null)
    .map((row) => row[at[figure]]).sort((a, b) => a - b);
}

let plot = null;

function showPlot(figure) {
  const systems = systemsInOrder();
  const values = systems.map((system) => valuesOf(system, figure));
  const x = [...new Set(values.flat())].sort((a, b) => a - b);
  const shares = values.map((sorted) => {
    let below = 0;
    return x.map((limit) => {
      while (below < sorted.length && sorted[below] <= limit) below++;
      return sorted.length ? below / sorted.length : null;
    });
  });
  const isLog = x.length > 1 && x[0] > 0 && x[x.length - 1] / x[0] > 30;
  const [word, unit] = names[figure];
  const ink = getComputedStyle(document.body).color;
  const axis = { stroke: ink, grid: { stroke: "#8883" }, ticks: { stroke: "#8883" } };
  if (plot) plot.destroy();
  plot = new uPlot({
    width: Math.min(1000, document.body.clientWidth - 40), height: 320,
    scales: { x: { time: false, distr: isLog ? 3 : 1 }, y: { range: [0, 1.02] } },
    axes: [{ ...axis, label: `${word} [${unit}]` }, { ...axis, label: "share of runs" }],
    series: [{ label: word, value: (_, value) => shown(value) },
      ...systems.map((system, index) => ({ label: system, width: 2, points: { show: false },
        stroke: colours[index % colours.length], paths: uPlot.paths.stepped({ align: 1 }),
        value: (_, value) => shown(value) }))],
  }, [x, ...shares], document.getElementById("plot"));
}

function showDrives(figure) {
  const table = document.getElementById("drives");
  table.replaceChildren();
  const systems = systemsInOrder();
  const [word, unit] = names[figure];
  const heads = systems.map((name) => [name]);
  addRow(table, [[`${word} [${unit}]`, "text"], ["drives"], ...heads], "th");
  const groups = new Map();
  for (const row of rows) {
    const group = groups.get(row[at.group]) || new Map();
    groups.set(row[at.group], group);
    group.set(row[at.system], [...(group.get(row[at.system]) || []), row[at[figure]]]);
  }
  for (const [name, bySystem] of groups) {
    const medians = systems.map((system) => median(bySystem.get(system) || []));
    const drives = Math.max(...[...bySystem.values()].map((values) => values.length));
    addRow(table, [[name, "text"], [drives], ...medians.map((value) => [shown(value)])]);
  }
}

function compareBy(index, sign) {
  return (a, b) => {
    const [x, y] = [a[index], b[index]];
    if (x === y) return 0;
    if (x === null || x === "") return 1;
    if (y === null || y === "") return -1;
    return sign * (x < y ? -1 : 1);
  };
}

const listed = columns.filter((name) => !["group", "kind", "seed"].includes(name));
const state = { sorted: null, sign: 1, words: [], kept: [] };
const rowsAtOnce = 100;

function runCell(row, name) {
  const value = row[at[name]];
  const isText = textColumns.has(name);
  const look = name === "said" ? "said" : verdictClass[value] || "";
  const className = isText ? `text ${look}` : "";
  if (name !== "drive" || row[at.kind] !== "liod" || row[at.trust] === null) {
    const cell = element("td", shown(value), className.trim());
    if (name === "said" && value) cell.title = value;
    return cell;
  }
  const cell = element("td", undefined, "text");
  const link = element("a", value);
  link.href = `runs/${row[at.system]}/${row[at.drive]}/report.html`;
  cell.append(link);
  return cell;
}

function matches(row) {
  const text = [row[at.drive], row[at.system], row[at.status], row[at.trust], row[at.causes],
    row[at.said]].join(" ").toLowerCase();
  return state.words.every((word) => text.includes(word));
}

// Laying out a thousand rows takes half a second, so only as many are made as were scrolled to.
function addRuns(until) {
  const body = document.getElementById("runs").tBodies[0];
  for (const row of state.kept.slice(body.rows.length, until)) {
    const line = element("tr");
    for (const name of listed) line.append(runCell(row, name));
    body.append(line);
  }
}

function showRuns() {
  state.kept = rows.filter(matches);
  if (state.sorted) state.kept.sort(compareBy(at[state.sorted], state.sign));
  const table = document.getElementById("runs");
  table.tBodies[0]?.remove();
  table.append(document.createElement("tbody"));
  table.parentNode.scrollTop = 0;
  addRuns(rowsAtOnce);
  document.getElementById("shown").textContent = `${state.kept.length} of ${rows.length} runs`;
}

function followScrolling() {
  const box = document.getElementById("runs").parentNode;
  box.onscroll = () => {
    if (box.scrollTop + 2 * box.clientHeight > box.scrollHeight) {
      addRuns(document.getElementById("runs").tBodies[0].rows.length + rowsAtOnce);
    }
  };
}

function sortBy(name, cell) {
  state.sign = state.sorted === name ? -state.sign : 1;
  state.sorted = name;
  for (const other of cell.parentNode.children) other.removeAttribute("aria-sort");
  cell.setAttribute("aria-sort", state.sign > 0 ? "ascending" : "descending");
  showRuns();
}

function showHead() {
  const head = document.getElementById("runs").createTHead().insertRow();
  for (const name of listed) {
    const cell = heading(name);
    cell.tabIndex = 0;
    cell.dataset.column = name;
    cell.onclick = () => sortBy(name, cell);
    cell.onkeydown = (event) => { if (event.key === "Enter") sortBy(name, cell); };
    head.append(cell);
  }
}

function showFigure(figure) {
  showPlot(figure);
  showDrives(figure);
}

function start() {
  const drives = new Set(rows.map((row) => row[at.drive])).size;
  document.getElementById("overview").textContent = `${rows.length} runs: ${drives} drives by ` +
    `${data.summary.length} systems; the baseline is ${data.baseline}.`;
  showSystems();
  showPaired();
  const select = document.getElementById("figure");
  for (const [name, words] of Object.entries(names)) {
    const option = element("option", words.join(" "));
    option.value = name;
    select.append(option);
  }
  select.onchange = () => showFigure(select.value);
  showFigure("ape_m");
  showHead();
  showRuns();
  followScrolling();
  const filter = document.getElementById("filter");
  filter.oninput = () => {
    state.words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    showRuns();
  };
  document.documentElement.dataset.drawn = "yes";
}

start();
