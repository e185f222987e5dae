// The path of each run from above, on the points of the first run's map.
let pathPlot = null, view = null, isPointing = false;

function mapPoints() {
  const map = runs[0].map;
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
  const size = Math.max(1.1 * devicePixelRatio, Math.min(4 * devicePixelRatio, runs[0].map.cell_m * perX * 0.7));
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

function drawStart(plot, run) {
  const {ctx} = plot;
  ctx.beginPath();
  ctx.arc(plot.valToPos(run.path.x[0], "x", true), plot.valToPos(run.path.y[0], "y", true),
    5 * devicePixelRatio, 0, 7);
  ctx.fillStyle = "#fff";
  ctx.strokeStyle = run.colour;
  ctx.lineWidth = 2.5 * devicePixelRatio;
  ctx.fill();
  ctx.stroke();
}

const shownRuns = () => runs.filter(hasPath);

function drawAbove(plot, points) {
  const {ctx, bbox} = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  if (points) drawPoints(plot, points);
  for (const run of shownRuns()) drawLine(plot, run.path, "#ffffffcc", 5);
  for (const run of shownRuns()) {
    drawLine(plot, run.path, run.colour + "59", 2.5);
    drawLine(plot, run.path, run.colour, 2.5, null, timeRange);
  }
  const {truth} = runs[0];
  if (truth && truth.path) drawLine(plot, truth.path, TRUTH_COLOUR, 1.5, [5, 4]);
  for (const run of shownRuns()) drawStart(plot, run);
  ctx.restore();
}

// The rectangle to be seen: all of the path with a margin, in equal scales.
function wholeView(width, height) {
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const {path} of shownRuns()) {
    for (const x of path.x) [x0, x1] = [Math.min(x0, x), Math.max(x1, x)];
    for (const y of path.y) [y0, y1] = [Math.min(y0, y), Math.max(y1, y)];
  }
  const margin = 15 + 0.1 * Math.max(x1 - x0, y1 - y0);
  const metresPerPixel = Math.max((x1 - x0 + 2 * margin) / width, (y1 - y0 + 2 * margin) / height);
  return {x: (x0 + x1) / 2, y: (y0 + y1) / 2, metresPerPixel};
}

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

// Marks where each run was at the time, or nothing for null.
function showHere(t) {
  for (const run of shownRuns()) {
    if (!run.here) continue;
    run.here.style.display = t === null ? "none" : "block";
    if (t === null) continue;
    const i = indexAt(run.path.t, t);
    run.here.style.left = `${pathPlot.valToPos(run.path.x[i], "x")}px`;
    run.here.style.top = `${pathPlot.valToPos(run.path.y[i], "y")}px`;
  }
}

// Shows in all plots the time at which a path is nearest to the pointer.
function pointAt(plot, left, top) {
  const x = plot.posToVal(left, "x"), y = plot.posToVal(top, "y");
  let best = Infinity, at = 0;
  for (const {path} of shownRuns()) {
    path.x.forEach((px, i) => {
      const square = (px - x) ** 2 + (path.y[i] - y) ** 2;
      if (square < best) { best = square; at = path.t[i]; }
    });
  }
  isPointing = true;
  for (const other of timePlots) other.setCursor({left: other.valToPos(at, "x"), top: 10});
  isPointing = false;
  showHere(at);
}

function listenToPointer(plot) {
  const over = plot.over;
  for (const run of shownRuns()) {
    run.here = element("div", undefined, "here");
    run.here.style.background = run.colour;
    over.append(run.here);
  }
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
  if (runs[0].truth && runs[0].truth.path) byId("hint").append(" The black dashes are the truth.");
}
