"""Tables on a terminal: within the window's width, with a note on omitted columns."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import Any

from geneva_cli.names import heading, spoken
from geneva_cli.output.terminal.fitted import rows_of
from geneva_cli.output.terminal.layout import BOLD, GAP, styled, width_of, wrapped
from geneva_cli.output.terminal.shown_values import bare, value
from geneva_cli.output.terminal.window import Window, paragraphs
from geneva_cli.output.text import WIDTH, apart
from geneva_cli.table import Table


def chunks(table: Table, window: Window) -> Iterator[str]:
    """The table as text, line by line."""
    title, prose = table.reading.title or table.title, table.prose
    text = [*paragraphs(title, window, BOLD), *[""] * bool(title)]
    text += [*paragraphs(prose, window), *[""] * bool(prose)]
    for line in chain(text, _record(table, window) if table.record else rows_of(table, window)):
        yield line + "\n"


def _record(table: Table, window: Window) -> Iterator[str]:
    """One line for each value, grouped by names; tables within it as tables."""
    is_first = True
    for name, part in apart(table):
        lines = list(_values(part, window) if part.record else rows_of(part, window, True))
        if not lines:
            continue
        if not is_first:
            yield ""
        if name:
            yield styled(heading(name), BOLD, window.styled)
            yield from paragraphs(part.reading.title, window)
        yield from lines
        is_first = False


def _values(record: Table, window: Window) -> Iterator[str]:
    shown = []
    for name, cell in zip(record.names, next(record.rows(), ()), strict=True):
        if cell is not None and cell != "":
            group, _, last = name.rpartition(".")
            shown.append((group, last, cell))
    labels = [("  " if group else "") + spoken(last)[0] for group, last, _ in shown]
    width = max(map(width_of, labels), default=0)
    current = ""
    for label, (group, last, cell) in zip(labels, shown, strict=True):
        if group != current:
            yield styled(heading(group), BOLD, window.styled)
            current = group
        yield from _value(label, width, _paragraphs(cell, spoken(last)[1]), window)


def _paragraphs(cell: Any, unit: str) -> list[str]:
    """The paragraphs of a value."""
    if not isinstance(cell, tuple):
        return [value(cell, unit)]
    if all(isinstance(one, (int, float)) for one in cell) and cell:
        return [f"{', '.join(bare(one, '') for one in cell)} {unit}".rstrip()]
    return [value(one) for one in cell] or ["none"]


def _value(label: str, width: int, texts: list[str], window: Window) -> Iterator[str]:
    """A label and its value, in several lines if it is long."""
    free = window.columns - width - len(GAP)
    # A long value stands below its label if fewer than 30 letters are free behind it.
    if len(texts) == 1 and (width_of(texts[0]) <= free or free >= 30):
        first, *more = wrapped(texts[0], free)
        yield f"{label}{' ' * (width - width_of(label))}{GAP}{first}"
        for line in more:
            yield " " * (width + len(GAP)) + line
        return
    yield label
    indent = " " * (len(label) - len(label.lstrip()) + len(GAP))
    for text in texts:
        first, *more = wrapped(text, min(window.columns, WIDTH) - len(indent) - len(GAP))
        yield f"{indent}- {first}"
        for line in more:
            yield f"{indent}  {line}"
