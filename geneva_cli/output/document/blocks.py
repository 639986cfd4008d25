"""The document: a design's results as blocks that any page format can set."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from geneva_cli.figure import Figure
    from geneva_cli.geometry.drawing import Drawing

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
