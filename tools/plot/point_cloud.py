# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Reads the x y z of a PCD file (version 0.7: ascii, binary, binary_compressed)."""
import numpy as np

TYPES = {("F", 4): "<f4", ("F", 8): "<f8", ("U", 1): "<u1", ("U", 2): "<u2", ("U", 4): "<u4",
         ("U", 8): "<u8", ("I", 1): "<i1", ("I", 2): "<i2", ("I", 4): "<i4", ("I", 8): "<i8"}
MAX_POINTS = 4_000_000  # a picture cannot show more


class BadCloud(Exception):
    """Says that the file is no readable PCD; the text gives the reason."""


def _header(stream):
    header = {}
    while "DATA" not in header:
        line = stream.readline(4096)
        if not line:
            raise BadCloud("the header has no DATA line")
        words = line.decode("ascii", errors="replace").split()
        if words and not words[0].startswith("#"):
            header[words[0]] = words[1:]
    return header


def _layout(header):
    try:
        names = header["FIELDS"]
        types = [TYPES[kind, int(size)] for kind, size in zip(header["TYPE"], header["SIZE"])]
        counts = [int(count) for count in header.get("COUNT", ["1"] * len(names))]
        num_points = int(header["POINTS"][0])
    except (KeyError, ValueError, IndexError) as error:
        raise BadCloud(f"the header is damaged ({error})") from error
    if not {"x", "y", "z"} <= set(names) or not len(names) == len(types) == len(counts):
        raise BadCloud("the header has no complete x, y and z fields")
    return names, types, counts, num_points


def _lzf(data, size):
    """Undoes LZF: literal runs, and copies of what was written before."""
    out = bytearray()
    i = 0
    while i < len(data):
        control = data[i]
        i += 1
        if control < 32:
            out += data[i:i + control + 1]
            i += control + 1
            continue
        length = control >> 5
        if length == 7:
            length += data[i]
            i += 1
        start = len(out) - ((control & 31) << 8) - data[i] - 1
        i += 1
        if start < 0:
            raise BadCloud("the compressed data are damaged")
        for k in range(length + 2):
            out.append(out[start + k])
    if len(out) != size:
        raise BadCloud("the compressed data are cut")
    return bytes(out)


def _compressed(stream, names, types, counts, num_points):
    sizes = np.frombuffer(stream.read(8), "<u4")
    if len(sizes) != 2:
        raise BadCloud("the compressed data are cut")
    data = _lzf(stream.read(int(sizes[0])), int(sizes[1]))
    columns, offset = {}, 0
    for name, kind, count in zip(names, types, counts):
        length = np.dtype(kind).itemsize * count * num_points
        columns[name] = np.frombuffer(data[offset:offset + length], kind)
        offset += length
    return columns


def read_xyz(path):
    """Returns the finite points, N x 3; raises BadCloud or OSError."""
    with open(path, "rb") as stream:
        header = _header(stream)
        names, types, counts, num_points = _layout(header)
        form = header["DATA"][0] if header["DATA"] else ""
        if form == "ascii":
            try:
                table = np.loadtxt(stream, ndmin=2, max_rows=num_points)
            except ValueError as error:
                raise BadCloud(f"the data are damaged ({error})") from error
            starts = np.cumsum([0] + counts)
            if len(table) and table.shape[1] != starts[-1]:
                raise BadCloud("rows have another number of columns than the header says")
            columns = {name: table[:, starts[i]] for i, name in enumerate(names)}
        elif form == "binary":
            kinds = [(f"{name}_{i}", kind, (count,)) for i, (name, kind, count)
                     in enumerate(zip(names, types, counts))]
            table = np.fromfile(stream, np.dtype(kinds), num_points)
            if len(table) != num_points:
                raise BadCloud(f"holds {len(table)} of the {num_points} points it names")
            columns = {name: table[f"{name}_{i}"][:, 0] for i, name in enumerate(names)}
        elif form == "binary_compressed":
            columns = _compressed(stream, names, types, counts, num_points)
        else:
            raise BadCloud(f"data form '{form}' is unknown")
    points = np.column_stack([np.asarray(columns[axis], dtype=float) for axis in "xyz"])
    points = points[np.isfinite(points).all(axis=1)]
    return points[:: max(1, len(points) // MAX_POINTS)]
