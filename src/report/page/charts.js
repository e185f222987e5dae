// The charts of one run, in the order of the page. A line that says `isSingle` is left out where
// runs are compared.
const NIS_BAND = [1.24, 14.45];  // 95 % of chi-square with six degrees of freedom

function shaded(low, high) {
  return {hooks: {drawClear: plot => {
    const top = Math.max(plot.bbox.top, plot.valToPos(high, "y", true));
    const bottom = Math.min(plot.bbox.top + plot.bbox.height, plot.valToPos(low, "y", true));
    if (!(bottom > top)) return;
    plot.ctx.fillStyle = "#2b8a3e1c";
    plot.ctx.fillRect(plot.bbox.left, top, plot.bbox.width, bottom - top);
  }}};
}

function errorCharts({truth}) {
  const errors = truth && truth.errors;
  if (!errors) return [];
  const charts = ["x", "y", "z"].map((axis, i) => ({
    title: `Error of ${axis} [m], estimate minus truth, and 3 sigma`, t: errors.t,
    lines: [{label: axis, y: errors[axis], std: errors[`${axis}_std`], isError: true, colour: COLOURS[i]}],
    options: {height: 165}}));
  const name = {x: "roll", y: "pitch", z: "yaw"};
  charts.push({title: "Error of attitude [°] about the world's axes, and 3 sigma", t: errors.t,
    lines: ["x", "y", "z"].map(axis => ({label: name[axis], y: errors[`r${axis}`],
      std: errors[`r${axis}_std`], isError: true}))});
  return charts;
}

function heightChart(run) {
  const lines = [{label: "z", y: run.path.z, colour: PATH_COLOUR}];
  const truth = run.truth && run.truth.path;
  if (truth) {
    const z = run.path.t.map(t => {
      const i = indexAt(truth.t, t);
      return Math.abs(truth.t[i] - t) < 0.5 ? truth.z[i] : null;
    });
    lines.unshift({label: "truth", y: z, colour: TRUTH_COLOUR, dash: [6, 4], isSingle: true});
  }
  return {title: "Height z [m]", t: run.path.t, lines};
}

function xyzLines(table, what, unit, factor = 1) {
  const scaled = column => (column || []).map(v => v == null ? null : v * factor);
  return ["x", "y", "z"].map(axis => ({label: axis, y: scaled(table[`${what}_${axis}_${unit}`]),
    std: scaled(table[`${what}_${axis}_std_${unit}`])}));
}

function stateCharts({states}) {
  if (!states || !states.t) return [];
  const t = states.t;
  const charts = [{title: "Velocity [m/s], in world", t, lines: xyzLines(states, "velocity", "mps")}];
  if (states.accel_bias_x_std_mps2.some(v => v)) {  // else the IMU is not in use
    const degPerRad = 180 / Math.PI;
    charts.push({title: "Gyro bias [°/s]", t, lines: xyzLines(states, "gyro_bias", "radps", degPerRad)});
    charts.push({title: "Accelerometer bias [m/s²]", t, lines: xyzLines(states, "accel_bias", "mps2")});
  }
  if (states.clock_offset_std_s.some(v => v)) {
    const ms = column => column.map(v => 1e3 * v);
    charts.push({title: "Clock offset [ms]", t,
      lines: [{label: "offset", y: ms(states.clock_offset_s), std: ms(states.clock_offset_std_s)}]});
  }
  return charts;
}

function healthCharts({states}) {
  if (!states || !states.t) return [];
  const charts = [{title: "Status", t: states.t, options: {height: 150, names: STATUS},
    lines: [{label: "status", y: states.status, isStepped: true, names: STATUS, width: 2}]}];
  if (states.trust.some(v => v >= 0)) {
    charts.push({title: "Verdict so far: may the result be trusted?", t: states.t,
      options: {height: 120, names: TRUST},
      lines: [{label: "trust", y: states.trust.map(v => v < 0 ? null : v), isStepped: true, names: TRUST,
        width: 2, colour: COLOURS[1]}]});
  }
  return charts;
}

function scanCharts({scans}) {
  if (!scans || !scans.t) return [];
  const stages = ["total", "match", "reduce", "deskew", "insert", "filter"];
  return [{title: "NIS of a match: 6 is right, the band holds 95 %", t: scans.t,
    lines: [{label: "NIS", y: scans.nis.map(v => v > 0 ? Math.max(v, 0.05) : null)}],
    options: {isLog: true, digits: 1, plugins: [shaded(...NIS_BAND)]}},
  {title: "Points of a scan", t: scans.t, options: {digits: 0},
    lines: [{label: "used", y: scans.num_used, isSingle: true}, {label: "matched", y: scans.num_matched}]},
  {title: "Computing time of a scan [ms]", t: scans.t, options: {digits: 2},
    lines: stages.map(stage => ({label: stage, y: scans[`${stage}_ms`], width: stage === "total" ? 2 : 1.2,
      isSingle: stage !== "total"}))}];
}

function chartsOf(run) {
  const ofPath = hasPath(run) ? [...errorCharts(run), heightChart(run)] : [];
  return [...ofPath, ...stateCharts(run), ...healthCharts(run), ...scanCharts(run)];
}
