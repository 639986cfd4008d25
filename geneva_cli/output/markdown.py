"""Markdown tables, for reports and issues."""

from collections.abc import Iterable, Iterator, Sequence

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
        table = flat(table)
        rows = zip(table.names, next(table.rows()), strict=True)
        yield from lines_of(("quantity", "value"), rows, (False, True))
    elif table.names:  # else only its title and prose are left
        yield from lines_of(table.names, table.rows(), [True] * len(table.names))


def lines_of(
    heads: Sequence[str], rows: Iterable[Sequence[object]], right: Sequence[bool]
) -> Iterator[str]:
    """The lines of a table, whose columns stand left or ``right``."""
    yield f"| {' | '.join(map(escaped, heads))} |\n"
    yield f"| {' | '.join('---:' if side else '---' for side in right)} |\n"
    for row in rows:
        yield f"| {' | '.join(map(escaped, row))} |\n"


def escaped(value: object) -> str:
    """A value without special meaning: a user's title may look like HTML or Markdown."""
    return "".join(ESCAPES.get(c, c) for c in cell(value))
