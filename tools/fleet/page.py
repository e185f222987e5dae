# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""The page of a fleet: one file without outside parts, whose script draws it from the table."""
import json
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
UPLOT = HERE.parents[1] / "third_party/uplot"


def in_script(content):
    """JSON that cannot end its script element."""
    return json.dumps(content, separators=(",", ":")).replace("<", "\\u003c")


def rounded(value):
    return float(f"{value:.6g}") if isinstance(value, float) else value


def columns_of(table):
    """Names of columns once, then only values: a third of the size."""
    names = list(table[0]) if table else []
    return {"columns": names, "rows": [[rounded(row[name]) for name in names] for row in table]}


def html(table, summary, baseline):
    def read(path):
        return path.read_text(encoding="utf-8")
    data = in_script({"table": columns_of(table), "summary": summary, "baseline": baseline})
    parts = {"@UPLOT_CSS@": read(UPLOT / "uPlot.min.css"), "@CSS@": read(HERE / "page.css"),
             "@UPLOT_JS@": read(UPLOT / "uPlot.iife.min.js"), "@DATA@": data,
             "@JS@": read(HERE / "page.js")}
    text = read(HERE / "page.html")
    for name, part in parts.items():
        text = text.replace(name, part, 1)
    return text
