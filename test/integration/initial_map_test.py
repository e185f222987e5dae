#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests a start in a map saved before, by another recording of the drive that made the map."""
import bisect
import json
import unittest

import support

DRIVE = ("street", "--lidar", "vlp16", "--seed", "5", "--duration", "30")
FILES = ("trajectory.tum", "trajectory_world.tum", "trajectory_level.tum", "covariance.csv",
         "notices.tsv")


def poses_of(path):
    rows = [[float(field) for field in line.split()] for line in path.read_text().splitlines()]
    return [row[0] for row in rows], [row[1:4] for row in rows]


def saved_map():
    folder = support.simulated(*DRIVE)
    run = support.made_once("initial-map", lambda path: support.run_well(
        "lio-replay", "--config", folder / "config.yaml", folder / "log.lcm", "--out", path,
        "--overwrite", "--map"))
    return run


def start(out, *words):
    drive = support.simulated(*DRIVE, "--sensor-seed", "105")
    return support.replay(drive / "log.lcm", out, "--config", drive / "config.yaml", "--start",
                          "12", "--duration", "10", "--initial-map", saved_map() / "map.pcd",
                          *words)


class InitialMap(unittest.TestCase):
    def test_the_place_is_found_and_the_path_goes_on_in_the_map(self):
        run = start("start-in-map")
        self.assertIn("found in the initial map", (run / "notices.tsv").read_text())
        times, positions = poses_of(run / "trajectory.tum")
        first_scan_s = float((run / "registration.csv").read_text().splitlines()[1].split(",")[0])
        self.assertLess(times[0] - first_scan_s, 5.0)
        map_times, map_positions = poses_of(saved_map() / "trajectory_level.tum")
        for time_s, position in zip(times, positions):
            after = bisect.bisect_left(map_times, time_s)
            share = (time_s - map_times[after - 1]) / (map_times[after] - map_times[after - 1])
            off_m = sum((p - a - share * (b - a))**2 for p, a, b in zip(
                position, map_positions[after - 1], map_positions[after]))**0.5
            self.assertLess(off_m, 0.1)

    def test_threads_and_late_matches_change_nothing(self):
        once = start("start-in-map-once")
        for number, words in enumerate((("--threads", "2"), ("--match-lag", "7"))):
            again = start(f"start-in-map-{number}", *words)
            for name in FILES:
                self.assertEqual((once / name).read_bytes(), (again / name).read_bytes(), name)

    def test_a_locked_map_stays_as_it_is_and_another_grows(self):
        sizes = [(start(f"start-in-map-{locked}", "--map", "--set",
                        f"pipeline.map_locked={locked}") / "map.pcd").stat().st_size
                 for locked in ("true", "false")]
        self.assertLess(sizes[0], sizes[1])
        self.assertLessEqual(sizes[0], (saved_map() / "map.pcd").stat().st_size)

    def test_a_guess_of_another_place_finds_nothing(self):
        run = support.WORK / "start-elsewhere"
        drive = support.simulated(*DRIVE, "--sensor-seed", "105")
        done = support.run("lio-replay", "--config", drive / "config.yaml", "--start", "12",
                           "--duration", "8", "--initial-map", saved_map() / "map.pcd",
                           "--initial-pose", "-40,0,0,90", drive / "log.lcm", "--out", run,
                           "--overwrite")
        self.assertEqual(done.returncode, 6, done.stderr)  # no pose: no trust
        self.assertEqual((run / "trajectory.tum").read_text(), "")
        verdict = json.loads((run / "verdict.json").read_text())
        self.assertEqual(["place_unknown"], [cause["kind"] for cause in verdict["causes"]])
        waits = (run / "notices.tsv").read_text().count("the place in the initial map is being")
        self.assertLessEqual(waits, 4)  # in 8 s, ever more rarely

    def test_unusable_maps_end_the_programs_before_they_start(self):
        drive = support.simulated(*DRIVE, "--sensor-seed", "105")
        damaged = support.WORK / "damaged.pcd"
        damaged.write_bytes((saved_map() / "map.pcd").read_bytes()[:5000])
        for path in (support.WORK / "missing.pcd", damaged):
            out = support.WORK / "never-begun"
            done = support.run("lio-replay", "--config", drive / "config.yaml", "--initial-map",
                               path, drive / "log.lcm", "--out", out)
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertIn(str(path), done.stderr)
            self.assertFalse(out.exists())
            done = support.run("liod", "--config", drive / "config.yaml", "--initial-map", path)
            self.assertEqual(done.returncode, 5, done.stderr)


if __name__ == "__main__":
    support.main()
