#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Starts in saved maps, at many places of another recording, and prints one Markdown table.

A drive makes the map; the same drive, recorded again by sensors with other errors, gives the
starts: lio-replay --initial-map begins anywhere in it and is given a few seconds. Both drives are
at the same true pose at the same time, so the map's own path tells where the second one is in the
map. Writes into out/start_in_a_map/SCENARIO/. Needs tools/setup.sh.
"""
import argparse
import bisect
import concurrent.futures
import csv
import os
import pathlib
import shutil
import statistics
import subprocess

ROOT = pathlib.Path("out/start_in_a_map")
BIN = pathlib.Path("build/bin")
WRONG_M = 1.0  # a pose that is farther off than this is of another place


def run(*words, codes=(0,)):
    done = subprocess.run([str(word) for word in words], check=False, capture_output=True,
                          text=True)
    if done.returncode not in codes:
        raise RuntimeError(f"{words} ended with {done.returncode}: {done.stderr}")
    return done


def poses_of(path):
    rows = [[float(field) for field in line.split()] for line in path.read_text().splitlines()]
    return [row[0] for row in rows], [row[1:4] for row in rows]


def position_at(times, positions, time_s):
    """The position at a time within the rows', or None."""
    after = bisect.bisect_left(times, time_s)
    if after == 0 or after == len(times):
        return None
    share = (time_s - times[after - 1]) / (times[after] - times[after - 1])
    return [a + share * (b - a) for a, b in zip(positions[after - 1], positions[after])]


def make_drives(scenario, given):
    """The folders of the drive that makes the map and of that which starts in it."""
    folders = ROOT / scenario / "map", ROOT / scenario / "drive"
    for folder, sensor_seed, lidar in zip(folders, (given.seed, given.seed + 100),
                                          (given.map_lidar, given.lidar)):
        if not (folder / "truth.tum").exists():
            words = ["--lidar", lidar] if lidar else []
            run(BIN / "lio-sim", "--scenario", scenario, "--seed", given.seed, "--sensor-seed",
                sensor_seed, "--threads", os.cpu_count(), "--out", folder, *words)
    if not (folders[0] / "run/map.pcd").exists():
        run(BIN / "lio-replay", "--config", folders[0] / "config.yaml", folders[0] / "log.lcm",
            "--out", folders[0] / "run", "--overwrite", "--map", codes=(0, 6))
    return folders


def start_at(start_s, number, folders, given):
    """One row: when it was found, how far off the poses were."""
    made, drive = folders
    out = drive.parent / f"starts/{number:02}"
    shutil.rmtree(out, ignore_errors=True)
    sets = [word for text in given.set for word in ("--set", text)]
    run(BIN / "lio-replay", "--config", drive / "config.yaml", *sets, "--start", start_s,
        "--duration", given.seconds, "--initial-map", made / "run/map.pcd", drive / "log.lcm",
        "--out", out, codes=(0, 6))
    with open(out / "registration.csv", newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    times, positions = poses_of(out / "trajectory.tum")
    true_times, true_positions = poses_of(made / "run/trajectory_level.tum")
    errors_m = []
    for time_s, position in zip(times, positions):
        truth = position_at(true_times, true_positions, time_s)
        if truth is not None:
            errors_m.append(sum((a - b)**2 for a, b in zip(position, truth))**0.5)
    begin_s = float(rows[0]["t_s"])
    return {"start_s": start_s, "found_after_s": times[0] - begin_s if times else None,
            "errors_m": errors_m, "scan_ms": [float(row["total_ms"]) for row in rows],
            "matches": max(int(row["matches"]) for row in rows)}


def summary(scenario, rows):
    found = [row for row in rows if row["errors_m"]]
    wrong = [row for row in found if max(row["errors_m"]) > WRONG_M]
    right = [row for row in found if row not in wrong]
    waits_s = [row["found_after_s"] for row in right] or [float("nan")]
    off_m = [statistics.median(row["errors_m"]) for row in right] or [float("nan")]
    scan_ms = sorted(ms for row in rows for ms in row["scan_ms"])
    return (f"| {scenario} | {len(right)} of {len(rows)} | {len(wrong)} "
            f"| {sum(wait <= 5.0 for wait in waits_s)} "
            f"| {statistics.median(waits_s):.1f}, {max(waits_s):.1f} "
            f"| {100 * statistics.median(off_m):.1f}, {100 * max(off_m):.1f} "
            f"| {statistics.median(scan_ms):.1f}, {scan_ms[int(0.99 * len(scan_ms))]:.1f}, "
            f"{scan_ms[-1]:.1f} | {max(row['matches'] for row in rows)} |")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--places", type=int, default=50, help="starts in each map (50)")
    parser.add_argument("--seconds", type=float, default=8.0, help="of log for each start (8)")
    parser.add_argument("--seed", type=int, default=1, help="of the places (1)")
    parser.add_argument("--map-lidar", default="", help="lidar of the drives that make the maps")
    parser.add_argument("--lidar", default="", help="lidar of the drives that start in them")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="override one key of the estimator")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--verbose", action="store_true", help="a line for each start")
    parser.add_argument("scenarios", nargs="*", default=["street", "office", "garage"])
    return parser.parse_args()


def main():
    given = arguments()
    print("| map | found | wrong | within 5 s | after, s: median, max | off, cm: median, max "
          "| ms a scan: median, 99 %, max | matches |\n|---|---|---|---|---|---|---|---|")
    for scenario in given.scenarios:
        folders = make_drives(scenario, given)
        times, _ = poses_of(folders[0] / "run/trajectory_level.tum")
        length_s = times[-1] - times[0] - given.seconds - 2.0
        starts_s = [1.0 + length_s * i / max(1, given.places - 1) for i in range(given.places)]
        with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
            rows = list(pool.map(lambda job: start_at(job[1], job[0], folders, given),
                                 enumerate(starts_s)))
        if given.verbose:
            for row in rows:
                worst = f"{max(row['errors_m']):.2f} m" if row["errors_m"] else "not found"
                print(f"  {row['start_s']:.3f} s: {row['found_after_s']} {worst}")
        print(summary(scenario, rows), flush=True)


if __name__ == "__main__":
    main()
