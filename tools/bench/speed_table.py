#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Prints medians over the runs in the given folders: stage times, real-time factor, memory."""
import csv
import json
import pathlib
import statistics
import sys


def points_per_sweep(folder):
    with open(folder / "registration.csv", newline="", encoding="utf-8") as stream:
        return statistics.median(int(row["num_raw"]) for row in csv.DictReader(stream))


def main():
    folders = [pathlib.Path(name) for name in sys.argv[1:]]
    runs = [json.loads((folder / "stats.json").read_text()) for folder in folders]

    def median(*keys):
        values = []
        for run in runs:
            for key in keys:
                run = run[key]
            values.append(run)
        return statistics.median(values)

    print(f"{len(runs)} runs, {median('num_scans'):.0f} sweeps of "
          f"{points_per_sweep(folders[0]):.0f} returns")
    print(f"{'stage':<8} {'median':>8} {'p99':>8}   ms per sweep")
    for stage in runs[0]["stage_ms"]:
        print(f"{stage:<8} {median('stage_ms', stage, 'median'):8.2f} "
              f"{median('stage_ms', stage, 'p99'):8.2f}")
    print(f"real-time factor {median('realtime_factor'):.1f}")
    print(f"memory at its peak {median('rss_peak_mb'):.0f} MB")


if __name__ == "__main__":
    main()
