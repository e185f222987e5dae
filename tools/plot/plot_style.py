# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Holds what all pictures share: style, loading, and the end of a script that cannot draw."""
import json
import sys

EXIT_USAGE = 2
EXIT_CONFIGURATION = 3
EXIT_UNUSABLE_INPUT = 5

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.colors import ListedColormap  # noqa: F401 (for the scripts)
except ImportError as missing:
    print(f"lio-eval: pictures need matplotlib ({missing}); apt-get install python3-matplotlib",
          file=sys.stderr)
    sys.exit(EXIT_CONFIGURATION)

TRUTH = "#3a3f47"
ESTIMATE = "#d1495b"
SECOND = "#2e86ab"
BAND = "#2e86ab"

plt.rcParams.update({
    "figure.dpi": 110,
    "savefig.facecolor": "white",
    "font.size": 10,
    "axes.titlesize": 11,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e4e6ea",
    "grid.linewidth": 0.8,
    "legend.frameon": False,
    "lines.linewidth": 1.6,
    "lines.solid_capstyle": "round",
})


def fail(exit_code, message):
    """Ends the program with one line that says what to do."""
    print(f"lio-eval: {message}", file=sys.stderr)
    sys.exit(exit_code)


def load(path):
    with open(path, encoding="utf-8") as stream:
        return json.load(stream)


def column(data, name):
    """Returns a list with nulls as an array with NaN, which breaks lines."""
    return np.array([np.nan if v is None else v for v in data.get(name, [])], dtype=float)


def save(figure, path):
    try:
        figure.savefig(path)
    except (OSError, ValueError) as error:
        fail(EXIT_USAGE, f"{path}: cannot be written ({error})")
    plt.close(figure)
