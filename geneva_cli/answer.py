"""The answer of a command: summaries for people above a table, and the data for programs."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from geneva_cli.table import Table

PASSES, WARNS, FAILS = "passes", "warns", "fails"  # the state of a design


class SummaryLine(NamedTuple):
    """One answer about a design: its label, the answer, and its reason."""

    label: str
    text: str
    note: str = ""
    state: str = ""  # WARNS or FAILS for a warning or a failed check


class Summary(NamedTuple):
    """A short summary of one design: a headline, and one line for each answer.

    ``state`` is PASSES, WARNS or FAILS; empty if nothing is judged.
    """

    head: str
    lines: tuple[SummaryLine, ...] = ()
    state: str = ""


class Answer(NamedTuple):
    """The answer of a command: summaries above a table for people, and the data for programs."""

    summaries: tuple[Summary, ...]
    page: Table | None
    data: Table
