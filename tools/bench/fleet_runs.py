# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Runs fleets (tools/fleet.sh) for the scripts of this folder, and reads their runs."""
import json
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def run_fleet(fleet, out, jobs, environment=None):
    """Runs a fleet, given as what its file says, in the folder; returns the exit code."""
    out.mkdir(parents=True, exist_ok=True)
    file = out / "fleet.yaml"  # YAML takes JSON, too
    file.write_text(json.dumps(fleet, indent=1), encoding="utf-8")
    words = [ROOT / "tools/fleet.sh", file, "--out", out, "--jobs", str(jobs)]
    return subprocess.run(words, env=environment, check=False).returncode


def scored_runs(root):
    """Yields the row of the table and the folder of each run with a score; tells of the others."""
    for row in read(root / "table.json")["rows"]:
        if row["status"] == "done":
            yield row, root / "runs" / row["system"] / row["drive"]
        else:
            print(f"{row['system']} over {row['drive']}: {row['status']} {row['said']}",
                  file=sys.stderr)


def figures(root, system, name, seeds, figure):
    """A figure of the runs of a simulated drive that there are so far, as {seed: value}."""
    rows = {seed: root / f"runs/{system}/{name}-{seed}/row.json" for seed in seeds}
    values = {seed: read(row)[figure] for seed, row in rows.items() if row.exists()}
    return {seed: value for seed, value in values.items() if value is not None}


def median_and_worst(values):
    """As text; a dash where nothing was measured, and one figure where only one was."""
    values = list(values)
    if not values:
        return "-"
    if len(values) == 1:
        return f"{values[0]:.2g}"
    return f"{statistics.median(values):.2g}, {max(values):.2g}"
