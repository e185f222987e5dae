#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests that no output of any program replaces what the program reads, given or found by default:
it ends with 2, says so in a line, and leaves every file as it was."""
import shutil
import unittest

import support

USAGE = 2


def contents(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class KeptInputs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.drive = support.simulated("street", "--duration", "3", "--lidar", "vlp16")

    def setUp(self):
        self.folder = support.WORK / "kept-inputs"
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self.drive, self.folder / "sim")
        texts = {
            "sequences/07/times.txt": "0.0\n0.1\n", "sequences/07/calib.txt": "Tr: 1\n",
            "sequences/07/velodyne/000000.bin": "x", "poses/07.txt": "1 0 0 0 0 1 0 0 0 0 1 0\n",
            "day/calib_imu_to_velo.txt": "R: 1\n", "day/drive/velodyne_points/timestamps.txt": "x",
            "bags/part_0.bag": "#ROSBAG V2.0\n", "drive.pcap": "\u00d4\u00c3\u00b2\u00a1",
            "drive.imu.lcm": "samples", "drive.json": "{}", "sensor.json": "{}", "imu.csv": "0",
            "run/trajectory.tum": "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n", "run/options.yaml": "{}\n",
            "run/covariance.csv": "t_s\n", "run/map.pcd": "# .PCD", "run/rig_draft.yaml": "{}\n",
            "run/segment_2/registration.csv": "t_s\n", "run/segment_2/rig.yaml": "{}\n",
            "maps/map.ply": "ply\n"}
        for name, text in texts.items():
            path = self.folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(text.encode("latin-1"))

    def check(self, program, *words, max_lines=1):
        before = contents(self.folder)
        done = support.run(program, *words, cwd=self.folder)
        self.assertEqual(done.returncode, USAGE, done.stderr)
        self.assertEqual(done.stderr.count("is input, name another file to write\n"), 1,
                         done.stderr)
        self.assertLessEqual(len(done.stderr.splitlines()), max_lines, done.stderr)
        self.assertTrue(contents(self.folder) == before, "files were changed")

    def check_all(self, program, *cases, **kwargs):
        for words in cases:
            with self.subTest(program=program, words=words):
                self.check(program, *words.split(), **kwargs)

    def test_lio_convert(self):
        self.check_all(
            "lio-convert",
            "kitti-odometry sequences/07 o.lcm --truth poses/07.txt",
            "kitti-odometry sequences/07/ poses/07.txt",
            "kitti-odometry sequences/07 o.lcm --truth sequences/07/times.txt",
            "kitti-odometry sequences/07 o.lcm --truth imu.csv --poses imu.csv",
            "kitti-raw day/drive o.lcm --rig day/calib_imu_to_velo.txt",
            "kitti-raw day/drive/ o.lcm --truth day/calib_imu_to_velo.txt",
            "rosbag bags bags/part_0.bag", "rosbag bags/part_0.bag o.lcm --truth bags/part_0.bag",
            "pcap drive.pcap drive.pcap", "pcap drive.pcap drive.imu.lcm",
            "pcap drive.pcap drive.json", "pcap drive.pcap imu.csv --imu imu.csv",
            "pcap drive.pcap sensor.json --metadata sensor.json")

    def test_lio_sim(self):
        self.check_all(
            "lio-sim",
            "--scenario street --scans sim/log.lcm --out sim",
            "--scenario street --scans sim/log.lcm --picture sim/log.lcm",
            "--scenario street --lidar sim/config.yaml --out sim",
            "--scenario street --imu imu.csv --picture imu.csv")

    def test_lio_log(self):
        with_log = "sim/log.lcm --config sim/config.yaml"
        self.check_all(
            "lio-log",
            f"calibrate {with_log} --json sim/log.lcm", f"calibrate {with_log} --rig sim/log.lcm",
            f"calibrate {with_log} --json sim/config.yaml",
            f"calibrate {with_log} --rig sim/config.yaml",
            f"doctor {with_log} --json sim/config.yaml",
            f"doctor {with_log} --write-rig sim/config.yaml",
            "export sim/log.lcm --mcap sim/log.lcm", "export sim/log.lcm --tum sim/../sim/log.lcm")

    def test_lio_replay(self):
        log = "--config sim/config.yaml sim/log.lcm"
        self.check_all(
            "lio-replay",
            f"{log} --initial-map run/map.pcd --out run --overwrite",
            f"{log} --initial-map maps/map.ply --out maps",
            f"{log} --config run/options.yaml --out run --overwrite",
            f"{log} --config run/segment_2/rig.yaml --out run --overwrite")

    def test_liod(self):
        cases = ("--config sim/config.yaml --initial-map run/map.pcd --out run --overwrite",
                 "--config sim/config.yaml --config run/options.yaml --out run --overwrite")
        self.check_all("liod", *cases)
        # It tells all faults: the map is damaged besides.
        self.check_all("liod", *(f"--check {words}" for words in cases), max_lines=2)

    def test_lio_run(self):
        self.check_all(
            "lio-run",
            "sim/log.lcm --config run/options.yaml --out run --overwrite",
            "sim/log.lcm --rig run/options.yaml --out run --overwrite",
            "sim/log.lcm --config run/rig_draft.yaml --out run --overwrite",
            "sequences/07 --truth run/trajectory.tum --out run --overwrite")

    def test_lio_eval(self):
        shutil.copy(self.folder / "sim/truth.tum", self.folder / "run/truth.tum")
        self.check_all(
            "lio-eval",
            "sim/truth.tum run --json sim/truth.tum", "sim/truth.tum run --csv sim/truth.tum",
            "sim/truth.tum run --plot sim/truth.tum",
            "sim/truth.tum run --plot run/trajectory.tum",
            "sim/truth.tum run --json run/trajectory.tum",
            "sim/truth.tum run --map run/map.pcd --plot run/map.pcd",
            "consistency sim/truth.tum run --json sim/truth.tum",
            "consistency sim/truth.tum run --plot sim/truth.tum",
            "consistency truth.tum run --json run/truth.tum",
            "consistency sim/truth.tum run --plot run/covariance.csv",
            "consistency sim/truth.tum run --json run/trajectory.tum")


if __name__ == "__main__":
    support.main()
