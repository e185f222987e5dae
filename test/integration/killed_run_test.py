#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests what kill -9 leaves of a run of lio-replay and of liod: whole rows up to a second before,
and files that end with the same scan."""
import shutil
import struct
import subprocess
import time
import unittest

import support

FILES_OF_SCANS = ("trajectory.tum", "trajectory_world.tum", "covariance.csv",
                  "covariance_world.csv", "states.csv", "registration.csv")
FILE_OF_SAMPLES = "trajectory_imu_rate.tum"
MAX_APART_S = 1.0
MAX_LOST_S = 1.0
# The files are written one after the other: a kill between two of them leaves the last rows of one
# alone. The writes of all files are over so long after the first one is seen, also where the
# scheduler puts another process between them; the next ones come half a second after the first.
WRITES_ARE_OVER_S = 0.1
# A network of its own, a daemon, somebody who hears its odometry, a player; then kill -9.
SCRIPT = """
set -e
ip link set lo up multicast on; ip route add 224.0.0.0/4 dev lo
"$BIN/liod" --config "$DRIVE/config.yaml" --out "$OUT/run" 2>"$OUT/said" & liod=$!
until grep -q listening "$OUT/said"; do sleep 0.05; done
lcm-logger -q -f -c LIO_ODOM "$OUT/heard.lcm" & logger=$!
sleep 0.3
lcm-logplayer "$DRIVE/log.lcm" >/dev/null & player=$!
sleep "$SECONDS_LONG"
kill -9 $liod; date +%s%6N >"$OUT/killed"
kill $logger $player; wait
"""


def drive():
    return support.simulated("street", "--duration", "20", "--lidar", "vlp16")


def killed_replay():
    """The folder of a replay that was killed in its midst."""
    out = support.WORK / "killed"
    shutil.rmtree(out, ignore_errors=True)
    rows = out / "trajectory.tum"
    words = [support.BUILD / "bin/lio-replay", "--config", drive() / "config.yaml",
             drive() / "log.lcm", "--out", out]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        while process.poll() is None and not (rows.exists() and rows.stat().st_size > 8000):
            time.sleep(0.001)
        time.sleep(WRITES_ARE_OVER_S)
        process.kill()
    return out


def killed_daemon(seconds):
    """The folder of a liod that was killed so long after the first message."""
    out = support.WORK / "killed-daemon"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    subprocess.run(["unshare", "-rn", "env", f"BIN={support.BUILD / 'bin'}", f"DRIVE={drive()}",
                    f"OUT={out}", f"SECONDS_LONG={seconds}", "bash", "-c", SCRIPT],
                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   timeout=support.TIMEOUT_S, check=False)
    return out


def odometry(log):
    """For each odometry of a log: when it was heard and its stamp, in microseconds."""
    data, at, found = log.read_bytes(), 0, []
    while at + 28 <= len(data):
        _, _, heard, num_channel, num_data = struct.unpack_from(">IqqII", data, at)
        at += 28 + num_channel
        if at + 16 <= len(data):
            found.append((heard, struct.unpack_from(">q", data, at + 8)[0]))
        at += num_data
    return found


class KilledRun(unittest.TestCase):
    def check_rows(self, out):
        """Checks that rows are whole and that files end together; the stamp of the last scan."""
        self.assertFalse((out / "stats.json").exists(), "it was not killed in time")
        ends_s = {}
        for name in (*FILES_OF_SCANS, FILE_OF_SAMPLES):
            text = (out / name).read_text()
            self.assertTrue(text.endswith("\n"), name)
            rows = text.splitlines()
            separator = "," if name.endswith(".csv") else " "
            self.assertEqual(len({row.count(separator) for row in rows}), 1, name)
            ends_s[name] = float(rows[-1].split(separator)[0])
        print(ends_s)
        self.assertEqual(len({ends_s[name] for name in FILES_OF_SCANS}), 1)
        end_s = ends_s["trajectory.tum"]
        self.assertLess(abs(ends_s[FILE_OF_SAMPLES] - end_s), MAX_APART_S)
        return end_s

    def test_a_killed_replay_leaves_whole_rows_that_programs_read(self):
        out = killed_replay()
        self.check_rows(out)
        truth = drive() / "truth.tum"
        # A kill while the files are written leaves rows in the first that the last has not.
        rows = (out / "covariance.csv").read_text().splitlines(keepends=True)
        (out / "covariance.csv").write_text("".join(rows[:-3]))
        # A system that goes down may cut a row all the same.
        with open(out / "trajectory.tum", "a", encoding="ascii") as stream:
            stream.write("2000000000.5 1.0 2.")
        done = support.run("lio-eval", truth, out / "trajectory.tum")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the last line is cut", done.stderr)
        with open(out / "covariance.csv", "a", encoding="ascii") as stream:
            stream.write("2000000000.5,1.0")
        for words in (("lio-eval", "consistency", truth, out), ("lio-run", out)):
            done = support.run(*words)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_killed_daemon_leaves_all_but_the_last_second(self):
        if not support.may_unshare("-rn"):
            self.skipTest("no right to make a network namespace")
        for seconds in (5.3, 6.1, 6.8):
            with self.subTest(seconds=seconds):
                out = killed_daemon(seconds)
                end_s = self.check_rows(out / "run")
                killed_us = int((out / "killed").read_text())
                known = [stamp for heard, stamp in odometry(out / "heard.lcm")
                         if heard < killed_us - MAX_LOST_S * 1e6]
                self.assertGreater(len(known), 20)
                self.assertGreaterEqual(end_s, max(known) * 1e-6 - 1e-5)


if __name__ == "__main__":
    support.main()
