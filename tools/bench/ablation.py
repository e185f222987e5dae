#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Measures what each effect of the simulator's realism `field` costs: it is added alone to ideal
sensors, and left out alone of the field. Prints Markdown tables of ATE [cm] of the level path and
NEES per degree of freedom of the steady path, each as median and worst over the seeds.

  tools/bench/ablation.py [--seeds 1,2,3] [--drives street:hdl32e,...] [--work out/ablation]
                          [--effects glass,...] [--table]

Results are kept in WORK/results.json; --table prints what is there and measures nothing. Scans are
cast once for all effects of IMU and clocks. Needs tools/setup.sh, and 3 GB of disk at a time."""
import argparse
import pathlib
import shutil

from simulated_runs import Drive, Results, median_and_worst, replay, simulate

# Effects that change what the lidar sees; the others leave the scans as they are.
LIDAR = ("mixed-pixels", "laser-bias", "grazing-bias", "intensity-bias", "glass", "beam-table",
         "rotor", "encoder")
OTHERS = ("stamp-jitter", "clock-drift", "vibration", "engine", "rectification", "g-sensitivity",
          "warm-up")
CLOCKS = ("--without", "stamp-jitter", "--without", "clock-drift")
DRIVES = "street:hdl32e,suburb:hdl32e,street:vlp16,suburb:vlp16"
IDEAL, FIELD = ("--realism", "ideal"), ("--realism", "field")


def measure(results, drive, work, row, *words):
    name = f"{drive.name} {row}"
    if name in results:
        return
    folder = work / "log"
    simulate(drive, folder, *words)
    results.keep(name, replay(folder))


def measure_drive(results, drive, work, effects):
    """The rows that share scans come first, then those that need scans of their own."""
    rows = [(grade, effect) for grade in ("ideal", "field") for effect in ("", *effects)]
    if f"{drive.name} datasheet" not in results:
        measure(results, drive, work, "datasheet", "--realism", "datasheet")
    if all(f"{drive.name} {row_name(*row)}" in results for row in rows):
        return
    ideal, field = work / "ideal", work / "field"
    simulate(drive, ideal, *IDEAL)
    simulate(drive, field, *FIELD, *CLOCKS)
    scans = {"ideal": ("--scans", ideal / "log.lcm"), "field": ("--scans", field / "log.lcm")}
    for grade, effect in sorted(rows, key=lambda row: row[1] in LIDAR):
        choice = ("--with" if grade == "ideal" else "--without", effect) if effect else ()
        shared = () if effect in LIDAR else scans[grade]
        measure(results, drive, work, row_name(grade, effect), "--realism", grade, *choice, *shared)
    for folder in (ideal, field, work / "log"):
        shutil.rmtree(folder, ignore_errors=True)


def row_name(grade, effect):
    return f"{grade} {'+' if grade == 'ideal' else '-'}{effect}" if effect else grade


def cell(results, drives, row):
    found = [results[f"{drive.name} {row}"] for drive in drives
             if f"{drive.name} {row}" in results]
    ates = median_and_worst([100 * figures["ate_m"] for figures in found])
    return f"{ates}; {median_and_worst([figures['nees'] for figures in found])}"


def print_table(results, drives, seeds, grade, effects):
    print(f"\n| {'added to ideal' if grade == 'ideal' else 'left out of field'} | "
          + " | ".join(drive.replace(":", ", ") for drive in drives) + " |")
    print("|---" * (len(drives) + 1) + "|")
    rows = [(effect or "nothing", row_name(grade, effect)) for effect in ("", *effects)]
    if grade == "field":
        rows.append(("all: `datasheet`", "datasheet"))
    for title, row in rows:
        cells = [cell(results, [Drive(*words.split(":"), seed) for seed in seeds], row)
                 for words in drives]
        print(f"| {title} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--drives", default=DRIVES)
    parser.add_argument("--effects", default=",".join((*LIDAR, *OTHERS)))
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("out/ablation"))
    parser.add_argument("--table", action="store_true")
    args = parser.parse_args()
    seeds = [int(seed) for seed in args.seeds.split(",")]
    drives, effects = args.drives.split(","), args.effects.split(",")
    results = Results(args.work / "results.json")
    for seed in seeds if not args.table else ():
        for words in drives:
            measure_drive(results, Drive(*words.split(":"), seed), args.work, effects)
    for grade in ("ideal", "field"):
        print_table(results, drives, seeds, grade, effects)


if __name__ == "__main__":
    main()
