#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Checks that no class has more than 20 data members and no function more than 60 lines.

A class here is a type with member functions. Plain rows of data without any, as options and
counters are, may be longer: tools/lint/sizes.txt names them, each with its reason. The same file
holds what is still too large, each with its present size, which may only shrink.
"""
import pathlib
import re
import sys

import cpp_text

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = pathlib.Path("tools/lint/sizes.txt")
FOLDERS = ("include", "src", "tools", "test")
MAX_MEMBERS = 20
MAX_LINES = 60
ROW = re.compile(r"^(row|class|function) (\S+) (\S+?)(?: (\d+))?(?:  +(.*))?$")


def allowances():
    """(kind, file, name) -> size allowed; a row of data has no size."""
    found = {}
    for line in (ROOT / PAGE).read_text().splitlines():
        if not line or line.startswith("#"):
            continue
        match = ROW.match(line)
        if match is None or (match[1] == "row") == (match[4] is not None):
            sys.exit(f"lint: {PAGE}: cannot read the line: {line}")
        found[match[1], match[2], match[3]] = int(match[4]) if match[4] else None
    return found


def too_large(path):
    """(kind, name, line, size) of each class and function of a file that is above the limits."""
    source = cpp_text.Reader(path.read_text())
    for found in source.classes:
        if found.num_members > MAX_MEMBERS:
            kind = "class" if found.num_methods else "row"
            yield kind, found.name, found.line, found.num_members
    for found in source.functions:
        if found.num_lines > MAX_LINES:
            yield "function", found.name, found.line, found.num_lines


def message(kind, name, size):
    if kind == "class":
        return f"class {name} has {size} data members; {MAX_MEMBERS} is the limit: split it"
    if kind == "function":
        return f"function {name} has {size} lines; {MAX_LINES} is the limit: split it"
    return (f"struct {name} has {size} data members; {MAX_MEMBERS} is the limit. It has no member "
            f"functions: if it is a row of data, give it a line in {PAGE}, else split it")


def main():
    allowed, used, faults = allowances(), set(), []
    for path in sorted(p for folder in FOLDERS for p in (ROOT / folder).rglob("*.[ch]pp")):
        file = path.relative_to(ROOT).as_posix()
        for kind, name, line, size in too_large(path):
            key = kind, file, name
            used.add(key)
            if key not in allowed:
                faults.append(f"{file}:{line}: {message(kind, name, size)}")
            elif allowed[key] is not None and size != allowed[key]:
                faults.append(f"{file}:{line}: {name} has {size}, {PAGE} says {allowed[key]}: "
                              + ("lower it there" if size < allowed[key] else "it may only shrink"))
    for kind, file, name in sorted(set(allowed) - used):
        faults.append(f"{PAGE}: {kind} {file} {name} is no longer too large: remove the line")
    for fault in faults:
        print("lint:", fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
