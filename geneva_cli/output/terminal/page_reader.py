"""A page of the manual on a terminal: its Markdown, in the window's width.

It supports the Markdown of the pages: headings, paragraphs, lists, tables and blocks of code, and
within lines code, bold words and links.
"""

import re
from collections.abc import Iterator

from geneva_cli.output.terminal import layout
from geneva_cli.output.terminal.layout import BOLD, PLAIN, ShownColumn, Window
from geneva_cli.output.text import WIDTH

INDENT = "  "  # before code
PROSE = 20  # letters to which a column of prose is narrowed before a table becomes a list
LINK = re.compile(r"\[([^]]+)\]\([^)]*\)")
CODE = re.compile(r"`([^`]+)`|\*\*([^*]+)\*\*")
START = r"[-*] |#|\||```"  # of a block, with or without an empty line before it
BLOCK = re.compile(
    r"(?:```.*\n(?P<code>(?:(?!```).*\n)*)(?:```.*)?"
    r"|(?P<table>\|.*(?:\n\|.*)*)"
    r"|(?P<head>#.*)"
    rf"|(?P<text>.+(?:\n(?!{START}).+)*)|(?=\n))\n?"  # or an empty line
)
RULE = re.compile(r"\|[-:| ]+")  # the line below the headings of a table


def chunks(text: str, window: Window) -> Iterator[str]:
    """The page, line by line."""
    for block in BLOCK.finditer(text):
        for line in _shown(block.lastgroup, block[block.lastgroup or 0].strip("\n"), window):
            yield f"{line}\n"


def _shown(kind: str | None, text: str, window: Window) -> Iterator[str]:
    """The lines of a heading, a paragraph, an item, a table or a block of code."""
    if kind == "code":
        for line in text.splitlines():
            yield from (INDENT + part for part in _broken(line, window.columns - len(INDENT)))
    elif text.startswith(4 * " "):  # code without fences
        for line in text.splitlines():
            yield from _broken(line, window.columns)
    elif kind == "table":
        yield from _table(text.splitlines(), window)
    elif kind == "head" and window.styled:
        for line in layout.wrapped(_bare(text.lstrip("# ")), window.columns):
            yield f"{BOLD}{line}{PLAIN}"
    else:
        indent = INDENT * text.startswith(("- ", "* "))
        text = LINK.sub(r"\1", " ".join(line.strip() for line in text.splitlines()))
        text = f"\n{indent}".join(layout.wrapped(text, min(window.columns, WIDTH) - len(indent)))
        if window.styled:  # code and bold words in bold, also across lines
            text = CODE.sub(
                lambda m: BOLD + (m[1] or m[2]).replace("\n", f"{PLAIN}\n{BOLD}") + PLAIN, text
            )
        yield text


def _broken(line: str, width: int) -> list[str]:
    """A line of code, broken between words in a narrow window; a rule is shortened."""
    if not any(map(str.isalnum, line)):
        return [line[:width].rstrip()]
    first, *more = layout.wrapped(line, width)
    rest = layout.wrapped(" ".join(more), width - 2 * len(INDENT)) if more else []
    return [first, *(2 * INDENT + part for part in rest)]


def _table(block: list[str], window: Window) -> Iterator[str]:
    lines = [line for line in block if not RULE.fullmatch(line)]
    names, *rows = [[_bare(cell.strip()) for cell in line.strip("|").split("|")] for line in lines]
    columns = [
        ShownColumn(name, name, "", cells, True) for name, *cells in zip(names, *rows, strict=True)
    ]
    sizes = layout.widths(columns, window.columns, PROSE)
    if sizes is not None:
        yield from layout.heads(columns, sizes, window.styled)
        for texts in rows:
            yield from layout.row(texts, sizes, [True] * len(sizes))
        return
    for texts in rows:
        for name, text in zip(names, texts, strict=True):
            yield from layout.wrapped(f"{name}: {text}" if name else text, window.columns)
        yield ""


def _bare(text: str) -> str:
    return CODE.sub(lambda match: match[1] or match[2], LINK.sub(r"\1", text))
