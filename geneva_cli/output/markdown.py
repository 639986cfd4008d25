"""Markdown tables, for reports and issues."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.errors import clean
from geneva_cli.output.text import cell
from geneva_cli.table import Table


def chunks(table: Table, terminal: bool) -> Iterator[str]:
    """The table, line by line."""
    if table.title:
        yield f"# {clean(table.title)}\n\n"
    if table.record:
        yield "| quantity | value |\n| --- | ---: |\n"
        for name, value in zip(table.names, next(table.rows()), strict=True):
            yield f"| {name} | {_escaped(value)} |\n"
        return
    yield "| " + " | ".join(table.names) + " |\n"
    yield "| " + " | ".join(["---:"] * len(table.names)) + " |\n"
    for row in table.rows():
        yield "| " + " | ".join(_escaped(v) for v in row) + " |\n"


def _escaped(value: object) -> str:
    return cell(value).replace("|", "\\|")
