#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Prints the row of netns.sh about one run: netns_row.py CASE RUN DRIVE BUILD"""
import csv
import json
import pathlib
import subprocess
import sys

LOST = 4


def main():
    case, run, drive, build = sys.argv[1], *map(pathlib.Path, sys.argv[2:])
    stats = json.loads((run / "stats.json").read_text())
    account = stats["account"]
    received = account["imu"]["received"] + account["chunks"]["received"]
    sent = 0
    info = subprocess.run([build / "bin/lio-log", "info", drive / "log.lcm"], check=True,
                          capture_output=True, text=True).stdout
    for line in info.splitlines():
        words = line.split()
        if words and words[0] in ("LIO_IMU", "LIO_SCAN"):
            sent += int(words[1])
    score = run / "eval.json"
    subprocess.run([build / "bin/lio-eval", drive / "truth.tum", run / "trajectory.tum", "--json",
                    score], check=True, capture_output=True)
    ape_cm = 100 * json.loads(score.read_text())["ape"]["position_m"]["rmse"]
    with open(run / "states.csv", newline="", encoding="utf-8") as stream:
        states = [int(row["status"]) for row in csv.DictReader(stream)]
    print(f"| {case} | {received} | {sent} | {stats['num_imu_missing']} | "
          f"{stats['num_chunks_missing']} | {len(states)} | {0.1 * states.count(LOST):.1f} | "
          f"{ape_cm:.1f} |", flush=True)


if __name__ == "__main__":
    main()
