"""Tables as plain text, for a pipe or a file: every column, whatever the width."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Sequence
from typing import Any

from geneva_cli.errors import clean
from geneva_cli.table import Table, flat, in_digits, plain_rows, record_table

WIDTH = 90  # letters of a line in a file or a pipe


def chunks(table: Table) -> Iterator[str]:
    """The table as text, line by line."""
    for text in filter(None, (table.title, table.prose)):
        for paragraph in text.split("\n"):
            yield "\n".join(textwrap.wrap(clean(paragraph), WIDTH)) + "\n"
        yield "\n"
    if not table.record:
        yield from _plain(table)
        return
    for _, piece in apart(table, plain_names=True):
        if not piece.record:
            yield "\n"
            yield from _plain(piece)
            yield "\n"
            continue
        # one line for each value, and a heading where the first part of the dotted name changes
        shown, width = [], 0
        own = flat(piece) if piece.names else piece
        for name, (value,) in zip(own.names, own.columns, strict=True):
            if value not in (None, ""):  # a value that does not apply has no line
                group, _, last = name.rpartition(".")
                shown.append((group, last, value))
                width = max(width, len(last) + (2 if group else 0))
        current = ""
        for group, name, value in shown:
            if group != current:
                yield f"{group}\n" if group else ""
                current = group
            label = f"  {name}" if group else name
            yield f"{label.ljust(width)}  {cell(value)}\n"


def cell(value: Any) -> str:
    """A value as a person wants to read it."""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return in_digits(value, 7)  # enough for people; csv and json have all digits
    return clean(str(value))


def _plain(table: Table) -> Iterator[str]:
    """Rows under their headings; empty if there are no columns."""
    if not table.names:
        return
    # names broken at underscores, so that sixteen columns stay readable
    parts = [clean(name).split("_") for name in table.names]
    height = max(len(p) for p in parts)
    heads = [[""] * (height - len(p)) + p for p in parts]
    is_first = True
    for block in table.blocks():
        rows = block if table.mixed else without_noise(block)
        lines = [[cell(v) for v in row] for row in rows]
        columns = zip(*lines, strict=True)
        widths = [
            max(map(len, (*(head if is_first else ()), *column)))
            for head, column in zip(heads, columns, strict=True)
        ]
        left = [isinstance(v, str) for v in block[0]]
        if is_first:
            for level in zip(*heads, strict=True):
                yield _line(level, widths, left)
            yield "  ".join("-" * w for w in widths) + "\n"
            is_first = False
        for line in lines:
            yield _line(line, widths, left)


def without_noise(block: list[tuple[Any, ...]]) -> Iterator[list[Any]]:
    """Rows in which numbers below 1e-13 of their column's largest, which are rounding, are 0."""
    scales = [
        max((abs(v) for v in column if isinstance(v, float) and v == v), default=0.0)
        for column in zip(*block, strict=True)
    ]
    for row in block:
        yield [
            0.0 if isinstance(v, float) and abs(v) < 1e-13 * scale < math.inf else v
            for v, scale in zip(row, scales, strict=True)
        ]


def _line(texts: Sequence[str], widths: list[int], left: list[bool]) -> str:
    cells = [
        t.ljust(w) if is_left else t.rjust(w)
        for t, w, is_left in zip(texts, widths, left, strict=True)
    ]
    return "  ".join(cells).rstrip() + "\n"


def apart(record: Table, plain_names: bool = False) -> Iterator[tuple[str, Table]]:
    """The parts of a record in order: each table with its name, and records between them.

    With ``plain_names`` a table with dotted names stays in its record.
    """
    values: dict[str, Any] = {}
    (row,) = plain_rows(record.columns) or [()]
    for name, value in zip(record.names, row, strict=True):
        dotted = isinstance(value, Table) and any("." in n for n in value.names)
        if isinstance(value, Table) and not (plain_names and dotted):
            yield "", record_table(values)
            yield name, value
            values = {}
        else:
            values[name] = value
    yield "", record_table(values)
