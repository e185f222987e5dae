#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests that liod.read_log gives what the log holds, as views that own no memory."""
import gc
import struct
import unittest

import package
import support

liod = package.load()
import numpy as np  # noqa: E402  (the package needs it, too)

SYNC = 0xEDA1DA01


def messages(path):
    """Yields channel and payload of each event, by an independent reading of the format."""
    data = path.read_bytes()
    at = 0
    while at < len(data):
        sync, _, _, channel, size = struct.unpack_from(">IqqII", data, at)
        assert sync == SYNC
        at += 28
        yield data[at:at + channel].decode(), data[at + channel:at + channel + size]
        at += channel + size


def write_log(path, events):
    with open(path, "wb") as stream:
        for number, (channel, payload) in enumerate(events):
            name = channel.encode()
            stream.write(struct.pack(">IqqII", SYNC, number, number, len(name), len(payload)))
            stream.write(name + payload)


class ReadLog(package.Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.events = list(liod.read_log(cls.log))
        cls.scans = [e for e in cls.events if isinstance(e, liod.Scan)]
        cls.samples = [e for e in cls.events if isinstance(e, liod.ImuSamples)]
        cls.work = support.WORK / "python-log"
        cls.work.mkdir(parents=True, exist_ok=True)

    def test_all_samples_are_there_in_order(self):
        payloads = [data for channel, data in messages(self.log) if channel == "LIO_IMU"]
        stamps = np.concatenate([batch.stamps_ns for batch in self.samples])
        self.assertEqual(len(stamps), len(payloads))
        self.assertTrue((np.diff(stamps) > 0).all())
        utimes = [struct.unpack_from(">q", data, 8)[0] for data in payloads]
        np.testing.assert_array_equal(stamps, np.array(utimes) * 1000)

    def test_scans_are_whole_and_hold_every_point(self):
        chunks = sum(channel == "LIO_SCAN" for channel, _ in messages(self.log))
        self.assertGreater(chunks, len(self.scans))
        self.assertGreater(len(self.scans), 50)
        self.assertEqual({scan.num_missing_chunks for scan in self.scans}, {0})
        for before, after in zip(self.scans, self.scans[1:]):
            self.assertEqual(after.seq, before.seq + 1)
            self.assertGreater(after.stamp_ns, before.end_ns - 1_000_000)  # a firing, at most
        scan = self.scans[10]
        self.assertEqual(scan.points.shape, (len(scan), 3))
        self.assertEqual(scan.end_ns - scan.stamp_ns, scan.times_ns.max())
        self.assertEqual(set(scan.rings), set(range(16)))
        ranges = np.linalg.norm(scan.points, axis=1)
        self.assertTrue((ranges < 200).all() and (ranges > 0.5).all())

    def test_arrays_are_read_only_views_of_one_memory(self):
        scan, batch = self.scans[0], self.samples[0]
        for owner, views in ((scan, (scan.points, scan.times_ns, scan.rings, scan.intensity,
                                     scan.records)),
                             (batch, (batch.stamps_ns, batch.gyro, batch.accel))):
            for view in views:
                self.assertIs(view.base, owner)
                self.assertFalse(view.flags.owndata)
                with self.assertRaises(ValueError):
                    view[0] = view[0]
        self.assertEqual(scan.points.ctypes.data, scan.records.ctypes.data)
        self.assertEqual(scan.points.ctypes.data, scan.points.ctypes.data)
        np.testing.assert_array_equal(scan.records["y"], scan.points[:, 1])
        np.testing.assert_array_equal(scan.records["ring"], scan.rings)
        np.testing.assert_array_equal(scan.records["t_offset_ns"], scan.times_ns)
        np.testing.assert_array_equal(scan.records["intensity"], scan.intensity)

    def test_a_view_outlives_the_event(self):
        events = liod.read_log(self.log)
        scan = next(e for e in events if isinstance(e, liod.Scan))
        points, copy = scan.points, scan.points.copy()
        del scan, events
        gc.collect()
        np.testing.assert_array_equal(points, copy)

    def test_a_lost_chunk_leaves_a_smaller_scan(self):
        events = list(messages(self.log))
        lost = [i for i, (channel, _) in enumerate(events) if channel == "LIO_SCAN"][20]
        write_log(self.work / "lost.lcm", events[:lost] + events[lost + 1:])
        log = liod.read_log(self.work / "lost.lcm")
        scans = [e for e in log if isinstance(e, liod.Scan)]
        self.assertEqual(len(scans), len(self.scans))
        self.assertEqual(sum(scan.num_missing_chunks for scan in scans), 1)
        self.assertEqual(log.num_missing_chunks, 1)

    def test_damage_is_passed_over_and_counted(self):
        data = bytearray(self.log.read_bytes())
        at = data.index(struct.pack(">I", SYNC), len(data) // 2)
        data[at:at + 400] = b"x" * 400
        (self.work / "damaged.lcm").write_bytes(data)
        log = liod.read_log(self.work / "damaged.lcm")
        self.assertGreater(sum(1 for _ in log), 50)
        self.assertGreaterEqual(log.num_skipped_bytes, 400)

    def test_every_truncation_of_a_message_is_refused_and_counted(self):
        payload = next(data for channel, data in messages(self.log) if channel == "LIO_SCAN")
        sizes = [*range(0, 80), len(payload) - 1]
        write_log(self.work / "cut.lcm", [("LIO_SCAN", payload[:size]) for size in sizes])
        log = liod.read_log(self.work / "cut.lcm")
        self.assertEqual(list(log), [])
        self.assertEqual(log.num_refused, len(sizes))

    def test_what_is_no_log_is_named_with_what_takes_it(self):
        self.check_error(liod.InputError, ["/no/such.lcm"], liod.read_log, "/no/such.lcm")
        self.check_error(liod.InputError, [str(self.drive)], liod.read_log, self.drive)
        bag = self.work / "drive.bag"
        bag.write_bytes(b"#ROSBAG V2.0\n")
        self.check_error(liod.InputError, ["lio-convert"], liod.read_log, bag)
        self.check_error(liod.InputError, ["/dev/zero"], liod.read_log, "/dev/zero")
        with self.assertRaises(TypeError):
            liod.read_log(12)

    def test_the_channels_are_chosen_by_their_prefix(self):
        self.assertEqual(list(liod.read_log(self.log, "OTHER_")), [])


class Outputs(package.Case):
    """A log with liod's own messages, as lcm-logger records it."""

    def test_estimates_of_a_log_have_their_channel(self):
        folder = support.made_once("python-outputs", lambda path: support.run_well(
            "lio_view_log", path / "log.lcm", "3", "100"))
        events = [e for e in liod.read_log(folder / "log.lcm") if isinstance(e, liod.Estimate)]
        channels = {e.channel for e in events}
        self.assertIn("LIO_ODOM", channels)
        for estimate in (e for e in events if e.channel == "LIO_ODOM"):
            self.assertEqual(estimate.covariance.shape, (6, 6))
            np.testing.assert_allclose(estimate.pose[:3, 3], estimate.position)
            self.assertIsInstance(estimate.status, liod.Status)
            self.assertIsNone(estimate.gyro_bias)
            self.assertIsNone(estimate.match)
        for state in (e for e in events if e.channel == "LIO_STATE"):
            self.assertIsNone(state.status)
            self.assertIsNone(state.map_pose)
            self.assertEqual(state.gyro_bias.shape, (3,))


if __name__ == "__main__":
    support.main()
