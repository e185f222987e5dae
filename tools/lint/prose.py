#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Counts faults of prose, and fails when there are more than tools/lint/prose.txt says.

  wide_lines    lines above 100 columns in README.md, CHANGELOG.md, CONTRIBUTING.md and docs/
  no_subject    sentences whose first word is a preposition or a pronoun that stands for the subject
                (of the points ... instead of the points ...): in comments and docstrings, in the
                texts that programs and pages print, and in the same pages of Markdown (paragraphs,
                lists and headings; no tables and no code). A comment, a text or a heading may not
                begin so in lower case either. A question may.
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
SENTENCE = (r"(?:^[^\w\s]*(?i:{words})|(?:^|(?<=[.:;?!] )|(?<=[.:;?!]\) ))[^\w\s]*(?:{more}))\b"
            r"[^?]*?(?=[.:;!?]|$)")
WORDS = "of|what|where|that"
FIRST_WORD = re.compile(SENTENCE.format(words=WORDS, more="Of|What|Where|That|By|With"))
# A page may begin a sentence with By or With: its sentences are long enough for a subject behind.
FIRST_WORD_OF_PAGE = re.compile(SENTENCE.format(words=WORDS, more="Of|What|Where|That"))
SPDX = re.compile(r"\W*SPDX-")
CPP_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*')
CPP_LITERALS = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')
CPP_SUFFIXES = (".cpp", ".hpp", ".js", ".lcm")
SHELL_SUFFIXES = (".py", ".sh", ".cmake", ".yaml")
MARKDOWN_MARK = re.compile(r"^\s*(?:#+|[-*]|\d+\.)\s+")
SHELL_COMMENT = re.compile(r"(?:^|(?<=\s))#[^\n]*")
COMMENT_MARK = re.compile(r"^(//+|#+)\s*")


def pages():
    return [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md"))]


def wide_lines():
    for page in pages():
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
    pattern = CPP_COMMENT if path.suffix in CPP_SUFFIXES else SHELL_COMMENT
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


def paragraphs(path):
    """Each heading, paragraph and entry of a list of a page; neither tables nor code."""
    block, is_code = [], False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        mark = MARKDOWN_MARK.match(line)
        is_fence = line.lstrip().startswith("```")
        is_code = is_code != is_fence
        is_prose = line.strip() and not is_code and not is_fence and line[0] not in "|<" and (
            mark or block or not line.startswith("    "))
        if block and (mark or not is_prose):
            yield block
            block = []
        if is_prose:
            block.append((number, MARKDOWN_MARK.sub("", line).strip()))
        if line.startswith("#"):
            yield block
            block = []
    if block:
        yield block


def files_of(*folders):
    return sorted(path for folder in folders for path in (ROOT / folder).rglob("*")
                  if path.suffix in (*CPP_SUFFIXES, *SHELL_SUFFIXES)
                  or path.name == "CMakeLists.txt")


def texts():
    """Everything that is to be plain English, as lines with their numbers."""
    folders = ("include", "src", "tools", "test", "examples", "cmake", "config", "lcmtypes")
    single = [ROOT / name for name in ("CMakeLists.txt", ".clang-tidy", ".ci/run")]
    for path in [*single, *files_of(*folders)]:
        for block in comment_blocks(path):
            yield path, block
        for block in docstrings(path) if path.suffix == ".py" else ():
            yield path, block
    for path in files_of("include", "src", "tools"):
        for block in literals(path) if path.suffix in CPP_SUFFIXES else ():
            yield path, block


def no_subject():
    blocks = [*((FIRST_WORD, *text) for text in texts()),
              *((FIRST_WORD_OF_PAGE, page, block) for page in pages() for block in paragraphs(page))]
    for pattern, path, block in blocks:
        begins, text = [], ""
        for number, line in block:
            begins.append((len(text), number))
            text += line + " "
        for match in pattern.finditer(text):
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
