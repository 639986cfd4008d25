"""The table: what every command that prints numbers hands to the output."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from typing import Any, NamedTuple

PIECE = 65536  # rows of a long table that are made at once; blocks divide it
HTML_ROWS = 60  # that a notebook shows
NO_BOUND = "no bound"  # an infinity, where a person reads it


class Reading(NamedTuple):
    """How a person at a terminal reads a table whose columns do not all fit.

    ``first`` are its columns from the most important one; others follow in their order. ``title``
    stands above it, and says what is in the columns ``said``: where they are constant, it stands
    for them. Of ``designs`` the names are those of designs, not of quantities.
    """

    first: tuple[str, ...] = ()
    title: str = ""
    said: tuple[str, ...] = ()
    designs: bool = False


class Table(NamedTuple):
    """Named columns (lists or arrays) of equal length; the names carry the units.

    A ``record`` has one row, whose dotted names are a tree: json nests it, and people read it
    line by line. A None is a value that does not exist (an empty field, ``null`` in json). In a
    record a value may be a tuple of texts, or a table of its own. ``prose`` stands below the title.
    The columns of a ``mixed`` table hold quantities of many kinds, so that no number in them is
    small beside another; their names are headings, as drive.A=0.6, in which json sees no tree.
    """

    names: tuple[str, ...]
    columns: Sequence[Any]
    record: bool = False
    title: str = ""
    prose: str = ""
    mixed: bool = False
    reading: Reading = Reading()

    def __len__(self) -> int:
        return len(self.columns[0]) if self.columns else 0

    def blocks(self, size: int = 8192) -> Iterator[list[tuple[Any, ...]]]:
        """Rows as plain Python values, a block at a time, so that memory stays flat."""
        for start in range(0, len(self), size):
            part = [c[start : start + size] for c in self.columns]
            lists = [p if isinstance(p, (list, tuple)) else p.tolist() for p in part]
            yield list(zip(*lists, strict=True))

    def rows(self) -> Iterator[tuple[Any, ...]]:
        """Rows one by one."""
        for block in self.blocks():
            yield from block

    def replaced(self, **fields: Any) -> Table:
        """The table with some of its fields replaced; _replace counts fields by the rows."""
        own: dict[str, Any] = dict(zip(self._fields, self, strict=True))
        return Table(**own | fields)

    def to_dict(self) -> dict[str, Any]:
        """Columns by name, numbers as arrays; a record's values by name, tables in it as rows.

        >>> Table(("z", "tau"), ([3, 4], [1 / 6, 0.25])).to_dict()["tau"][1]
        0.25
        """
        if self.record:
            row = zip(self.names, next(self.rows()), strict=True)
            return {n: v.to_rows() if isinstance(v, Table) else v for n, v in row}
        columns = (c if isinstance(c, (list, tuple)) else _whole(c) for c in self.columns)
        return dict(zip(self.names, columns, strict=True))

    def to_rows(self) -> list[dict[str, Any]]:
        """A list of rows, each by name; what a data frame is made of."""
        return [dict(zip(self.names, row, strict=True)) for row in self.rows()]

    def _repr_html_(self) -> str:
        """How a notebook shows it: the first rows, and how many there are."""
        from html import escape  # nothing else needs it, and it takes 5 ms

        names, rows = self.names, list(islice(self.rows(), HTML_ROWS))
        if self.record:
            values = flat(self)
            names = ("name", "value")
            rows = list(zip(values.names, next(values.rows()), strict=True))
        head = "".join(f"<th>{escape(name)}</th>" for name in names)
        body = "".join(
            "<tr>" + "".join(f"<td>{escape(_shown(v))}</td>" for v in row) + "</tr>" for row in rows
        )
        more = "" if self.record or len(self) <= HTML_ROWS else f"<p>{len(self)} rows</p>"
        title = f"<caption>{escape(self.title)}</caption>" if self.title else ""
        return f"<table>{title}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _shown(value: object) -> str:
    if value is None:
        return ""
    return in_digits(value, 7) if isinstance(value, float) else str(value)


def in_digits(value: float, digits: int) -> str:
    """A number in so many significant digits, without a sign at zero; an infinity in words.

    >>> in_digits(-0.0, 6), in_digits(float("inf"), 6)
    ('0', 'no bound')
    """
    endless = value in (math.inf, -math.inf)
    return NO_BOUND if endless else f"{value + 0.0:.{digits}g}"


def _whole(column: Any) -> Any:
    """A column as one array, those made piece by piece too."""
    import numpy as np

    if not isinstance(column, Column):
        return column
    starts = range(0, len(column), PIECE)
    return np.concatenate([column[start : start + PIECE] for start in starts])


class _Pieces:
    """Rows of a table too long to be held; the piece that was made last is kept."""

    def __init__(self, length: int, make: Callable[[int, int], Sequence[Any]]) -> None:
        self.length, self.make = length, make
        # its start and its columns, replaced together: another thread may ask for another piece
        self.last: tuple[int, Sequence[Any]] = (-1, ())

    def at(self, start: int) -> Sequence[Any]:
        """The columns of the piece that begins there; arrays are read-only, since they are kept."""
        known, columns = self.last
        if start != known:
            columns = self.make(start, min(start + PIECE, self.length))
            for column in columns:
                if not isinstance(column, (list, tuple)):
                    column.flags.writeable = False
            self.last = start, columns
        return columns


class Column:
    """One column of such a table: it has a length, and gives slices within a piece."""

    def __init__(self, pieces: _Pieces, number: int, dtype: str = "float64") -> None:
        self.pieces, self.number, self.dtype = pieces, number, dtype

    def __len__(self) -> int:
        return self.pieces.length

    def __getitem__(self, rows: slice) -> Any:
        start = rows.start - rows.start % PIECE
        return self.pieces.at(start)[self.number][rows.start - start : rows.stop - start]


def pieces(
    length: int, count: int, make: Callable[[int, int], Sequence[Any]], dtype: str = "float64"
) -> list[Column]:
    """``count`` columns of numbers of which ``make(start, stop)`` gives the rows, as arrays.

    ``dtype`` is "object" where some may be lists with None among the numbers. A table of them
    takes the memory of one piece, however many rows are written.
    """
    made = _Pieces(length, make)
    return [Column(made, number, dtype) for number in range(count)]


def is_floats(column: Any) -> bool:
    """Whether a column is an array of doubles."""
    return not isinstance(column, (list, tuple)) and column.dtype == "float64"


def rows_table(
    names: Sequence[str], rows: Sequence[Sequence[Any]], title: str = "", mixed: bool = False
) -> Table:
    """A table from its rows."""
    columns = list(zip(*rows, strict=True)) if rows else [() for _ in names]
    return Table(tuple(names), columns, title=title, mixed=mixed)


def record_table(values: dict[str, Any], title: str = "", prose: str = "") -> Table:
    """A table of one row, to be read line by line."""
    return Table(tuple(values), [(v,) for v in values.values()], True, title, prose)


def flat(table: Table) -> Table:
    """A record with one text or number a name: ``name.1``, ``name.2`` for texts and tables in it.

    For formats that cannot nest. No texts at all are the word none.
    """
    values: dict[str, Any] = {}
    for name, value in zip(table.names, next(table.rows()), strict=True):
        if isinstance(value, Table):
            for i, row in enumerate(value.rows(), 1):
                values |= {f"{name}.{i}.{key}": v for key, v in zip(value.names, row, strict=True)}
        elif isinstance(value, tuple):
            values |= {f"{name}.{i}": text for i, text in enumerate(value, 1)} or {name: "none"}
        else:
            values[name] = value
    return record_table(values, table.title, table.prose)
