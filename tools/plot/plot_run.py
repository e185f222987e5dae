#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Draws a run without truth: path.png and, if there is a map.pcd, map.png beside its files."""
import argparse
import pathlib

import plot_style as style
import point_cloud
from plot_style import np, plt
from plot_trajectory import bounds, draw_cloud


def draw(path_xy, points, title, is_map, file):
    low, high = bounds([path_xy], 25.0 if is_map else 5.0)
    width, height = 9 * (high - low) / max(high - low)
    figure, axes = plt.subplots(figsize=(width + 1.5, height + 1.2), layout="constrained")
    if points is not None:
        draw_cloud(axes, points, low, high, colour_by_height=is_map)
    if is_map:
        axes.set_facecolor("#14171c")
        axes.grid(False)
    axes.plot(*path_xy.T, color=style.ESTIMATE, label="estimate", zorder=4)
    axes.plot(*path_xy[0], "o", color=style.ESTIMATE, label="start", zorder=5)
    axes.plot(*path_xy[-1], "s", color=style.ESTIMATE, markerfacecolor="none", markersize=9,
              label="end", zorder=5)
    axes.set_aspect("equal")
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.set_title(title)
    axes.legend(loc="upper right", labelcolor="white" if is_map else None)
    style.save(figure, file)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="as liod --out or lio-replay --out wrote it",
                        type=pathlib.Path)
    folder = parser.parse_args().folder
    try:
        path_xy = np.loadtxt(folder / "trajectory.tum", ndmin=2)[:, 1:3]
        points = None
        if (folder / "map.pcd").exists():
            points = point_cloud.read_xyz(folder / "map.pcd")
    except (OSError, ValueError, IndexError, point_cloud.BadCloud) as error:
        style.fail(style.EXIT_UNUSABLE_INPUT, f"{folder}: {error}")
    draw(path_xy, points, "Estimated path from above", False, folder / "path.png")
    if points is not None:
        draw(path_xy, points, "Map from above, with the path", True, folder / "map.png")


if __name__ == "__main__":
    main()
