#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Checks that every source has its test: src/MODULE/X.cpp, and every header with code that has no
such source, needs test/MODULE/X_test.cpp or a row in the table of docs/testing.md that says which
test stands for it. Rows of sources that are gone, or that have a test by now, are told, too."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "testing.md"
MIN_RETURNS = 2  # a header with fewer functions that give something is data


def names():
    """MODULE/X of every source that needs a test."""
    found = {path.relative_to(ROOT / "src").with_suffix("").as_posix()
             for path in (ROOT / "src").rglob("*.cpp")}
    for base in (ROOT / "include" / "lio", ROOT / "src"):
        for path in base.rglob("*.hpp"):
            has_code = len(re.findall(r"\breturn\b", path.read_text())) >= MIN_RETURNS
            if has_code:
                found.add(path.relative_to(base).with_suffix("").as_posix())
    return found


def table():
    """The rows of the page: names of a source (a star stands for any letters), test."""
    rows = re.findall(r"^\| `(\w+/[\w*]+)` \| `(test/[\w/.]+)` \|", PAGE.read_text(), re.MULTILINE)
    return [(re.compile(name.replace("*", r"\w+") + "$"), name, test) for name, test in rows]


def main():
    faults = []
    rows = table()
    untested = {name for name in names() if not (ROOT / "test" / f"{name}_test.cpp").is_file()}
    for name in sorted(untested):
        if not any(pattern.match(name) for pattern, _, _ in rows):
            faults.append(f"{name} has neither test/{name}_test.cpp nor a row in docs/testing.md")
    for pattern, name, test in rows:
        if not any(pattern.match(other) for other in untested):
            faults.append(f"docs/testing.md: the row of {name} is out of date")
        if not (ROOT / test).is_file():
            faults.append(f"docs/testing.md: {test} of {name} is not there")
    for fault in faults:
        print("lint:", fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
