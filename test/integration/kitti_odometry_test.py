#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Rearranges KITTI raw drive 0005 as an odometry sequence, because no real one is available: scans
compensated for the motion, times from 0 on, poses of the camera. The converter must turn these into
the lidar's poses, and lidar-only odometry must follow them."""
import datetime
import unittest

import numpy as np

import support

SWEEP_S = 0.1033


def stamps(file):
    """Returns the seconds since the file's first midnight."""
    rows = []
    for line in file.read_text().splitlines():
        whole, fraction = line.split(".")
        time = datetime.datetime.fromisoformat(whole)
        rows.append(time.hour * 3600 + time.minute * 60 + time.second + float("0." + fraction))
    return np.array(rows)


def calibration(file):
    """Reads the pose of a calibration file with rows R and T: p_target = pose @ p_source."""
    rows = dict(line.split(":", 1) for line in file.read_text().splitlines() if ":" in line)
    pose = np.eye(4)
    pose[:3, :3] = np.array(rows["R"].split(), float).reshape(3, 3)
    pose[:3, 3] = np.array(rows["T"].split(), float)
    return pose


def rotation(roll, pitch, yaw):
    (cr, cp, cy), (sr, sp, sy) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    return (np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
            @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
            @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]]))


def imu_poses(times, packets, at):
    """Returns the IMU's poses in the world at instants `at`; positions are integrated velocity."""
    velocity = packets[:, [7, 6, 10]]
    steps = np.diff(times)[:, None] * (velocity[1:] + velocity[:-1]) / 2
    position = np.vstack([np.zeros(3), np.cumsum(steps, axis=0)])
    angles = np.unwrap(packets[:, 3:6], axis=0)
    poses = []
    for t in at:
        pose = np.eye(4)
        pose[:3, :3] = rotation(*(np.interp(t, times, angles[:, i]) for i in range(3)))
        pose[:3, 3] = [np.interp(t, times, position[:, i]) for i in range(3)]
        poses.append(pose)
    return poses


def compensated(points, velocity, rate):
    """Moves points to the lidar's pose at the instant it faces forward; both are in its frame."""
    since_s = -np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi) * SWEEP_S
    moved = points.copy()
    moved[:, :3] += since_s[:, None] * (np.cross(rate, points[:, :3]) + velocity)
    return moved


def row(pose):
    return " ".join(f"{value:.9e}" for value in pose[:3].ravel()) + "\n"


def lay_out(drive, folder):
    day = drive.parent
    T_lidar_imu = calibration(day / "calib_imu_to_velo.txt")
    T_camera_lidar = calibration(day / "calib_velo_to_cam.txt")
    scan_times = stamps(drive / "velodyne_points/timestamps.txt")
    packets = np.array([np.loadtxt(f) for f in sorted((drive / "oxts/data").glob("*.txt"))])
    times = stamps(drive / "oxts/timestamps.txt")[:len(packets)]
    T_world_lidar = [pose @ np.linalg.inv(T_lidar_imu)
                     for pose in imu_poses(times, packets, scan_times)]
    sequence = folder / "sequences/50"
    (sequence / "velodyne").mkdir(parents=True)
    (folder / "poses").mkdir()
    for k, file in enumerate(sorted((drive / "velodyne_points/data").glob("*.bin"))):
        at = [np.interp(scan_times[k], times, packets[:, i]) for i in (8, 9, 10, 17, 18, 19)]
        turn = T_lidar_imu[:3, :3]
        rate = turn @ at[3:]
        velocity = turn @ at[:3] - np.cross(rate, T_lidar_imu[:3, 3])
        points = np.fromfile(file, np.float32).reshape(-1, 4)
        compensated(points, velocity, rate).tofile(sequence / f"velodyne/{k:06}.bin")
    (sequence / "times.txt").write_text("".join(f"{t - scan_times[0]:e}\n" for t in scan_times))
    (sequence / "calib.txt").write_text("P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: " + row(T_camera_lidar))
    T_lidar0_world = np.linalg.inv(T_world_lidar[0])
    lidar = [T_lidar0_world @ pose for pose in T_world_lidar]
    back = np.linalg.inv(T_camera_lidar)
    (folder / "poses/50.txt").write_text("".join(row(T_camera_lidar @ p @ back) for p in lidar))
    np.savetxt(folder / "lidar.txt", [p[:3, 3] for p in lidar])


class KittiOdometry(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        drive = support.kitti_drive()
        cls.folder = support.made_once("kitti-odometry", lambda path: lay_out(drive, path))
        cls.sequence = cls.folder / "sequences/50"

    def convert(self, name, *words):
        log, truth = self.folder / f"{name}.lcm", self.folder / f"{name}.tum"
        said = support.run_well("lio-convert", "kitti-odometry", self.sequence, log, "--truth",
                                truth, *words)
        return log, truth, said

    def test_poses_become_the_lidars(self):
        _, truth, said = self.convert("poses")
        self.assertIn("80 sweeps", said)
        rows = np.loadtxt(truth)
        np.testing.assert_allclose(rows[:, 1:4], np.loadtxt(self.folder / "lidar.txt"), atol=2e-5)
        times = np.loadtxt(self.sequence / "times.txt")
        np.testing.assert_allclose(rows[:, 0], times, atol=1e-6)
        self.assertGreater(rows[-1, 1], 25)  # forward is the lidar's x, not the camera's z

    def test_lidar_only_odometry_follows_with_and_without_the_vertical_correction(self):
        for degrees in ("0", "0.205"):
            with self.subTest(degrees):
                log, truth, said = self.convert(f"by-{degrees}", "--vertical-correction", degrees)
                self.assertIn(f"raised by {degrees} deg", said)
                run = support.replay(log, f"kitti-odometry-{degrees}", "--config",
                                     support.SOURCE / "config/kitti_odometry.yaml")
                figures = support.evaluate(truth, run)
                ape_m = figures["ape"]["position_m"]["rmse"]
                print(f"vertical correction {degrees} deg: APE {ape_m:.3f} m over 31 m")
                self.assertLessEqual(ape_m, 0.15)
                self.assertEqual(support.stats(run)["num_scans_dropped"], 0)
                self.assertEqual(support.stats(run)["num_scans"], 80)


if __name__ == "__main__":
    support.main()
