#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Measures the latency of liod with lio-bench-latency while scans are matched, both on the same
cores, and prints histograms; see --help."""
import argparse
import os
import pathlib
import subprocess

import live


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--speed", default="1", help="times real time (1)")
    parser.add_argument("--scenario", default="street", help="of lio-sim (street)")
    parser.add_argument("--lidar", default="vlp16")
    parser.add_argument("--duration", default="60", help="of the drive [s] (60)")
    parser.add_argument("--cores", type=int, default=2, help="cores that all share (2)")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/latency"))
    return parser.parse_args()


def main():
    options = arguments()
    live.enter_namespace()
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:options.cores])
    drive = options.out / f"{options.scenario}-{options.lidar}"
    if not (drive / "config.yaml").exists():
        subprocess.run([live.BIN / "lio-sim", "--scenario", options.scenario, "--lidar",
                        options.lidar, "--imu", "xsens_mti10", "--duration", options.duration,
                        "--threads", "2", "--out", drive], check=True)
    liod = live.Liod(options.out / "run", "--config", drive / "config.yaml")
    print(f"speed {options.speed}, {options.lidar}, load before "
          f"{os.getloadavg()[0]:.1f}", flush=True)
    subprocess.run([live.BIN / "lio-bench-latency", drive / "log.lcm", options.speed], check=True)
    liod.stop()
    stats = liod.stats()
    print(f"scans {stats['num_scans']}, dropped {stats['num_scans_dropped']}, messages and scans "
          f"lost {live.losses(stats)}")


if __name__ == "__main__":
    main()
