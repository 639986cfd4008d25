"""Tables on a terminal: nothing is wider than the window, and what is left out is said."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator, Sequence
from itertools import chain
from typing import Any, NamedTuple

from geneva_cli.errors import clean
from geneva_cli.names import heading, spoken
from geneva_cli.output.layout import (
    BOLD,
    DIM,
    GAP,
    PLAIN,
    ShownColumn,
    fitting,
    heads,
    row,
    stacked,
    turned,
    width_of,
    wrapped,
)
from geneva_cli.output.text import WIDTH, apart, cell, without_noise
from geneva_cli.table import Table, in_digits

NARROWEST = 60  # columns of a window; a narrower one breaks lines itself
HELD = 8192  # rows by which a table is laid out; later ones of a longer table follow that
DIGITS = 5  # significant digits; csv and json carry all
NUMBER = 11  # letters of the widest number of so many digits, -1.2345e-10
FEW = 3  # rows of a table that may be turned on its side
HOURS = 1e6  # of a life, 114 years of running day and night: longer ones mean nothing
ENDLESS = "practically unlimited"
SPARE = 3  # letters by which a column may be wider so that its points stand below each other
VALUE = 30  # letters that a value has beside its label; with fewer it stands below
BOUNDLESS = 1_000_000  # letters of a line where the window does not matter
NAMING = ("quantity", "dimension", "check")  # columns whose cells are names with units


class Window(NamedTuple):
    """The terminal's width in letters, whether it shows bold ones, and what does not depend on it.

    A ``whole`` table has every column, constant ones too; a ``wide`` one is wider than the window.
    """

    columns: int
    styled: bool = False
    whole: bool = False
    wide: bool = False


def window(whole: bool, is_wide: bool) -> Window:
    """The window of standard output; COLUMNS says its width before the terminal does."""
    styled = os.environ.get("TERM", "dumb") != "dumb" and not os.environ.get("NO_COLOR")
    columns = max(shutil.get_terminal_size().columns, NARROWEST)
    return Window(columns, styled, whole or is_wide, is_wide)


def chunks(table: Table, window: Window) -> Iterator[str]:
    """The table as text, line by line."""
    title, prose = table.reading.title or table.title, table.prose
    text = [*_paragraphs(title, window, BOLD), *[""] * bool(title)]
    text += [*_paragraphs(prose, window), *[""] * bool(prose)]
    for line in chain(text, _record(table, window) if table.record else _table(table, window)):
        yield line + "\n"


def _paragraphs(text: str, window: Window, style: str = "") -> Iterator[str]:
    for paragraph in text.split("\n") if text else ():
        for line in wrapped(clean(paragraph), min(window.columns, WIDTH)):
            yield _styled(line, style, window)


def _styled(line: str, style: str, window: Window) -> str:
    return f"{style}{line}{PLAIN}" if style and line and window.styled else line


def value(number: Any, unit: str = "") -> str:
    """A value as a person at a terminal reads it, its unit beside it.

    >>> value(34.733492, "N m"), value(53173000.0), value(2.8e8, "h")
    ('34.733 N m', '5.3173e7', 'practically unlimited')
    """
    text = _bare(number, unit)
    is_number = isinstance(number, (int, float)) and not isinstance(number, bool)
    return f"{text} {unit}" if unit and is_number and text != ENDLESS else text


def _bare(number: Any, unit: str) -> str:
    if not isinstance(number, float):
        return cell(number)
    if unit == "h" and number > HOURS:
        return ENDLESS
    digits, e, power = in_digits(number, DIGITS).partition("e")
    return f"{digits}e{int(power)}" if e else digits


def _table(table: Table, window: Window, is_inner: bool = False) -> Iterator[str]:
    """Rows under their headings: as many columns as fit, and what became of the others.

    A short table is turned on its side where that shows more: one row, few in a record.
    """
    blocks = table.blocks(HELD)
    first = next(blocks, [])
    if not first:
        yield from ["no rows"] if table.names else []
        return
    every = _columns(table, first)
    columns, once = (every, []) if window.whole else _sorted_out(every, table)
    if once:
        yield from _paragraphs(f"In every row: {'; '.join(once)}.", window)
        yield ""
    if len(table) > HELD:
        columns = [c if c.is_text else c._replace(cells=[*c.cells, "0" * NUMBER]) for c in columns]
    order = _order(table)
    kept, sizes = fitting(columns, order, BOUNDLESS if window.wide else window.columns)
    lost = [column.name for column in columns if column not in kept]
    if lost and len(first) <= (FEW if is_inner or 3 * len(kept) < len(columns) else 1):
        lines = turned(columns, window.columns)
        if lines:
            yield from lines
            return
    if lost and len(kept) == 1 and len(table) <= HELD:
        second = min((c for c in columns if c.name in lost), key=lambda c: order.index(c.name))
        yield from stacked(kept[0], second, window.columns)
        yield from _left_out([name for name in lost if name != second.name], window)
        return
    yield from heads(kept, sizes, window.styled)
    names = {column.name for column in kept}
    for block in chain([every], (_columns(table, block) for block in blocks)):
        cells = [column.cells for column in block if column.name in names]
        for texts in zip(*cells, strict=True):
            yield from row(texts, sizes, [column.is_text for column in kept])
    yield from _left_out(lost, window)


def _order(table: Table) -> list[str]:
    """The columns from the most important one."""
    return [*table.reading.first, *(n for n in table.names if n not in table.reading.first)]


def _left_out(names: Sequence[str], window: Window) -> Iterator[str]:
    """The line that says which columns are left out, and how to see them."""
    if not names:
        return
    one = "1 more column" if len(names) == 1 else f"{len(names)} more columns"
    line, rest = f"{one}: --wide, or --columns ", list(names)
    while rest and width_of(line + rest[0]) + len(",...") <= window.columns:
        line += rest.pop(0) + ","
    yield ""
    yield _styled(f"{line}..." if rest else line[:-1], DIM, window)


def _columns(table: Table, block: list[tuple[Any, ...]]) -> list[ShownColumn]:
    """All columns of some rows."""
    rows = block if table.mixed else without_noise(block)
    found = []
    for name, values in zip(table.names, zip(*rows, strict=True), strict=True):
        literal = table.reading.designs and name not in NAMING
        words, unit = (name, "") if literal else spoken(name)
        is_text = any(isinstance(v, (str, bool)) for v in values)
        texts = [_bare(v, unit) for v in values]
        if name in NAMING:
            texts = [clean(heading(text)) for text in texts]
        elif not is_text and not table.mixed:
            texts = _aligned(texts)
        found.append(ShownColumn(name, clean(words), unit, texts, is_text))
    return found


def _aligned(texts: list[str]) -> list[str]:
    """Numbers with their points below each other, where that takes but little more width."""
    tails = [len(text) - text.find(".") if "." in text else 0 for text in texts]
    most = max(tails)
    found = [text + " " * (most - tail) for text, tail in zip(texts, tails, strict=True)]
    is_wide = max(map(len, found)) > max(map(len, texts)) + SPARE
    return texts if is_wide or any("e" in text for text in texts) else found


def _sorted_out(columns: list[ShownColumn], table: Table) -> tuple[list[ShownColumn], list[str]]:
    """The columns that differ from row to row, and what the others hold in every row."""
    kept, once = [], []
    for column in columns:
        cells = {text.strip() for text in column.cells}
        if cells == {""}:
            continue
        if len(cells) > 1 or len(column.cells) == 1 or table.reading.designs:
            kept.append(column)
        elif column.name not in table.reading.said:
            once.append(" ".join(filter(None, (column.words, cells.pop(), column.unit))))
    return kept, once


def _record(table: Table, window: Window) -> Iterator[str]:
    """A line a value, under the groups of their names; tables in it as tables."""
    is_first = True
    for name, part in apart(table):
        lines = list(_values(part, window) if part.record else _table(part, window, True))
        if not lines:
            continue
        if not is_first:
            yield ""
        if name:
            yield _styled(heading(name), BOLD, window)
        yield from lines
        is_first = False


def _values(record: Table, window: Window) -> Iterator[str]:
    shown = []
    for name, found in zip(record.names, next(record.rows(), ()), strict=True):
        if found is not None and found != "":
            group, _, last = name.rpartition(".")
            shown.append((group, last, found))
    labels = [("  " if group else "") + spoken(last)[0] for group, last, _ in shown]
    width = max(map(width_of, labels), default=0)
    current = ""
    for label, (group, last, found) in zip(labels, shown, strict=True):
        if group != current:
            yield _styled(heading(group), BOLD, window)
            current = group
        yield from _value(label, width, _said(found, spoken(last)[1]), window)


def _said(found: Any, unit: str) -> list[str]:
    """The paragraphs of a value."""
    if not isinstance(found, tuple):
        return [value(found, unit)]
    if all(isinstance(one, (int, float)) for one in found) and found:
        return [f"{', '.join(_bare(one, '') for one in found)} {unit}".rstrip()]
    return [value(one) for one in found] or ["none"]


def _value(label: str, width: int, texts: list[str], window: Window) -> Iterator[str]:
    """A label and its value, in several lines where it is long."""
    beside = window.columns - width - len(GAP)
    if len(texts) == 1 and (width_of(texts[0]) <= beside or beside >= VALUE):
        first, *more = wrapped(texts[0], beside)
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
