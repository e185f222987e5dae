#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""A drive from the log to its figures, in Python alone: path over map, error, covariance.

    examples/notebook.py --out out/notebook            # simulates a drive first, by lio-sim
    examples/notebook.py --drive out/loop --out out/notebook

Each part between the marks %% is a cell for editors that know them (VS Code, Spyder, PyCharm).
"""
# %% What it needs.
import argparse
import pathlib
import shutil
import subprocess

import liod
import matplotlib
import numpy as np

matplotlib.use("Agg")  # a notebook takes "inline" instead
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)

TRUTH, ESTIMATE, BAND = "#3a3f47", "#d1495b", "#2e86ab"
AXES = ("x", "y", "z")
plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
                     "axes.axisbelow": True, "grid.color": "#e4e6ea", "figure.dpi": 110,
                     "axes.titlelocation": "left", "axes.titleweight": "bold",
                     "legend.frameon": False})


# %% A drive: log, rig and truth, as lio-sim writes them.
def simulate(folder):
    """Returns the folder of a simulated drive around a block of streets."""
    here = pathlib.Path(__file__).resolve().parents[1] / "build/bin/lio-sim"
    program = here if here.is_file() else shutil.which("lio-sim")
    if program is None:
        raise SystemExit("notebook: there is no lio-sim; name a drive with --drive")
    subprocess.run([program, "--scenario", "loop", "--duration", "60", "--out", folder], check=True)
    return folder


# %% The estimator: events of the log in, estimates out.
def run(drive, out):
    odometry = liod.Odometry(drive / "config.yaml", out=out, overwrite=True, keep_map=True)
    estimates = [estimate for event in liod.read_log(drive / "log.lcm")
                 for estimate in odometry.add(event)]
    estimates += odometry.finish()
    print(f"{len(estimates)} poses; trust: {odometry.verdict()['trust']}")
    return estimates, odometry.map_points


# %% The errors, in the axes of the covariance.
def errors(estimates, truth_file):
    """Returns times [s], errors of the positions [m] and their standard deviations [m].

    The first poses of both paths are laid upon each other, so that the error there is zero.
    """
    truth = np.loadtxt(truth_file)
    stamps = np.array([e.stamp_ns for e in estimates])
    t_s = (stamps - stamps[0]) * 1e-9
    truth_t_s = truth[:, 0] - stamps[0] * 1e-9
    inside = (t_s >= truth_t_s[0]) & (t_s <= truth_t_s[-1])
    at = np.column_stack([np.interp(t_s, truth_t_s, truth[:, i]) for i in (1, 2, 3)])
    yaws = np.unwrap(yaw_of(*truth[:, 4:8].T))
    first = estimates[int(np.argmax(inside))]
    turn = yaw_of(*first.quaternion_xyzw) - np.interp(t_s[np.argmax(inside)], truth_t_s, yaws)
    rotation = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0],
                         [0, 0, 1]])
    positions = np.stack([e.position for e in estimates])
    moved = (at - at[np.argmax(inside)]) @ rotation.T + first.position
    std = np.sqrt(np.stack([np.diag(e.covariance)[:3] for e in estimates]))
    return t_s[inside], (positions - moved)[inside], std[inside]


def yaw_of(x, y, z, w):
    return np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


# %% Path over map.
def draw_path(estimates, points, picture):
    path = np.stack([e.map_pose[:3, 3] for e in estimates])
    low, high = path[:, :2].min(axis=0) - 40, path[:, :2].max(axis=0) + 40
    points = points[((points[:, :2] > low) & (points[:, :2] < high)).all(axis=1)]
    points = points[np.argsort(points[:, 2])]
    figure, axes = plt.subplots(figsize=(8, 6.4), layout="constrained")
    cloud = axes.scatter(*points[:, :2].T, c=points[:, 2], s=0.3, cmap="viridis", vmin=-4, vmax=12,
                         linewidths=0, rasterized=True)
    figure.colorbar(cloud, label="height [m]", shrink=0.7)
    axes.plot(*path[:, :2].T, color=ESTIMATE, linewidth=2, label="estimate")
    axes.plot(*path[0, :2], "o", color=ESTIMATE, label="start")
    axes.set(title="Path over map", xlabel="x [m]", ylabel="y [m]", aspect="equal",
             xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    axes.legend(loc="upper right", frameon=True, framealpha=0.9)
    figure.savefig(picture)
    plt.close(figure)


# %% Error over time.
def draw_error(scored, picture):
    t_s = (scored.stamps_ns - scored.stamps_ns[0]) * 1e-9
    figure, (above, below) = plt.subplots(2, 1, figsize=(9, 5), sharex=True, layout="constrained")
    above.plot(t_s, scored.position_error_m, color=ESTIMATE)
    rmse = scored.figures["ape"]["position_m"]["rmse"]
    above.axhline(rmse, color=TRUTH, linewidth=1, linestyle="--", label=f"rmse {rmse:.3f} m")
    above.set(title="Error of the aligned path", ylabel="position [m]")
    above.set_ylim(bottom=0)
    above.legend()
    below.plot(t_s, scored.rotation_error_deg, color=BAND)
    below.set(xlabel="time [s]", ylabel="rotation [deg]")
    below.set_ylim(bottom=0)
    below.margins(x=0)
    figure.savefig(picture)
    plt.close(figure)


# %% Error inside the covariance.
def draw_covariance(t_s, error_m, std_m, picture):
    figure, rows = plt.subplots(3, 1, figsize=(9, 6), sharex=True, layout="constrained")
    for i, (axes, name) in enumerate(zip(rows, AXES)):
        axes.fill_between(t_s, -3 * std_m[:, i], 3 * std_m[:, i], color=BAND, alpha=0.22,
                          linewidth=0, label="3 sigma of the filter")
        axes.plot(t_s, error_m[:, i], color=ESTIMATE, linewidth=1.2, label="error")
        axes.set_ylabel(f"{name} [m]")
        axes.margins(x=0)
    rows[0].set_title("Error of the position in world, and what the filter claims")
    rows[0].legend(loc="upper left", ncols=2)
    rows[2].set_xlabel("time [s]")
    figure.savefig(picture)
    plt.close(figure)


# %% All of it.
def main():
    parser = argparse.ArgumentParser(description="Draws a run's path, error and covariance.")
    parser.add_argument("--drive", type=pathlib.Path, help="folder of lio-sim (default: simulated)")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/notebook"))
    arguments = parser.parse_args()
    out = arguments.out
    out.mkdir(parents=True, exist_ok=True)
    drive = arguments.drive or simulate(out / "drive")
    estimates, points = run(drive, out / "run")
    scored = liod.evaluate(drive / "truth.tum", out / "run")
    rmse = scored.figures["ape"]["position_m"]["rmse"]
    print(f"position error {rmse:.3f} m rmse over {scored.figures['path_length_m']:.1f} m")
    draw_path(estimates, points, out / "python_path.png")
    draw_error(scored, out / "python_error.png")
    draw_covariance(*errors(estimates, drive / "truth.tum"), out / "python_covariance.png")


if __name__ == "__main__":
    main()
