"""Headlines of summaries: a design's title and the count of its warnings."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from geneva_cli.answer import WARNS, Answer, Summary, SummaryLine
from geneva_cli.design import Design
from geneva_cli.table import Table
from geneva_cli.verdict.headline import below_summary, warning


def record_answer(
    design: Design, record: Table, lines: Iterable[SummaryLine], warnings: Sequence[str]
) -> Answer:
    """An answer of some lines and warnings, with the other values of a record below them."""
    summary = summary_of(design, lines, warnings)
    return Answer((summary,), below_summary(record, without=("title",)), record)


def summary_of(design: Design, lines: Iterable[SummaryLine], warnings: Sequence[str]) -> Summary:
    """Some lines and warnings about a design, whose headline counts the warnings."""
    head = f"{title_of(design)}{counted(warnings)}"
    return Summary(head, (*lines, *map(warning, warnings)), WARNS if warnings else "")


def title_of(design: Design) -> str:
    """The title of a design, or else its description.

    >>> title_of(Design(External(6)))
    'Geneva wheel of 6 slots'
    """
    return design.spec.title or design.spec.wheel.title


def counted(warnings: Sequence[str]) -> str:
    """The number of warnings behind a headline; empty without any.

    >>> counted(["a", "b"]), counted([])
    (': 2 warnings', '')
    """
    many = len(warnings)
    return f": {many} warning{'s' * (many != 1)}" if many else ""
