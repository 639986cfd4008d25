"""A page of the manual on a terminal: its Markdown, in the window's width.

It supports the Markdown of the pages: headings, paragraphs, lists, tables and blocks of code, and
within lines code, bold words and links.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from geneva_cli.output.terminal.layout import (
    BOLD,
    PLAIN,
    ShownColumn,
    Window,
    heads,
    row,
    widths,
    wrapped,
)
from geneva_cli.output.text import WIDTH

FENCE = "```"
INDENT = "  "  # before code
PROSE = 20  # letters to which a column of prose is narrowed before a table becomes a list
LINK = re.compile(r"\[([^]]+)\]\([^)]*\)")
CODE = re.compile(r"`([^`]+)`|\*\*([^*]+)\*\*")


def chunks(text: str, window: Window) -> Iterator[str]:
    """The page, line by line."""
    for block in _blocks(text):
        for line in _shown(block, window):
            yield line + "\n"


def _blocks(text: str) -> Iterator[list[str]]:
    """The lines of each heading, paragraph, item, table and code block, and empty ones between."""
    start = re.compile(r"(?=[-*] |#|\||```)")  # of a block, with or without an empty line before it
    block: list[str] = []
    for line in text.splitlines():
        if block and block[0].startswith(FENCE):
            if line.startswith(FENCE):
                yield block
                block = []
            else:
                block.append(line)
            continue
        is_row = line.startswith("|") and block and block[0].startswith("|")
        if block and not is_row and (not line or start.match(line) or block[0].startswith("#")):
            yield block
            block = []
        if line:
            block.append(line)
        else:
            yield [""]
    if block:
        yield block


def _shown(block: list[str], window: Window) -> Iterator[str]:
    first = block[0]
    if first.startswith(FENCE):
        for line in block[1:]:
            yield from (INDENT + part for part in _broken(line, window.columns - len(INDENT)))
    elif first.startswith(4 * " "):  # code without fences
        for line in block:
            yield from _broken(line, window.columns)
    elif first.startswith("|"):
        yield from _table(block, window)
    elif first.startswith("#") and window.styled:
        for line in wrapped(_bare(first.lstrip("# ")), window.columns):
            yield f"{BOLD}{line}{PLAIN}"
    else:
        is_item = first.startswith(("- ", "* "))
        text = " ".join(line.strip() for line in block)
        width = min(window.columns, WIDTH) - len(INDENT) * is_item
        lines = wrapped(LINK.sub(r"\1", text), width)
        yield _marked(("\n" + INDENT * is_item).join(lines), window)


def _broken(line: str, width: int) -> list[str]:
    """A line of code, broken between words in a narrow window; a rule is shortened."""
    if not any(map(str.isalnum, line)):
        return [line[:width].rstrip()]
    first, *more = wrapped(line, width)
    rest = " ".join(more)
    return [first, *(2 * INDENT + part for part in wrapped(rest, width - 2 * len(INDENT)) if rest)]


def _table(block: list[str], window: Window) -> Iterator[str]:
    rows = [[_bare(cell.strip()) for cell in line.strip("|").split("|")] for line in block]
    rule = re.compile(r"\|[-:| ]+")  # the line below the headings
    names, *rows = [r for r, line in zip(rows, block, strict=True) if not rule.fullmatch(line)]
    columns = [
        ShownColumn(name, name, "", cells, True) for name, *cells in zip(names, *rows, strict=True)
    ]
    sizes = widths(columns, window.columns, PROSE)
    if sizes is not None:
        yield from heads(columns, sizes, window.styled)
        for texts in rows:
            yield from row(texts, sizes, [True] * len(sizes))
        return
    for texts in rows:
        for name, text in zip(names, texts, strict=True):
            yield from wrapped(f"{name}: {text}" if name else text, window.columns)
        yield ""


def _bare(text: str) -> str:
    return CODE.sub(lambda match: match[1] or match[2], LINK.sub(r"\1", text))


def _marked(text: str, window: Window) -> str:
    """Code and bold words in bold, also across lines; unchanged on a terminal without bold."""
    if not window.styled:
        return text

    def bold(match: re.Match[str]) -> str:
        words = match[1] or match[2]
        return BOLD + words.replace("\n", f"{PLAIN}\n{BOLD}") + PLAIN

    return CODE.sub(bold, text)
