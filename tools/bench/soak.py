#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Plays a simulated drive to liod over and over and records memory and time a scan; see --help.

Each time the player starts again the clock goes back, as on a robot whose log is played again:
liod seeks the place in its map and goes on.
"""
import argparse
import csv
import pathlib
import statistics
import subprocess
import sys
import time

import live

SPEEDS = (16, 11, 8, 5.6, 4, 2.8, 2, 1.4, 1)
SAMPLE_S = 5.0
COLUMNS = ("time_s", "loop", "rss_mb", "scans", "scan_ms_median", "scan_ms_p99")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=3.0, help="how long to play (3)")
    parser.add_argument("--speed", type=float,
                        help="times real time; without it the highest of "
                        f"{', '.join(map(str, SPEEDS))} that loses nothing in one loop")
    parser.add_argument("--scenario", default="campus", help="of lio-sim (campus)")
    parser.add_argument("--duration", type=float, default=60.0, help="of the drive [s] (60)")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/soak"))
    parser.add_argument("--max-growth-mb", type=float,
                        help="fail when RSS grows by more between the second quarter of the run "
                        "and the last")
    return parser.parse_args()


def simulate(options):
    folder = options.out / "drive"
    if not (folder / "config.yaml").exists():
        subprocess.run([live.BIN / "lio-sim", "--scenario", options.scenario, "--duration",
                        str(options.duration), "--lidar", "vlp16", "--imu", "xsens_mti10",
                        "--threads", "2", "--out", folder], check=True)
    return folder


def loses_nothing(drive, speed, out):
    liod = live.Liod(out, "--config", drive / "config.yaml")
    live.play(drive / "log.lcm", speed)
    liod.wait_until_idle()
    liod.stop()
    lost = live.losses(liod.stats())
    print(f"soak: speed {speed}: {lost} messages and scans lost", flush=True)
    return lost == 0


def find_speed(drive, out):
    for speed in SPEEDS:
        if loses_nothing(drive, speed, out):
            return speed
    sys.exit("soak: even speed 1 loses messages on this machine")


class Rows:
    """Reads what registration.csv of all segments has gained since the last look."""

    def __init__(self, out):
        self.out = out
        self.offsets = {}

    def new_times_ms(self):
        times = []
        for path in sorted(self.out.rglob("registration.csv")):
            with open(path, "rb") as stream:
                if path not in self.offsets:
                    self.offsets[path] = len(stream.readline())
                stream.seek(self.offsets[path])
                data = stream.read()
            whole = data[:data.rfind(b"\n") + 1]
            self.offsets[path] += len(whole)
            times += [float(line.rsplit(b",", 1)[1]) for line in whole.splitlines()]
        return times


def soak(drive, options, speed):
    out = options.out / "run"
    liod = live.Liod(out, "--config", drive / "config.yaml")
    rows, loop, samples, begin = Rows(out), 0, [], time.monotonic()
    player = None
    with open(options.out / "soak.csv", "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(COLUMNS)
        while (now := time.monotonic() - begin) < 60 * options.minutes:
            if player is None or player.poll() is not None:
                player, loop = live.start_player(drive / "log.lcm", speed), loop + 1
            time.sleep(SAMPLE_S)
            if liod.process.poll() is not None:
                sys.exit(f"soak: liod ended; see {liod.log_path}")
            times = sorted(rows.new_times_ms()) or [float("nan")]
            samples.append((now, loop, liod.rss_mb(), len(times), statistics.median(times),
                            times[int(0.99 * (len(times) - 1))]))
            writer.writerow([f"{value:.3f}" for value in samples[-1]])
            stream.flush()
    player.terminate()
    player.wait()
    liod.wait_until_idle()
    code = liod.stop()
    return samples, code, liod.stats()


def summary(samples, code, stats, speed):
    quarter = max(1, len(samples) // 4)
    parts = [samples[i * quarter:(i + 1) * quarter] for i in range(4)]
    rss = [statistics.median(row[2] for row in part) for part in parts if part]
    scan = [statistics.median(row[4] for row in part if row[4] == row[4]) for part in parts if part]
    unaccounted = sum(abs(fates["unaccounted"]) for fates in stats["account"].values())
    print(f"soak: speed {speed}, {samples[-1][1]} loops in {samples[-1][0] / 60:.1f} min, "
          f"{stats['num_scans']} scans, exit code {code}, {live.losses(stats)} lost, "
          f"{unaccounted} unaccounted for")
    print("soak: RSS by quarters [MB]:", *(f"{value:.1f}" for value in rss))
    print("soak: median time a scan by quarters [ms]:", *(f"{value:.2f}" for value in scan))
    return rss


def plot(samples, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, (memory, duration) = pyplot.subplots(2, 1, sharex=True, figsize=(8, 5))
    minutes = [row[0] / 60 for row in samples]
    memory.plot(minutes, [row[2] for row in samples])
    memory.set_ylabel("RSS [MB]")
    memory.set_ylim(bottom=0)
    duration.plot(minutes, [row[4] for row in samples], label="median")
    duration.plot(minutes, [row[5] for row in samples], label="p99", linewidth=0.7)
    duration.set_ylabel("a scan [ms]")
    duration.set_xlabel("time [min]")
    duration.set_ylim(bottom=0)
    duration.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main():
    options = arguments()
    live.enter_namespace()
    options.out.mkdir(parents=True, exist_ok=True)
    drive = simulate(options)
    speed = options.speed or find_speed(drive, options.out / "probe")
    samples, code, stats = soak(drive, options, speed)
    rss = summary(samples, code, stats, speed)
    plot(samples, options.out / "soak.png")
    growth = rss[-1] - rss[min(1, len(rss) - 1)]
    if options.max_growth_mb is not None and growth > options.max_growth_mb:
        sys.exit(f"soak: RSS grew by {growth:.1f} MB, more than {options.max_growth_mb}")
    if code not in (0, 6):
        sys.exit(f"soak: liod ended with {code}; see {options.out / 'run' / 'liod.log'}")


if __name__ == "__main__":
    main()
