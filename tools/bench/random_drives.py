#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Draws drives at random and runs liod's defaults over them: the place, a lidar and an IMU that no
data file describes, the carrier, the IMU's convention, and in a third of them a fault. Nothing is
tuned on them, and what goes wrong on one is found before a user finds it. They are run as liod
would, in one pass, and in the two passes of lio-run. Prints a Markdown table for each of these,
with a row for each place: how many drives, ATE [cm] of the level path (median, worst), NEES per
degree of freedom (median, worst), how many were said to be doubtful; then each drive that was bold:
ATE above 0.3 m or NEES above 10 under a verdict that trusts it.

  tools/bench/random_drives.py [--drives 200] [--seed 1] [--duration 60] [--jobs N]
                               [--work out/random_drives] [--table]

All are drives of a fleet (tools/fleet.sh) in WORK, which goes on where it was stopped; --table
prints what is there and measures nothing. 200 drives of 60 s take an hour and a half on two cores."""
import argparse
import collections
import math
import os
import pathlib
import random

import yaml

from fleet_runs import ROOT, median_and_worst, run_fleet, scored_runs

PLACES = {"street": 3, "suburb": 3, "campus": 3, "office": 3, "loop": 2, "garage": 2, "hall": 2,
          "warehouse": 2, "mine": 1, "hedgerows": 1, "motorway": 1, "tunnel": 1, "parked": 1}
CARRIED = ("warehouse", "mine", "hedgerows")
CARRIERS = ("person", "robot", "drone")
VARIANTS = ("gravity-removed", "in-g", "in-deg", "in-g-and-deg", "z-down", "turned")
FAULTS = (
    "imu_gap:start=25,duration=1", "lidar_gap:start=25,duration=1.5", "drop", "chunk_loss",
    "reorder", "duplicate", "shaking:start=20", "dust:start=20,duration=10",
    "clock_offset:offset=0.025", "clock_offset:offset=-0.06",
    "nan", "wrong_extrinsic:yaw_deg=5,x=0.1",
    "gyro_saturation:start=20,limit=2.0,duration=30",
    "imu_dead:start=25,duration=10", "imu_dead:start=25,gyro=0,accel=1",
    "imu_offset:start=25,duration=10", "imu_offset:start=25,gyro=0,accel=0.5")
MAX_POINTS_PER_S = 1.0e6
PASSES = {"one-pass": 1, "two-passes": 2}


def log_uniform(draw, low, high):
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def elevations_deg(draw, beams):
    """Evenly spread, or denser near the horizon, as long-range lidars have them."""
    up, down = draw.uniform(8, 45), draw.uniform(12, 45)
    power = draw.choice((1.0, 1.0, 1.8))
    ratios = [2.0 * beam / (beams - 1) - 1.0 for beam in range(beams)]
    bent = [math.copysign(abs(ratio) ** power, ratio) for ratio in ratios]
    return [round((up if ratio > 0 else down) * ratio, 3) for ratio in bent]


def random_lidar(draw):
    beams = draw.choice((16, 16, 32, 32, 40, 64, 128))
    rotation_hz = draw.choice((10.0, 10.0, 20.0))
    columns = draw.choice([columns for columns in (512, 900, 1024, 1300, 1800, 2048)
                           if beams * columns * rotation_hz <= MAX_POINTS_PER_S] or [512])
    period_us = 1e6 / rotation_hz / columns
    round_us = draw.choice((0.0, 0.6)) * period_us  # a flash of all beams, or one after another
    stagger_deg = draw.choice((0.0, 0.0, 1.0, 3.0))
    return {
        "model": "generic", "rotation_hz": rotation_hz, "column_period_us": round(period_us, 5),
        "cut_azimuth_deg": draw.choice((0.0, 90.0, 180.0)),
        "min_range_m": draw.choice((0.3, 0.5, 1.0)),
        "max_range_m": draw.choice((50.0, 100.0, 200.0)),
        "range_std_m": round(draw.uniform(0.01, 0.03), 4), "range_step_m": 0.002,
        "beam_width_horizontal_mrad": round(draw.uniform(1.0, 6.0), 2),
        "beam_width_vertical_mrad": round(draw.uniform(1.0, 6.0), 2),
        "range_at_10_percent_m": round(draw.uniform(30.0, 120.0), 1),
        "beams": {
            "elevation_deg": elevations_deg(draw, beams),
            "fire_time_us": [round(round_us * beam / beams, 3) for beam in range(beams)],
            "azimuth_offset_deg": [stagger_deg * (beam % 4 - 1.5) for beam in range(beams)]}}


def random_imu(draw):
    """Between a tactical IMU and a phone's chip, quantity by quantity."""
    imu = yaml.safe_load((ROOT / "config/imus/consumer_mems.yaml").read_text(encoding="utf-8"))
    grade = draw.uniform(0.0, 1.0)  # 0: a twentieth of the errors of the phone's chip, 1: all
    for sensor in ("gyro", "accel"):
        for key, value in imu[sensor].items():
            if not key.startswith(("full_scale", "step", "bias_instability_time", "vibration")):
                ratio = 20.0 ** (grade - 1.0) * log_uniform(draw, 0.6, 1.6)
                imu[sensor][key] = float(f"{value * ratio:.3g}")
        for key in [key for key in imu[sensor] if key.startswith("vibration")]:
            imu[sensor][key] = float(f"{imu[sensor][key] * log_uniform(draw, 0.3, 2.0):.3g}")
    imu["gyro"]["full_scale_radps"] = draw.choice((8.7266, 17.453, 34.907))
    imu["gyro"]["step_radps"] = imu["gyro"]["full_scale_radps"] / 2 ** 15
    return imu | {"model": "random", "rate_hz": draw.choice((100.0, 200.0, 400.0))}


def write_sensor(file, sensor):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(yaml.safe_dump(sensor, sort_keys=False), encoding="utf-8")
    return file.name


def random_drive(seed, index, duration_s, work):
    """The same for the same seed and index, however many drives are drawn."""
    draw = random.Random(f"{seed} {index}")
    place = draw.choices(list(PLACES), PLACES.values())[0]
    lidar = write_sensor(work / f"lidar_{index:03d}.yaml", random_lidar(draw))
    imu = write_sensor(work / f"imu_{index:03d}.yaml", random_imu(draw))
    words = f"--scenario {place} --duration {duration_s} --lidar {lidar} --imu {imu}"
    name = [f"{index:03d}", place]
    if place in CARRIED:
        name.append(draw.choice(CARRIERS))
        words += f" --carrier {name[-1]}"
    if draw.random() < 0.15:
        name.append("moving")
        words += " --moving-start"
    if draw.random() < 0.1:
        name.append(draw.choice(VARIANTS))
        words += f" --imu-variant {name[-1]}"
    if draw.random() < 0.33:
        fault = draw.choice(FAULTS)
        name.append(fault.split(":", maxsplit=1)[0])
        words += f" --fault {fault}"
    return {"name": "-".join(name), "sim": words, "seeds": draw.randint(1, 10 ** 6), "group": place}


def is_bold(row):
    return row["trust"] == "yes" and (row["ape_m"] > 0.3 or (row["nees_pose"] or 0.0) > 10.0)


def print_tables(title, rows):
    places = collections.defaultdict(list)
    for row in rows:
        places[row["group"]].append(row)
    print(f"\n{title}:\n\n| place | drives | ATE, cm | NEES | doubtful |\n|---|---|---|---|---|")
    for place in sorted(places):
        drives = places[place]
        nees = [row["nees_pose"] for row in drives if row["nees_pose"] is not None]
        print(f"| {place} | {len(drives)} | {median_and_worst(100 * row['ape_m'] for row in drives)}"
              f" | {median_and_worst(nees)} | {sum(row['trust'] != 'yes' for row in drives)} |")
    print("\n| bold | ATE, cm | NEES |\n|---|---|---|")
    for row in filter(is_bold, rows):
        print(f"| {row['drive']} | {100 * row['ape_m']:.2g} | {row['nees_pose'] or math.nan:.2g} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--drives", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--duration", type=float, default=60.0)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("out/random_drives"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--table", action="store_true")
    args = parser.parse_args()
    code = 0
    if not args.table:
        drives = [random_drive(args.seed, index, args.duration, args.work)
                  for index in range(args.drives)]
        configurations = [{"name": name, "words": f"--passes {num}"}
                          for name, num in PASSES.items()]
        code = run_fleet({"drives": drives, "configurations": configurations}, args.work,
                         args.jobs)
    if code in (0, 1):
        rows = [row for row, _ in scored_runs(args.work)]
        for name in PASSES:
            print_tables(name, [row for row in rows if row["system"] == name])
    return code


if __name__ == "__main__":
    raise SystemExit(main())
