"""Selection of columns by name, for csv."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from geneva_cli.errors import GenevaError, cut, few
from geneva_cli.table import Table, rows_table

KIND = "row"  # column of a table whose rows are of several kinds, each with columns of its own


def only(table: Table, names: Sequence[str]) -> Table:
    """The columns with these names, in order; for a record its values and its tables' columns.

    Raises GenevaError for an unknown name.
    """
    inner = [t for v in next(table.rows(), ()) for t in _tables(v)] if table.record else []
    known = dict.fromkeys([*table.names, *(name for one in inner for name in one.names)])
    for name in names:
        if name not in known:
            some = few(name, known)
            raise GenevaError(f"--columns {cut(name)}: no such column; there are {some}")
    if not table.record:
        table = _of_kinds(table, names) if KIND in table.names else table
        at = [table.names.index(name) for name in names]
        return table.replaced(names=tuple(names), columns=[table.columns[i] for i in at])
    values: dict[str, Any] = {}
    for name, value in zip(table.names, next(table.rows()), strict=True):
        if name in names:
            values[name] = value
        else:
            parts = [t for t in _tables(value) if set(names) & set(t.names)]
            own = tuple(only(t, [n for n in names if n in t.names]) for t in parts)
            if own:
                values[name] = own[0] if isinstance(value, Table) else own
    return table.replaced(names=tuple(values), columns=[(v,) for v in values.values()])


def _tables(value: Any) -> list[Table]:
    """The tables in a cell: one, several, or none."""
    if isinstance(value, Table):
        return [value]
    return [v for v in value if isinstance(v, Table)] if isinstance(value, tuple) else []


def _of_kinds(table: Table, names: Sequence[str]) -> Table:
    """Return the rows of the kinds that have one of the columns, but for those that all kinds have.

    So the masses in a list of parts are those of its parts, without empty rows for its pivots.
    """
    at = table.names.index(KIND)
    has: dict[str, set[str]] = {}
    for row in table.rows():
        own = (name for name, value in zip(table.names, row, strict=True) if value is not None)
        has.setdefault(row[at], set()).update(own)
    special = set(names) - set[str].intersection(*has.values())
    kept = [row for row in table.rows() if not special or special & has[row[at]]]
    return table.replaced(columns=rows_table(table.names, kept).columns)
