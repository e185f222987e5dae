#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Measures what wrong densities of the IMU cost: those of the rig ten times too large and too
small, of gyro and accelerometer, and a shaking that starts in the middle of the drive and that the
rig knows nothing of. Prints a Markdown table: ATE [cm] of the level path with the right densities,
and the ratio to it with wrong ones, each as median and worst over the seeds.

  tools/bench/densities.py [--seeds 1,2,3] [--drives street:hdl32e,...] [--work out/densities]
                           [--table]

Results are kept in WORK/results.json; --table prints what is there and measures nothing. Needs
tools/setup.sh, and 2 GB of disk at a time."""
import argparse
import math
import pathlib
import re
import shutil

from simulated_runs import Drive, Results, median_and_worst, replay, simulate

DRIVES = "street:hdl32e,garage:hdl32e,suburb:hdl32e,campus:vlp16"
KEYS = {"gyro": "rig.imu.gyro_noise_density", "accel": "rig.imu.accel_noise_density"}
# 1 sigma of a sample, as the issue has it of carriers shaken hard; from the middle on.
SHAKING = {"accel": 0.6, "gyro": 0.01}
FAULT = "shaking:start=30,accel={accel},gyro={gyro}".format(**SHAKING)
RATE_HZ = 100.0  # the Xsens'
WRONG = ("gyro x 10", "gyro / 10", "accel x 10", "accel / 10")
ROWS = ("right", *WRONG, "shaken, told", "shaken, not told")


def densities(folder):
    text = (folder / "config.yaml").read_text()
    return {kind: float(re.search(rf"{kind}_noise_density: (\S+)", text)[1]) for kind in KEYS}


def settings_of(row, true):
    """The settings that make the rig say what the row's name tells."""
    if row == "shaken, told":
        shaken = {kind: std / math.sqrt(RATE_HZ) for kind, std in SHAKING.items()}
        return [f"{key}={math.hypot(true[kind], shaken[kind])}" for kind, key in KEYS.items()]
    for kind, key in KEYS.items():
        if row.startswith(kind):
            return [f"{key}={true[kind] * (10 if 'x' in row else 0.1)}"]
    return []


def measure_drive(results, drive, work):
    if all(f"{drive.name} {row}" in results for row in ROWS):
        return
    scans_folder, still, shaken = work / "scans", work / "still", work / "shaken"
    clocks = ("--without", "stamp-jitter", "--without", "clock-drift")
    simulate(drive, scans_folder, *clocks)
    scans = ("--scans", scans_folder / "log.lcm")
    simulate(drive, still, *scans)
    simulate(drive, shaken, *scans, "--fault", FAULT)
    true = densities(still)
    for row in ROWS:
        if f"{drive.name} {row}" not in results:
            folder = shaken if row.startswith("shaken") else still
            results.keep(f"{drive.name} {row}", replay(folder, *settings_of(row, true)))
    for folder in (scans_folder, still, shaken):
        shutil.rmtree(folder, ignore_errors=True)


def ratios(results, drives, row):
    right = "shaken, told" if row.startswith("shaken") else "right"
    return [results[f"{drive.name} {row}"]["ate_m"] / results[f"{drive.name} {right}"]["ate_m"]
            for drive in drives if f"{drive.name} {row}" in results]


def print_table(results, drives, seeds):
    print("\n| | " + " | ".join(words.replace(":", ", ") for words in drives) + " |")
    print("|---" * (len(drives) + 1) + "|")
    all_seeds = [[Drive(*words.split(":"), seed) for seed in seeds] for words in drives]
    for row in ROWS:
        cells = []
        for one in all_seeds:
            if row in ("right", "shaken, told"):
                found = [f"{drive.name} {row}" for drive in one if f"{drive.name} {row}" in results]
                cells.append(median_and_worst([100 * results[name]["ate_m"] for name in found])
                             + " cm")
            else:
                cells.append(median_and_worst(ratios(results, one, row)))
        print(f"| {row} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--drives", default=DRIVES)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("out/densities"))
    parser.add_argument("--table", action="store_true")
    args = parser.parse_args()
    seeds, drives = [int(seed) for seed in args.seeds.split(",")], args.drives.split(",")
    results = Results(args.work / "results.json")
    for seed in seeds if not args.table else ():
        for words in drives:
            measure_drive(results, Drive(*words.split(":"), seed), args.work)
    print_table(results, drives, seeds)


if __name__ == "__main__":
    main()
