"""Markdown tables, for reports and issues."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.output.text import cell
from geneva_cli.table import Table, flat

# HTML by its own names, which every renderer reads alike; Markdown by its backslash
ESCAPES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", **{c: f"\\{c}" for c in "\\`*[]|"}}


def chunks(table: Table) -> Iterator[str]:
    """The table, line by line."""
    if table.title:
        yield f"# {escaped(table.title)}\n\n"
    if table.prose:
        yield f"{escaped(table.prose)}\n\n"
    if table.record:
        yield "| quantity | value |\n| --- | ---: |\n"
        table = flat(table)
        for name, value in zip(table.names, next(table.rows()), strict=True):
            yield f"| {escaped(name)} | {escaped(value)} |\n"
        return
    if not table.names:  # only its title and prose are left
        return
    yield "| " + " | ".join(map(escaped, table.names)) + " |\n"
    yield "| " + " | ".join(["---:"] * len(table.names)) + " |\n"
    for row in table.rows():
        yield "| " + " | ".join(escaped(v) for v in row) + " |\n"


def escaped(value: object) -> str:
    """A value without special meaning: a user's title may look like HTML or Markdown."""
    return "".join(ESCAPES.get(c, c) for c in cell(value))
