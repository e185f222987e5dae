# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""The figures of one run: a row of the table. Columns whose names end in _wall_s, _cpu_s, _ms or
_mb are measured anew by each run; all others are the same whenever a run is made again."""
import steps

# Column, and the place of its value in eval.json.
SCORES = {
    "ape_m": ("ape", "position_m", "rmse"),
    "ape_max_m": ("ape", "position_m", "max"),
    "ape_deg": ("ape", "rotation_deg", "rmse"),
    "drift_percent": ("drift", "translation_percent"),
    "drift_deg_per_100m": ("drift", "rotation_deg_per_100m"),
    "rpe_1s_m": ("rpe", "1s", "translation_m", "rmse"),
    "end_m": ("end", "error_m"),
    "end_percent": ("end", "error_percent"),
    "coverage_ratio": ("association", "coverage_ratio"),
    "path_m": ("path_length_m",),
    "duration_s": ("duration_s",),
}
NEES = {
    "nees_pose": ("nees", "pose", "average_per_dof"),
    "nees_position": ("nees", "position", "average_per_dof"),
    "nees_rotation": ("nees", "rotation", "average_per_dof"),
}
STATS = {
    "num_rejected": ("num_matches_rejected",),
    "scan_median_ms": ("stage_ms", "total", "median"),
    "scan_p99_ms": ("stage_ms", "total", "p99"),
    "rss_peak_mb": ("rss_peak_mb",),
}
FIGURES = (*SCORES, *NEES, *STATS, "run_cpu_s", "run_wall_s")
COLUMNS = ("drive", "group", "seed", "system", "kind", "status", "trust", *FIGURES, "causes",
           "said")


def value_at(tree, path):
    for key in path:
        tree = tree.get(key) if isinstance(tree, dict) else None
    return tree


def load(path):
    return steps.read_json(path) if path.exists() else {}


def empty_row(status, said):
    return {"status": status, "trust": None, **dict.fromkeys(FIGURES), "causes": "", "said": said}


def figures(folder):
    sources = ((SCORES, "eval.json"), (NEES, "consistency.json"), (STATS, "stats.json"))
    return {column: value_at(load(folder / name), path)
            for columns, name in sources for column, path in columns.items()}


def status_of(folder, done, unscored):
    if done["exit"] == steps.CONFIGURATION or not (folder / "verdict.json").exists():
        return "failed"
    if unscored:
        return unscored
    return "done" if (folder / "eval.json").exists() else "no pose"


def row_of_run(folder, done, unscored):
    """The row of a run's folder; `unscored` is its status where there is nothing to score."""
    verdict = load(folder / "verdict.json")
    said = done["said"] if done["exit"] in (steps.CONFIGURATION, steps.INPUT) else ""
    return empty_row(status_of(folder, done, unscored), said) | figures(folder) | {
        "trust": verdict.get("trust"),
        "causes": " ".join(cause["kind"] for cause in verdict.get("causes", [])),
        "run_cpu_s": done["cpu_s"], "run_wall_s": done["wall_s"],
        "exit": done["exit"]}


def row_of_peer(folder, done):
    scored = (folder / "eval.json").exists()
    row = empty_row("done", "") if scored else empty_row("failed", done["said"])
    return row | figures(folder)
