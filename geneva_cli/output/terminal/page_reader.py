"""A page of the manual on a terminal: its Markdown, by Rich, in the window's width."""

import io
import re
from collections.abc import Iterator
from typing import ClassVar

from rich.console import Console, ConsoleOptions, RenderResult
from rich.default_styles import DEFAULT_STYLES
from rich.markdown import CodeBlock, Heading, Markdown, TableElement
from rich.text import Text
from rich.theme import Theme

from geneva_cli.output.terminal import layout
from geneva_cli.output.terminal.layout import ShownColumn, Window

INDENT = "  "  # before code
PROSE = 20  # letters to which a column of prose is narrowed before a table becomes a list
LINK = re.compile(r"\[([^]]+)\]\([^)]*\)")
BOLD = re.compile(r"markdown\.(h\d|code|strong)")
LOOK = Theme({name: "bold" if BOLD.fullmatch(name) else "none" for name in DEFAULT_STYLES})


class _Heading(Heading):
    LEVEL_ALIGN: ClassVar = {}  # all at the left


class _Code(CodeBlock):
    """Lines as they stand, indented; a longer one is broken between words, a rule is shortened."""

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        width = options.max_width - len(INDENT)
        for line in str(self.text).rstrip().split("\n"):
            is_rule = not any(map(str.isalnum, line))
            for part in [line[:width]] if is_rule else layout.wrapped(line, width):
                yield Text(INDENT + part)


class _Table(TableElement):
    """Columns as in our tables, as Rich breaks words; in a narrow window a value a line."""

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        assert self.header and self.header.row and self.body
        lines = [self.header.row, *self.body.rows]
        names, *rows = ([cell.content.plain for cell in line.cells] for line in lines)
        columns = [
            ShownColumn(n, n, "", cells, True) for n, *cells in zip(names, *rows, strict=True)
        ]
        sizes = layout.widths(columns, options.max_width, PROSE)
        if sizes:
            yield from (Text(line, "bold") for line in layout.heads(columns, sizes, False))
        for row in rows:
            if sizes:
                yield from map(Text, layout.row(row, sizes, [True] * len(sizes)))
                continue
            for name, text in zip(names, row, strict=True):
                text = f"{name}: {text}" if name else text
                yield from map(Text, layout.wrapped(text, options.max_width))
            yield Text()


class _Page(Markdown):
    elements: ClassVar = {
        **Markdown.elements,
        "heading_open": _Heading,
        "fence": _Code,
        "code_block": _Code,
        "table_open": _Table,
    }


def chunks(text: str, window: Window) -> Iterator[str]:
    """The page, line by line."""
    shown = io.StringIO()
    screen = Console(
        file=shown,
        width=min(window.columns, layout.READABLE),
        force_terminal=window.styled,
        color_system="standard" if window.styled else None,
        theme=LOOK,
        legacy_windows=False,
    )
    screen.print(_Page(LINK.sub(r"\1", text)))
    yield from (f"{line.rstrip()}\n" for line in shown.getvalue().splitlines())
