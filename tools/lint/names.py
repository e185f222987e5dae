#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Checks that no two types of include/ and src/, and no two inline variables of their headers and
those of test/, have the same name in the same namespace.

No compiler tells when they stand in different sources, yet the linker then takes one type's
constructors and destructor, or one variable's value, for the other's. Names in unnamed namespaces
may be shared.
"""
import pathlib
import re
import sys

import cpp_text

ROOT = pathlib.Path(__file__).resolve().parents[2]
VARIABLE = re.compile(r"^namespace (?P<namespace>[\w:]*) ?\{|"
                      r"^inline (?:constexpr|const) [^;={(]*?\b(?P<name>k\w+)(?=[ ;={])", re.M)


def inline_variables(text):
    """Yields namespace::name and position of each inline variable at the top of a header."""
    namespace = ""
    for found in VARIABLE.finditer(text):
        if found["name"] is None:
            namespace = found["namespace"]
        else:
            yield f"{namespace}::{found['name']}", found.start()


def main():
    places = {}
    for path in sorted(p for base in ("include", "src") for p in (ROOT / base).rglob("*.[ch]pp")):
        for found in cpp_text.Reader(path.read_text()).classes:
            if "" not in found.namespace and "(unnamed)" not in found.name:
                name = "::".join([*found.namespace, found.name])
                places.setdefault(name, []).append(f"{path.relative_to(ROOT)}:{found.line}")
    bases = ("include", "src", "test")
    for path in sorted(p for base in bases for p in (ROOT / base).rglob("*.hpp")):
        text = path.read_text()
        for name, start in inline_variables(text):
            line = text.count("\n", 0, start) + 1
            places.setdefault(name, []).append(f"{path.relative_to(ROOT)}:{line}")
    faults = [f"{name} is defined twice: {', '.join(where)}; rename one"
              for name, where in places.items() if len(where) > 1 and "<" not in name]
    for fault in faults:
        print("lint:", fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
