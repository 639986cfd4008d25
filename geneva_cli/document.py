"""The document: what is handed over of a design, as blocks that any format of pages can set."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from geneva_cli.curves.drawing import Drawing
    from geneva_cli.figure import Figure

Value: TypeAlias = float | int | str | bool | None
Row: TypeAlias = tuple[Value, ...]
BAD = "FAILS"  # a cell that is to be seen


class Heading(NamedTuple):
    """What the blocks up to the next one are about."""

    text: str


class Prose(NamedTuple):
    """A paragraph."""

    text: str


class Listed(NamedTuple):
    """Texts, one below the other."""

    texts: tuple[str, ...]


class Fact(NamedTuple):
    """A named value; several of a kind are a tuple."""

    name: str
    value: Value | Row
    unit: str = ""


class Facts(NamedTuple):
    """Named values under a caption."""

    caption: str
    facts: tuple[Fact, ...]


class Grid(NamedTuple):
    """A table: its first column says what each row is."""

    caption: str
    heads: tuple[str, ...]
    rows: tuple[Row, ...]


class Picture(NamedTuple):
    """A drawing, to be looked at."""

    drawing: Drawing


class Curves(NamedTuple):
    """A figure."""

    figure: Figure


Block: TypeAlias = Heading | Prose | Listed | Facts | Grid | Picture | Curves


class Document(NamedTuple):
    """A title, the verdict with its reasons, and then everything else."""

    title: str
    passes: bool
    verdict: str
    reasons: tuple[str, ...]
    blocks: tuple[Block, ...]
