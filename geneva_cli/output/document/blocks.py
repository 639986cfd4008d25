"""The document: a design's results as blocks that any page format can set."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from geneva_cli.errors import clean
from geneva_cli.table import NO_BOUND, for_people

if TYPE_CHECKING:
    from geneva_cli.figure import Figure
    from geneva_cli.geometry.sheet import Drawing


Value: TypeAlias = float | int | str | bool | None
Row: TypeAlias = tuple[Value, ...]
BAD = "FAILS"  # a cell that must be noticed


class Heading(NamedTuple):
    """The subject of the blocks up to the next heading."""

    text: str


class Prose(NamedTuple):
    """A paragraph."""

    text: str


class TextList(NamedTuple):
    """A list of texts."""

    texts: tuple[str, ...]


class Fact(NamedTuple):
    """A named value, or a tuple of several."""

    name: str
    value: Value | Row
    unit: str = ""


class Facts(NamedTuple):
    """Named values under a caption."""

    caption: str
    facts: tuple[Fact, ...]


class Grid(NamedTuple):
    """A table whose first column names its rows."""

    caption: str
    heads: tuple[str, ...]
    rows: tuple[Row, ...]


class Picture(NamedTuple):
    """A drawing to view."""

    drawing: Drawing


class Curves(NamedTuple):
    """A figure."""

    figure: Figure


Block: TypeAlias = Heading | Prose | TextList | Facts | Grid | Picture | Curves


class Document(NamedTuple):
    """A title, the verdict with its reasons, and then the blocks.

    ``state`` is that of an ``answer.Summary``.
    """

    title: str
    state: str
    verdict: str
    reasons: tuple[str, ...]
    blocks: tuple[Block, ...]


SHORT = 12  # letters that are not broken into lines
NO_BREAK = "\u00a0"  # a space at which no line is broken
TIMES = f"{NO_BREAK}×{NO_BREAK}"
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def value_text(value: Value | Row, unit: str = "", digits: int = 4) -> str:
    """A value with its unit. Raises ArithmeticError for NaN, a fault of this program.

    >>> value_text(182.612895, "°"), value_text(53.17, "W/m²"), value_text(None), value_text(True)
    ('182.6°', '53.17 W/m²', '–', 'yes')
    """
    if isinstance(value, tuple):
        return ", ".join(value_text(one, unit, digits) for one in value) or "none"
    text = _bare(value, unit, digits)
    if not unit or value is None or not is_number(value) or text == NO_BOUND:
        return text
    return f"{text}°" if unit == "°" else f"{text} {unit}"


def texts(grid: Grid) -> list[list[str]]:
    """The cells of a table as texts; a column's unit stands in its head."""
    units = [head.rpartition(", ")[2] for head in grid.heads]
    return [
        [_bare(value, unit) for value, unit in zip(row, units, strict=True)] for row in grid.rows
    ]


def is_number(value: object) -> bool:
    """Return True for a value that is right-aligned in its column."""
    return value is None or (isinstance(value, (int, float)) and not isinstance(value, bool))


def is_short(column: Iterable[str]) -> bool:
    """Return True for a column whose texts are not broken into lines, such as units."""
    return all(len(text) <= SHORT for text in column)


def _bare(value: Value, unit: str = "", digits: int = 4) -> str:
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, float):
        return clean(str(value))
    if math.isnan(value):
        raise ArithmeticError("a value of the report is not a number")
    number, _, power = for_people(value, unit, digits).partition("e")
    return f"{number}{TIMES}10{str(int(power)).translate(RAISED)}" if power else number
