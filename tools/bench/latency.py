#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Measures the latency of liod with lio-bench-latency while scans are matched, both on the same
cores, and prints histograms; see --help."""
import argparse
import contextlib
import os
import pathlib
import subprocess
import sys

import live

sys.path.insert(0, str(live.ROOT / "test/integration"))
os.environ.setdefault("LIO_BUILD", str(live.BIN.parent))

import browser  # noqa: E402
import view_test  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--speed", default="1", help="times real time (1)")
    parser.add_argument("--scenario", default="street", help="of lio-sim (street)")
    parser.add_argument("--lidar", default="vlp16")
    parser.add_argument("--duration", default="60", help="of the drive [s] (60)")
    parser.add_argument("--cores", type=int, default=2, help="cores that all share (2)")
    parser.add_argument("--realtime", action="store_true",
                        help="liod and the player have real-time priority (SCHED_FIFO; as root)")
    parser.add_argument("--view", action="store_true",
                        help="with lio-view and a page in Chromium, on the same cores")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/latency"))
    return parser.parse_args()


def measure(drive, speed, priority, page):
    """Plays the drive, prints the latencies and, with a page, how many frames that has drawn."""
    player = [live.BIN / "lio-bench-latency", drive / "log.lcm", speed]
    subprocess.run([*priority, *player], check=True)
    if page:
        frames, points = page.run("[lioView.stage.numDrawn, lioView.stage.map.num]")
        print(f"the page drew {frames} frames, {points} points at last")


def main():
    options = arguments()
    if options.view and not browser.BROWSER:
        sys.exit("chromium is not installed")
    live.enter_namespace()
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:options.cores])
    drive = options.out / f"{options.scenario}-{options.lidar}"
    if not (drive / "config.yaml").exists():
        subprocess.run([live.BIN / "lio-sim", "--scenario", options.scenario, "--lidar",
                        options.lidar, "--imu", "xsens_mti10", "--duration", options.duration,
                        "--threads", "2", "--out", drive], check=True)
    priority = ["chrt", "--fifo", "20"] if options.realtime else []
    liod = live.Liod(options.out / "run", "--config", drive / "config.yaml", prefix=priority)
    print(f"speed {options.speed}, {options.lidar}, load before "
          f"{os.getloadavg()[0]:.1f}", flush=True)
    with view_test.live_page() if options.view else contextlib.nullcontext() as page:
        measure(drive, options.speed, priority, page)
    liod.stop()
    stats = liod.stats()
    print(f"scans {stats['num_scans']}, dropped {stats['num_scans_dropped']}, messages and scans "
          f"lost {live.losses(stats)}")


if __name__ == "__main__":
    main()
