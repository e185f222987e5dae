#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests bags in UrbanLoco's layout, with and without point times, each with its own extrinsic."""
import json
import unittest

import support

EXIT_NO_TRUST = 6


class UrbanLoco(unittest.TestCase):
    def check(self, name, ape_bound_m):
        bag = support.unpacked_bag(name)
        log = bag.with_suffix(".lcm")
        support.run_well("lio-convert", "rosbag", bag, log)
        folder = support.replay(log, f"{name}-run", "--config",
                                support.SOURCE / "config/default.yaml", "--config",
                                support.RIGS / f"{name}.yaml")
        figures = support.evaluate(support.data_file(f"{name}.gt.tum"), folder)
        ape_m, tilt_deg = figures["ape"]["position_m"]["rmse"], figures["tilt_deg"]["max"]
        end = figures["end"]
        print(f"path {figures['path_length_m']:.1f} m, APE {ape_m:.4f} m, "
              f"end {end['error_m']:.3f} m ({end['error_percent']:.2f} %), "
              f"tilt at most {tilt_deg:.3f} deg")
        self.assertLessEqual(ape_m, ape_bound_m)
        self.assertLessEqual(tilt_deg, 0.5)
        # Initialization at rest takes at most 1.5 s; every scan after it has a row.
        num_scans = support.stats(folder)["num_scans"]
        self.assertGreaterEqual(figures["association"]["num_estimate"], num_scans - 16)
        self.assertEqual(support.stats(folder)["num_scans_dropped"], 0)

    def test_bag_with_point_time_tracks_to_three_centimetres(self):
        self.check("ulhk_sample", 0.03)

    def test_bag_without_point_time_tracks_to_six_centimetres(self):
        self.check("ulhk_sample_notime", 0.06)

    def test_a_lidar_turned_by_a_quarter_is_named_on_a_straight_road_and_the_fix_is_right(self):
        bag = support.unpacked_bag("ulhk_sample_notime")
        truth = support.data_file("ulhk_sample_notime.gt.tum")
        folder = support.WORK / "stranger"
        done = support.run("lio-run", bag, "--out", folder, "--overwrite", "--truth", truth)
        self.assertEqual(done.returncode, EXIT_NO_TRUST, done.stderr)
        verdict = json.loads((folder / "verdict.json").read_text())
        self.assertEqual([cause["kind"] for cause in verdict["causes"]],
                         ["extrinsic_rotation", "imu_axes"])
        corrected = folder / "rig_corrected.yaml"
        self.assertIn(str(corrected), done.stdout)
        rig = support.WORK / "stranger.yaml"
        rig.write_text(corrected.read_text())
        again = support.run("lio-run", bag, "--rig", rig, "--out", folder, "--overwrite",
                            "--truth", truth)
        self.assertEqual(again.returncode, 0, again.stderr)
        figures = json.loads((folder / "eval.json").read_text())
        self.assertLessEqual(figures["ape"]["position_m"]["rmse"], 0.06)


if __name__ == "__main__":
    support.main()
