#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Draws close-ups of surfaces that a drive sees at its begin and again at its end, where it closes
a loop: they are single when the estimate closes it, and doubled by the drift when it does not.

    wall_closeup.py DRIVE RUN OUT.png

DRIVE is a fleet's folder of a simulated drive (log.lcm, truth.tum, rig.yaml), and RUN that of its
run. Every point is transformed with the pose of its own instant, once the truth's and once
the estimate's; the two worlds are aligned at the first pose. For each direction (along the path,
across it, up) the flattest patch that both passes see is drawn edge-on, with stretched heights.
"""
import argparse
import pathlib
import re
import struct
import sys

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "plot"))
import plot_style as style  # noqa: E402
from plot_style import plt  # noqa: E402

NEAR_M = 15.0  # points are taken from poses this near the start
RANGE_M = 30.0
STEP_M = 0.3  # between scans that are taken: at rest all would show the same points
CELL_M = 2.5  # size of a patch
MIN_POINTS = 250  # per pass
FLAT_M = 0.05  # a patch with more scatter than this is not flat
HALF_VIEW_M = 0.15
SYNC = 0xEDA1DA01
POINT = np.dtype([("xyz", "<f4", 3), ("t_ns", "<u4"), ("intensity", "<u2"), ("ring", "<u2")])
DIRECTIONS = ("along the path", "across the path", "up")


def chunks(path):
    """Yields (scan number, stamp in s, points) of each LIO_SCAN event of an LCM log.

    LCM's own numbers are big-endian; the packed points are little-endian.
    """
    with open(path, "rb") as stream:
        while len(head := stream.read(28)) == 28:
            sync, _, _, name_size, size = struct.unpack(">IqqII", head)
            if sync != SYNC:
                raise ValueError(f"{path}: damaged at byte {stream.tell() - 28}")
            name = stream.read(name_size)
            if name != b"LIO_SCAN":
                stream.seek(size, 1)
                continue
            data = stream.read(size)
            utime, _, seq, _, _, _, _, step, num, num_bytes = struct.unpack_from(
                ">qqihhbbhii", data, 8)
            if step != POINT.itemsize:
                raise ValueError(f"{path}: points of {step} bytes")
            yield seq, 1e-6 * utime, np.frombuffer(data, POINT, num, len(data) - num_bytes)


def rotations(q):
    """Returns the rotation matrices of unit quaternions x y z w."""
    x, y, z, w = q.T
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
                     2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                     2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
                    axis=-1).reshape(-1, 3, 3)


class Path:
    """Interpolates poses of imu linearly between rows (rotation: normalised quaternions)."""

    def __init__(self, path):
        rows = np.loadtxt(path)
        self.t, self.p, q = rows[:, 0], rows[:, 1:4], rows[:, 4:8]
        flips = np.cumprod(np.where(np.sum(q[1:] * q[:-1], axis=1) < 0, -1, 1))
        self.q = q * np.concatenate([[1], flips])[:, None]

    def at(self, t):
        p = np.column_stack([np.interp(t, self.t, column) for column in self.p.T])
        q = np.column_stack([np.interp(t, self.t, column) for column in self.q.T])
        return rotations(q / np.linalg.norm(q, axis=1, keepdims=True)), p

    def carry(self, points_imu, t):
        R, p = self.at(t)
        return np.einsum("nij,nj->ni", R, points_imu) + p


def numbers_of(config, key):
    """Returns the list of a key of the rig, or None if there is none."""
    found = re.search(rf"^ *{key}: \[(.*)\]", config, re.MULTILINE)
    return np.array([float(word) for word in found[1].split(",")]) if found else None


def meet(estimate, truth):
    """Turns the estimate about z and shifts it until it has the truth's pose at its first row."""
    (R_est, p_est), (R_true, p_true) = estimate.at(estimate.t[:1]), truth.at(estimate.t[:1])
    difference = R_true[0] @ R_est[0].T
    yaw = np.arctan2(difference[1, 0] - difference[0, 1], difference[0, 0] + difference[1, 1])
    c, s = np.cos(yaw), np.sin(yaw)
    R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    return R, p_true[0] - R @ p_est[0]


def collect(folder):
    """Returns the points in imu with their times and the pass to which they belong (0 or 1)."""
    truth = Path(folder / "truth.tum")
    config = (folder / "rig.yaml").read_text()
    w, x, y, z = numbers_of(config, "rotation_wxyz")
    R = rotations(np.array([[x, y, z, w]]))[0]
    lever = numbers_of(config, "translation_m")
    own_low, own_high = numbers_of(config, "min_m"), numbers_of(config, "max_m")
    middle = 0.5 * (truth.t[0] + truth.t[-1])
    parts = []
    last, scan = truth.p[0] + 2 * STEP_M, None
    for seq, stamp, raw in chunks(folder / "log.lcm"):
        here = truth.at(np.array([stamp]))[1][0]
        if seq != scan and np.linalg.norm(here - last) > STEP_M:
            last, scan = here, seq
        if seq != scan or np.linalg.norm(here - truth.p[0]) > NEAR_M:
            continue
        xyz = raw["xyz"].astype(float)
        distance = np.linalg.norm(xyz, axis=1)
        keep = np.isfinite(distance) & (distance > 3.0) & (distance < RANGE_M)
        if own_low is not None:
            keep &= ~((xyz > own_low) & (xyz < own_high)).all(axis=1)
        t = stamp + 1e-9 * raw["t_ns"][keep]
        parts.append(np.column_stack([xyz[keep] @ R.T + lever, t, t > middle]))
    table = np.vstack(parts)
    return truth, table[:, :3], table[:, 3], table[:, 4].astype(int)


def thin(order, limit):
    """Returns a bounded, evenly spread share of the indices."""
    return order[:: max(1, len(order) // limit)]


def patches(points, which, forward):
    """Returns per direction the flattest cell seen in both passes: (centre, normal, tangent)."""
    across = np.array([-forward[1], forward[0], 0.0])
    axes = np.array([forward, across, [0.0, 0.0, 1.0]])
    best = {}
    keys = np.floor(points / CELL_M).astype(int)
    order = np.lexsort(keys.T)
    splits = np.flatnonzero(np.any(np.diff(keys[order], axis=0), axis=1)) + 1
    for cell in np.split(order, splits):
        counts = np.bincount(which[cell], minlength=2)
        if counts.min() < MIN_POINTS:
            continue
        first = points[cell[which[cell] == 0]]
        values, vectors = np.linalg.eigh(np.cov(first.T))
        normal = vectors[:, 0]
        direction = int(np.argmax(np.abs(axes @ normal)))
        flatness = np.sqrt(values[0])
        if flatness > FLAT_M or np.sqrt(values[1]) < 0.3 or abs(axes[direction] @ normal) < 0.9:
            continue
        if direction not in best or flatness < best[direction][0]:
            best[direction] = (flatness, first.mean(axis=0), normal, vectors[:, 2])
    return best


def section(points, which, patch):
    """Returns the coordinates of a patch's points along and across it, for each pass."""
    _, centre, normal, tangent = patch
    offset = points - centre
    third = np.cross(normal, tangent)
    high, along = offset @ normal, offset @ tangent
    keep = ((np.abs(high) < HALF_VIEW_M) & (np.abs(along) < 0.5 * CELL_M)
            & (np.abs(offset @ third) < 0.5 * CELL_M))
    return [(along[keep & (which == i)], high[keep & (which == i)]) for i in (0, 1)]


def draw(axes, sections, title):
    colours = (style.SECOND, style.ESTIMATE)
    for (along, high), colour, label in zip(sections, colours, ("begin", "end")):
        some = thin(np.arange(len(high)), 1500)
        axes.plot(along[some], 100 * high[some], ".", color=colour, markersize=2.5, alpha=0.5,
                  markeredgewidth=0, label=f"at the {label}: ±{100 * high.std():.1f} cm")
        axes.axhline(100 * np.median(high), color=colour, linewidth=1.4)
    gap = np.median(sections[1][1]) - np.median(sections[0][1])
    axes.set_title(f"{title}: {100 * abs(gap):.1f} cm apart", fontsize=10)
    axes.set_ylim(-100 * HALF_VIEW_M, 100 * HALF_VIEW_M)
    axes.set_xlim(-0.5 * CELL_M, 0.5 * CELL_M)
    axes.legend(loc="upper right", fontsize=7, markerscale=4, frameon=True, edgecolor="none")
    return gap


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("drive", type=pathlib.Path)
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("picture")
    arguments = parser.parse_args()
    truth, points_imu, times, which = collect(arguments.drive)
    estimate = Path(arguments.run / "trajectory_imu_rate.tum")
    known = (times >= estimate.t[0]) & (times <= estimate.t[-1])
    points_imu, times, which = points_imu[known], times[known], which[known]
    by_truth = truth.carry(points_imu, times)
    R, shift = meet(estimate, truth)
    by_estimate = estimate.carry(points_imu, times) @ R.T + shift
    moved = truth.p[np.argmax(np.linalg.norm(truth.p - truth.p[0], axis=1) > 5.0)] - truth.p[0]
    forward = np.array([moved[0], moved[1], 0.0]) / np.hypot(moved[0], moved[1])
    found = patches(by_truth, which, forward)
    if not found:
        sys.exit(f"wall_closeup: {arguments.drive}: no flat patch is seen both at the begin and at "
                 "the end")
    figure, grid = plt.subplots(2, len(found), figsize=(4.2 * len(found), 5.6), squeeze=False,
                                layout="constrained", sharey=True)
    for column, direction in enumerate(sorted(found)):
        for row, (name, points) in enumerate((("truth", by_truth), ("liod", by_estimate))):
            gap = draw(grid[row][column], section(points, which, found[direction]), name)
            print(f"{DIRECTIONS[direction]}, {name}: {100 * gap:+.2f} cm")
        grid[1][column].set_xlabel(f"[m] along a surface that faces {DIRECTIONS[direction]}")
    for row in grid:
        row[0].set_ylabel("edge-on [cm]")
    style.save(figure, arguments.picture)


if __name__ == "__main__":
    main()
