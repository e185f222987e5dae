#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Draws one trajectory against the truth, from the data of lio-eval."""
import argparse
import os

import plot_style as style
import point_cloud
from plot_style import ListedColormap, np, plt

# The darkest third is left out, because it would vanish on the dark ground of the map picture.
HEIGHTS = ListedColormap(plt.get_cmap("viridis")(np.linspace(0.3, 1, 256)))
CELLS = 1000


def bounds(paths, margin):
    """Returns x and y limits around the paths; no side is less than a third of the longer one."""
    xy = np.vstack(paths)
    low, high = np.nanmin(xy, axis=0), np.nanmax(xy, axis=0)
    centre, half = (low + high) / 2, (high - low) / 2
    half = np.maximum(half, max(half.max() / 3, 1.0)) + margin
    return centre - half, centre + half


def draw_cloud(axes, points, low, high, colour_by_height):
    """Draws the points as a picture of CELLS cells along its longer side, each its highest point.

    A scatter plot of a million points takes ten seconds; this takes a tenth of one.
    """
    points = points[((points[:, :2] > low) & (points[:, :2] < high)).all(axis=1)]
    if not len(points):
        return None
    points = points[np.argsort(points[:, 2], kind="stable")]  # the last point to fill a cell stays
    cell = max(high - low) / CELLS
    column, row = ((points[:, :2] - low) / cell).astype(int).T
    heights = np.full((int(row.max()) + 1, int(column.max()) + 1), np.nan)
    heights[row, column] = points[:, 2]
    z_low, z_high = np.percentile(points[:, 2], [2, 98])
    colours = {"cmap": HEIGHTS, "vmin": z_low, "vmax": max(z_high, z_low + 0.1)}
    if not colour_by_height:
        colours = {"cmap": ListedColormap(["#d3d7de"])}
    top = low + cell * np.array(heights.shape[::-1])
    return axes.imshow(heights, origin="lower", extent=(low[0], top[0], low[1], top[1]),
                       interpolation="nearest", zorder=1, **colours)


def plan_axes(data):
    """Returns the axes seen from above: x and y; for KITTI's camera, which has y down, x and z."""
    return "xy" if data["has_time"] else "xz"


def plan(data, name):
    return np.column_stack([style.column(data["columns"], f"{name}_{a}") for a in plan_axes(data)])


def draw_paths(axes, data, margin, points=None, colour_by_height=False):
    truth, estimate = plan(data, "truth"), plan(data, "estimate")
    low, high = bounds([truth, estimate], margin)
    cloud = None
    if points is not None:
        cloud = draw_cloud(axes, points, low, high, colour_by_height)
    truth_colour = "white" if colour_by_height else style.TRUTH
    axes.plot(*truth.T, color=truth_colour, linewidth=3.2, alpha=0.9, zorder=3, label="truth")
    axes.plot(*estimate.T, color=style.ESTIMATE, linewidth=1.4, zorder=4, label="estimate")
    axes.plot(*estimate[0], "o", color=style.ESTIMATE, markersize=6, zorder=5, label="start")
    axes.plot(*estimate[-1], "s", color=style.ESTIMATE, markerfacecolor="none", markersize=9,
              markeredgewidth=1.6, zorder=5, label="end")
    axes.set_aspect("equal")
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_xlabel(f"{plan_axes(data)[0]} [m]")
    axes.set_ylabel(f"{plan_axes(data)[1]} [m]")
    return cloud


def summary_line(summary):
    ape = summary["ape"]["position_m"]
    drift = summary["drift"]["translation_percent"]
    words = [f"path {summary['path_length_m']:.0f} m",
             f"APE {ape['rmse']:.3f} m rmse, {ape['max']:.3f} m max "
             f"({summary['alignment']['mode']})"]
    if drift is not None:
        words.append(f"drift {drift:.2f} %")
    words.append(f"end error {summary['end']['error_m']:.2f} m")
    return "   ·   ".join(words)


def draw_error(axes, data, name, title, unit, colour):
    columns = data["columns"]
    values = style.column(columns, name)
    time = style.column(columns, "time")
    stats = data["summary"]["ape"][{"m": "position_m", "deg": "rotation_deg"}[unit]]
    axes.fill_between(time, 0, values, color=colour, alpha=0.18, linewidth=0)
    axes.plot(time, values, color=colour)
    axes.axhline(stats["rmse"], color=colour, linewidth=1, linestyle=(0, (4, 3)))
    axes.set_title(f"{title}: {stats['rmse']:.3g} {unit} rmse, {stats['max']:.3g} {unit} max")
    axes.set_ylim(0, max(np.nanmax(values) * 1.08, 1e-6))
    axes.margins(x=0)
    axes.set_ylabel(f"[{unit}]")


def draw_height(axes, columns):
    time = style.column(columns, "time")
    axes.plot(time, style.column(columns, "truth_height_m"), color=style.TRUTH, linewidth=2.6,
              label="truth")
    axes.plot(time, style.column(columns, "estimate_height_m"), color=style.ESTIMATE,
              label="estimate")
    axes.margins(x=0)
    axes.set_ylabel("z - z(start) [m]")
    axes.legend(loc="best", ncols=2)


def draw_time_series(rows, data):
    draw_error(rows[0], data, "position_error_m", "Position error", "m", style.ESTIMATE)
    draw_error(rows[1], data, "rotation_error_deg", "Rotation error", "deg", style.SECOND)
    draw_height(rows[2], data["columns"])
    rows[2].set_title(height_title(data["summary"]["z_drift"]))
    rows[-1].set_xlabel("time [s]" if data["has_time"] else "row")


def height_title(drift):
    if drift is None:
        return "z since the start (KITTI's own axes)"
    return f"Height since the start: off by {drift['end_m']:+.2f} m at the end"


def margin_of(data):
    return float(np.clip(0.12 * data["summary"]["path_length_m"], 3.0, 25.0))


def overview(data, points, path):
    figure = plt.figure(figsize=(14, 7.6), layout="constrained")
    grid = figure.add_gridspec(3, 2, width_ratios=[1.25, 1])
    axes = figure.add_subplot(grid[:, 0])
    draw_paths(axes, data, margin_of(data), points)
    axes.set_title("Path from above")
    axes.legend(loc="best", framealpha=0.85, frameon=True, edgecolor="none")
    rows = [figure.add_subplot(grid[i, 1]) for i in range(3)]
    draw_time_series(rows, data)
    figure.suptitle(summary_line(data["summary"]), fontsize=11)
    style.save(figure, path)


def fitted_figure(data, margin, extra_width):
    """Makes a figure whose height fits the path's shape."""
    low, high = bounds([plan(data, "truth"), plan(data, "estimate")], margin)
    width, height = high - low
    size = 9 * width / max(width, height), 9 * height / max(width, height)
    return plt.subplots(figsize=(size[0] + 0.9 + extra_width, size[1] + 1.2), layout="constrained")


def path_picture(data, points, path):
    figure, axes = fitted_figure(data, margin_of(data), 0)
    draw_paths(axes, data, margin_of(data), points)
    axes.set_title("Estimated and true path from above")
    axes.legend(loc="best", framealpha=0.85, frameon=True, edgecolor="none")
    figure.supxlabel(summary_line(data["summary"]), fontsize=9)
    style.save(figure, path)


def error_picture(data, path):
    figure, rows = plt.subplots(3, 1, figsize=(10, 7.5), sharex=True, layout="constrained")
    draw_time_series(rows, data)
    style.save(figure, path)


def map_picture(data, points, path):
    figure, axes = fitted_figure(data, 2 * margin_of(data), 1.0)
    axes.set_facecolor("#14171c")
    axes.grid(False)
    cloud = draw_paths(axes, data, 2 * margin_of(data), points, colour_by_height=True)
    if cloud is not None:
        bar = figure.colorbar(cloud, ax=axes, shrink=0.6, pad=0.01)
        bar.set_label("height [m]")
        bar.outline.set_visible(False)
    axes.set_title("Map from above, with the path")
    axes.legend(loc="upper right", labelcolor="white")
    style.save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", help="JSON as lio-eval writes it")
    parser.add_argument("--overview", metavar="FILE.png", help="everything in one picture")
    parser.add_argument("--folder", metavar="DIR", help="path.png, error.png, map.png")
    parser.add_argument("--map", metavar="FILE.pcd", help="points behind the paths")
    arguments = parser.parse_args()
    data = style.load(arguments.data)
    points = None
    if arguments.map:
        try:
            points = point_cloud.read_xyz(arguments.map)
        except (OSError, point_cloud.BadCloud) as error:
            style.fail(style.EXIT_UNUSABLE_INPUT, f"{arguments.map}: {error}; give a PCD file")
    if arguments.overview:
        overview(data, points, arguments.overview)
    if arguments.folder:
        try:
            os.makedirs(arguments.folder, exist_ok=True)
        except OSError as error:
            style.fail(style.EXIT_USAGE, f"{arguments.folder}: cannot be made ({error})")
        path_picture(data, points, os.path.join(arguments.folder, "path.png"))
        error_picture(data, os.path.join(arguments.folder, "error.png"))
        if points is not None:
            map_picture(data, points, os.path.join(arguments.folder, "map.png"))


if __name__ == "__main__":
    main()
