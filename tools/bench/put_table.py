#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Puts a table into its place on a page: put_table.py PAGE.md NAME TABLE.md

The place is between the lines "<!-- NAME -->" and "<!-- end of NAME -->".
"""
import pathlib
import sys


def main():
    page, name, table = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
    begin, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->\n"
    text = page.read_text(encoding="utf-8")
    if text.count(begin) != 1 or text.count(end) != 1:
        sys.exit(f"put_table: {page} has no place for '{name}'")
    before, rest = text.split(begin)
    after = rest.split(end)[1]
    page.write_text(before + begin + table.read_text(encoding="utf-8") + end + after,
                    encoding="utf-8")


if __name__ == "__main__":
    main()
