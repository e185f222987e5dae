#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Prints one Markdown row for each scenario that tools/bench/scenarios.sh has run."""
import csv
import json
import pathlib
import sys

HEADER = ("| scenario | path m | APE se3 cm | drift % | end error cm | z drift cm | tilt deg "
          "| step mm | scans | not fused | weak | ms a scan | MB |")


def row(root, name):
    folder = root / name
    score = json.loads((folder / "eval.json").read_text())
    stats = json.loads((folder / "run" / "stats.json").read_text())
    with open(folder / "run" / "registration.csv", encoding="utf-8") as file:
        matches = list(csv.DictReader(file))
    weak = sum(match["status"] in ("degenerate", "5") for match in matches)
    drift = score["drift"]["translation_percent"] if score["drift"]["num_segments"] else None
    cells = [name, f"{score['path_length_m']:.0f}",
             f"{100 * score['ape']['position_m']['rmse']:.2f}",
             "-" if drift is None else f"{drift:.3f}",
             f"{100 * score['end']['error_m']:.1f}", f"{100 * score['z_drift']['end_m']:.1f}",
             f"{score['tilt_deg']['rmse']:.2f}",
             f"{1000 * score['step']['translation_m']['median']:.2f}",
             str(len(matches)), str(stats["num_matches_rejected"]), str(weak),
             f"{stats['stage_ms']['total']['median']:.1f}", f"{stats['rss_peak_mb']:.0f}"]
    return "| " + " | ".join(cells) + " |"


def main():
    root = pathlib.Path(sys.argv[1])
    print(HEADER)
    print("|" + "---|" * (HEADER.count("|") - 1))
    for name in sys.argv[2:]:
        print(row(root, name))


if __name__ == "__main__":
    main()
