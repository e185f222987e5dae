#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests lio-log calibrate on a simulated walk with a clock offset and a wrong configuration."""
import json
import math
import re
import unittest

import support

OFFSET_S = 0.03
TURN_DEG = {"yaw_deg": 3, "pitch_deg": -2, "roll_deg": 1}
FAULTS = ("--fault", f"clock_offset:offset={OFFSET_S},channel=lidar", "--fault",
          "wrong_extrinsic:" + ",".join(f"{k}={v}" for k, v in TURN_DEG.items()))


def times(a, b):
    """Returns the product of quaternions w x y z."""
    (w, x, y, z), (p, q, r, s) = a, b
    return (w * p - x * q - y * r - z * s, w * q + x * p + y * s - z * r,
            w * r - x * s + y * p + z * q, w * s + x * r - y * q + z * p)


def inverse(q):
    return (q[0], -q[1], -q[2], -q[3])


def about(axis, degrees):
    half = math.radians(degrees) / 2
    return (math.cos(half), *(math.sin(half) if i == axis else 0.0 for i in range(3)))


def angle_deg(q):
    return math.degrees(2 * math.atan2(math.hypot(*q[1:]), abs(q[0])))


def rotation_in(file):
    found = re.search(r"rotation_wxyz: \[(.*)\]", file.read_text())
    return tuple(map(float, found[1].split(",")))


class Calibrate(unittest.TestCase):
    def calibrate(self, folder, name):
        json_file, rig = (support.WORK / f"{name}.{end}" for end in ("json", "yaml"))
        done = support.run("lio-log", "calibrate", folder / "log.lcm", "--config",
                           folder / "config.yaml", "--json", json_file, "--rig", rig)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(json_file.read_text()), rig

    def test_campus_walk_gives_offset_to_1_ms_and_rotation_to_a_fifth_of_a_degree(self):
        folder = support.simulated("campus", "--duration", "40", *FAULTS)
        turn = times(times(about(2, TURN_DEG["yaw_deg"]), about(1, TURN_DEG["pitch_deg"])),
                     about(0, TURN_DEG["roll_deg"]))
        # The configuration claims turn * truth.
        truth = times(inverse(turn), rotation_in(folder / "config.yaml"))
        found, rig = self.calibrate(folder, "calibrate-campus")
        offset_error_s = found["offset_s"] + OFFSET_S
        error_deg = angle_deg(times(inverse(truth), found["rotation_wxyz"]))
        std_deg = math.hypot(*found["rotation_std_deg"])
        print("offset off by %.3f ms (1 sigma %.3f), rotation by %.4f deg (1 sigma %.4f)" % (
            1e3 * offset_error_s, 1e3 * found["offset_std_s"], error_deg, std_deg))
        self.assertLess(abs(offset_error_s), 1e-3)
        self.assertLess(error_deg, 0.2)
        # The stated uncertainty must agree with the error.
        self.assertLess(abs(offset_error_s), 4 * found["offset_std_s"])
        self.assertLess(error_deg, 4 * std_deg)
        self.assertLess(found["offset_std_s"], 2e-4)
        self.assertAlmostEqual(found["rotation_from_configured_deg"], angle_deg(turn), delta=0.2)
        # The written file serves as configuration after another one.
        support.run_well("lio-replay", "--config", folder / "config.yaml", "--config", rig,
                         "--duration", "3", folder / "log.lcm", "--out",
                         support.WORK / "calibrate-replay", "--overwrite")
        self.assertLess(angle_deg(times(inverse(truth), rotation_in(rig))), 0.2)
        self.assertIn(f"clock_offset_s: {found['offset_s']:.6f}", rig.read_text())

    def test_parked_car_is_refused(self):
        folder = support.simulated("parked", "--duration", "8", "--lidar", "vlp16")
        done = support.run("lio-log", "calibrate", folder / "log.lcm", "--config",
                           folder / "config.yaml")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("too little motion", done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_rig_needs_a_configured_translation(self):
        folder = support.simulated("parked", "--duration", "8", "--lidar", "vlp16")
        done = support.run("lio-log", "calibrate", folder / "log.lcm", "--rig",
                           support.WORK / "no.yaml")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("T_imu_lidar", done.stderr)


class Info(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.log = support.simulated("parked", "--duration", "8", "--lidar", "vlp16") / "log.lcm"

    def test_channels_counts_and_rates_are_told(self):
        text = support.run_well("lio-log", "info", self.log)
        self.assertRegex(text, r"LIO_IMU +80\d ")
        self.assertRegex(text, r"inertial samples: 80\d, 8\.\d+ s at 100\.\d+ Hz, 0 gaps")
        self.assertRegex(text, r"sweeps: (79|80), 7\.\d+ s at 10\.\d+ Hz, 0 gaps")
        self.assertIn("damage: 0 bytes skipped", text)

    def test_damage_is_told_and_ends_with_5(self):
        whole = self.log.read_bytes()
        middle = whole.index(b"\xed\xa1\xda\x01", len(whole) // 2)  # the begin of a message
        damaged = support.WORK / "info-damaged.lcm"
        damaged.write_bytes(whole[:middle] + b"\x55" * 20000 + whole[middle + 20000:])
        done = support.run("lio-log", "info", damaged)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("damaged", done.stderr)
        self.assertIn("LIO_SCAN", done.stdout)

    def test_no_log_is_unusable_input(self):
        for command in ("info", "calibrate"):
            done = support.run("lio-log", command, "/no/such.lcm")
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertIn("/no/such.lcm", done.stderr)


if __name__ == "__main__":
    support.main()
