# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Recordings to logs."""
import os
from typing import Optional, Union

from . import _liod
from ._liod import Conversion

Path = Union[str, "os.PathLike[str]"]

__all__ = ["Conversion", "convert"]


def convert(recording: Path, log: Path, *, kind: Optional[str] = None,
            truth: Optional[Path] = None, lidar_topic: Optional[str] = None,
            imu_topic: Optional[str] = None, truth_topic: Optional[str] = None,
            lidar: Optional[str] = None, point_time: Optional[str] = None,
            stamp: Optional[str] = None, start_s: Optional[float] = None,
            duration_s: Optional[float] = None, whole_scans: Optional[bool] = None,
            sensor: Optional[str] = None, imu: Optional[Path] = None,
            metadata: Optional[Path] = None, rig: Optional[Path] = None,
            imu_rate_hz: Optional[float] = None, poses: Optional[Path] = None,
            vertical_correction_deg: Optional[float] = None) -> Conversion:
    """Converts a recording to an LCM log, as lio-convert does.

    kind: rosbag, pcap, kitti-raw or kitti-odometry; found by the content where it is not given.
    rosbag: truth, truth_topic, lidar_topic, imu_topic, lidar, point_time, stamp, start_s,
        duration_s, whole_scans.
    pcap: sensor, imu, metadata, whole_scans.
    kitti-raw: truth, rig, imu_rate_hz.
    kitti-odometry: truth, poses, vertical_correction_deg.

    Raises UsageError for an option that the kind does not have and for an ambiguous topic,
    InputError for what is no recording, OutputError for a file that cannot be written. A damaged
    recording is converted as far as it can be read: the result's is_damaged says so.
    """
    options = {
        "truth": truth, "truth_topic": truth_topic, "lidar_topic": lidar_topic,
        "imu_topic": imu_topic, "lidar": lidar, "point_time": point_time, "stamp": stamp,
        "start_s": start_s, "duration_s": duration_s, "whole_scans": whole_scans,
        "sensor": sensor, "imu": imu, "metadata": metadata, "rig": rig,
        "imu_rate_hz": imu_rate_hz, "poses": poses,
        "vertical_correction_deg": vertical_correction_deg,
    }
    return _liod.convert(recording, log, kind, options)
