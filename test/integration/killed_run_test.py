#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests what kill -9 leaves of a run: whole rows, and files that end together."""
import shutil
import subprocess
import time
import unittest

import support

FILES = ("trajectory.tum", "trajectory_world.tum", "trajectory_imu_rate.tum", "covariance.csv",
         "covariance_world.csv", "states.csv", "registration.csv")
MAX_APART_S = 1.0


def killed_run():
    """The folder of a replay that was killed in its midst."""
    drive = support.simulated("street", "--duration", "20", "--lidar", "vlp16")
    out = support.WORK / "killed"
    shutil.rmtree(out, ignore_errors=True)
    rows = out / "trajectory.tum"
    words = [support.BUILD / "bin/lio-replay", "--config", drive / "config.yaml",
             drive / "log.lcm", "--out", out]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        while process.poll() is None and not (rows.exists() and rows.stat().st_size > 8000):
            time.sleep(0.001)
        process.kill()
    return drive, out


class KilledRun(unittest.TestCase):
    def test_rows_are_whole_and_all_files_end_together(self):
        drive, out = killed_run()
        self.assertFalse((out / "stats.json").exists(), "it was not killed in time")
        ends_s = {}
        for name in FILES:
            text = (out / name).read_text()
            self.assertTrue(text.endswith("\n"), name)
            rows = text.splitlines()
            separator = "," if name.endswith(".csv") else " "
            self.assertEqual(len({row.count(separator) for row in rows}), 1, name)
            ends_s[name] = float(rows[-1].split(separator)[0])
        print(ends_s)
        self.assertLess(max(ends_s.values()) - min(ends_s.values()), MAX_APART_S)
        # A system that goes down may cut a row all the same.
        with open(out / "trajectory.tum", "a", encoding="ascii") as stream:
            stream.write("2000000000.5 1.0 2.")
        done = support.run("lio-eval", drive / "truth.tum", out / "trajectory.tum")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the last line is cut", done.stderr)
        with open(out / "covariance.csv", "a", encoding="ascii") as stream:
            stream.write("2000000000.5,1.0")
        for words in (("lio-eval", "consistency", drive / "truth.tum", out), ("lio-run", out)):
            done = support.run(*words)
            self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    support.main()
