#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests KITTI raw drive 0005, a real drive in motion from its first scan, with the IMU interpolated
to 100 Hz and lidar-only. Good systems reach 1.8 to 2.2 cm, 8 to 15 cm and 3.6 to 4.2 %."""
import unittest

import support


class KittiRaw(unittest.TestCase):
    def check(self, name, *words):
        drive = support.kitti_drive()
        folder = support.made_once("kitti-raw", lambda path: support.run_well(
            "lio-convert", "kitti-raw", drive, path / "log.lcm", "--truth", path / "truth.tum",
            "--rig", path / "rig.yaml", "--imu-rate", "100"))
        run = support.replay(folder / "log.lcm", f"kitti-raw-{name}", "--config",
                             support.SOURCE / "config/kitti_raw.yaml", "--config",
                             folder / "rig.yaml", *words)
        figures = support.evaluate(folder / "truth.tum", run)
        step = figures["step"]
        shown = {"step m": (step["translation_m"]["median"], 0.023),
                 "step deg": (step["rotation_deg"]["median"], 0.06),
                 "APE m": (figures["ape"]["position_m"]["rmse"], 0.13),
                 "end %": (figures["end"]["error_percent"], 4.5)}
        print(name, ", ".join(f"{key} {value:.4f}" for key, (value, _) in shown.items()))
        for key, (value, bar) in shown.items():
            self.assertLessEqual(value, bar, key)
        self.assertEqual(support.stats(run)["num_scans_dropped"], 0)
        self.assertEqual(support.stats(run)["num_scans"], 80)

    def test_with_the_imu(self):
        self.check("imu")

    def test_lidar_only(self):
        self.check("lidar-only", "--set", "pipeline.use_imu=false")


if __name__ == "__main__":
    support.main()
