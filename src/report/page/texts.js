// The texts of the page: verdicts, causes, figures, assumptions, notices and options.
const lastPart = run => run.input.split("/").filter(part => part).pop() || "run";

// The last part of the path, where no other run has the same.
function nameOf(run) {
  const isShared = runs.some(other => other !== run && lastPart(other) === lastPart(run));
  return isShared ? run.input : lastPart(run);
}

function swatch(run) {
  const made = element("span", undefined, "swatch");
  made.style.background = run.colour;
  return made;
}

function badge(run) {
  return element("span", `trust: ${run.verdict.trust}`, `badge ${run.verdict.trust}`);
}

function verdictText(verdict) {
  const claimed = verdict.claimed || {};
  let text = `  poses for ${(100 * verdict.coverage).toFixed(0)} % of the time`;
  if (claimed.position_std_m_per_100m != null) {
    text += `; claimed: ${number(claimed.position_std_m_per_100m, 2)} m per 100 m`;
  }
  if (claimed.tilt_std_deg != null) text += `, ${number(claimed.tilt_std_deg, 2)}° of tilt (1 sigma)`;
  return text;
}

function showHeader() {
  document.title = `liod: ${runs.map(nameOf).join(", ")}`;
  byId("title").textContent = isMany ? `${runs.length} runs side by side` : data.input;
  if (isMany || !data.verdict) return;
  byId("verdict").append(badge(data), verdictText(data.verdict));
}

function showCause(run, cause, note) {
  const box = element("div", undefined, cause.leaves === "no" && !note ? "cause no-trust" : "cause");
  if (isMany) box.append(swatch(run), `${run.input}: `);
  box.append(element("strong", cause.kind.replaceAll("_", " ") + note), element("div", cause.evidence));
  if (cause.fix) box.append(element("pre", cause.fix.trimEnd()));
  byId("causes").append(box);
}

function showCauses(run) {
  if (!run.verdict) return;
  for (const cause of run.verdict.causes) showCause(run, cause, "");
  const note = ": found by the first pass, and no longer there in this one";
  for (const cause of run.verdict.mended || []) showCause(run, cause, note);
}

function figureRows(run) {
  const rows = [], stats = run.stats, truth = run.truth;
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
    const noise = stats.imu_noise_per_rig, beams = stats.beam_errors;
    if (noise && noise.gyro.median != null) {
      rows.push(["noise over the rig's, gyro, accelerometer",
        `${number(noise.gyro.median, 1)}, ${number(noise.accel.median, 1)} times`]);
    }
    if (beams) {
      const shown = ({rms, std}) => `${number(1e3 * rms, 2)} ± ${number(1e3 * std, 2)}`;
      rows.push(["errors found of the lasers' ranges", `${shown(beams.range_m)} mm`],
        ["errors found of elevations, azimuths",
          `${shown(beams.elevation_rad)}, ${shown(beams.azimuth_rad)} mrad`]);
    }
  }
  return rows;
}

function showTable(table, rows) {
  for (const row of rows) {
    const line = element("tr");
    for (const cell of row) {
      const box = element("td");
      box.append(cell instanceof Node ? cell : String(cell));
      line.append(box);
    }
    table.append(line);
  }
}

// One column a run; a figure that only some of them have is a dash for the others.
function comparedRows() {
  const ofRuns = runs.map(run => new Map(figureRows(run)));
  const names = [...new Set(ofRuns.flatMap(figures => [...figures.keys()]))];
  const heads = runs.map(run => {
    const head = element("span");
    head.append(swatch(run), run.input);
    return head;
  });
  const trust = runs.map(run => run.verdict ? badge(run) : "–");
  const coverage = runs.map(run => run.verdict ? `${(100 * run.verdict.coverage).toFixed(0)} %` : "–");
  return [["", ...heads], ["verdict", ...trust], ["poses for", ...coverage],
    ...names.map(name => [name, ...ofRuns.map(figures => figures.get(name) ?? "–")])];
}

// The entries of a printed configuration, by their full names: "rig.imu.units".
function entriesOf(yaml) {
  const entries = new Map(), path = [];
  for (const line of yaml.split("\n")) {
    const found = line.match(/^( *)([\w-]+):(.*)$/);
    if (!found) continue;
    const depth = found[1].length / 2;
    path.length = depth;
    path[depth] = found[2];
    const value = found[3].replace(/\s#.*$/, "").trim();
    if (value) entries.set(path.join("."), value);
  }
  return entries;
}

function showOptions() {
  if (!isMany) { byId("options").textContent = data.options; return; }
  const all = runs.map(run => entriesOf(run.options));
  const names = [...new Set(all.flatMap(entries => [...entries.keys()]))];
  const rows = names.map(name => [name, ...all.map(entries => entries.get(name) ?? "–")])
    .filter(row => row.slice(1).some(value => value !== row[1]));
  const table = element("table");
  showTable(table, rows);
  const box = byId("options").parentElement;
  box.open = true;
  box.replaceChildren(element("summary", rows.length ? "Options that differ" : "No option differs"), table);
}

function showAssumptions(isOwnTime) {
  const said = [];
  for (const run of runs) {
    const mine = [...run.assumptions];
    if (run.truth && run.truth.note) mine.push(`No comparison with the truth: ${run.truth.note}`);
    if (run.truth && run.truth.remark) mine.push(run.truth.remark);
    said.push(...mine.map(text => isMany ? `${run.input}: ${text}` : text));
  }
  if (isOwnTime) said.push("The runs are of different times: each has its own zero.");
  if (!said.length) return;
  const list = element("ul");
  for (const text of said) list.append(element("li", text));
  byId("assumptions").append(element("h2", "Assumptions"), list);
}

function showNotices() {
  const notices = byId("notices"), rows = [];
  for (const run of runs) {
    for (const [t, severity, text] of run.notices) {
      rows.push([t, [`${t.toFixed(1)} s`, ...(isMany ? [swatch(run)] : []), severity, text]]);
    }
  }
  if (!rows.length) return notices.remove();
  const table = element("table");
  showTable(table, rows.sort((a, b) => a[0] - b[0]).map(([, row]) => row));
  notices.append(element("h2", "Notices during the run"), table);
}

function showTexts(isOwnTime) {
  showHeader();
  runs.forEach(showCauses);
  showTable(byId("figures"), isMany ? comparedRows() : figureRows(data));
  showAssumptions(isOwnTime);
  showOptions();
  showNotices();
}
