"""The first page of a report: six key figures of the machine, and its motor."""

from __future__ import annotations

from geneva_cli.design import Design
from geneva_cli.document import Grid, Row
from geneva_cli.study.document.facts import capital
from geneva_cli.study.summary import report


def key_figures(design: Design) -> Grid:
    """The key figures of the summary of ``geneva report``."""
    rows: list[Row] = []
    for line in report.key_figures(design):
        note = f"; {line.note}" if line.note else ""
        rows.append((capital(line.label), f"{line.text}{note}"))
    return Grid("In short", ("", ""), tuple(rows))
