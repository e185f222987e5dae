# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Arranges pictures on one sheet: contact_sheet.py FOLDER OUT.png

FOLDER holds `names`, one per line, and NAME.ppm for each. contact_sheet.sh calls this script.
"""

import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

COLUMNS = 3
TILE_INCHES = 5.0
DPI = 96
COLOURS = 256  # a palette makes the file three times smaller and looks the same


def read_ppm(path):
    """Returns the pixels of a binary PPM as lio-sim writes it."""
    magic, size, depth, pixels = path.read_bytes().split(b"\n", 3)
    if magic != b"P6" or depth != b"255":
        raise ValueError(f"{path}: not a binary PPM of 8 bits")
    width, height = (int(word) for word in size.split())
    return np.frombuffer(pixels, np.uint8).reshape(height, width, 3)


def main():
    folder, out = pathlib.Path(sys.argv[1]), sys.argv[2]
    names = (folder / "names").read_text().split()
    rows = math.ceil(len(names) / COLUMNS)
    height, width, _ = read_ppm(folder / f"{names[0]}.ppm").shape
    size = (COLUMNS * TILE_INCHES, rows * (TILE_INCHES * height / width + 0.32))
    figure, axes = plt.subplots(rows, COLUMNS, figsize=size)
    for axis in axes.flat:
        axis.axis("off")
    for axis, name in zip(axes.flat, names):
        axis.imshow(read_ppm(folder / f"{name}.ppm"), interpolation="antialiased")
        axis.set_title(name, fontsize=13, pad=4)
    figure.subplots_adjust(left=0.004, right=0.996, top=0.975, bottom=0.004, wspace=0.012,
                           hspace=0.09)
    figure.savefig(out, dpi=DPI)
    with Image.open(out) as sheet:
        small = sheet.convert("RGB").quantize(COLOURS, dither=Image.Dither.FLOYDSTEINBERG)
    small.save(out, optimize=True)


main()
