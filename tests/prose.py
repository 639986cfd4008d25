"""Measures of the project's English: words a sentence, and how docstrings begin."""

from __future__ import annotations

import ast
import re
import statistics
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

from repo import ROOT

PACKAGE = ROOT / "geneva_cli"
# First words that put the subject last, or that need another text to be understood.
POOR_STARTS = ("What", "Of", "Whether", "How", "Where", "Which", "The same")
# Strings of fewer words are names, keys and parts of other texts.
SHOWN_WORDS = 4
# A sentence ends at a full stop before a capital, a quote or a code word; not after "e.g." or "z."
_ENDS = re.compile(r"(?<=[.!?])(?<!e\.g\.)(?<!i\.e\.)(?<!cf\.)(?<!No\.)\s+(?=[A-Z`\"'(*\d])")
_FENCE = re.compile(r"^(```|~~~).*?^\1\s*$", re.MULTILINE | re.DOTALL)
_ARGUMENTS = re.compile(r"^(Args|Arguments|Parameters|Returns|Raises|Example|Examples):$")


class Sentence(NamedTuple):
    """A sentence, and where it stands."""

    where: str
    text: str

    @property
    def words(self) -> int:
        """Count of words: what has a letter or a digit, between spaces."""
        return sum(any(c.isalnum() for c in word) for word in self.text.split())


class Measures(NamedTuple):
    """Words a sentence: mean, the number that 90 % do not exceed, and the longest."""

    total: int
    mean: float
    nine_tenths: int
    longest: int

    @classmethod
    def of(cls, sentences: list[Sentence]) -> Measures:
        """Measures of some sentences."""
        words = sorted(s.words for s in sentences) or [0]
        high = words[min(int(0.9 * len(words)), len(words) - 1)]
        return cls(len(sentences), statistics.fmean(words), high, words[-1])


def split(text: str, where: str) -> Iterator[Sentence]:
    """Sentences of a plain text, whose paragraphs are apart by empty lines."""
    for paragraph in re.split(r"\n\s*\n", text):
        for sentence in _ENDS.split(" ".join(paragraph.split())):
            if sum(c.isalpha() for c in sentence) > 2:
                yield Sentence(where, sentence)


def page_sentences(path: Path) -> list[Sentence]:
    """Sentences of a Markdown page, without code, formulas, tables, headings and pictures."""
    text = _FENCE.sub("\n\n", path.read_text(encoding="utf-8"))
    lines = []
    for line in text.splitlines():
        bare = line.strip()
        if bare.startswith(("#", "|", "![", "<", "- Formula: `")) or line.startswith("    "):
            lines.append("")
        elif re.match(r"([-*+]|\d+\.)\s", bare):
            lines += ["", re.sub(r"^([-*+]|\d+\.)\s+", "", bare)]
        else:
            lines.append(bare)
    return list(split("\n".join(lines), str(path.relative_to(ROOT))))


class Docstring(NamedTuple):
    """A docstring and its place."""

    where: str
    text: str

    @property
    def poor_start(self) -> bool:
        """Its first words are among ``POOR_STARTS``."""
        return re.match(rf"({'|'.join(POOR_STARTS)})\b", self.text) is not None


@cache
def texts(path: Path) -> tuple[list[Docstring], list[Sentence]]:
    """Docstrings and messages of a Python file, whose syntax tree is not kept."""
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    name = str(path.relative_to(ROOT))
    return list(docstrings(nodes, name)), list(messages(nodes, name))


def docstrings(nodes: list[ast.AST], file: str) -> Iterator[Docstring]:
    """All docstrings among the nodes of a file."""
    kinds = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    for node in nodes:
        if isinstance(node, kinds) and (text := ast.get_docstring(node)):
            yield Docstring(f"{file}:{getattr(node, 'lineno', 1)}", text)


# an item of a list: a word with its meaning, an option in a help, or an example
_OF_LIST = re.compile(r"(\w+|[-*]|``\w+``)( \([^)]*\))?: |\S+( \S+)* {2,}\S|geneva ")


def docstring_sentences(doc: Docstring) -> list[Sentence]:
    """Sentences of a docstring, without its examples and the names of its sections."""
    lines, code = [], False
    for line in doc.text.splitlines():
        bare = line.strip()
        code = bare.startswith((">>>", "...")) or (code and bool(bare))
        if code or _ARGUMENTS.match(bare) or bare.endswith("::"):
            lines.append("")
        elif _OF_LIST.match(bare):
            lines += ["", bare]
        else:
            lines.append(bare)
    return list(split("\n".join(lines), doc.where))


def messages(nodes: list[ast.AST], file: str) -> Iterator[Sentence]:
    """Sentences that a file shows to users: strings of ``SHOWN_WORDS`` words, but docstrings.

    Errors, warnings, advice, help of options and texts of tables are all of them; a value that is
    filled in stands as X. Strings with markup or braces are code.
    """
    inner = {
        id(part)
        for node in nodes
        if isinstance(node, ast.JoinedStr)
        for part in ast.walk(node)
        if part is not node
    }
    inner |= {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    for node in nodes:
        if id(node) not in inner and isinstance(node, ast.expr):
            text = _literal(node)
            code = re.search(r"[{}<>]|--[a-z-]+:|\w\*\d|\w:[a-z]", text)
            if len(text.split()) >= SHOWN_WORDS and not code:
                yield from split(text, f"{file}:{node.lineno}")


def _literal(node: ast.expr) -> str:
    """Text of a string, with X where a value is filled in."""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else ""
    if isinstance(node, ast.JoinedStr):
        return "".join(_literal(v) if isinstance(v, ast.Constant) else "X" for v in node.values)
    return ""


def files(paths: list[Path], ending: str) -> list[Path]:
    """Files with an ending among paths and in their folders, sorted."""
    result = set()
    for path in paths:
        result |= set(path.rglob(f"*{ending}")) if path.is_dir() else {path}
    return sorted(path for path in result if path.name.endswith(ending))
