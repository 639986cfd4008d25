"""The values of a report that no section has shown yet, so that none is left out."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from geneva_cli.document import Block, Grid
from geneva_cli.study.document.facts import capital, fact, facts, is_known
from geneva_cli.table import Table


class RemainingValues:
    """The values that have not been shown yet."""

    def __init__(self, values: dict[str, Any]) -> None:
        self.values = values

    def one(self, name: str) -> Any:
        """A single value, which then counts as shown."""
        return self.values.pop(name, None)

    def take(self, group: str) -> dict[str, Any]:
        """The values of a group by the rest of their names, which then count as shown."""
        begin = f"{group}."
        names = [name for name in self.values if name.startswith(begin)]
        return {name.removeprefix(begin): self.values.pop(name) for name in names}

    def rest(self) -> Iterator[Block]:
        """All values that no section has taken, such as those of a new section."""
        groups = dict.fromkeys(name.rpartition(".")[0] for name in self.values)
        for group in groups:
            own = {n: v for n, v in self.values.items() if n.rpartition(".")[0] == group}
            for name in [n for n, v in own.items() if isinstance(v, Table)]:
                yield grid(capital(name.rpartition(".")[2]), own.pop(name))
            plain = {n.rpartition(".")[2]: v for n, v in own.items()}
            yield from facts(capital(group.replace(".", ", ")), plain)


def grid(caption: str, table: Table) -> Grid:
    """A table with units in its headings, without columns that have no value."""
    rows = list(table.rows())
    shown = [i for i in range(len(table.names)) if any(is_known(row[i]) for row in rows)]
    heads = [head(table.names[i]) for i in shown]
    return Grid(caption, tuple(heads), tuple(tuple(row[i] for i in shown) for row in rows))


def head(name: str) -> str:
    """The head of a column: its name and its unit."""
    column = fact(name, None)
    return f"{column.name}, {column.unit}" if column.unit else column.name
