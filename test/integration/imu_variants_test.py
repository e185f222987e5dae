#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests IMU messages in other units and axes: the convention must be detected, reported and
corrected, or the log refused with the setting that mends it."""
import unittest

import support

DRIVE = ("suburb", "--duration", "10", "--lidar", "vlp16", "--moving-start", "--realism",
         "datasheet", "--imu-variant")
NAMES = {"in-g": "accelerometer in g, gyro in rad/s",
         "in-deg": "accelerometer in m/s^2, gyro in deg/s",
         "in-g-and-deg": "accelerometer in g, gyro in deg/s",
         "z-down": "its x -y -z are the rig's x y z (z down)",
         "turned": "its y -x z are the rig's x y z"}
FIXES = {"in-g": "set rig.imu.units: auto or g", "in-deg": "set rig.imu.units: auto or deg",
         "z-down": "or turn rig.T_imu_lidar: translation_m: ["}


class ImuVariants(unittest.TestCase):
    def replay(self, variant, *words):
        drive = support.simulated(*DRIVE, variant)
        out = support.WORK / f"imu-{variant}-run"
        done = support.run("lio-replay", "--config", drive / "config.yaml", *words,
                           drive / "log.lcm", "--out", out, "--overwrite")
        return done, drive, out

    def test_each_is_named_within_two_seconds_and_tracked_from_its_first_sweep(self):
        for variant, name in NAMES.items():
            with self.subTest(variant):
                done, drive, out = self.replay(variant)
                self.assertEqual(done.returncode, 0, done.stderr)
                line = next(line for line in done.stderr.splitlines() if name in line)
                begin_s = float((drive / "truth.tum").read_text().split(None, 1)[0])
                self.assertLess(float(line.split(": ")[1]) - begin_s, 2.0, line)
                started = done.stderr.splitlines()[-1]
                self.assertIn("started in motion", started)
                self.assertIn("accelerometer in", started)
                figures = support.evaluate(drive / "truth.tum", out)
                print(variant, "APE %.4f m" % figures["ape"]["position_m"]["rmse"])
                self.assertLess(figures["ape"]["position_m"]["rmse"], 0.01)
                self.assertGreater(figures["association"]["coverage_ratio"], 0.95)

    def test_removed_gravity_is_tracked_and_said(self):
        done, drive, out = self.replay("gravity-removed")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("without gravity: roll and pitch unknown", done.stderr)
        figures = support.evaluate(drive / "truth.tum", out)
        self.assertLess(figures["ape"]["position_m"]["rmse"], 0.01)

    def test_plain_messages_are_not_talked_about(self):
        done, _, _ = self.replay("normal")
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertNotIn("accelerometer", done.stderr)

    def test_wrongly_stated_units_are_a_configuration_error_with_the_fix(self):
        for variant, fix in FIXES.items():
            with self.subTest(variant):
                done, _, _ = self.replay(variant, "--set", "rig.imu.units=si")
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn(fix, done.stderr.splitlines()[-1])

    def test_wrongly_stated_gravity_is_a_configuration_error_with_the_fix(self):
        done, _, _ = self.replay("gravity-removed", "--set", "rig.imu.gravity=present")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("set rig.imu.gravity: auto or removed", done.stderr)


if __name__ == "__main__":
    support.main()
