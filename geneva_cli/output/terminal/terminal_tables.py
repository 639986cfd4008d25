"""Tables on a terminal: within the window's width, with a note on omitted columns."""

import re
from collections.abc import Iterator, Sequence
from itertools import chain
from typing import Any

from geneva_cli.errors import clean
from geneva_cli.names import heading, spoken
from geneva_cli.output.terminal import layout
from geneva_cli.output.terminal.layout import BOLD, DIM, ShownColumn, Window
from geneva_cli.output.text import GAP, WIDTH, apart, width_of, without_noise
from geneva_cli.table import Table


def chunks(table: Table, window: Window) -> Iterator[str]:
    """The table as text, line by line."""
    title, prose = table.reading.title or table.title, table.prose
    text = [*layout.paragraphs(title, window, BOLD), *[""] * bool(title)]
    text += [*layout.paragraphs(prose, window), *[""] * bool(prose)]
    for line in chain(text, _record(table, window) if table.record else rows_of(table, window)):
        yield line + "\n"


def _record(table: Table, window: Window) -> Iterator[str]:
    """One line for each value, grouped by names; tables within it as tables."""
    is_first = True
    for name, part in apart(table):
        lines = list(_values(part, window) if part.record else rows_of(part, window))
        if not lines:
            continue
        if not is_first:
            yield ""
        if name:
            yield layout.styled(heading(name), BOLD, window.styled)
            yield from layout.paragraphs(part.reading.title, window)
        yield from lines
        is_first = False


def _values(record: Table, window: Window) -> Iterator[str]:
    shown = []
    for name, cell in zip(record.names, next(record.rows(), ()), strict=True):
        if cell is not None and cell != "":
            group, _, last = name.rpartition(".")
            words, unit = spoken(last)
            if not isinstance(cell, tuple):
                texts = [layout.value(cell, unit)]
            elif cell and all(isinstance(v, (int, float)) for v in cell):
                texts = [f"{', '.join(layout.bare(one, '') for one in cell)} {unit}".rstrip()]
            else:
                texts = [*map(layout.value, cell)] or ["none"]
            shown.append((group, "  " * bool(group) + words, texts))
    width = max((width_of(label) for _, label, _ in shown), default=0)
    free, current = window.columns - width - len(GAP), ""
    for group, label, texts in shown:
        if group != current:
            yield layout.styled(heading(group), BOLD, window.styled)
            current = group
        # A long value stands below its label if fewer than 30 letters are free behind it.
        if len(texts) == 1 and (width_of(texts[0]) <= free or free >= 30):
            yield from layout.row((label, texts[0]), (width, free), (True, True))
            continue
        yield label
        indent = " " * (len(label) - len(label.lstrip()) + len(GAP))
        for text in texts:
            first, *more = layout.wrapped(text, min(window.columns, WIDTH) - len(indent) - len(GAP))
            yield f"{indent}- {first}"
            yield from (f"{indent}  {line}" for line in more)


def rows_of(table: Table, window: Window) -> Iterator[str]:
    """Rows under their headings: as many columns as fit, and a note on the others.

    A single row that does not fit is a value a line.
    """
    rows = [*table.rows()]
    if not rows:
        yield from ["no rows"] if table.names else []
        return
    all_columns = _columns(table, rows)
    columns, once = (all_columns, []) if window.whole else _sorted_out(all_columns, table)
    if once:
        yield from layout.paragraphs(f"In every row: {'; '.join(once)}.", window)
        yield ""
    order = [*table.reading.first, *(n for n in table.names if n not in table.reading.first)]
    width = 1_000_000 if window.wide else window.columns  # a million letters: without a limit
    kept, sizes = layout.fitting(columns, order, width)
    lost = [column for column in columns if column not in kept]
    if lost and len(rows) == 1 and not table.reading.designs:
        yield from _values(table, window)
        return
    if not table.mixed:
        pointed = [column._replace(cells=_aligned(column.cells)) for column in kept]
        if wider := layout.widths(pointed, width):
            sizes, kept = wider, pointed
    yield from layout.heads(kept, sizes, window.styled)
    is_text = [column.is_text for column in kept]
    for texts in zip(*(column.cells for column in kept), strict=True):
        yield from layout.row(texts, sizes, is_text)
    if lost:
        rest = sorted((column.name for column in lost), key=order.index)
        one = "1 more column" if len(rest) == 1 else f"{len(rest)} more columns"
        start, shown = f"{one}: --wide, or --columns ", ""
        while rest and width_of(start + shown + rest[0]) + len(",...") <= window.columns:
            shown += rest.pop(0) + ","
        line = f"{start}{shown}..." if rest else start + shown[:-1]
        yield ""
        yield layout.styled(line if shown else f"{one}: --wide", DIM, window.styled)


def _aligned(texts: Sequence[str]) -> Sequence[str]:
    """Numbers with aligned decimal points, if that takes little more width."""
    numeric = re.compile(r"-?[\d.]+|-")  # without a power of ten; or no value
    if not all(numeric.fullmatch(text) for text in texts):
        return texts
    tails = [len(text) - text.find(".") if "." in text else 0 for text in texts]
    padded = [text + " " * (max(tails) - tail) for text, tail in zip(texts, tails, strict=True)]
    # A column may become three letters wider.
    return padded if max(map(len, padded)) <= max(map(len, texts)) + 3 else texts


def _columns(table: Table, rows: list[Any]) -> list[ShownColumn]:
    rows = rows if table.mixed else [*without_noise(rows)]
    naming = ("quantity", "dimension", "check")  # columns whose cells are names with units
    # the unit of each row's values, from its column of units or from the row's name
    by_row = [""] * len(rows)
    for name in ("unit", *naming, "key"):
        if name in table.names:
            cells = [str(row[table.names.index(name)] or "") for row in rows]
            by_row = cells if name == "unit" else [spoken(cell)[1] for cell in cells]
            break
    columns = []
    for name, values in zip(table.names, zip(*rows, strict=True), strict=True):
        literal = table.reading.designs and name not in naming
        words, unit = (name, "") if literal else spoken(name)
        is_text = any(isinstance(v, (str, bool)) for v in values)
        texts = [layout.bare(v, unit or other) for v, other in zip(values, by_row, strict=True)]
        if name in naming:
            texts = [clean(heading(text)) for text in texts]
        decides = name in table.reading.decide
        columns.append(ShownColumn(name, clean(words), unit, texts, is_text, decides))
    return columns


def _sorted_out(columns: list[ShownColumn], table: Table) -> tuple[list[ShownColumn], list[str]]:
    """The columns that differ between rows, and descriptions of the constant ones."""
    kept, once = [], []
    for column in columns:
        cells = set(column.cells)
        if cells == {""}:
            continue
        if len(cells) > 1 or len(column.cells) == 1 or table.reading.designs:
            kept.append(column)
        elif column.name not in table.reading.in_title:
            once.append(f"{column.words} {layout.with_unit(cells.pop(), column.unit)}")
    return kept or columns[:1], once
