# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""The faults of reliability.py: each is a fault of lio-sim, from START_S of the drive on."""
import dataclasses

START_S = 20.0
FOREVER_S = 1000.0


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    faults: tuple
    end_s: float  # when the fault is over, or the time of its only event
    is_live: bool = False
    shifts_stamps: bool = False  # rows are found by their scan's number
    is_cast_anew: bool = False   # the rays themselves change


def timed(kind, duration_s, extra=""):
    return f"{kind}:{extra}start={START_S:g},duration={duration_s:g}"


def simple(kind, duration_s, extra="", **more):
    return Case(kind, (timed(kind, duration_s, extra),), START_S + duration_s, **more)


def outages():
    for duration_s in (1.0, 5.0, 30.0):
        for name, kinds in (("IMU", ("imu_gap",)), ("lidar", ("lidar_gap",)),
                            ("both", ("imu_gap", "lidar_gap"))):
            yield Case(f"{name} silent for {duration_s:g} s",
                       tuple(timed(kind, duration_s) for kind in kinds), START_S + duration_s,
                       is_live=duration_s == 5.0)


def clocks():
    whose = {"both": "both clocks", "lidar": "lidar's clock", "imu": "IMU's clock"}
    for channel, offset_s, duration_s in (
            ("both", 1.5, 15.0), ("both", 1.5, FOREVER_S), ("both", -1.5, FOREVER_S),
            ("both", 5.0, FOREVER_S), ("both", -5.0, FOREVER_S), ("both", 3600.0, FOREVER_S),
            ("both", -3600.0, FOREVER_S), ("lidar", 0.2, 1.0), ("lidar", -0.2, 1.0),
            ("lidar", 1.5, FOREVER_S), ("lidar", -1.5, FOREVER_S), ("imu", 0.5, FOREVER_S),
            ("imu", -0.5, FOREVER_S)):
        lasts = "" if duration_s == FOREVER_S else f" for {duration_s:g} s"
        yield Case(f"{whose[channel]} set by {offset_s:+g} s{lasts}",
                   (timed("stamp_jump", duration_s, f"channel={channel},offset={offset_s:g},"),),
                   START_S + (0.0 if duration_s == FOREVER_S else duration_s),
                   is_live=(channel, offset_s) in (("both", -5.0), ("both", -3600.0),
                                                   ("lidar", -0.2)),
                   shifts_stamps=True)


def others():
    yield Case("none", (), START_S, is_live=True)
    for kind in ("drop", "duplicate", "reorder", "chunk_loss", "nan"):
        yield simple(kind, 20.0, "ratio=0.05,", is_live=kind in ("drop", "chunk_loss"))
    yield Case("clock_offset", ("clock_offset:channel=lidar,offset=0.02",), START_S)
    yield Case("stamps a sweep behind", ("clock_offset:channel=lidar,offset=-0.1",), START_S)
    yield simple("gyro_saturation", 5.0, "limit=0.2,")
    yield simple("shaking", 10.0)
    for name, keys in (("gyro dead", ""), ("accelerometer dead", "gyro=0,accel=1,"),
                       ("IMU dead", "accel=1,")):
        yield Case(name, (timed("imu_dead", 10.0, keys),), START_S, is_live=not keys)
    yield Case("gyro 0.05 rad/s off", (timed("imu_offset", 10.0),), START_S)
    yield Case("accelerometer 0.5 m/s^2 off",
               (timed("imu_offset", 10.0, "gyro=0,accel=0.5,"),), START_S)
    yield simple("empty_scan", 1.0)
    yield simple("sparse_scan", 1.0)
    yield simple("dust", 5.0, is_cast_anew=True)
    yield Case("wrong_extrinsic", ("wrong_extrinsic:yaw_deg=3",), START_S)


def all_cases():
    return [*others(), *outages(), *clocks()]


# One of each kind that a change of the estimator could break, in a minute.
BRIEF = ("none", "drop", "chunk_loss", "nan", "gyro_saturation", "gyro dead",
         "accelerometer dead", "empty_scan",
         "IMU silent for 5 s", "lidar silent for 5 s", "both silent for 5 s",
         "both clocks set by -3600 s", "lidar's clock set by -0.2 s for 1 s")

# Cases that break a bar and may: (case, drive or None for any) -> the reason.
KNOWN = {
    ("wrong_extrinsic", None): "the truth is laid on the first row, whose heading is off as the "
                               "rig is",
    ("stamps a sweep behind", "street"): "the first 10 s, before the offset was known, have bent the "
                                         "map",
}


def why_known(case, scenario):
    return KNOWN.get((case, scenario)) or KNOWN.get((case, None))
