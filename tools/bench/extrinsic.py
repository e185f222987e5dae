#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Replays simulated drives with wrong extrinsics, corrected on the way and not. Prints a Markdown
table of position errors: of the path in world as published, of the level path, and of the latter
from --after seconds on.

  tools/bench/extrinsic.py [--drives street,campus,...] [--seed 1] [--after 35] [--work out/extrinsic]

Needs tools/setup.sh, and up to 1 GB of disk for each drive, which is given back."""
import argparse
import json
import math
import pathlib
import shutil
import sys

import verdict

DRIVES = {
    "campus, VLP-16": ("campus", "--lidar", "vlp16"),
    "street, HDL-32E": ("street", "--lidar", "hdl32e"),
    "garage, HDL-32E": ("garage", "--lidar", "hdl32e"),
    "loop, OS1-64": ("loop", "--lidar", "os1_64"),
    "office, VLP-16": ("office", "--lidar", "vlp16"),
}
ALL_ALIKE = (1 / math.sqrt(3),) * 3


def turned_and_moved(translation, rotation):
    moved = [x + d for x, d in zip(translation, (0.06, -0.06, 0.06))]
    return verdict.extrinsic(moved, verdict.multiply(verdict.turn(ALL_ALIKE, 5), rotation))


SETUPS = {
    "right": lambda t, q: "{}\n",
    "5 deg of yaw": verdict.rotated((0, 0, 1), 5),
    "5 deg of pitch": verdict.rotated((0, 1, 0), 5),
    "1 m ahead": verdict.moved(1, 0, 0),
    "5 deg and 10 cm": turned_and_moved,
}
KEPT = "filter: {estimate_extrinsic: false}\n"


def error_m(truth, path, after_s):
    rows = path.read_text().splitlines()
    first_s = float(rows[0].split()[0])
    part = path.with_suffix(".part.tum")
    part.write_text("\n".join(r for r in rows if float(r.split()[0]) >= first_s + after_s) + "\n")
    scores = part.with_suffix(".json")
    verdict.run("lio-eval", truth, part, "--json", scores)
    return json.loads(scores.read_text())["ape"]["position_m"]["rmse"]


def errors(folder, overlays, after_s):
    judged, _ = verdict.judged(folder, overlays)
    run = folder / "run"
    found = [error_m(folder / "truth.tum", run / name, since_s) for name, since_s in
             (("trajectory_world.tum", 0), ("trajectory_level.tum", 0),
              ("trajectory_level.tum", after_s))]
    return ", ".join(f"{100 * error:.1f}" for error in found), judged["trust"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--drives", default=";".join(DRIVES), help="separated by semicolons")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--after", type=float, default=35.0)
    parser.add_argument("--work", type=pathlib.Path, default=verdict.ROOT / "out/extrinsic")
    return parser.parse_args()


def main():
    given = arguments()
    print("| drive | wrong by | kept: world, level, late | corrected: world, level, late | trust |")
    print("|---|---|---|---|---|")
    for drive in given.drives.split(";"):
        folder = given.work / DRIVES[drive][0]
        verdict.simulate(("--scenario", *DRIVES[drive], "--duration", "60", "--seed", given.seed),
                         folder)
        for name, setup in SETUPS.items():
            overlay = setup(*verdict.read_extrinsic(folder))
            kept, _ = errors(folder, [overlay, KEPT], given.after)
            corrected, trust = errors(folder, [overlay], given.after)
            print(f"| {drive} | {name} | {kept} | {corrected} | {trust} |", flush=True)
        shutil.rmtree(folder)


if __name__ == "__main__":
    sys.exit(main())
