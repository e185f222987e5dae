# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Puts the rows of all runs into table.tsv, table.json and index.html, in the fleet's folder. A run
without a row is in the table as unfinished."""
import csv
import io
import json
import os
import pathlib

import page
import paired
import rows
import steps


def row_of(run):
    file = pathlib.Path("runs") / run["system"] / run["drive"] / "row.json"
    row = steps.read_json(file) if file.exists() else {}
    if row.get("key") != run["key"]:
        row = rows.empty_row("unfinished", "run the fleet again")
    known = {name: run[name] for name in ("drive", "group", "seed", "system", "kind")}
    return {column: (known | row).get(column) for column in rows.COLUMNS}


def cell(value):
    if value is None:
        return ""
    if isinstance(value, float):
        return f"{value:.9g}"
    return str(value).replace("\t", " ").replace("\n", " ")


def tsv(table):
    stream = io.StringIO()
    writer = csv.writer(stream, delimiter="\t", lineterminator="\n", quoting=csv.QUOTE_NONE,
                        quotechar=None)
    writer.writerow(rows.COLUMNS)
    writer.writerows([cell(row[column]) for column in rows.COLUMNS] for row in table)
    return stream.getvalue()


def write(name, text):
    """Replaces a file at once, so that a reader never sees a half of it."""
    pathlib.Path(f"{name}.part").write_text(text, encoding="utf-8")
    os.replace(f"{name}.part", name)


def collect():
    plan = steps.read_json("plan.json")
    table = [row_of(run) for run in plan["runs"]]
    summary = paired.summarize(table, plan["systems"], plan["baseline"])
    write("table.tsv", tsv(table))
    write("table.json", json.dumps({"baseline": plan["baseline"], "summary": summary,
                                    "rows": table}, indent=1) + "\n")
    write("index.html", page.html(table, summary, plan["baseline"]))
    return table


def read_table():
    return steps.read_json("table.json")["rows"]


if __name__ == "__main__":
    steps.die_with_parent()
    collect()
