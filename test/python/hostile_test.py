#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests that wrong arrays are refused in words, that wrong values are counted, and that neither
ends the process."""
import random

import package
import support

liod = package.load()
import numpy as np  # noqa: E402  (the package needs it, too)

NOW_NS = 1_700_000_000_000_000_000
RATE, FORCE = [0.0, 0.0, 0.0], [0.0, 0.0, 9.8]
POINTS = np.ones((5, 3), np.float32)
# Things that are no numbers, or not these.
ODD = (None, "x", b"x", object(), {}, [], [[]], [1, "x", 2], [[1, 2], [3]], 1j, [1j, 2, 3],
       np.array(["a"]), np.array([None, 1]), np.zeros((2, 2, 2)), np.array(3.0), True,
       np.array([True, False, True]), np.datetime64("now"), float("nan"), 10**30, -1, 2**63, range)


class Hostile(package.Case):
    def setUp(self):
        self.odometry = liod.Odometry(self.config)

    def count(self, name):
        return self.odometry.counters[name]

    def test_wrong_shapes_are_named(self):
        add = self.odometry.add_imu
        stamps = NOW_NS + np.arange(4)
        many = np.zeros((4, 3))
        for words, arguments in (
                (["gyro", "(3,)", "(2,)"], (NOW_NS, [0, 0], FORCE)),
                (["accel", "(4,)"], (NOW_NS, RATE, [0, 0, 0, 0])),
                (["gyro", "(4, 2)"], (stamps, np.zeros((4, 2)), many)),
                (["accel", "4 stamps", "3"], (stamps, many, many[:3])),
                (["one stamp"], (NOW_NS, many, many)),
                (["one stamp"], (stamps, RATE, FORCE)),
                (["stamp_ns", "(2, 2)"], (stamps.reshape(2, 2), many, many))):
            with self.subTest(arguments):
                self.check_error(ValueError, words, add, *arguments)
        scan = self.odometry.add_scan
        for words, arguments in (
                (["points", "(3,)"], (NOW_NS, [1, 2, 3])),
                (["points", "(5, 4)"], (NOW_NS, np.zeros((5, 4)))),
                (["times_ns", "5 points", "4"], (NOW_NS, POINTS, np.zeros(4, int))),
                (["rings", "5 points"], (NOW_NS, POINTS, None, [1])),
                (["intensity", "(N,)"], (NOW_NS, POINTS, None, None, 3)),
                (["one integer"], ([NOW_NS], POINTS))):
            with self.subTest(arguments):
                self.check_error(ValueError, words, scan, *arguments)
        self.assertEqual((self.count("num_imu"), self.count("num_chunks")), (0, 0))

    def test_wrong_types_are_named(self):
        for words, arguments in (
                (["stamp_ns", "integers", "float64"], (1.5e9, RATE, FORCE)),
                (["gyro", "real numbers"], (NOW_NS, [1j, 0, 0], FORCE)),
                (["accel", "real numbers"], (NOW_NS, RATE, ["a", "b", "c"])),
                (["gyro", "object"], (NOW_NS, [None, 0, 0], FORCE)),
                (["stamp_ns"], (2**70, RATE, FORCE))):
            with self.subTest(arguments):
                self.check_error(TypeError, words, self.odometry.add_imu, *arguments)
        for words, arguments in (
                (["times_ns", "float32"], (NOW_NS, POINTS, np.zeros(5, np.float32))),
                (["rings", "bool"], (NOW_NS, POINTS, None, np.zeros(5, bool)))):
            with self.subTest(arguments):
                self.check_error(TypeError, words, self.odometry.add_scan, *arguments)
        self.check_error(TypeError, ["read_log"], self.odometry.add, 12)

    def test_numbers_outside_their_range_are_named(self):
        for stamp in (-1, 2**63 - 1, np.uint64(2**64 - 1)):
            with self.subTest(stamp):
                self.check_error(ValueError, ["stamp_ns"], self.odometry.add_imu, stamp, RATE,
                                 FORCE)
        for name, column in (("times_ns", [-1]), ("times_ns", [2_000_000_000]), ("rings", [65536]),
                             ("intensity", [-5])):
            with self.subTest(name):
                self.check_error(ValueError, [name, "0 to"], self.odometry.add_scan, NOW_NS,
                                 POINTS[:1], **{name: column})

    def test_values_that_are_no_numbers_are_counted(self):
        self.odometry.add_imu(NOW_NS, [np.nan, 0, 0], FORCE)
        self.odometry.add_imu([NOW_NS + 1, NOW_NS + 2], [RATE, RATE], [FORCE, [0, np.inf, 0]])
        self.assertEqual(self.count("num_imu_nonfinite"), 2)
        points = np.full((100, 3), np.nan)
        points[::2] = 1e300
        self.odometry.add_scan(NOW_NS, points)
        self.odometry.add_scan(NOW_NS + 100_000_000, np.zeros((0, 3)))
        self.odometry.finish()
        self.assertEqual(self.count("num_scans"), 2)

    def test_a_drive_with_holes_of_nan_goes_on(self):
        rng = np.random.default_rng(1)
        estimates = []
        for event in liod.read_log(self.log):
            if isinstance(event, liod.Scan):
                points = event.points.copy()
                points[rng.random(len(points)) < 0.1] = np.nan
                estimates += self.odometry.add_scan(event.stamp_ns, points, event.times_ns,
                                                    event.rings)
            else:
                gyro = event.gyro.copy()
                gyro[rng.random(len(gyro)) < 0.02] = np.inf
                estimates += self.odometry.add_imu(event.stamps_ns, gyro, event.accel)
        self.assertGreater(self.count("num_points_nonfinite"), 1000)
        self.assertGreater(self.count("num_imu_nonfinite"), 3)
        self.assertEqual(estimates[-1].status, liod.Status.OK)

    def test_arrays_of_every_layout_are_read_alike(self):
        poses = []
        for change in (np.asarray, np.asfortranarray, lambda a: a.astype(">f8"),
                       lambda a: a[::-1].copy()[::-1], lambda a: a.astype(np.longdouble),
                       lambda a: np.repeat(a, 2, axis=1)[:, ::2]):
            odometry = liod.Odometry(self.config)
            for event in liod.read_log(self.log):
                if isinstance(event, liod.Scan):
                    odometry.add_scan(event.stamp_ns, change(event.points), event.times_ns,
                                      event.rings)
                else:
                    odometry.add_imu(event.stamps_ns, change(event.gyro), change(event.accel))
                if odometry.counters["num_scans"] > 15:
                    break
            poses.append([e.position.tolist() for e in odometry.finish()])
        self.assertTrue(poses[0])
        for other in poses[1:]:
            self.assertEqual(other, poses[0])

    def test_nothing_odd_ends_the_process(self):
        pick = random.Random(1)
        good = [NOW_NS, RATE, FORCE, POINTS, np.zeros(5, np.uint32)]
        calls = [(self.odometry.add_imu, 3), (self.odometry.add_scan, 5), (self.odometry.add, 1),
                 (lambda a, b: liod.evaluate(a, b), 2), (liod.read_log, 1),
                 (lambda a, b: liod.convert(a, b), 2), (liod.Odometry, 1)]
        num_refused = 0
        for _ in range(3000):
            call, arity = pick.choice(calls)
            arguments = [pick.choice(ODD) if pick.random() < 0.4 else pick.choice(good)
                         for _ in range(arity)]
            try:
                call(*arguments)
            except (TypeError, ValueError, liod.Error, OverflowError):
                num_refused += 1
        self.assertGreater(num_refused, 2000)

    def test_scans_and_samples_of_any_time_are_survived(self):
        pick = np.random.default_rng(2)
        for _ in range(500):
            stamp = int(pick.integers(0, 2**62 - 1))
            if pick.random() < 0.5:
                self.odometry.add_imu(stamp, pick.normal(size=3) * 10.0**pick.integers(0, 30),
                                      pick.normal(size=3))
            else:
                self.odometry.add_scan(stamp, pick.normal(size=(50, 3)) * 30,
                                       pick.integers(0, 10**9, 50), pick.integers(0, 65535, 50))
        self.odometry.finish()


if __name__ == "__main__":
    support.main()
