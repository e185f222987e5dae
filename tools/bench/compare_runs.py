#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Makes the table and the picture of the runs of tools/bench/compare.sh.

    compare_runs.py DIR    the fleet's folder, into which paths.png is drawn
"""
import os
import pathlib
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "plot"))
from fleet_runs import read, scored_runs  # noqa: E402
from plot_style import np, plt  # noqa: E402

HEADER = ("| method | APE se3 cm | APE deg | drift % | end error cm | z drift cm | step mm "
          "| not fused | ms a scan | p99 ms | MB |")


def row(name, score, stats):
    drift = score["drift"]["translation_percent"]
    cells = [name, f"{100 * score['ape']['position_m']['rmse']:.2f}",
             f"{score['ape']['rotation_deg']['rmse']:.3f}",
             "-" if drift is None else f"{drift:.3f}", f"{100 * score['end']['error_m']:.1f}",
             f"{100 * score['z_drift']['end_m']:.1f}",
             f"{1000 * score['step']['translation_m']['median']:.2f}",
             str(stats["num_matches_rejected"]), f"{stats['stage_ms']['total']['median']:.2f}",
             f"{stats['stage_ms']['total']['p99']:.2f}", f"{stats['rss_peak_mb']:.0f}"]
    return "| " + " | ".join(cells) + " |"


def rotation(wxyz):
    w, x, y, z = wxyz
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def aligned_path(folder, score):
    """Returns the positions in the truth's frame, using the alignment that lio-eval found."""
    poses = np.loadtxt(folder / "trajectory.tum", ndmin=2)
    alignment = score["alignment"]
    return poses[:, 0], (poses[:, 1:4] @ rotation(alignment["rotation_wxyz"]).T +
                         alignment["translation_m"])


def draw(folders, scores, picture):
    """Draws the paths from above, and below them each path's error over time."""
    truth = np.loadtxt(next(iter(folders.values())) / "truth.tum", ndmin=2)
    figure, (plan, error) = plt.subplots(2, 1, figsize=(9, 10), height_ratios=(3, 2))
    plan.plot(truth[:, 1], truth[:, 2], color="black", linewidth=2.5, label="truth")
    for name, score in scores.items():
        times, path = aligned_path(folders[name], score)
        line = "--" if name.endswith("-lidar") else "-"
        plan.plot(path[:, 0], path[:, 1], line, linewidth=1, label=name)
        inside = (times >= truth[0, 0]) & (times <= truth[-1, 0])
        off = [path[inside, i] - np.interp(times[inside], truth[:, 0], truth[:, i + 1])
               for i in range(3)]
        error.semilogy(times[inside] - truth[0, 0],
                       np.maximum(np.sqrt(np.sum(np.square(off), axis=0)), 1e-4), line, linewidth=1)
    plan.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="Paths, SE3-aligned")
    plan.legend(loc="best", fontsize="small")
    error.set(xlabel="time [s]", ylabel="position error [m]")
    error.grid(True, which="both", alpha=0.3)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


def main():
    root = pathlib.Path(sys.argv[1])
    folders = {run["system"]: folder for run, folder in scored_runs(root)}
    scores = {name: read(folder / "eval_published.json") for name, folder in folders.items()}
    print(HEADER, "|" + "---|" * (HEADER.count("|") - 1), sep="\n")
    for name, score in scores.items():
        print(row(name, score, read(folders[name] / "stats.json")))
    if scores:
        draw(folders, scores, root / "paths.png")


if __name__ == "__main__":
    main()
