"""The document: a design's results as blocks that any page format can set."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from geneva_cli.answer import Value, value_text

if TYPE_CHECKING:
    from geneva_cli.figure import Figure
    from geneva_cli.geometry.sheet import Drawing

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


class Grid(NamedTuple):
    """A table whose first column names its rows; one of ``facts`` has a value in each."""

    caption: str
    heads: tuple[str, ...]
    rows: tuple[Row, ...]
    facts: bool = False


def fact_grid(caption: str, facts: Iterable[Fact]) -> Grid:
    """Named values with their units, as texts."""
    rows = tuple((fact.name, value_text(fact.value, fact.unit)) for fact in facts)
    return Grid(caption, ("", ""), rows, facts=True)


class Picture(NamedTuple):
    """A drawing to view."""

    drawing: Drawing


class Curves(NamedTuple):
    """A figure."""

    figure: Figure


Block: TypeAlias = Heading | Prose | TextList | Grid | Picture | Curves


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


def right_aligned(grid: Grid) -> list[bool]:
    """Whether each column stands right: one of numbers, or the values of facts."""
    columns = zip(*grid.rows, strict=True)
    return [False, True] if grid.facts else [all(map(is_number, column)) for column in columns]


def texts(grid: Grid) -> list[list[str]]:
    """The cells of a table as texts; a column's unit stands in its head."""
    units = [head.rpartition(", ")[2] for head in grid.heads]
    text = partial(value_text, bare=True)
    return [[*map(text, row, units)] for row in grid.rows]


def is_number(value: object) -> bool:
    """Return True for a value that is right-aligned in its column."""
    return value is None or (isinstance(value, (int, float)) and not isinstance(value, bool))


def is_short(column: Iterable[str]) -> bool:
    """Return True for a column whose texts are not broken into lines, such as units."""
    return all(len(text) <= SHORT for text in column)
