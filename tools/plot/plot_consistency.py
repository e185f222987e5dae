#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Draws NEES and NIS of many runs with their chi-square bands, from the data of lio-eval."""
import argparse

import plot_style as style
from plot_style import np, plt

GAUSSIAN = (0.6827, 0.9545, 0.9973)


def draw_series(axes, curve, title, summary):
    time, mean = style.column(curve, "time"), style.column(curve, "mean")
    low, high = style.column(curve, "low"), style.column(curve, "high")
    axes.fill_between(time, low, high, color=style.BAND, alpha=0.22, linewidth=0,
                      label="95 % band")
    axes.axhline(1, color=style.BAND, linewidth=1)
    axes.plot(time, mean, color=style.ESTIMATE, linewidth=1.2, label="mean over runs")
    axes.set_title(f"{title}: {summary['average_per_dof']:.2f} per dof, "
                   f"{100 * summary['share_in_band']:.0f} % of the time in its band")
    values = mean[mean > 0]
    if len(values) and (values.max() > 4 * high.max() or values.min() < low.min() / 4):
        axes.set_yscale("log")
    else:
        axes.set_ylim(0, 1.15 * max(mean.max(), high.max()))
    axes.margins(x=0)


def draw_shares(axes, shares):
    names = list(shares)
    position = np.arange(len(names))
    colours = ("#1b4965", "#5fa8d3", "#bee3f5")
    for i, (expected, colour) in enumerate(zip(GAUSSIAN, colours)):
        offset = (i - 1) * 0.26
        axes.bar(position + offset, [100 * shares[name][i] for name in names], 0.24,
                 color=colour, label=f"{i + 1} sigma")
        axes.hlines([100 * expected] * len(names), position + offset - 0.13,
                    position + offset + 0.13, color=style.ESTIMATE, linewidth=2)
    axes.set_xticks(position, names)
    axes.set_ylim(0, 105)
    axes.set_ylabel("[%]")
    axes.set_title("Errors inside 1, 2, 3 sigma (red: Gaussian)")
    axes.legend(loc="lower right", ncols=3, framealpha=0.9, frameon=True, edgecolor="none")


def draw_whiteness(axes, whiteness):
    lags = np.arange(1, len(whiteness["band"]) + 1)
    band = np.array(whiteness["band"])
    axes.fill_between(lags, -band, band, color=style.BAND, alpha=0.22, linewidth=0)
    axes.vlines(lags, 0, whiteness["autocorrelation"], color=style.ESTIMATE, linewidth=2)
    axes.plot(lags, whiteness["autocorrelation"], "o", color=style.ESTIMATE, markersize=4)
    axes.axhline(0, color=style.TRUTH, linewidth=0.8)
    axes.set_xticks(lags[::2])
    axes.set_xlabel("lag [scans]")
    axes.set_title("Autocorrelation of NIS (white: inside the band)")


def draw(data, path):
    summary = data["summary"]
    figure, rows = plt.subplots(3, 2, figsize=(14, 9), layout="constrained")
    for axes, name in zip(rows[:, 0], ("pose", "position", "rotation")):
        draw_series(axes, data[name], f"NEES of {name}", summary["nees"][name])
    rows[0, 0].legend(loc="upper right", ncols=2, framealpha=0.85, frameon=True, edgecolor="none")
    rows[2, 0].set_xlabel("time since the run's first row [s]")
    if data["nis"] is None:
        rows[0, 1].text(0.5, 0.5, "no fused scans in registration.csv", ha="center")
        rows[1, 1].axis("off")
    else:
        draw_series(rows[0, 1], data["nis"], "NIS", summary["nis"])
        rows[0, 1].set_xlabel("time since the run's first row [s]")
        draw_whiteness(rows[1, 1], summary["nis_whiteness"])
    draw_shares(rows[2, 1], summary["sigma_shares"])
    figure.suptitle(f"Consistency of {summary['num_runs']} runs", fontsize=12)
    style.save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", help="JSON as lio-eval writes it")
    parser.add_argument("picture", help="PNG to write")
    arguments = parser.parse_args()
    draw(style.load(arguments.data), arguments.picture)


if __name__ == "__main__":
    main()
