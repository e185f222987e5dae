#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Measures what each effect of the simulator's realism `field` costs: it is added alone to ideal
sensors, and left out alone of the field. Prints Markdown tables of ATE [cm] of the level path and
NEES per degree of freedom of the steady path, each as median and worst over the seeds.

  tools/bench/ablation.py [--seeds 1,2,3] [--drives street:hdl32e,...] [--work out/ablation]
                          [--effects glass,...] [--jobs N] [--table]

All are drives of a fleet (tools/fleet.sh) in WORK, which goes on where it was stopped; --table
prints what is there and measures nothing. Scans are cast once for all effects of IMU and clocks.
Needs what the fleet does, and for each job 5 GB of disk at a time."""
import argparse
import os
import pathlib

from fleet_runs import figures, median_and_worst, run_fleet

# Effects that change what the lidar sees; the others leave the scans as they are.
LIDAR = ("mixed-pixels", "laser-bias", "grazing-bias", "intensity-bias", "glass", "beam-table",
         "rotor", "encoder")
OTHERS = ("stamp-jitter", "clock-drift", "vibration", "engine", "rectification", "g-sensitivity",
          "warm-up")
CLOCKS = "--without stamp-jitter --without clock-drift"
DRIVES = "street:hdl32e,suburb:hdl32e,street:vlp16,suburb:vlp16"
GRADES = {"ideal": "with", "field": "without"}


def row_name(grade, effect):
    return f"{grade}{'+' if grade == 'ideal' else '-'}{effect}" if effect else grade


def drives_of(place, effects):
    """Name and words of each row of a place, and the drive whose scans it takes, if any."""
    for grade, choice in GRADES.items():
        scans = f"scans-{place}-{grade}"
        yield scans, f"--realism {grade} {CLOCKS if grade == 'field' else ''}", ""
        for effect in ("", *effects):
            words = f"--realism {grade} " + (f"--{choice} {effect}" if effect else "")
            yield f"{place}-{row_name(grade, effect)}", words, "" if effect in LIDAR else scans
    yield f"{place}-datasheet", "--realism datasheet", ""


def fleet_of(places, seeds, effects):
    drives = [{"name": name, "scans": scans, "seeds": ",".join(map(str, seeds)),
               "sim": "--scenario {} --lidar {} --duration 60 ".format(*place.split("-")) + words}
              for place in places for name, words, scans in drives_of(place, effects)]
    return {"drives": drives, "configurations": [
        {"name": "liod", "words": "--passes 1", "drives": [f"{place}-*" for place in places]}]}


def cell(work, name, seeds):
    ates = figures(work, "liod", name, seeds, "ape_m").values()
    nees = figures(work, "liod", name, seeds, "nees_pose").values()
    return f"{median_and_worst(100 * ate for ate in ates)}; {median_and_worst(nees)}"


def print_table(work, places, seeds, grade, effects):
    print(f"\n| {'added to ideal' if grade == 'ideal' else 'left out of field'} | "
          + " | ".join(place.replace("-", ", ") for place in places) + " |")
    print("|---" * (len(places) + 1) + "|")
    rows = [(effect or "nothing", row_name(grade, effect)) for effect in ("", *effects)]
    if grade == "field":
        rows.append(("all: `datasheet`", "datasheet"))
    for title, row in rows:
        cells = [cell(work, f"{place}-{row}", seeds) for place in places]
        print(f"| {title} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--drives", default=DRIVES)
    parser.add_argument("--effects", default=",".join((*LIDAR, *OTHERS)))
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("out/ablation"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--table", action="store_true")
    args = parser.parse_args()
    seeds = [int(seed) for seed in args.seeds.split(",")]
    places, effects = args.drives.replace(":", "-").split(","), args.effects.split(",")
    code = 0 if args.table else run_fleet(fleet_of(places, seeds, effects), args.work, args.jobs)
    for grade in GRADES if code in (0, 1) else ():
        print_table(args.work, places, seeds, grade, effects)
    return code


if __name__ == "__main__":
    raise SystemExit(main())
