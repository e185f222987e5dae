#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests that liod.convert gives the bytes and the words of lio-convert."""
import _thread
import pathlib
import shutil
import threading

import package
import support

liod = package.load()

WORK = support.WORK / "python-convert"


class Convert(package.Case):
    def setUp(self):
        WORK.mkdir(parents=True, exist_ok=True)

    def check_like_program(self, kind, recording, words, **options):
        """Both give the same log, the same truth and the same summary."""
        by_program, by_call = WORK / "program.lcm", WORK / "call.lcm"
        truths = WORK / "program.tum", WORK / "call.tum"
        text = support.run_well("lio-convert", kind, recording, by_program, "--truth", truths[0],
                                *words)
        done = liod.convert(recording, by_call, truth=truths[1], **options)
        self.assertEqual(done.kind, kind)
        self.assertFalse(done.is_damaged)
        self.assertEqual(by_program.read_bytes(), by_call.read_bytes())
        self.assertEqual(truths[0].read_bytes(), truths[1].read_bytes())
        self.assertEqual(text.replace("program.", "call."), done.summary)
        self.assertTrue(any(isinstance(e, liod.Scan) for e in liod.read_log(by_call)))

    def test_a_bag_is_converted_as_by_the_program(self):
        self.check_like_program("rosbag", support.unpacked_bag("ulhk_sample"),
                                ("--duration", "2", "--lidar", "hdl32e"),
                                duration_s=2, lidar="hdl32e")

    def test_a_drive_of_kitti_is_converted_as_by_the_program(self):
        self.check_like_program("kitti-raw", support.kitti_drive(), ("--imu-rate", "100"),
                                imu_rate_hz=100)

    def test_a_damaged_bag_is_converted_as_far_as_it_goes(self):
        bag = WORK / "cut.bag"
        data = support.unpacked_bag("ulhk_sample").read_bytes()
        bag.write_bytes(data[:len(data) // 2])
        done = liod.convert(bag, WORK / "cut.lcm", lidar="hdl32e")
        self.assertTrue(done.is_damaged)
        self.assertIn("damage", done.summary)

    def test_an_interrupt_ends_a_conversion(self):
        bag = support.unpacked_bag("ulhk_sample")
        timer = threading.Timer(0.02, _thread.interrupt_main)
        timer.start()
        num_whole = 0
        with self.assertRaises(KeyboardInterrupt):
            while True:
                liod.convert(bag, WORK / "interrupted.lcm", lidar="hdl32e")
                num_whole += 1
        self.assertLessEqual(num_whole, 1)

    def test_a_wish_of_another_kind_is_refused(self):
        bag = WORK / "head.bag"
        bag.write_bytes(b"#ROSBAG V2.0\n")
        out = WORK / "never.lcm"
        out.unlink(missing_ok=True)
        for words, options in ((["imu_rate_hz", "rosbag"], {"imu_rate_hz": 100}),
                               (["point_time", "auto, s, ms"], {"point_time": "min"}),
                               (["stamp", "start, end"], {"stamp": "middle"}),
                               (["start_s"], {"start_s": -1}),
                               (["duration_s"], {"duration_s": float("nan")}),
                               (["truth_topic", "truth"], {"truth_topic": "/truth"}),
                               (["kind", "kitti-raw"], {"kind": "kitti"})):
            with self.subTest(options):
                self.check_error(liod.UsageError, words, liod.convert, bag, out, **options)
        for options in ({"start_s": "x"}, {"lidar": 3}, {"truth": 3}, {"whole_scans": "x"}):
            with self.subTest(options):
                self.check_error(TypeError, [next(iter(options))], liod.convert, bag, out,
                                 **options)
        self.assertFalse(out.exists())

    def test_what_is_no_recording_is_named(self):
        out = WORK / "never.lcm"
        self.check_error(liod.InputError, ["/no/such.bag", "exist"], liod.convert, "/no/such.bag",
                         out)
        self.check_error(liod.InputError, [str(self.log)], liod.convert, self.log, out)
        self.check_error(liod.InputError, ["/etc/passwd", "ROS bag"], liod.convert, "/etc/passwd",
                         out)

    def test_the_recording_is_not_overwritten(self):
        bag = WORK / "own.bag"
        bag.write_bytes(b"#ROSBAG V2.0\n")
        self.check_error(liod.UsageError, [str(bag)], liod.convert, bag, bag)
        self.assertEqual(bag.read_bytes(), b"#ROSBAG V2.0\n")

    def test_what_cannot_be_written_is_named(self):
        bag = WORK / "whole.bag"
        shutil.copy(support.unpacked_bag("ulhk_sample"), bag)
        with self.assertRaises(liod.Error) as caught:
            liod.convert(bag, pathlib.Path("/no/such/folder/out.lcm"), lidar="hdl32e")
        self.assertIn("/no/such/folder/out.lcm", str(caught.exception))


if __name__ == "__main__":
    support.main()
