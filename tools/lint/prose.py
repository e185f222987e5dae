#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Counts faults of prose, and fails when there are more than tools/lint/prose.txt says.

  wide_lines    lines of README.md and docs/ above 100 columns
  no_subject    sentences whose first word is a preposition or a pronoun that stands for the subject
                (of the points ... instead of the points ...): in comments and docstrings of
                include, src, tools, test and examples, and in what the programs print, which is the
                literals of include, src and tools
  --list NAME   print each place of one of them"""
import ast
import io
import pathlib
import re
import sys
import tokenize

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = "tools/lint/prose.txt"
MAX_COLUMNS = 100
# At the beginning of the text, or behind the end of a sentence.
FIRST_WORD = re.compile(r"(?:^|(?<=[.:;?!] )|(?<=[.:;?!]\) ))[^\w\s]*"
                        r"(?:Of|What|Where|That|By|With)\b[^?]*?(?=[.:;!?]|$)")
SPDX = re.compile(r"\W*SPDX-")
CPP_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*')
CPP_LITERALS = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')
CPP_SUFFIXES = (".cpp", ".hpp")
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


def comment_blocks(path):
    """Comments on neighbouring lines belong together: each block's lines, with their numbers."""
    block, last = [], -1
    for number, text, alone in comments_of(path):
        if block and (not alone or number != last + 1):
            yield block
            block = []
        last = number if alone else -1
        if not SPDX.match(text):
            block.append((number, COMMENT_MARK.sub("", text)))
    if block:
        yield block


def docstrings(path):
    """The strings of a script that stand for themselves."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Expr) and isinstance(getattr(node.value, "value", None), str):
            yield [(node.lineno + i, line.strip())
                   for i, line in enumerate(node.value.value.splitlines())]


def literals(path):
    """Each text of a source of C++, of all literals that the compiler makes one."""
    text = CPP_COMMENT.sub(lambda m: m.group() if m.group().startswith('"') else "",
                           path.read_text())
    for match in CPP_LITERALS.finditer(text):
        number = text.count("\n", 0, match.start()) + 1
        parts = re.findall(r'"((?:[^"\\\n]|\\.)*)"', match.group())
        yield [(number, "".join(parts).replace("\\n", " "))]


def files_of(*folders):
    return sorted(path for folder in folders for path in (ROOT / folder).rglob("*")
                  if path.suffix in (*CPP_SUFFIXES, ".py", ".sh") or path.name == "CMakeLists.txt")


def texts():
    """Everything that is to be plain English, as lines with their numbers."""
    for path in files_of("include", "src", "tools", "test", "examples"):
        for block in comment_blocks(path):
            yield path, block
        for block in docstrings(path) if path.suffix == ".py" else ():
            yield path, block
    for path in files_of("include", "src", "tools"):
        for block in literals(path) if path.suffix in CPP_SUFFIXES else ():
            yield path, block


def no_subject():
    for path, block in texts():
        begins, text = [], ""
        for number, line in block:
            begins.append((len(text), number))
            text += line + " "
        for match in FIRST_WORD.finditer(text):
            number = [number for begin, number in begins if begin <= match.start()][-1]
            if not text[match.end():].startswith("?"):
                yield path, number, match.group()


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
