#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Checks that no two types of include/ and src/ have the same name in the same namespace.

No compiler tells when they stand in different sources, yet the linker then takes one type's
constructors and destructor for the other's. Types in unnamed namespaces may share their names.
"""
import pathlib
import sys

import cpp_text

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    places = {}
    for path in sorted(p for base in ("include", "src") for p in (ROOT / base).rglob("*.[ch]pp")):
        for found in cpp_text.Reader(path.read_text()).classes:
            if "" not in found.namespace and "(unnamed)" not in found.name:
                name = "::".join([*found.namespace, found.name])
                places.setdefault(name, []).append(f"{path.relative_to(ROOT)}:{found.line}")
    faults = [f"{name} is defined twice: {', '.join(where)}; rename one"
              for name, where in places.items() if len(where) > 1 and "<" not in name]
    for fault in faults:
        print("lint:", fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
