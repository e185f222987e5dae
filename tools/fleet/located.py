# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Reads YAML and TSV into tables whose entries know their line, so that every fault names it."""
import csv
import dataclasses
import pathlib

import yaml


@dataclasses.dataclass
class Entry:
    """One row or mapping: its place, its values by key, and the line of each key."""
    file: pathlib.Path
    line: int
    values: dict
    lines: dict

    def place(self, key=None):
        return f"{self.file}:{self.lines.get(key, self.line)}"


class Faults(list):
    """All that is wrong, each with file and line."""

    def add(self, place, text):
        self.append(f"{place}: {text}")


def _entry(node, file, faults):
    entry = Entry(file, node.start_mark.line + 1, {}, {})
    for key_node, value_node in node.value:
        key, line = str(key_node.value), key_node.start_mark.line + 1
        if key in entry.values:
            faults.add(f"{file}:{line}", f"{key} is given twice, first in line {entry.lines[key]}; "
                       "remove one")
            continue
        entry.lines[key] = line
        entry.values[key] = _value(value_node, file, faults)
    return entry


def _value(node, file, faults):
    if isinstance(node, yaml.MappingNode):
        return _entry(node, file, faults)
    if isinstance(node, yaml.SequenceNode):
        return [_value(item, file, faults) for item in node.value]
    # Everything stays text, so that a drive may be called 05 or no.
    return "" if node.tag.endswith(":null") else node.value


def read_yaml(file, faults):
    """Returns the file's mapping as an Entry, or None with a fault."""
    try:
        node = yaml.compose(file.read_text(encoding="utf-8"), yaml.SafeLoader)
    except yaml.YAMLError as error:
        line = error.problem_mark.line + 1 if getattr(error, "problem_mark", None) else 1
        faults.add(f"{file}:{line}", f"is no YAML: {getattr(error, 'problem', error)}")
        return None
    if not isinstance(node, yaml.MappingNode):
        faults.add(f"{file}:1", "needs keys at its top, such as drives:; see docs/fleet.md")
        return None
    return _entry(node, file, faults)


def read_tsv(file, faults):
    """Returns the rows as Entries; the first line names the keys, and empty cells are left out."""
    with open(file, newline="", encoding="utf-8") as stream:
        rows = list(enumerate(csv.reader(stream, delimiter="\t", quoting=csv.QUOTE_NONE), 1))
    rows = [(line, cells) for line, cells in rows
            if any(cells) and not cells[0].startswith("#")]
    if not rows:
        faults.add(f"{file}:1", "is empty; its first line names the columns, such as name and sim")
        return []
    keys, entries = rows[0][1], []
    for line, cells in rows[1:]:
        if len(cells) != len(keys):
            faults.add(f"{file}:{line}", f"has {len(cells)} cells, and the first line names "
                       f"{len(keys)} columns; separate cells by one tabulator each")
            continue
        values = {key: cell.strip() for key, cell in zip(keys, cells) if cell.strip()}
        entries.append(Entry(file, line, values, {}))
    return entries
