#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Prints the results of a run from its stats.json and, when there is one, its eval.json."""
import json
import pathlib
import sys


def load(path):
    return json.loads(path.read_text()) if path.exists() else None


LOSSES = ("num_chunks_missing", "num_imu_missing", "num_kernel_dropped", "num_imu_queue_dropped",
          "num_chunks_queue_dropped")
CLOSED_RATIO = 0.01  # a path whose end is this near its start, relative to its length, is a loop


def num_lost(stats):
    return sum(stats.get(name, 0) for name in LOSSES) + stats["num_scans_dropped"]


def scan_rows(stats):
    total = stats["stage_ms"]["total"]
    lost = num_lost(stats) - stats["num_scans_dropped"]
    yield "sweeps, IMU samples", f"{stats['num_scans']}, {stats['num_imu']}"
    yield "messages lost, sweeps dropped", f"{lost}, {stats['num_scans_dropped']}"
    yield "matches rejected, gated ones of them", (
        f"{stats['num_matches_rejected']}, {stats['num_gated']}")
    yield "time per sweep, median and p99", f"{total['median']:.1f} and {total['p99']:.1f} ms"
    yield "memory at its peak", f"{stats['rss_peak_mb']:.0f} MB"


def error_rows(figures):
    ape, drift, end = figures["ape"], figures["drift"], figures["end"]
    yield "path", f"{figures['path_length_m']:.1f} m in {figures['duration_s']:.1f} s"
    yield "position error (APE, SE3), rmse and max", (
        f"{ape['position_m']['rmse']:.3f} and {ape['position_m']['max']:.3f} m")
    yield "rotation error without its mean, rmse", (
        f"{ape['rotation_without_offset_deg']['rmse']:.3f} deg")
    if drift["translation_percent"] is not None:
        yield "drift", (f"{drift['translation_percent']:.3f} %, "
                        f"{drift['rotation_deg_per_100m']:.3f} deg/100 m")
    yield "error at the end", f"{end['error_m']:.3f} m ({end['error_percent']:.3f} % of the path)"
    if end["truth_gap_m"] < CLOSED_RATIO * figures["path_length_m"]:
        yield "closing gap of the loop", (
            f"{end['estimate_gap_m']:.3f} m (truth {end['truth_gap_m']:.3f} m)")
    else:
        yield "start to end, estimate and truth", (
            f"{end['estimate_gap_m']:.3f} and {end['truth_gap_m']:.3f} m")
    if figures["z_drift"]:
        yield "height error at the end", f"{figures['z_drift']['end_m']:+.3f} m"


def main():
    folder = pathlib.Path(sys.argv[1])
    stats = load(folder / "stats.json")
    rows = list(scan_rows(stats))
    figures = load(folder / "eval.json")
    if figures:
        rows += error_rows(figures)
    width = max(len(name) for name, _ in rows)
    print()
    for name, value in rows:
        print(f"  {name:<{width}}  {value}")
    print()
    if num_lost(stats):
        print("  Data were lost because this machine was too busy; play slower: --speed S\n")


if __name__ == "__main__":
    main()
