"""Tables for people: plain columns on a pipe, Rich on a terminal."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator
from typing import Any

from geneva_cli.errors import clean
from geneva_cli.table import Table, flat, in_digits

WIDTH = 90
HELD = 10_000  # rows that a terminal gets with frames: they are laid out as a whole
NOISE = 1e-13
DIGITS = 7  # significant digits for people; csv and json carry all


def chunks(table: Table, terminal: bool) -> Iterator[str]:
    """The table as text, line by line."""
    if terminal and not table.record and len(table) <= HELD:
        yield from _rich(table)
        return
    if table.title:
        yield "\n".join(paragraphs(table.title)) + "\n\n"
    if table.prose:
        yield "\n".join(paragraphs(table.prose)) + "\n\n"
    yield from _record(table) if table.record else _plain(table)


def cell(value: Any) -> str:
    """A value as a person wants to read it."""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return in_digits(value, DIGITS)
    return clean(str(value))


def paragraphs(text: str) -> list[str]:
    """A text of one or more paragraphs, broken into lines that fit a terminal."""
    lines = []
    for paragraph in text.split("\n"):
        lines += textwrap.wrap(clean(paragraph), WIDTH) or [""]
    return lines


def _headings(names: tuple[str, ...]) -> list[list[str]]:
    """Column names broken at underscores, so that sixteen columns stay readable."""
    parts = [clean(name).split("_") for name in names]
    height = max(len(p) for p in parts)
    return [[""] * (height - len(p)) + p for p in parts]


def _plain(table: Table) -> Iterator[str]:
    """Rows under their headings; nothing where none are left of both."""
    if not table.names:
        return
    heads = _headings(table.names)
    for block in table.blocks():
        rows = block if table.mixed else _without_noise(block)
        lines = [[cell(v) for v in row] for row in rows]
        widths = [
            max(len(text) for text in (*head, *(line[i] for line in lines)))
            for i, head in enumerate(heads)
        ]
        left = [isinstance(v, str) for v in block[0]]
        if heads[0]:
            for level in range(len(heads[0])):
                yield _line([h[level] for h in heads], widths, left)
            yield "  ".join("-" * w for w in widths) + "\n"
            heads = [[] for _ in heads]
        for line in lines:
            yield _line(line, widths, left)


def _without_noise(block: list[tuple[Any, ...]]) -> Iterator[list[Any]]:
    """Rows in which a number that is only rounding beside its column's largest is shown as 0."""
    scales = [
        max((abs(v) for v in column if isinstance(v, float) and v == v), default=0.0)
        for column in zip(*block, strict=True)
    ]
    for row in block:
        yield [
            0.0 if isinstance(v, float) and abs(v) < NOISE * scale < math.inf else v
            for v, scale in zip(row, scales, strict=True)
        ]


def _line(texts: list[str], widths: list[int], left: list[bool]) -> str:
    cells = [
        t.ljust(w) if is_left else t.rjust(w)
        for t, w, is_left in zip(texts, widths, left, strict=True)
    ]
    return "  ".join(cells).rstrip() + "\n"


def _record(table: Table) -> Iterator[str]:
    """One line a value, a heading where the first part of the dotted name changes.

    Tables in it whose names are plain stand as tables, after what is before them.
    """
    every = next(table.rows(), ())
    for i, value in enumerate(every):
        if isinstance(value, Table) and not any("." in name for name in value.names):
            before, after = (
                Table(table.names[part], [(v,) for v in every[part]], True)
                for part in (slice(i), slice(i + 1, None))
            )
            yield from _record(before)
            yield "\n"
            yield from _plain(value)
            yield "\n"
            yield from _record(after)
            return
    if not every:
        return
    table = flat(table)
    # What does not apply is no line for a person.
    shown = [pair for pair in zip(table.names, next(table.rows()), strict=True) if _is(pair[1])]
    row = [value for _, value in shown]
    split = [name.rpartition(".") for name, _ in shown]
    width = max((len(name) + (2 if group else 0) for group, _, name in split), default=0)
    current = ""
    for (group, _, name), value in zip(split, row, strict=True):
        if group != current:
            yield f"{group}\n" if group else ""
            current = group
        label = f"  {name}" if group else name
        yield f"{label.ljust(width)}  {cell(value)}\n"


def _is(value: Any) -> bool:
    return value is not None and value != ""


def _rich(table: Table) -> Iterator[str]:
    import io

    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table as RichTable
    from rich.text import Text

    out = RichTable(
        box=SIMPLE_HEAD, title=Text(clean(table.title)) if table.title else None, padding=(0, 1)
    )
    rows = list(table.rows())
    for i, head in enumerate(_headings(table.names)):
        is_text = bool(rows) and isinstance(rows[0][i], str)
        out.add_column(Text("\n".join(head)), justify="left" if is_text else "right", no_wrap=True)
    for row in rows:
        out.add_row(*[Text(cell(v)) for v in row])
    console = Console(file=io.StringIO(), force_terminal=True)
    # A table wider than the window is shown whole: a number cut short is a wrong number.
    needed = console.measure(out, options=console.options.update(width=10_000)).maximum
    console.width = max(needed, 40)
    console.print(out)
    file = console.file
    assert isinstance(file, io.StringIO)
    yield file.getvalue()
