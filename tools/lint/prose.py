#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Counts faults of prose, and fails when there are more than tools/lint/prose.txt says.

  wide_lines    lines of README.md and docs/ above 100 columns
  no_subject    comments of include, src and tools whose first word is a preposition or a pronoun
                that stands for the subject: "Of the points ..." instead of "The points ..."
  --list NAME   print each place of one of them"""
import io
import pathlib
import re
import sys
import tokenize

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = "tools/lint/prose.txt"
MAX_COLUMNS = 100
FIRST_WORD = re.compile(r"\W*(Of|What|Where|That|By|With)\b")
CPP_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*')
SHELL_COMMENT = re.compile(r"(?:^|(?<=\s))#[^\n]*")
COMMENT_MARK = re.compile(r"^(//+|#+)\s*")


def wide_lines():
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    for page in pages:
        for number, line in enumerate(page.read_text().splitlines(), 1):
            if len(line) > MAX_COLUMNS:
                yield page, number, f"{len(line)} columns"


def comments_of(path):
    """Each comment: line, text behind the mark, does it stand alone on its line."""
    text = path.read_text()
    if path.suffix == ".py":
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.COMMENT:
                yield token.start[0], token.string, not token.line[:token.start[1]].strip()
        return
    pattern = CPP_COMMENT if path.suffix in (".cpp", ".hpp") else SHELL_COMMENT
    for number, line in enumerate(text.splitlines(), 1):
        for match in pattern.finditer(line):
            if not match.group().startswith('"'):
                yield number, match.group(), not line[:match.start()].strip()


def no_subject():
    files = [path for folder in ("include", "src", "tools") for path in (ROOT / folder).rglob("*")
             if path.suffix in (".cpp", ".hpp", ".py", ".sh") or path.name == "CMakeLists.txt"]
    for path in sorted(files):
        last = -1  # the line of the comment before: a block's later lines begin anywhere
        for number, text, alone in comments_of(path):
            words = COMMENT_MARK.sub("", text)
            if FIRST_WORD.match(words) and (not alone or last != number - 1):
                yield path, number, words
            last = number if alone else -1


def main():
    checks = {"wide_lines": wide_lines, "no_subject": no_subject}
    if len(sys.argv) == 3 and sys.argv[1] == "--list":
        for path, number, words in checks[sys.argv[2]]():
            print(f"{path.relative_to(ROOT)}:{number}: {words}")
        return 0
    failed = False
    for line in (ROOT / PAGE).read_text().splitlines():
        if not line or line.startswith("#"):
            continue
        name, most = line.split()
        count = sum(1 for _ in checks[name]())
        if count > int(most):
            failed = True
            print(f"lint: {name}: {count}, and {PAGE} allows {most}; "
                  f"tools/lint/prose.py --list {name} tells where", file=sys.stderr)
        elif count < int(most):
            print(f"lint: {name}: {count} by now; lower the {most} in {PAGE}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
