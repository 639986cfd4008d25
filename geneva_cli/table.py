"""The table: numbers that a command hands to the output."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import chain, islice
from typing import Any, NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError, cut, few, nearest

BLOCK = 8192  # rows that are computed and written at once
WHOLE_ROWS = 100_000  # longer tables are computed while they are written
SHOWN_ROWS = 10  # rows that the interpreter shows
NO_BOUND = "no bound"  # an infinity, for people
Make: TypeAlias = Callable[[int, int], Sequence[Any]]  # columns of the rows from start to stop


class Reading(NamedTuple):
    """Hints for showing a table at a terminal if its columns do not all fit.

    ``first`` are its columns in order of importance; others follow in their order. Those that
    ``decide``, such as whether a machine can be built, are never left out. ``title`` stands above
    it, and replaces the constant columns ``in_title``. With ``designs`` the columns are named for
    designs, not for quantities.
    """

    first: tuple[str, ...] = ()
    title: str = ""
    in_title: tuple[str, ...] = ()
    designs: bool = False
    decide: tuple[str, ...] = ()


class Table(NamedTuple):
    """Named columns (lists or arrays) of equal length; the names carry the units.

    A ``record`` has one row, whose dotted names form a tree: nested in json, one line each for
    people. None is a value that does not exist (an empty field, ``null`` in json). In a record a
    value may also be a tuple of texts, or a table. ``prose`` stands below the title. The columns of
    a ``mixed`` table hold quantities of many kinds, so no number in them is rounding compared with
    another. Their names are headings, such as drive.A=0.6, which json does not nest. A long
    table has no columns: ``later`` is its length and what computes its rows.
    """

    names: tuple[str, ...]
    columns: Sequence[Any]
    record: bool = False
    title: str = ""
    prose: str = ""
    mixed: bool = False
    reading: Reading = Reading()
    later: tuple[int, Make] | None = None

    def __getitem__(self, key: Any) -> Any:
        """A column by its name, as a read-only NumPy array; for a record, the value.

        Raises GenevaError, with the nearest name, for an unknown one.

        >>> Table(("z", "tau"), ([3, 4], [1 / 6, 0.25]))["z"]
        array([3, 4])
        """
        if not isinstance(key, str):
            return tuple.__getitem__(self, key)
        if key not in self.names:
            hint = nearest(key, self.names)
            raise GenevaError(f"no column {cut(key)}{hint}; it has {few(key, self.names)}")
        column = self.whole()[self.names.index(key)]
        if self.record:
            return column[0]
        import numpy as np

        array = np.asarray(column).view()
        array.flags.writeable = False
        return array

    def __repr__(self) -> str:
        """The title and the first rows, numbers to six digits; for a record the first values."""
        rows = [map(_briefly, row) for row in islice(self.rows(), SHOWN_ROWS)]
        if self.record:
            lines = [f"{name}  {value}" for name, value in zip(self.names, *rows, strict=True)]
            count, what, lines = len(lines), "values", lines[:SHOWN_ROWS]
        else:
            lines = ["  ".join(row) for row in (self.names, *rows)]
            count, what = len(self) + 1, "rows"
        left = count - len(lines)
        more = [f"... {left} more {what}"] if left else []
        return "\n".join([*([self.title] if self.title else []), *lines, *more])

    def to_pandas(self) -> Any:
        """A pandas DataFrame of the rows; a record is one row, with nested names joined by dots.

        Raises GenevaError if pandas is not installed.
        """
        try:
            import pandas
        except ImportError:
            raise GenevaError("pandas is not installed: pip install pandas") from None
        table = flat(self) if self.record else self
        columns = zip(table.names, table.whole(), strict=True)
        return pandas.DataFrame({name: list(column) for name, column in columns})

    def __len__(self) -> int:
        if self.later:
            return self.later[0]
        return len(self.columns[0]) if self.columns else 0

    def slices(self) -> Iterator[Sequence[Any]]:
        """Slices of all columns, a block at a time, so that memory stays flat."""
        for start in range(0, len(self), BLOCK):
            stop = min(start + BLOCK, len(self))
            own = [column[start:stop] for column in self.columns]
            yield self.later[1](start, stop) if self.later else own

    def whole(self) -> Sequence[Any]:
        """All columns; those of a long table are computed."""
        if not self.later:
            return self.columns
        import numpy as np

        return [*map(np.concatenate, zip(*self.slices(), strict=True))]

    def through(self, change: Callable[[Sequence[Any]], Sequence[Any]], **fields: Any) -> Table:
        """The table with its columns changed; those of a long one as its rows are computed."""
        if not self.later:
            return self.replaced(columns=change(self.columns), **fields)
        length, make = self.later
        later = length, lambda start, stop: change(make(start, stop))
        return self.replaced(later=later, **fields)

    def blocks(self) -> Iterator[list[tuple[Any, ...]]]:
        """Rows as plain Python values, in blocks, so that memory stays flat."""
        for columns in self.slices():
            plain = (c if isinstance(c, (list, tuple)) else c.tolist() for c in columns)
            yield list(zip(*plain, strict=True))

    def rows(self) -> Iterator[tuple[Any, ...]]:
        """The rows, one by one."""
        return chain.from_iterable(self.blocks())

    def replaced(self, **fields: Any) -> Table:
        """The table with some fields replaced; _replace would check their number against len()."""
        return Table(**self._asdict() | fields)

    def to_dict(self) -> dict[str, Any]:
        """Columns by name, numbers as arrays; a record's values by name, tables in it as rows.

        >>> Table(("z", "tau"), ([3, 4], [1 / 6, 0.25])).to_dict()["tau"][1]
        0.25
        """
        if self.record:
            row = zip(self.names, next(self.rows()), strict=True)
            return {n: v.to_rows() if isinstance(v, Table) else v for n, v in row}
        return dict(zip(self.names, self.whole(), strict=True))

    def to_rows(self) -> list[dict[str, Any]]:
        """A list of rows by name, as data frames take it."""
        return [dict(zip(self.names, row, strict=True)) for row in self.rows()]


def _briefly(value: object) -> str:
    """A cell in a few characters."""
    if isinstance(value, Table):
        return f"a table of {len(value)} rows"
    if isinstance(value, tuple):
        return f"{len(value)} texts" if value else "none"
    if isinstance(value, float):
        return for_people(value, digits=6)
    return cut("" if value is None else str(value), 40)


def for_people(value: float, unit: str = "", digits: int = 4) -> str:
    """A number for people: four digits, but for millimetres those of a drawing.

    An angle of rounding errors is 0.

    >>> for_people(34.733492, "N m"), for_people(393.91305, "mm"), for_people(12345.6)
    ('34.73', '393.913', '12350')
    """
    if unit == "mm" and 1.0 <= abs(value) < 1e6:
        return in_decimals(value)
    if unit in ("deg", "°") and abs(value) < 1e-9:
        return "0"
    if math.isinf(value):
        return NO_BOUND
    text = f"{value + 0.0:.{digits}g}"
    return f"{float(text):.0f}" if "e+" in text and abs(value) < 1e6 else text


def in_decimals(value: float, decimals: int = 3) -> str:
    """A number with at most so many decimals, zero without a sign.

    >>> in_decimals(173.20508), in_decimals(20.0), in_decimals(-1e-9, 0)
    ('173.205', '20', '0')
    """
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text


def computed_table(names: Sequence[str], length: int, make: Make) -> Table:
    """A table whose rows ``make(start, stop)`` gives; a long one is computed as it is written."""
    if length > WHOLE_ROWS:
        return Table(tuple(names), (), later=(length, make))
    return Table(tuple(names), make(0, length))


def rows_table(
    names: Sequence[str],
    rows: Sequence[Sequence[Any]],
    title: str = "",
    mixed: bool = False,
    reading: Reading | None = None,
) -> Table:
    """A table from its rows."""
    columns = list(zip(*rows, strict=True)) if rows else [() for _ in names]
    return Table(tuple(names), columns, title=title, mixed=mixed, reading=reading or Reading())


def record_table(values: dict[str, Any], title: str = "", prose: str = "") -> Table:
    """A table of one row, shown line by line."""
    return Table(tuple(values), list(zip(values.values(), strict=True)), True, title, prose)


def flat(table: Table) -> Table:
    """A record with one text or number for each name; ``name.1``, ``name.2`` for lists and tables.

    For formats without nesting. An empty list is the word none.

    >>> flat(record_table({"places": ((1.0, 2.0), (3.0, 4.0)), "open": {"from_deg": 5.0}})).names
    ('places.1.1', 'places.1.2', 'places.2.1', 'places.2.2', 'open.from_deg')
    """
    values = dict[str, Any]()
    for name, (value,) in zip(table.names, table.columns, strict=True):
        values |= _single_values(name, value)
    return record_table(values, table.title, table.prose)


def _single_values(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Yield the texts and numbers within a value, each with its whole name."""
    if isinstance(value, Table):
        value = tuple(value.to_rows())
    parts = dict(enumerate(value, 1)) if isinstance(value, tuple) else value
    if not isinstance(parts, dict):
        yield name, value
    elif not parts:
        yield name, "none"
    else:
        for key, part in parts.items():
            yield from _single_values(f"{name}.{key}", part)
