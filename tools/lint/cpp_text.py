# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Reads classes and functions from the text of a C++ source, without a compiler.

A compiler needs seconds a file for Eigen's headers; this needs milliseconds, and is sound for code
that clang-format has laid out and that declares no function or class by a macro of its own.
"""
import dataclasses
import re

TOKEN = re.compile(
    r"""(?P<skip>//[^\n]*|/\*.*?\*/|^[ \t]*\#(?:[^\n\\]|\\.|\\\n)*)
      |(?P<text>R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:[^"\\\n]|\\.)*"|(?<!\w)'(?:[^'\\\n]|\\.)+')
      |(?P<number>\d[\w.']*)
      |(?P<word>[A-Za-z_]\w*)
      |(?P<sign>::|->|&&|\|\||<=|>=|==|!=|[^\s\w])""",
    re.VERBOSE | re.DOTALL | re.MULTILINE)
NOT_DATA = {"using", "typedef", "friend", "static", "static_assert", "template", "enum"}
CLASS_WORDS = {"class", "struct", "union"}
BRACKETS = {"(": ")", "[": "]", "{": "}"}


@dataclasses.dataclass
class Token:
    text: str
    line: int


@dataclasses.dataclass
class Class:
    name: str
    line: int
    num_members: int = 0
    num_methods: int = 0
    namespace: tuple = ()  # from outside in; an unnamed one is ""


@dataclasses.dataclass
class Function:
    name: str
    line: int
    num_lines: int


def tokens_of(text):
    """All tokens but comments and preprocessor lines; a string is one token."""
    found, line, at = [], 1, 0
    for match in TOKEN.finditer(text):
        line += text.count("\n", at, match.start())
        at = match.start()
        if match.lastgroup != "skip":
            found.append(Token('""' if match.group("text") else match.group(), line))
    return found


class Reader:
    """Walks over scopes: what a namespace or class declares, function bodies as a whole."""

    def __init__(self, text):
        self.tokens = tokens_of(text)
        self.classes = []
        self.functions = []
        self.namespaces = []
        self._read_scope(0, None, "")

    def _end_of(self, at):
        """The index behind the bracket that closes the one at `at`."""
        opening, closing = self.tokens[at].text, BRACKETS[self.tokens[at].text]
        depth = 0
        while at < len(self.tokens):
            text = self.tokens[at].text
            depth += (text == opening) - (text == closing)
            at += 1
            if depth == 0:
                break
        return at

    def _read_scope(self, at, owner, prefix):
        """Reads declarations up to the closing brace of the scope, whose index it gives."""
        start = at
        while at < len(self.tokens) and self.tokens[at].text != "}":
            text = self.tokens[at].text
            if at == start and text in ("public", "private", "protected"):
                at = start = at + 2  # with its colon
            elif text == ";":
                self._count(self.tokens[start:at], owner)
                at = start = at + 1
            elif text == "{":
                at = start = self._read_braces(start, at, owner, prefix)
            elif text in ("(", "["):
                at = self._end_of(at)
            else:
                at += 1
        return at

    def _read_braces(self, start, at, owner, prefix):
        """Tells by the words before a brace what it opens; gives where the next declaration is."""
        head = without_brackets(self.tokens[start:at])
        words = [token.text for token in head]
        if "namespace" in words or words[:1] == ["extern"]:
            self.namespaces.append("".join(words[words.index("namespace") + 1:])
                                   if "namespace" in words else "extern")
            end = self._read_scope(at + 1, None, prefix) + 1
            self.namespaces.pop()
            return end
        if is_class(words):
            return self._read_class(start, at, owner, prefix, words)
        if "enum" in words or not is_function(words):
            # An enumeration, or a member's or a constant's initial value.
            end = self._end_of(at)
            while end < len(self.tokens) and self.tokens[end].text != ";":
                end = self._end_of(end) if self.tokens[end].text in BRACKETS else end + 1
            self._count(self.tokens[start:end], owner)
            return end + 1
        end = self._end_of(at)
        while end < len(self.tokens) and self.tokens[end].text in ("{", ","):
            # The brace was a base's or a member's initial value; the body follows.
            while self.tokens[end].text != "{":
                end += 1
            end = self._end_of(end)
        self._add_function(start, end, words, owner, prefix)
        # Clang accepts a stray ";" behind a body; it declares nothing.
        return end

    def _read_class(self, start, at, owner, prefix, words):
        where = max(words.index(word) for word in CLASS_WORDS if word in words)
        name = prefix + class_name(words[where + 1:])
        found = Class(name, self.tokens[start].line, namespace=tuple(self.namespaces))
        self.classes.append(found)
        end = self._read_scope(at + 1, found, name + "::") + 1
        behind = end
        while behind < len(self.tokens) and self.tokens[behind].text != ";":
            behind += 1
        if behind > end and owner:  # struct {...} member;
            owner.num_members += 1
        return behind + 1

    def _add_function(self, start, end, words, owner, prefix):
        if owner:
            owner.num_methods += 1
        before = words[:words.index("(")]
        name = prefix + (before[-1] if before else "")
        if name.startswith("TEST"):
            inner = [token.text for token in self.tokens[start:start + 6]]
            name = f"{inner[2]}.{inner[4]}"
        line = self.tokens[start].line
        self.functions.append(Function(name, line, self.tokens[end - 1].line - line + 1))

    def _count(self, statement, owner):
        """Counts a declaration that ended with a semicolon as a member or a method of its class."""
        if owner is None:
            return
        texts = [token.text for token in statement]
        words = [token.text for token in without_brackets(statement)]
        if not words:
            return
        if is_function(words):
            owner.num_methods += "friend" not in words and "using" not in words
        elif words[0] == "enum":
            owner.num_members += "}" in words and words[-1] != "}"  # enum {...} member;
        elif not NOT_DATA & set(texts[:3]) and not is_forward(words):
            owner.num_members += 1 + words.count(",")


def without_brackets(tokens):
    """The tokens outside of all brackets, <...> included, and the outermost brackets."""
    kept, depth, angle = [], 0, 0
    for index, token in enumerate(tokens):
        text = token.text
        if text in ("(", "[", "{"):
            if depth == 0 and angle == 0:
                kept.append(token)
            depth += 1
        elif text in (")", "]", "}"):
            depth -= 1
            if depth == 0 and angle == 0:
                kept.append(token)
        elif depth == 0:
            before = tokens[index - 1].text if index else ""
            if text == "<" and re.fullmatch(r"\w+", before) and before != "operator":
                angle += 1
            elif text == ">" and angle:
                angle -= 1
            elif angle == 0:
                kept.append(token)
    return kept


def is_class(words):
    """A class is opened, not a function or a variable of a class's type."""
    return bool(CLASS_WORDS & set(words)) and "(" not in after_attributes(words) and \
        "=" not in words and "enum" not in words


def after_attributes(words):
    """The words but for alignas(...) and the like between `struct` and the name."""
    text = " ".join(words)
    return re.sub(r"\b(alignas|__attribute__) \( \)", "", text).split()


def class_name(words):
    text = re.sub(r"\b(alignas|__attribute__) \( \)|\[ \]", "", " ".join(words))
    return re.split(r" : | final\b|$", text)[0].replace(" ", "") or "(unnamed)"


def is_function(words):
    """A parenthesis comes before any initial value: a function, not data."""
    for word in words:
        if word == "operator":
            return True
        if word in ("=", "{"):
            return False
        if word == "(":
            return True
    return False


def is_forward(words):
    return len(words) >= 2 and words[-2] in CLASS_WORDS or words == ["}"]
