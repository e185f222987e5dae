"use strict";
(() => {
const data = JSON.parse(document.getElementById("data").textContent);
const byId = id => document.getElementById(id);
const COLOURS = ["#2563c9", "#d9480f", "#2b8a3e", "#9c36b5", "#5c6773", "#c92a2a"];
const STATUS = ["init", "ok", "degenerate", "coasting", "lost"];
const TRUST = ["yes", "doubtful", "no"];
const TRUTH_COLOUR = "#111", PATH_COLOUR = "#d6336c";
const NIS_BAND = [1.24, 14.45];  // 95 % of chi-square with six degrees of freedom
const timePlots = [];
let pathPlot = null;

function element(name, text, className) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  return made;
}

// ---- text ----
const number = (value, digits) => value === null || value === undefined ? "–" : value.toFixed(digits);

function showHeader() {
  const name = data.input.split("/").filter(part => part).pop() || "run";
  document.title = `liod: ${name}`;
  byId("title").textContent = data.input;
  const verdict = data.verdict;
  if (!verdict) return;
  const line = byId("verdict");
  line.append(element("span", `trust: ${verdict.trust}`, `badge ${verdict.trust}`));
  const claimed = verdict.claimed || {};
  let text = `  poses for ${(100 * verdict.coverage).toFixed(0)} % of the time`;
  if (claimed.position_std_m_per_100m != null) {
    text += `; claimed: ${number(claimed.position_std_m_per_100m, 2)} m per 100 m`;
  }
  if (claimed.tilt_std_deg != null) text += `, ${number(claimed.tilt_std_deg, 2)}° of tilt (1 sigma)`;
  line.append(text);
}

function showCauses() {
  for (const cause of (data.verdict && data.verdict.causes) || []) {
    const box = element("div", undefined, cause.leaves === "no" ? "cause no-trust" : "cause");
    box.append(element("strong", cause.kind.replaceAll("_", " ")), element("div", cause.evidence));
    if (cause.fix) box.append(element("pre", cause.fix.trimEnd()));
    byId("causes").append(box);
  }
}

function figureRows() {
  const rows = [], stats = data.stats, truth = data.truth;
  if (truth && truth.figures) {
    const f = truth.figures, ape = f.ape.position_m;
    rows.push(["path length, duration", `${number(f.path_length_m, 1)} m, ${number(f.duration_s, 1)} s`]);
    rows.push(["position error (SE3), rmse, max", `${number(ape.rmse, 3)}, ${number(ape.max, 3)} m`]);
    rows.push(["rotation error, rmse", `${number(f.ape.rotation_without_offset_deg.rmse, 3)}°`]);
    if (f.drift.translation_percent != null) rows.push(["drift", `${number(f.drift.translation_percent, 3)} %`]);
    rows.push(["error at the end", `${number(f.end.error_m, 3)} m (${number(f.end.error_percent, 3)} %)`]);
  }
  if (stats) {
    const total = stats.stage_ms.total;
    rows.push(["sweeps, IMU samples", `${stats.num_scans}, ${stats.num_imu}`]);
    rows.push(["sweeps dropped", stats.num_scans_dropped]);
    rows.push(["matches rejected, gated", `${stats.num_matches_rejected}, ${stats.num_gated}`]);
    rows.push(["time per sweep, median, p99", `${number(total.median, 1)}, ${number(total.p99, 1)} ms`]);
    rows.push(["speed", `${number(stats.realtime_factor, 1)} × real time`]);
    rows.push(["memory at its peak", `${number(stats.rss_peak_mb, 0)} MB`]);
  }
  return rows;
}

function showTable(table, rows) {
  for (const row of rows) {
    const line = element("tr");
    for (const cell of row) line.append(element("td", String(cell)));
    table.append(line);
  }
}

function showTexts() {
  showHeader();
  showCauses();
  showTable(byId("figures"), figureRows());
  const said = [...data.assumptions];
  if (data.truth && data.truth.note) said.push(`No comparison with the truth: ${data.truth.note}`);
  if (data.truth && data.truth.remark) said.push(data.truth.remark);
  if (said.length) {
    const list = element("ul");
    for (const text of said) list.append(element("li", text));
    byId("assumptions").append(element("h2", "What was assumed"), list);
  }
  byId("options").textContent = data.options;
  const notices = byId("notices");
  if (!data.notices.length) return notices.remove();
  const table = element("table");
  showTable(table, data.notices.map(([t, severity, text]) => [`${t.toFixed(1)} s`, severity, text]));
  notices.append(element("h2", "What was told on the way"), table);
}

// ---- plots over time ----
let timeRange = [0, 1];

function wholeTime() {
  let low = Infinity, high = -Infinity;
  for (const part of [data.scans, data.states, data.path]) {
    if (!part || !part.t || !part.t.length) continue;
    low = Math.min(low, part.t[0]);
    high = Math.max(high, part.t[part.t.length - 1]);
  }
  for (const [t] of data.notices) {
    if (low < Infinity) [low, high] = [Math.min(low, t), Math.max(high, t)];
  }
  return low < high ? [low, high] : [low === Infinity ? 0 : low, (low === Infinity ? 0 : low) + 1];
}

let isLinking = false;
function setTime(min, max) {
  isLinking = true;
  timeRange = [min, max];
  for (const plot of timePlots) plot.setScale("x", {min, max});
  isLinking = false;
  if (pathPlot) pathPlot.redraw(false);
}

function indexAt(times, t) {
  let low = 0, high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] < t) low = middle; else high = middle;
  }
  return t - times[low] < times[high] - t ? low : high;
}

function showNoticeMarks(plot) {
  const {ctx, bbox} = plot;
  ctx.save();
  ctx.strokeStyle = "#b26a0066";
  ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
  for (const [t, severity] of data.notices) {
    const x = plot.valToPos(t, "x", true);
    if (severity === "info" || x < bbox.left || x > bbox.left + bbox.width) continue;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
  }
  ctx.restore();
}

function noticeShower() {
  return {hooks: {draw: showNoticeMarks, setScale: (plot, key) => {
    if (key === "x" && !isLinking) setTime(plot.scales.x.min, plot.scales.x.max);
  }, setCursor: plot => {
    if (isPointing || plot.cursor.left < 0 || plot.cursor.left === undefined) return;
    if (plot.cursor.event) showHere(plot.posToVal(plot.cursor.left, "x"));
  }}};
}

// Each line is {label, y, colour, std, dash, isStepped}; `std` draws a band of three sigma about y,
// or about zero when the line says `isError`.
function seriesOf(lines, digits) {
  const series = [{label: "t [s]", value: (_, t) => t == null ? "–" : t.toFixed(2)}];
  const columns = [], bands = [];
  lines.forEach((line, i) => {
    const stroke = line.colour || COLOURS[i % COLOURS.length];
    if (line.std) {
      const middle = line.isError ? line.y.map(() => 0) : line.y;
      const at = series.length;
      for (const sign of [3, -3]) {
        series.push({class: "band", stroke: stroke + "55", width: 1, points: {show: false}});
        columns.push(middle.map((y, k) => y == null || line.std[k] == null ? null : y + sign * line.std[k]));
      }
      bands.push({series: [at, at + 1], fill: stroke + "1f"});
    }
    series.push({label: line.label, stroke, width: line.width || 1.4, dash: line.dash,
      points: {show: false}, spanGaps: false,
      paths: line.isStepped ? uPlot.paths.stepped({align: 1}) : undefined,
      value: line.names ? (_, y) => y == null ? "–" : line.names[y] || "?"
        : (_, y) => y == null ? "–" : y.toFixed(digits)});
    columns.push(line.y);
  });
  return {series, columns, bands};
}

function axisOf(options) {
  const axis = {size: options.names ? 86 : 62, space: 24, font: "12px system-ui, DejaVu Sans, sans-serif",
    grid: {stroke: "#e8ebef", width: 1}, ticks: {stroke: "#e8ebef", width: 1}};
  if (options.names) {
    axis.splits = () => options.names.map((_, i) => i);
    axis.values = (_, splits) => splits.map(i => options.names[i]);
  }
  return axis;
}

function addTimePlot(title, t, lines, options = {}) {
  if (!t || t.length < 2 || !lines.length || !lines.every(line => line.y)) return;
  const card = element("section", undefined, "card");
  card.append(element("h2", title));
  byId("plots").append(card);
  const {series, columns, bands} = seriesOf(lines, options.digits ?? 3);
  const y = options.isLog ? {distr: 3} : {};
  if (options.names) y.range = [-0.3, options.names.length - 0.7];
  const plot = new uPlot({
    width: card.clientWidth - 26, height: options.height || 190, series, bands,
    scales: {x: {time: false}, y},
    axes: [{...axisOf({}), size: 34, space: 50, values: (_, s) => s.map(v => `${v}`)}, axisOf(options)],
    cursor: {sync: {key: "liod", setSeries: false, scales: ["x", null]}, y: false,
      drag: {x: true, y: false}, points: {size: 6},
      bind: {dblclick: () => () => { setTime(...wholeTime()); return null; }}},
    plugins: [noticeShower(), ...(options.plugins || [])],
  }, [t, ...columns], card);
  timePlots.push(plot);
}

function shaded(low, high) {
  return {hooks: {drawClear: plot => {
    const top = Math.max(plot.bbox.top, plot.valToPos(high, "y", true));
    const bottom = Math.min(plot.bbox.top + plot.bbox.height, plot.valToPos(low, "y", true));
    if (!(bottom > top)) return;
    plot.ctx.fillStyle = "#2b8a3e1c";
    plot.ctx.fillRect(plot.bbox.left, top, plot.bbox.width, bottom - top);
  }}};
}

function addErrorPlots() {
  const errors = data.truth && data.truth.errors;
  if (!errors) return;
  for (const axis of ["x", "y", "z"]) {
    addTimePlot(`Error of ${axis} [m], estimate minus truth, and 3 sigma`, errors.t,
      [{label: axis, y: errors[axis], std: errors[`${axis}_std`], isError: true,
        colour: COLOURS["xyz".indexOf(axis)]}], {height: 165});
  }
  const name = {x: "roll", y: "pitch", z: "yaw"};
  addTimePlot("Error of attitude [°] about the world's axes, and 3 sigma", errors.t,
    ["x", "y", "z"].map(axis => ({label: name[axis], y: errors[`r${axis}`],
      std: errors[`r${axis}_std`], isError: true})));
}

function addHeightPlot() {
  const lines = [{label: "z", y: data.path.z, colour: PATH_COLOUR}];
  const truth = data.truth && data.truth.path;
  if (truth) {
    const z = data.path.t.map(t => {
      const i = indexAt(truth.t, t);
      return Math.abs(truth.t[i] - t) < 0.5 ? truth.z[i] : null;
    });
    lines.unshift({label: "truth", y: z, colour: TRUTH_COLOUR, dash: [6, 4]});
  }
  addTimePlot("Height z [m]", data.path.t, lines);
}

function xyzLines(table, what, unit, factor = 1) {
  const scaled = column => (column || []).map(v => v == null ? null : v * factor);
  return ["x", "y", "z"].map(axis => ({label: axis, y: scaled(table[`${what}_${axis}_${unit}`]),
    std: scaled(table[`${what}_${axis}_std_${unit}`])}));
}

function addStatePlots() {
  const states = data.states;
  if (!states || !states.t) return;
  addTimePlot("Velocity [m/s], in world", states.t, xyzLines(states, "velocity", "mps"));
  if (states.accel_bias_x_std_mps2.some(v => v)) {  // else the IMU is not in use
    const degPerRad = 180 / Math.PI;
    addTimePlot("Gyro bias [°/s]", states.t, xyzLines(states, "gyro_bias", "radps", degPerRad));
    addTimePlot("Accelerometer bias [m/s²]", states.t, xyzLines(states, "accel_bias", "mps2"));
  }
  if (states.clock_offset_std_s.some(v => v)) {
    const ms = column => column.map(v => 1e3 * v);
    addTimePlot("Clock offset [ms]", states.t,
      [{label: "offset", y: ms(states.clock_offset_s), std: ms(states.clock_offset_std_s)}]);
  }
}

function addHealthPlots() {
  const states = data.states, scans = data.scans;
  if (states && states.t) {
    addTimePlot("Status", states.t,
      [{label: "status", y: states.status, isStepped: true, names: STATUS, width: 2}],
      {height: 150, names: STATUS});
    if (states.trust.some(v => v >= 0)) {
      addTimePlot("Verdict so far: may the result be trusted?", states.t,
        [{label: "trust", y: states.trust.map(v => v < 0 ? null : v), isStepped: true, names: TRUST,
          width: 2, colour: COLOURS[1]}], {height: 120, names: TRUST});
    }
  }
  if (!scans || !scans.t) return;
  addTimePlot("NIS of a match: 6 is right, the band holds 95 %", scans.t,
    [{label: "NIS", y: scans.nis.map(v => v > 0 ? Math.max(v, 0.05) : null)}],
    {isLog: true, digits: 1, plugins: [shaded(...NIS_BAND)]});
  addTimePlot("Points of a scan", scans.t, [{label: "used", y: scans.num_used},
    {label: "matched", y: scans.num_matched}], {digits: 0});
  addTimePlot("Computing time of a scan [ms]", scans.t,
    ["total", "match", "reduce", "deskew", "insert", "filter"].map(stage =>
      ({label: stage, y: scans[`${stage}_ms`], width: stage === "total" ? 2 : 1.2})), {digits: 2});
}

// ---- the path from above ----
function mapPoints() {
  const map = data.map;
  if (!map) return null;
  const bytes = Uint8Array.from(atob(map.xyz), letter => letter.charCodeAt(0));
  const steps = new Uint16Array(bytes.buffer);
  const points = {x: [], y: [], shade: []};
  const heights = [];
  for (let i = 0; i < steps.length; i += 3) heights.push(steps[i + 2]);
  const sorted = [...heights].sort((a, b) => a - b);
  const low = sorted[Math.floor(0.02 * sorted.length)], high = sorted[Math.floor(0.98 * sorted.length)];
  for (let i = 0; i < steps.length; i += 3) {
    points.x.push(map.origin[0] + map.step_m * steps[i]);
    points.y.push(map.origin[1] + map.step_m * steps[i + 1]);
    const share = Math.min(1, Math.max(0, (steps[i + 2] - low) / Math.max(1, high - low)));
    points.shade.push(Math.floor(share * 15.999));
  }
  return points;
}

const SHADES = Array.from({length: 16}, (_, i) => `hsl(${214 - 8 * i} ${26 + 2 * i}% ${78 - 2.6 * i}%)`);

function drawPoints(plot, points) {
  const {ctx, bbox} = plot, {x, y} = plot.scales;
  const perX = bbox.width / (x.max - x.min), perY = bbox.height / (y.max - y.min);
  const size = Math.max(1.1 * devicePixelRatio, Math.min(4 * devicePixelRatio, data.map.cell_m * perX * 0.7));
  SHADES.forEach((colour, shade) => {
    ctx.fillStyle = colour;
    for (let i = 0; i < points.x.length; ++i) {
      if (points.shade[i] !== shade) continue;
      ctx.fillRect(bbox.left + (points.x[i] - x.min) * perX - size / 2,
        bbox.top + bbox.height - (points.y[i] - y.min) * perY - size / 2, size, size);
    }
  });
}

function drawLine(plot, path, colour, width, dash, within) {
  const {ctx} = plot;
  ctx.beginPath();
  ctx.strokeStyle = colour;
  ctx.lineWidth = width * devicePixelRatio;
  ctx.setLineDash((dash || []).map(v => v * devicePixelRatio));
  let isDown = false;
  path.t.forEach((t, i) => {
    if (within && (t < within[0] || t > within[1])) { isDown = false; return; }
    const x = plot.valToPos(path.x[i], "x", true), y = plot.valToPos(path.y[i], "y", true);
    if (isDown) ctx.lineTo(x, y); else ctx.moveTo(x, y);
    isDown = true;
  });
  ctx.stroke();
  ctx.setLineDash([]);
}

function drawStart(plot) {
  const {ctx} = plot;
  ctx.beginPath();
  ctx.arc(plot.valToPos(data.path.x[0], "x", true), plot.valToPos(data.path.y[0], "y", true),
    5 * devicePixelRatio, 0, 7);
  ctx.fillStyle = "#fff";
  ctx.strokeStyle = PATH_COLOUR;
  ctx.lineWidth = 2.5 * devicePixelRatio;
  ctx.fill();
  ctx.stroke();
}

function drawAbove(plot, points) {
  const {ctx, bbox} = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  if (points) drawPoints(plot, points);
  drawLine(plot, data.path, "#ffffffcc", 5);
  drawLine(plot, data.path, PATH_COLOUR + "59", 2.5);
  drawLine(plot, data.path, PATH_COLOUR, 2.5, null, timeRange);
  if (data.truth && data.truth.path) drawLine(plot, data.truth.path, TRUTH_COLOUR, 1.5, [5, 4]);
  drawStart(plot);
  ctx.restore();
}

// The rectangle to be seen: all of the path with a margin, in equal scales.
function wholeView(width, height) {
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  data.path.x.forEach((x, i) => {
    const y = data.path.y[i];
    x0 = Math.min(x0, x); x1 = Math.max(x1, x); y0 = Math.min(y0, y); y1 = Math.max(y1, y);
  });
  const margin = 15 + 0.1 * Math.max(x1 - x0, y1 - y0);
  const metresPerPixel = Math.max((x1 - x0 + 2 * margin) / width, (y1 - y0 + 2 * margin) / height);
  return {x: (x0 + x1) / 2, y: (y0 + y1) / 2, metresPerPixel};
}

let view = null, isPointing = false, here = null;

function applyView(plot) {
  const width = plot.bbox.width / devicePixelRatio, height = plot.bbox.height / devicePixelRatio;
  if (!view) view = wholeView(width, height);
  const dx = view.metresPerPixel * width / 2, dy = view.metresPerPixel * height / 2;
  plot.batch(() => {
    plot.setScale("x", {min: view.x - dx, max: view.x + dx});
    plot.setScale("y", {min: view.y - dy, max: view.y + dy});
  });
  showHere(null);
}

function showHere(t) {
  if (!here || t === null) { if (here) here.style.display = "none"; return; }
  const i = indexAt(data.path.t, t);
  here.style.display = "block";
  here.style.left = `${pathPlot.valToPos(data.path.x[i], "x")}px`;
  here.style.top = `${pathPlot.valToPos(data.path.y[i], "y")}px`;
}

// Shows in all plots the time at which the path is nearest to the pointer.
function pointAt(plot, left, top) {
  const x = plot.posToVal(left, "x"), y = plot.posToVal(top, "y");
  let best = Infinity, at = 0;
  data.path.x.forEach((px, i) => {
    const square = (px - x) ** 2 + (data.path.y[i] - y) ** 2;
    if (square < best) { best = square; at = i; }
  });
  isPointing = true;
  for (const other of timePlots) {
    other.setCursor({left: other.valToPos(data.path.t[at], "x"), top: 10});
  }
  isPointing = false;
  showHere(data.path.t[at]);
}

function listenToPointer(plot) {
  const over = plot.over;
  here = element("div", undefined, "here");
  over.append(here);
  let dragged = null;
  over.addEventListener("wheel", event => {
    event.preventDefault();
    const x = plot.posToVal(event.offsetX, "x"), y = plot.posToVal(event.offsetY, "y");
    const factor = Math.exp(0.0015 * Math.max(-300, Math.min(300, event.deltaY)));
    view = {x: x + (view.x - x) * factor, y: y + (view.y - y) * factor,
      metresPerPixel: view.metresPerPixel * factor};
    applyView(plot);
  }, {passive: false});
  over.addEventListener("pointerdown", event => { dragged = {x: event.clientX, y: event.clientY}; });
  addEventListener("pointerup", () => { dragged = null; });
  over.addEventListener("pointermove", event => {
    if (!dragged) return pointAt(plot, event.offsetX, event.offsetY);
    view.x -= (event.clientX - dragged.x) * view.metresPerPixel;
    view.y += (event.clientY - dragged.y) * view.metresPerPixel;
    dragged = {x: event.clientX, y: event.clientY};
    applyView(plot);
  });
  over.addEventListener("dblclick", () => { view = null; applyView(plot); });
}

function addPathPlot() {
  const box = byId("path"), points = mapPoints();
  const axis = {...axisOf({}), size: 52, space: 40};
  pathPlot = new uPlot({
    width: box.clientWidth, height: 560, legend: {show: false},
    series: [{}, {points: {show: false}}],
    scales: {x: {time: false, auto: false, range: (_, min, max) => [min, max]},
      y: {auto: false, range: (_, min, max) => [min, max]}},
    axes: [{...axis, size: 40, label: "x [m]", labelSize: 18}, {...axis, label: "y [m]", labelSize: 18}],
    cursor: {x: true, y: true, drag: {x: false, y: false, setScale: false}, points: {show: false}},
    hooks: {draw: [plot => drawAbove(plot, points)]},
  }, [[-1e9, 1e9], [null, null]], box);
  applyView(pathPlot);
  listenToPointer(pathPlot);
  if (data.truth && data.truth.path) byId("hint").append(" The black dashes are the truth.");
}

function fitToWindow() {
  for (const plot of timePlots) {
    plot.setSize({width: plot.root.parentElement.clientWidth - 26, height: plot.height});
  }
  if (!pathPlot) return;
  pathPlot.setSize({width: byId("path").clientWidth, height: pathPlot.height});
  view = null;
  applyView(pathPlot);
}

// ---- for tests: report.html#check ----
function isDrawn({ctx, bbox}) {
  const {data: pixels} = ctx.getImageData(bbox.left, bbox.top, bbox.width, bbox.height);
  let coloured = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    const [r, g, b, a] = [pixels[i], pixels[i + 1], pixels[i + 2], pixels[i + 3]];
    if (a > 100 && Math.max(r, g, b) - Math.min(r, g, b) > 60) ++coloured;
  }
  return coloured > 20;
}

// Says on the document how many plots there are, how many have ink on them, how many follow the
// pointer on the path, and how many a zoom of one.
function checkPage() {
  const said = document.documentElement.dataset;
  const plots = pathPlot ? [pathPlot, ...timePlots] : timePlots;
  said.plots = plots.length;
  said.drawn = plots.filter(isDrawn).length;
  if (pathPlot) {
    pointAt(pathPlot, pathPlot.over.clientWidth / 2, pathPlot.over.clientHeight / 2);
    said.pointed = timePlots.filter(plot => plot.cursor.left > 0).length;
    said.here = here.style.display;
  }
  const [low, high] = wholeTime(), middle = (low + high) / 2;
  if (timePlots.length) timePlots[0].setScale("x", {min: low, max: middle});
  setTimeout(() => {
    said.zoomed = timePlots.filter(plot => Math.abs(plot.scales.x.max - middle) < 1e-6).length;
    said.checked = "yes";
  }, 200);
}

showTexts();
timeRange = wholeTime();
if (data.path && data.path.t && data.path.t.length > 1) {
  addErrorPlots();
  addHeightPlot();
} else {
  byId("above").remove();
}
addStatePlots();
addHealthPlots();
setTime(...timeRange);
if (byId("above")) addPathPlot();
addEventListener("resize", fitToWindow);
if (location.hash === "#check") setTimeout(checkPage, 200);
})();
