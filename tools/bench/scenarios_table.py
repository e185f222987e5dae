#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Prints two Markdown tables, a row for each scenario that tools/bench/scenarios.sh has run. Figures
are those of the level path, but z drift, which is that of the path as it was published.

    scenarios_table.py DIR    the fleet's folder
"""
import csv
import pathlib
import sys

from fleet_runs import read, scored_runs

ERRORS = ("| drive | path m | APE cm | drift % | end cm | gap cm | z drift cm | z level cm "
          "| tilt ° | step mm |")
MATCHES = "| drive | scans | converged | degenerate | no match | not fused | ms a scan | MB |"
CLOSED_RATIO = 0.01  # a path that ends this near its start, relative to its length, is closed


def closing_gap(score):
    """Returns the distance from first to last position if the true path is closed; else a dash."""
    end = score["end"]
    if end["truth_gap_m"] > CLOSED_RATIO * score["path_length_m"]:
        return "-"
    return f"{100 * end['estimate_gap_m']:.1f}"


def height_of_level_path(score):
    """Returns the largest error of its height since the start, without alignment; a dash where no
    gravity was felt, so that no path is level."""
    if not score["estimate"].endswith("trajectory_level.tum"):
        return "-"
    return f"{100 * score['z_drift']['max_m']:.1f}"


def status_counts(matches):
    """Converged, with degenerate directions, neither; and how many of all were not fused."""
    counts = {"converged": 0, "degenerate": 0}
    for match in matches:
        counts[match["status"]] = counts.get(match["status"], 0) + 1
    others = len(matches) - counts["converged"] - counts["degenerate"]
    unfused = sum(match["fused"] == "0" for match in matches)
    return [counts["converged"], counts["degenerate"], others, unfused]


def rows(name, folder):
    """The scenario's row of each table."""
    score, published, stats = (read(folder / file) for file in
                               ("eval.json", "eval_published.json", "stats.json"))
    with open(folder / "registration.csv", encoding="utf-8") as file:
        matches = list(csv.DictReader(file))
    drift = score["drift"]["translation_percent"] if score["drift"]["num_segments"] else None
    errors = [name, f"{score['path_length_m']:.0f}",
              f"{100 * score['ape']['position_m']['rmse']:.2f}",
              "-" if drift is None else f"{drift:.3f}",
              f"{100 * score['end']['error_m']:.1f}", closing_gap(score),
              f"{100 * published['z_drift']['end_m']:.1f}", height_of_level_path(score),
              f"{score['tilt_deg']['rmse']:.2f}",
              f"{1000 * score['step']['translation_m']['median']:.2f}"]
    counts = [name, str(len(matches)), *(str(count) for count in status_counts(matches)),
              f"{stats['stage_ms']['total']['median']:.1f}", f"{stats['rss_peak_mb']:.0f}"]
    return ["| " + " | ".join(cells) + " |" for cells in (errors, counts)]


def main():
    root = pathlib.Path(sys.argv[1])
    columns = zip(*(rows(row["group"], folder) for row, folder in scored_runs(root)))
    for header, table in zip((ERRORS, MATCHES), columns):
        if header != ERRORS:
            print()
        print(header, "|" + "---|" * (header.count("|") - 1), *table, sep="\n")


if __name__ == "__main__":
    main()
