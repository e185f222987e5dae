# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Scores one run of reliability.py against the truth.

Errors are those of `lio-eval consistency --world`: the truth is turned about z and shifted until it
meets the first row, and nothing more.
"""
import csv
import dataclasses

import numpy as np

OK, LOST = 1, 4
# A row is wrong when its error is this improbable (chi square of 6 dimensions: one in 10 million)
# and one that somebody could notice.
MAX_NEES_PER_DOF = 45.0 / 6.0
MIN_NOTICED_M = 0.1
SETTLED_S = 5.0           # the last part of a run, in which it has recovered or not
MAX_SETTLED_DRIFT_M = 0.3  # over that part


@dataclasses.dataclass
class Rows:
    stamp_s: np.ndarray
    scan_seq: np.ndarray
    status: np.ndarray
    position_m: np.ndarray
    quaternion: np.ndarray  # x y z w
    covariance: np.ndarray  # 6 x 6 each


def table(path):
    with open(path, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def rows_of(folder):
    """Rows of one folder; only scans with a pose."""
    matches = table(folder / "registration.csv")
    match_s = np.array([float(row["t_s"]) for row in matches])
    poses = [line.split() for line in (folder / "trajectory_world.tum").read_text().splitlines()]
    covariances = {row["t_s"]: list(row.values())[1:37]
                   for row in table(folder / "covariance_world.csv")}
    status = {row["t_s"]: int(row["status"]) for row in table(folder / "states.csv")}

    # After an outage the state is some microseconds younger than the scan.
    def seq_at(t):
        return int(matches[int(np.argmin(np.abs(match_s - float(t))))]["scan_seq"])
    return [(int(t.replace(".", "")), seq_at(t), status[t], [float(v) for v in pose],
             [float(v) for v in covariances[t]]) for t, *pose in poses]


def read(run):
    """All rows in the order of their scans; those of a segment stand for those of the whole."""
    # A sweep that a clock step tears in two has two rows.
    by_scan = {}
    for folder in [run, *sorted(run.glob("segment_*"), key=lambda p: int(p.name[8:]))]:
        for row in rows_of(folder):
            by_scan[row[1], row[0]] = row
    rows = [by_scan[key] for key in sorted(by_scan)]
    pose = np.array([row[3] for row in rows])
    return Rows(np.array([row[0] for row in rows]) * 1e-9, np.array([row[1] for row in rows]),
                np.array([row[2] for row in rows]), pose[:, :3], pose[:, 3:],
                np.array([row[4] for row in rows]).reshape(-1, 6, 6))


def rotation(q):
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def log(matrix):
    cosine = np.clip((np.trace(matrix) - 1) / 2, -1, 1)
    angle = np.arccos(cosine)
    axis = np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0],
                     matrix[1, 0] - matrix[0, 1]]) / 2
    return axis * (angle / np.sin(angle) if 1e-9 < angle < np.pi - 1e-6 else 1.0)


def truth_at(path, times_s):
    """Position and rotation of the IMU at each time; the file's rate is far above the scans'."""
    data = np.loadtxt(path)
    position = np.stack([np.interp(times_s, data[:, 0], data[:, i]) for i in (1, 2, 3)], axis=1)
    right = np.clip(np.searchsorted(data[:, 0], times_s), 1, len(data) - 1)
    share = (times_s - data[right - 1, 0]) / (data[right, 0] - data[right - 1, 0])
    rotations = []
    for i, part in zip(right, np.clip(share, 0, 1)):
        before, after = data[i - 1, 4:8], data[i, 4:8]
        q = before * (1 - part) + after * part * np.sign(before @ after)
        rotations.append(rotation(q / np.linalg.norm(q)))
    return position, rotations


def errors(rows, position, rotations):
    """Six errors a row: position in world, rotation in the body."""
    first = rotation(rows.quaternion[0]) @ rotations[0].T
    yaw = np.arctan2(first[1, 0] - first[0, 1], first[0, 0] + first[1, 1])
    turn = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
    result = []
    for i, q in enumerate(rows.quaternion):
        true = turn @ (position[i] - position[0]) + rows.position_m[0]
        result.append(np.concatenate([true - rows.position_m[i],
                                      log(rotation(q).T @ turn @ rotations[i])]))
    return np.array(result)


def longest_s(times_s, wrong):
    """The longest time in which every row is wrong."""
    longest, begin = 0.0, None
    for time_s, is_wrong in zip(times_s, wrong):
        begin = (time_s if begin is None else begin) if is_wrong else None
        if begin is not None:
            longest = max(longest, time_s - begin)
    return longest


def score(run, truth, case, begin_s, true_end_s):
    """`true_end_s` has the true end of each scan, by its number; `begin_s` is the log's begin."""
    rows = read(run)
    times = rows.stamp_s.copy()
    if case.shifts_stamps:
        times = np.array([true_end_s.get(seq, time)
                          for seq, time in zip(rows.scan_seq, rows.stamp_s)])
    position, rotations = truth_at(truth, times)
    error = errors(rows, position, rotations)
    regular = rows.covariance[1:] + 1e-12 * np.eye(6)
    nees = np.einsum("ni,ni->n", error[1:], np.linalg.solve(regular, error[1:, :, None])[..., 0])
    nees = np.concatenate([[0.0], nees]) / 6.0
    distance = np.linalg.norm(error[:, :3], axis=1)
    wrong = (rows.status == OK) & (nees > MAX_NEES_PER_DOF) & (distance > MIN_NOTICED_M)
    after = times - begin_s > case.end_s
    judged = after & (rows.status != LOST)
    settled = times > times[-1] - SETTLED_S
    drift = np.linalg.norm((error[settled, :3] - error[settled][0, :3])[-1])
    return {"wrong_ok_s": longest_s(times, wrong),
            "anees_after": float(np.mean(nees[judged])) if judged.any() else None,
            "lost_s": 0.1 * int(np.count_nonzero(rows.status == LOST)),
            "end_m": float(distance[-1]),
            "drift_m": float(drift),
            "is_tracking": bool(drift < MAX_SETTLED_DRIFT_M and rows.status[-1] != LOST),
            "num_rows": len(times)}
