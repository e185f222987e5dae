#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Checks the includes between folders against tools/lint/layers.txt, and the drawing of them in
docs/design.md. A private header (src/FOLDER/*.hpp) belongs to its folder and to tests alone; a
public one (include/lio/FOLDER/*.hpp) serves another folder, and not just tests of one.
  --draw    print the drawing
  --update  write it into docs/design.md"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = "tools/lint/layers.txt"
DESIGN = ROOT / "docs" / "design.md"
BEGIN, END = "<!-- layers: begin -->", "<!-- layers: end -->"
SHARED_TESTS = ("contract", "fuzz", "support")  # they serve several folders
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]((?<=")[^"]+|lio/[^>]+)[">]')


def read_table():
    """Folder -> folders it may include, bottom up; (file, include) that are still to be mended."""
    allowed, to_mend, faults = {}, set(), []
    for line in (ROOT / PAGE).read_text().splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("! "):
            to_mend.add(tuple(line.split()[1:]))
            continue
        folder, _, others = line.partition(":")
        for other in set(others.split()) - set(allowed):
            faults.append(f"{PAGE}: {folder} names {other}, which no line above it defines")
        allowed[folder] = others.split()
    return allowed, to_mend, faults


def folder_of(path):
    """The line of layers.txt that a source belongs to; None where it has none, as in test/."""
    parts = path.relative_to(ROOT).parts
    if parts[0] == "tools":
        return "tools/bench" if parts[1] == "bench" else "tools"
    return {"include": parts[2:3], "src": parts[1:2]}.get(parts[0], (None,))[0]


def includes(path):
    """Each include of ours: line, text, folder of the header, is it private."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if match is None:
            continue
        text = match[1]
        parts = pathlib.PurePosixPath(text).parts
        if (ROOT / "include" / text).is_file():
            yield number, text, parts[1], False
        elif parts[0] == "lio" and len(parts) == 2:
            yield number, text, "lcmtypes", False
        elif len(parts) > 1 and (ROOT / "src" / text).is_file():
            yield number, text, parts[0], True
        elif "/" not in text or not (path.parent / text).is_file():
            if not (path.parent / text).is_file() and not (ROOT / "test" / text).is_file():
                yield number, text, None, False


def check_includes(allowed, to_mend):
    used, mended, faults = set(), set(to_mend), []
    for base in ("include/lio", "src", "tools"):
        for path in sorted((ROOT / base).rglob("*.[ch]pp")):
            folder, file = folder_of(path), path.relative_to(ROOT).as_posix()
            if folder not in allowed:
                faults.append(f"{file}: {PAGE} has no line for the folder {folder}")
                continue
            for number, text, target, is_private in includes(path):
                used.add((folder, target))
                if (file, text) in to_mend:
                    mended.discard((file, text))
                elif target is None:
                    faults.append(f"{file}:{number}: there is no header {text} of ours")
                elif target == folder or is_private and folder == "tools/bench":
                    continue
                elif is_private:
                    faults.append(f"{file}:{number}: {text} is private to src/{target}: "
                                  f"declare what others need in include/lio/{target}")
                elif target not in allowed[folder]:
                    faults.append(f"{file}:{number}: {folder} may not include {target} ({PAGE})")
    for file, text in sorted(mended):
        faults.append(f"{PAGE}: {file} does not include {text} any more: remove the line")
    for folder, others in allowed.items():
        for other in others:
            if (folder, other) not in used:
                faults.append(f"{PAGE}: {folder} includes {other} no more: remove it there")
    return faults


def check_tests():
    """A test may read the private headers of the folder that it tests, and the tests that several
    folders share those of any."""
    faults = []
    for path in sorted((ROOT / "test").rglob("*.[ch]pp")):
        folder = path.relative_to(ROOT).parts[1]
        for number, text, target, is_private in includes(path):
            if is_private and folder not in (target, *SHARED_TESTS):
                faults.append(f"{path.relative_to(ROOT)}:{number}: {text} is private to "
                              f"src/{target} and its tests in test/{target}")
    return faults


def check_public():
    """Each public header serves another folder: it is included there, or by a header that is. Tests
    are no such folder: they may read private headers."""
    headers = {path.relative_to(ROOT / "include").as_posix(): path
               for path in sorted((ROOT / "include/lio").glob("*/*.hpp"))}
    serving = set()
    for base in ("src", "include/lio", "tools", "examples"):
        for path in sorted((ROOT / base).rglob("*.[ch]pp")):
            parts = path.relative_to(ROOT).parts
            folder = parts[1] if base == "src" else folder_of(path)
            serving |= {text for _, text, target, _ in includes(path)
                        if text in headers and target != folder}
    to_follow = list(serving)
    while to_follow:
        inner = {text for _, text, _, _ in includes(headers[to_follow.pop()])
                 if text in headers} - serving
        serving |= inner
        to_follow += inner
    return [f"include/{text}: no other folder includes it: move it to src/{text[4:]}"
            for text in headers if text not in serving]


def reached(allowed, folder):
    """All folders that a folder depends on, through others, too."""
    found = set(allowed[folder])
    for other in allowed[folder]:
        found |= reached(allowed, other)
    return found


def draw(allowed):
    """A diagram without the arrows that follow from others, and the whole table."""
    lines = [BEGIN, "```mermaid", "flowchart TD"]
    for folder in reversed(allowed):
        through = set().union(*[reached(allowed, other) for other in allowed[folder]])
        arrows = [other for other in reversed(allowed[folder]) if other not in through]
        if arrows:
            lines.append(f"  {folder} --> {' & '.join(arrows)}")
    lines += ["```", "", "| folder | may include |", "|---|---|"]
    for folder in reversed(allowed):
        lines.append(f"| `{folder}` | {', '.join(allowed[folder]) or 'nothing'} |")
    return "\n".join(lines + [END])


def main():
    allowed, to_mend, faults = read_table()
    if sys.argv[1:] == ["--draw"]:
        print(draw(allowed))
        return 0
    block = re.compile(re.escape(BEGIN) + ".*?" + re.escape(END), re.DOTALL)
    page = DESIGN.read_text()
    if sys.argv[1:] == ["--update"]:
        DESIGN.write_text(block.sub(lambda _: draw(allowed), page))
        return 0
    faults += check_includes(allowed, to_mend) + check_tests() + check_public()
    if draw(allowed) not in page:
        faults.append("docs/design.md does not draw tools/lint/layers.txt as it is: run "
                      "tools/lint/layers.py --update")
    for fault in faults:
        print("lint:", fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
