// Plots over time, whose zoom and cursors are linked. A chart is {title, t, lines, options} of one
// run; each of its lines is {label, y, colour, std, dash, isStepped, names, width}: `std` draws a
// band of three sigma about y, or about zero when the line says `isError`.
const timePlots = [];
let timeRange = [0, 1], isLinking = false;

function setTime(min, max) {
  isLinking = true;
  timeRange = [min, max];
  for (const plot of timePlots) plot.setScale("x", {min, max});
  isLinking = false;
  if (pathPlot) pathPlot.redraw(false);
}

function showNoticeMarks(plot) {
  const {ctx, bbox} = plot;
  ctx.save();
  ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
  for (const run of runs) {
    ctx.strokeStyle = isMany ? run.colour + "66" : "#b26a0066";
    for (const [t, severity] of run.notices) {
      const x = plot.valToPos(t, "x", true);
      if (severity === "info" || x < bbox.left || x > bbox.left + bbox.width) continue;
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
    }
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

function seriesOf(lines, digits) {
  const series = [], columns = [], bands = [];
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

// Charts of several runs have times of their own each: the columns are joined over all times.
function joinedCharts(charts, digits) {
  const all = {series: [{label: "t [s]", value: (_, t) => t == null ? "–" : t.toFixed(2)}], bands: []};
  const tables = [];
  for (const {t, lines} of charts) {
    const {series, columns, bands} = seriesOf(lines, digits);
    const offset = all.series.length;
    all.series.push(...series);
    all.bands.push(...bands.map(band => ({...band, series: band.series.map(k => k + offset)})));
    tables.push([t, ...columns]);
  }
  all.columns = tables.length > 1 ? uPlot.join(tables) : tables[0];
  return all;
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

const isWhole = ({t, lines}) => t && t.length > 1 && lines.length && lines.every(line => line.y);

function addTimePlot(title, charts, options = {}) {
  const card = element("section", undefined, "card");
  card.append(element("h2", title));
  byId("plots").append(card);
  const {series, columns, bands} = joinedCharts(charts, options.digits ?? 3);
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
  }, columns, card);
  timePlots.push(plot);
}

// Several runs have a plot for each line of a chart, with one line a run.
function addComparedPlots(title, charts) {
  const {lines, options = {}} = charts[0].chart;
  for (const {label} of lines.filter(line => !line.isSingle)) {
    const parts = [];
    for (const {run, chart} of charts) {
      const line = chart.lines.find(other => other.label === label);
      if (!line) continue;
      parts.push({t: chart.t, lines: [{...line, label: nameOf(run), colour: run.colour}]});
    }
    const what = lines.length > 1 ? `${title}: ${label}` : title;
    addTimePlot(what, parts, options);
  }
}

function addTimePlots() {
  const byTitle = new Map();
  for (const run of runs) {
    for (const chart of chartsOf(run).filter(isWhole)) {
      if (!byTitle.has(chart.title)) byTitle.set(chart.title, []);
      byTitle.get(chart.title).push({run, chart});
    }
  }
  for (const [title, charts] of byTitle) {
    if (isMany) addComparedPlots(title, charts);
    else addTimePlot(title, [charts[0].chart], charts[0].chart.options);
  }
}
