#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests that liod.Odometry gives the bytes of lio-replay on the same log, from events and from
arrays, and that it is a good guest in a program of Python."""
import itertools
import json
import sys
import threading
import time
import unittest

import package
import support

liod = package.load()
import numpy as np  # noqa: E402  (the package needs it, too)

# These files of a run hold no computing times.
EXACT = ("trajectory.tum", "trajectory_world.tum", "trajectory_level.tum",
         "trajectory_imu_rate.tum", "covariance.csv", "covariance_world.csv",
         "covariance_level.csv", "states.csv", "notices.tsv", "options.yaml", "verdict.json",
         "map.pcd")


class SameBytes(package.Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.replayed = support.replay(cls.log, "python-replayed", "--config", cls.config, "--map")

    def odometry(self, name):
        return liod.Odometry(self.config, out=support.WORK / name, overwrite=True, keep_map=True)

    def check_same(self, name):
        folder = support.WORK / name
        for file in EXACT:
            expected, found = ((f / file).read_bytes() for f in (self.replayed, folder))
            self.assertTrue(expected, file)
            self.assertEqual(expected, found, f"{folder / file} differs from lio-replay's")
        self.assertEqual(support.untimed(self.replayed), support.untimed(folder))

    def test_events_of_the_log_give_the_bytes_of_lio_replay(self):
        with self.odometry("python-events") as odometry:
            estimates = [e for event in liod.read_log(self.log) for e in odometry.add(event)]
        self.check_same("python-events")
        rows = len((self.replayed / "trajectory.tum").read_text().splitlines())
        self.assertGreaterEqual(rows, len(estimates))

    def test_arrays_give_the_bytes_of_lio_replay(self):
        odometry = self.odometry("python-arrays")
        for event in liod.read_log(self.log):
            if isinstance(event, liod.Scan):
                odometry.add_scan(event.stamp_ns, event.points, event.times_ns, event.rings,
                                  event.intensity)
            elif isinstance(event, liod.ImuSamples):
                odometry.add_imu(event.stamps_ns, event.gyro, event.accel)
        odometry.finish()
        self.check_same("python-arrays")

    def test_single_samples_and_other_types_and_stamps_change_nothing(self):
        odometry = self.odometry("python-single")
        for event in liod.read_log(self.log):
            if isinstance(event, liod.Scan):
                # A stamp before the first point, and copies of other types.
                odometry.add_scan(event.stamp_ns - 20_000_000, event.points.astype(np.float64),
                                  event.times_ns.astype(np.int64) + 20_000_000,
                                  event.rings.tolist(), np.asfortranarray(event.intensity))
                continue
            for row in zip(event.stamps_ns.tolist(), event.gyro.tolist(), event.accel.tolist()):
                odometry.add_imu(*row)
        odometry.finish()
        self.check_same("python-single")

    def test_the_order_of_points_matters_to_the_last_bits_alone(self):
        odometry = liod.Odometry(self.config)
        estimates = []
        for event in liod.read_log(self.log):
            if isinstance(event, liod.ImuSamples):
                estimates += odometry.add(event)
                continue
            order = np.argsort(event.rings, kind="stable")
            estimates += odometry.add_scan(event.stamp_ns, event.points[order],
                                           event.times_ns[order], event.rings[order])
        estimates += odometry.finish()
        path = np.loadtxt(self.replayed / "trajectory_world.tum")
        np.testing.assert_allclose([e.position for e in estimates], path[:, 1:4], atol=0.01)

    def test_the_path_of_the_estimates_is_that_of_the_files(self):
        odometry = liod.Odometry(self.config)
        estimates = [e for event in liod.read_log(self.log) for e in odometry.add(event)]
        estimates += odometry.finish()
        rows = np.loadtxt(self.replayed / "trajectory_world.tum")
        self.assertEqual(len(rows), len(estimates))
        np.testing.assert_allclose([e.position for e in estimates], rows[:, 1:4], atol=1e-9)
        np.testing.assert_allclose([e.quaternion_xyzw for e in estimates], rows[:, 4:], atol=1e-9)
        text = (self.replayed / "trajectory_world.tum").read_text().split("\n")[:-1]
        stamps = [int(row.split()[0].replace(".", "")) for row in text]
        self.assertEqual([e.stamp_ns for e in estimates], stamps)


class Estimates(package.Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.odometry = liod.Odometry(cls.config, imu_rate=True, keep_map=True)
        cls.all = [e for event in liod.read_log(cls.log) for e in cls.odometry.add(event)]
        cls.all += cls.odometry.finish()
        cls.scans = [e for e in cls.all if e.source == liod.Source.SCAN]

    def test_estimates_come_at_both_rates(self):
        self.assertGreater(len(self.all), 5 * len(self.scans))
        stamps = [e.stamp_ns for e in self.scans]
        self.assertEqual(stamps, sorted(stamps))

    def test_a_scan_has_all_that_the_filter_knows(self):
        last = self.scans[-1]
        self.assertEqual(last.status, liod.Status.OK)
        np.testing.assert_array_equal(last.filter_covariance, last.filter_covariance.T)
        self.assertEqual(last.filter_covariance.shape, (21, 21))
        np.testing.assert_array_equal(last.covariance, last.filter_covariance[:6, :6])
        self.assertTrue((np.linalg.eigvalsh(last.covariance) > 0).all())
        self.assertAlmostEqual(np.linalg.norm(last.gravity), 9.8, delta=0.1)
        self.assertLess(np.abs(last.gyro_bias).max(), 0.05)
        np.testing.assert_allclose(last.pose[:3, :3] @ last.pose[:3, :3].T, np.eye(3), atol=1e-12)
        np.testing.assert_array_equal(last.pose[3], [0, 0, 0, 1])
        self.assertTrue(last.match.is_fused)
        self.assertEqual(last.match.status, "converged")
        self.assertIsNone(last.channel)

    def test_a_pose_at_the_rate_of_the_samples_has_no_biases(self):
        nav = next(e for e in self.all if e.source == liod.Source.IMU)
        self.assertIsNone(nav.gyro_bias)
        self.assertIsNone(nav.nis)
        self.assertIsNone(nav.match)
        self.assertEqual(nav.velocity.shape, (3,))

    def test_arrays_are_views_that_outlive_the_estimate(self):
        estimate = self.odometry_of_one()
        position, copy = estimate.position, estimate.position.copy()
        self.assertIs(position.base, estimate)
        del estimate
        np.testing.assert_array_equal(position, copy)

    def odometry_of_one(self):
        odometry = liod.Odometry(self.config)
        for event in liod.read_log(self.log):
            for estimate in odometry.add(event):
                return estimate
        raise AssertionError("no estimate came")

    def test_the_map_has_points_around_the_path(self):
        points = self.odometry.map_points
        self.assertEqual((points.dtype, points.shape[1]), (np.float32, 3))
        self.assertGreater(len(points), 10_000)
        self.assertLess(np.abs(points).max(), 300)

    def test_the_account_and_the_verdict_are_there(self):
        counters = self.odometry.counters
        self.assertEqual(counters["num_scans"], counters["num_chunks"])
        self.assertGreater(counters["num_imu"], 500)
        self.assertIn(self.odometry.verdict()["trust"], ("yes", "doubtful"))
        self.assertEqual(self.odometry.status, liod.Status.OK)
        self.assertIsInstance(self.odometry.notices, list)


class Configuration(package.Case):
    def test_mappings_files_and_both_are_taken(self):
        rig = {"rig": {"T_imu_lidar": {"translation_m": np.array([0.0, 0, 0.3]),
                                       "rotation_wxyz": [1, 0, 0, 0]},
                       "lidar": {"model": "vlp16"}}}
        for config in (rig, self.config, str(self.config), [self.config, rig],
                       [rig, {"pipeline": {"use_imu": False}}]):
            with self.subTest(config):
                liod.Odometry(config)

    def test_all_faults_are_told_at_once(self):
        config = {"rig": {"lidar": {"model": "vlp61"}}, "ndt": {"voxel_m": -1}, "nonsense": 1}
        self.check_error(liod.ConfigurationError,
                         ["T_imu_lidar", "vlp61", "ndt.voxel_m", "nonsense"], liod.Odometry,
                         config)
        self.check_error(liod.ConfigurationError, ["/no/such.yaml"], liod.Odometry,
                         "/no/such.yaml")
        self.check_error(liod.ConfigurationError, ["T_imu_lidar"], liod.Odometry)

    def test_values_of_any_kind_are_refused_and_never_crash(self):
        for value in (float("nan"), float("inf"), 10**400, [], {}, "x", [[1]], None, True, "a: b"):
            with self.subTest(value):
                self.check_error(liod.ConfigurationError, ["ndt.voxel_m"], liod.Odometry,
                                 [self.config, {"ndt": {"voxel_m": value}}])
        with self.assertRaises(TypeError):
            liod.Odometry([self.config, {"ndt": {"voxel_m": object()}}])
        with self.assertRaises(TypeError):
            liod.Odometry([12])

    def test_an_earlier_run_is_kept(self):
        folder = support.WORK / "python-kept"
        liod.Odometry(self.config, out=folder, overwrite=True).finish()
        self.check_error(liod.UsageError, ["overwrite", str(folder)], liod.Odometry, self.config,
                         out=folder)
        self.check_error(liod.OutputError, ["/dev/null"], liod.Odometry, self.config,
                         out="/dev/null/run")

    def test_data_that_contradict_the_configuration_are_an_error(self):
        drive = support.simulated("street", "--duration", "12", "--lidar", "vlp16",
                                  "--imu-variant", "in-deg")
        odometry = liod.Odometry([drive / "config.yaml", {"rig": {"imu": {"units": "si"}}}])
        with self.assertRaises(liod.ConfigurationError) as caught:
            for event in liod.read_log(drive / "log.lcm"):
                odometry.add(event)
        self.assertIn("rig.imu.units", str(caught.exception))
        self.assertEqual(odometry.notices[-1].severity, "error")
        self.check_error(liod.ConfigurationError, ["rig.imu.units"], odometry.add_imu, 1,
                         [0, 0, 0], [0, 0, 9.8])


class Guest(package.Case):
    def check_others_run(self, call):
        """Another thread gets a turn while the call works.

        The interpreter does not take the lock away by itself meanwhile, so a call that kept it
        would let no turn pass, however often it is made.
        """
        turns = 0
        stop = threading.Event()

        def count():
            nonlocal turns
            while not stop.is_set():
                turns += 1
                time.sleep(0)  # lets the lock go
        interval_s = sys.getswitchinterval()
        sys.setswitchinterval(1000)
        thread = threading.Thread(target=count)
        thread.start()
        try:
            for _ in range(20):  # a busy machine may give the other thread no time during a call
                before = turns
                call()
                if turns > before:
                    return
        finally:
            stop.set()
            sys.setswitchinterval(interval_s)
            thread.join()
        self.fail("no other thread got a turn")

    def test_other_threads_run_during_a_scan(self):
        odometry = liod.Odometry({"pipeline": {"use_imu": False}, "reduce": {"voxel_m": 0.05,
                                                                             "min_voxel_m": 0.05}})
        rng = np.random.default_rng(1)
        points = rng.normal(size=(300_000, 3))
        points *= 20 / np.linalg.norm(points, axis=1, keepdims=True)
        stamps = itertools.count(1_000_000_000, 100_000_000)
        self.check_others_run(lambda: odometry.add_scan(next(stamps), points))

    def test_other_threads_run_during_an_evaluation(self):
        count = 40_000
        stamps = 10_000_000 * np.arange(count)
        poses = np.tile(np.eye(4), (count, 1, 1))
        poses[:, 0, 3] = np.sin(0.01 * np.arange(count))
        poses[:, 1, 3] = 0.01 * np.arange(count)
        self.check_others_run(lambda: liod.evaluate((stamps, poses), (stamps, poses),
                                                    time_offset_s="auto"))

    def test_threads_that_share_an_estimator_do_not_break_it(self):
        odometry = liod.Odometry(self.config)
        events = list(liod.read_log(self.log))
        threads = [threading.Thread(target=lambda part: [odometry.add(e) for e in part],
                                    args=(events[i::3],)) for i in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            while thread.is_alive():
                self.assertIsInstance(odometry.counters["num_imu"], int)
                thread.join(0.01)
        odometry.finish()  # samples that wait are counted when they are taken
        self.assertEqual(odometry.counters["num_imu"],
                         sum(len(e) for e in events if isinstance(e, liod.ImuSamples)))

    def test_a_finished_run_takes_nothing_more(self):
        odometry = liod.Odometry(self.config)
        odometry.finish()
        self.assertTrue(odometry.is_finished)
        self.check_error(liod.UsageError, ["finished"], odometry.finish)
        self.check_error(liod.UsageError, ["finished"], odometry.add_imu, 1, [0, 0, 0], [0, 0, 9])

    def test_an_error_inside_a_with_block_is_the_one_that_is_raised(self):
        with self.assertRaises(ZeroDivisionError):
            with liod.Odometry(self.config):
                raise ZeroDivisionError

    def test_stats_of_the_files_close_the_account(self):
        folder = support.WORK / "python-stats"
        with liod.Odometry(self.config, out=folder, overwrite=True) as odometry:
            for event in liod.read_log(self.log):
                odometry.add(event)
        stats = json.loads((folder / "stats.json").read_text())
        text = json.dumps(stats["account"])
        self.assertNotIn("-", text)
        self.assertGreater(stats["num_scans"], 50)


if __name__ == "__main__":
    support.main()
