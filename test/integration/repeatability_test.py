#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests that one log always gives the same bytes: again, on more threads, and live from
lcm-logplayer."""
import subprocess
import unittest

import support

DURATION_S = "6"
# These files of a run hold no computing times.
EXACT = ("trajectory.tum", "trajectory_imu_rate.tum", "covariance.csv",
         "trajectory_world.tum", "covariance_world.csv", "states.csv", "options.yaml", "map.pcd")


class Repeatability(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.drive = support.simulated("street", "--duration", DURATION_S, "--lidar", "vlp16")
        cls.words = ("--config", cls.drive / "config.yaml")
        cls.first = support.replay(cls.drive / "log.lcm", "repeat-first", *cls.words, "--map")

    def check_same(self, folder, files):
        for name in files:
            expected, found = ((f / name).read_bytes() for f in (self.first, folder))
            self.assertTrue(expected, name)
            self.assertEqual(expected, found, f"{folder / name} differs from the first run's")

    def test_second_run_gives_the_same_bytes(self):
        folder = support.replay(self.drive / "log.lcm", "repeat-again", *self.words, "--map")
        self.check_same(folder, EXACT)
        self.assertEqual(support.untimed(self.first), support.untimed(folder))

    def test_more_threads_give_the_bytes_of_one(self):
        for threads in ("2", "3"):
            folder = support.replay(self.drive / "log.lcm", f"repeat-threads-{threads}",
                                    *self.words, "--map", "--threads", threads)
            self.check_same(folder, EXACT)
            self.assertEqual(support.untimed(self.first), support.untimed(folder))

    def test_live_run_gives_the_bytes_of_replay(self):
        folder = support.WORK / "repeat-live"
        play = [support.SOURCE / "tools/demo/play.sh", self.drive / "log.lcm", folder, "1",
                *self.words]
        done = subprocess.run(play, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=support.TIMEOUT_S, check=False)
        if done.returncode == 4:
            self.skipTest(done.stderr.strip())
        self.assertEqual(done.returncode, 0, done.stderr)
        live, replayed = support.stats(folder), support.stats(self.first)
        for name in ("num_scans", "num_imu", "num_chunks", "num_scans_dropped",
                     "num_chunks_missing"):
            self.assertEqual(live[name], replayed[name], f"{name}: messages were lost")
        self.check_same(folder, ("trajectory.tum", "covariance.csv", "trajectory_world.tum",
                                 "covariance_world.csv", "states.csv"))


if __name__ == "__main__":
    support.main()
