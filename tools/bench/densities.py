#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Measures what wrong densities of the IMU cost: those of the rig ten times too large and too
small, of gyro and accelerometer, and a shaking that starts in the middle of the drive and that the
rig knows nothing of. Prints a Markdown table: ATE [cm] of the level path with the right densities,
and the ratio to it with wrong ones, each as median and worst over the seeds.

  tools/bench/densities.py [--seeds 1,2,3] [--drives street:hdl32e,...] [--work out/densities]
                           [--jobs N] [--table]

All are drives and configurations of a fleet (tools/fleet.sh) in WORK, which goes on where it was
stopped; --table prints what is there and measures nothing. Needs what the fleet does, and for each
job 5 GB of disk at a time."""
import argparse
import math
import os
import pathlib

import yaml

from fleet_runs import ROOT, figures, median_and_worst, run_fleet

DRIVES = "street:hdl32e,garage:hdl32e,suburb:hdl32e,campus:vlp16"
IMU = yaml.safe_load((ROOT / "config/imus/xsens_mti10.yaml").read_text(encoding="utf-8"))
TRUE = {kind: float(IMU[kind]["noise_density"]) for kind in ("gyro", "accel")}
# 1 sigma of a sample, as the issue has it of carriers shaken hard; from the middle on.
SHAKING = {"accel": 0.6, "gyro": 0.01}
SHAKEN = {kind: math.hypot(TRUE[kind], std / math.sqrt(IMU["rate_hz"]))
          for kind, std in SHAKING.items()}
CLOCKS = "--without stamp-jitter --without clock-drift"
FAULT = "--fault shaking:start=30,accel={accel},gyro={gyro}".format(**SHAKING)
# Configuration: its row's title, the drives that it runs on, the densities that the rig claims.
ROWS = {
    "right": ("right", "still", {}),
    "gyro-x-10": ("gyro x 10", "still", {"gyro": 10 * TRUE["gyro"]}),
    "gyro-by-10": ("gyro / 10", "still", {"gyro": 0.1 * TRUE["gyro"]}),
    "accel-x-10": ("accel x 10", "still", {"accel": 10 * TRUE["accel"]}),
    "accel-by-10": ("accel / 10", "still", {"accel": 0.1 * TRUE["accel"]}),
    "told": ("shaken, told", "shaken", SHAKEN),
    "not-told": ("shaken, not told", "shaken", {}),
}
REFERENCES = {"still": "right", "shaken": "told"}


def drives_of(place, seeds):
    scenario, lidar = place.split("-")
    for kind, words in (("scans", CLOCKS), ("still", ""), ("shaken", FAULT)):
        yield {"name": f"{place}-{kind}", "seeds": ",".join(map(str, seeds)),
               "scans": "" if kind == "scans" else f"{place}-scans",
               "sim": f"--scenario {scenario} --lidar {lidar} --duration 60 {words}"}


def fleet_of(places, seeds):
    configurations = [
        {"name": name, "drives": f"*-{kind}-*", "words": "--passes 1",
         "set": [f"rig.imu.{sensor}_noise_density={value}" for sensor, value in claimed.items()]}
        for name, (_, kind, claimed) in ROWS.items()]
    return {"drives": [drive for place in places for drive in drives_of(place, seeds)],
            "configurations": configurations}


def cell(work, place, seeds, name):
    kind = ROWS[name][1]
    ates, references = (figures(work, system, f"{place}-{kind}", seeds, "ape_m")
                        for system in (name, REFERENCES[kind]))
    if name in REFERENCES.values():
        return median_and_worst(100 * ate for ate in ates.values()) + " cm"
    return median_and_worst(ates[seed] / references[seed] for seed in ates.keys() & references)


def print_table(work, places, seeds):
    print("\n| | " + " | ".join(place.replace("-", ", ") for place in places) + " |")
    print("|---" * (len(places) + 1) + "|")
    for name, (title, _, _) in ROWS.items():
        cells = [cell(work, place, seeds, name) for place in places]
        print(f"| {title} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--drives", default=DRIVES)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("out/densities"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--table", action="store_true")
    args = parser.parse_args()
    seeds = [int(seed) for seed in args.seeds.split(",")]
    places = args.drives.replace(":", "-").split(",")
    code = 0 if args.table else run_fleet(fleet_of(places, seeds), args.work, args.jobs)
    if code in (0, 1):
        print_table(args.work, places, seeds)
    return code


if __name__ == "__main__":
    raise SystemExit(main())
