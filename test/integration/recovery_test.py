#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests recovery from gaps, clock steps and gyro saturation, mostly on a walk with a VLP-16, whose
footfalls of 6 m/s^2 go unmeasured during a gap in the IMU. After a gap that cannot be bridged the
estimator must initialize again at its last pose."""
import unittest

import support


class Recovery(unittest.TestCase):
    def run_with(self, fault, seed="77", scenario="campus", also=None):
        faults = ["--fault", fault] + (["--fault", also] if also else [])
        folder = support.simulated(scenario, "--lidar", "vlp16", "--seed", seed, "--duration", "32",
                                   *faults)
        run = support.replay(folder / "log.lcm", folder.name + "-run", "--config",
                             folder / "config.yaml")
        figures = support.evaluate(folder / "truth.tum", run)
        ape_m = figures["ape"]["position_m"]["rmse"]
        self.end_error_m = figures["end"]["error_m"]
        print(f"{fault}: APE {ape_m:.4f} m, at the end {self.end_error_m:.4f} m,"
              f" restarts {support.stats(run)['num_restarts']}")
        return ape_m, support.stats(run)

    def test_a_second_without_the_imu_is_bridged_by_the_lidar(self):
        ape_m, _ = self.run_with("imu_gap:start=15,duration=1")
        self.assertLess(ape_m, 0.1)

    def test_steps_that_go_unseen_do_not_turn_the_path(self):
        ape_m, _ = self.run_with("imu_gap:start=9,duration=0.4", "2")
        self.assertLess(ape_m, 0.1, "was 5 m")

    def test_clocks_that_jump_back_for_two_seconds_leave_the_path_whole(self):
        ape_m, stats = self.run_with("stamp_jump:offset=-3,start=15,duration=2")
        self.assertLess(ape_m, 0.05)
        self.assertEqual(stats["num_restarts"], 2)

    def test_a_clock_that_is_set_right_again_is_no_gap(self):
        ape_m, _ = self.run_with("stamp_jump:offset=-2,start=10,duration=1")
        self.assertLess(ape_m, 0.05)

    # The stamps come a second time, so the samples look late. While the stamps are wrong, the path,
    # by its stamps, is off by the distance travelled in 0.5 s.
    def test_a_clock_that_steps_back_by_less_than_a_second_is_seen_to(self):
        ape_m, stats = self.run_with("stamp_jump:offset=-0.5,start=10,duration=3")
        self.assertEqual(stats["num_clock_jumps"], 2)
        self.assertLess(self.end_error_m, 0.05, "was 2.6 m")
        self.assertLess(ape_m, 0.4)

    # When a host's clock is set forward and back, it takes both sensors along. The stamps alone say
    # that nothing came for a second and a half; the scans show that nothing moved meanwhile.
    def test_clocks_that_are_set_forth_are_told_from_a_gap(self):
        for scenario in ("street", "campus"):
            _, stats = self.run_with("stamp_jump:offset=1.5,start=10,duration=0.5",
                                     scenario=scenario)
            self.assertEqual(stats["num_restarts"], 2)
            self.assertLess(self.end_error_m, 0.3, "was 37 m")

    def test_a_gap_of_both_sensors_is_told_from_a_set_clock(self):
        ape_m, stats = self.run_with("imu_gap:start=10,duration=0.7", scenario="street",
                                     also="lidar_gap:start=10,duration=0.7")
        self.assertEqual(stats["num_clock_jumps"], 0)
        self.assertLess(ape_m, 0.05)

    def test_an_inertial_clock_that_steps_alone_is_put_right(self):
        for offset in ("-0.5", "0.4", "1.5"):
            ape_m, stats = self.run_with(
                f"stamp_jump:channel=imu,offset={offset},start=10,duration=5")
            self.assertLess(ape_m, 0.02, "was 1.1 m and more")
            self.assertEqual(stats["num_restarts"], 0)

    # Nothing is received for five seconds of walking. The walk is found again in the map.
    def test_an_outage_of_both_sensors_is_survived(self):
        _, stats = self.run_with("imu_gap:start=15,duration=5", "1",
                                 also="lidar_gap:start=15,duration=5")
        self.assertEqual(stats["num_restarts"], 1)
        self.assertLess(self.end_error_m, 0.3)

    def test_an_imu_that_dies_leaves_the_lidar_and_is_used_again(self):
        ape_m, stats = self.run_with("imu_gap:start=10,duration=10", "1")
        self.assertEqual(stats["num_restarts"], 1)
        self.assertEqual(stats["num_scans_without_imu"], 0)
        self.assertLess(ape_m, 0.1, "was 9.6 m")

    def test_a_gyro_that_jumps_leaves_the_way_to_the_lidar(self):
        for scenario, was in (("garage", "15 m"), ("street", "11 m")):
            with self.subTest(scenario=scenario):
                ape_m, stats = self.run_with("imu_offset:start=20,gyro=0.3,accel=0", "5", scenario)
                self.assertEqual(stats["num_imu_contradicted"], 1)
                self.assertLess(ape_m, 0.05, f"was {was}")

    def test_a_gyro_that_clips_is_helped_by_the_scans(self):
        ape_m, stats = self.run_with("gyro_saturation:limit=0.1,start=10,duration=8")
        self.assertGreater(stats["num_imu_clipped"], 100)
        self.assertEqual(stats["num_restarts"], 0)
        self.assertLess(ape_m, 0.05, "was 2.4 m")


if __name__ == "__main__":
    support.main()
