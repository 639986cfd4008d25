"""The document: what is handed over of a design, as blocks that any format of pages can set."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from geneva_cli.curves.drawing import Drawing
    from geneva_cli.figure import Figure
    from geneva_cli.table import Table

Value: TypeAlias = float | int | str | bool | None
Row: TypeAlias = tuple[Value, ...]
BAD = "FAILS"  # a cell that is to be seen
PASSES, WARNS, FAILS = "passes", "warns", "fails"  # how a design stands


class Line(NamedTuple):
    """One answer about a design: what it is about, the answer, and how it follows."""

    label: str
    text: str
    note: str = ""
    state: str = ""  # WARNS or FAILS where it is a warning or a failed check


class Summary(NamedTuple):
    """What a designer tells a colleague about one design: a headline, and a line an answer.

    ``state`` is PASSES, WARNS or FAILS; empty where nothing is judged.
    """

    head: str
    lines: tuple[Line, ...] = ()
    state: str = ""


class Answer(NamedTuple):
    """What a command answers: summaries above a table for people, and the data for programs."""

    summaries: tuple[Summary, ...]
    page: Table | None
    data: Table


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
    """A title, the verdict with its reasons, and then everything else.

    ``state`` is PASSES, WARNS or FAILS.
    """

    title: str
    state: str
    verdict: str
    reasons: tuple[str, ...]
    blocks: tuple[Block, ...]
