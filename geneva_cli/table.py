"""The table: what every command that prints numbers hands to the output."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

PIECE = 65536  # rows of a long table that are made at once; blocks divide it


class Table(NamedTuple):
    """Named columns (lists or arrays) of equal length; the names carry the units.

    A ``record`` has one row, whose dotted names are a tree: json nests it, and people read it
    line by line. A None is a value that does not exist (an empty field, ``null`` in json). In a
    record a value may be a tuple of texts, or a table of its own. ``prose`` stands below the title.
    """

    names: tuple[str, ...]
    columns: Sequence[Any]
    record: bool = False
    title: str = ""
    prose: str = ""

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


class _Pieces:
    """Rows of a table too long to be held; the piece that was made last is kept."""

    def __init__(self, length: int, make: Callable[[int, int], Sequence[Any]]) -> None:
        self.length, self.make = length, make
        self.start = -1
        self.columns: Sequence[Any] = ()

    def at(self, start: int) -> Sequence[Any]:
        """The columns of the piece that begins there."""
        if start != self.start:
            self.columns = self.make(start, min(start + PIECE, self.length))
            self.start = start
        return self.columns


class Column:
    """One column of such a table: it has a length, and gives slices within a piece."""

    dtype = "float64"

    def __init__(self, pieces: _Pieces, number: int) -> None:
        self.pieces, self.number = pieces, number

    def __len__(self) -> int:
        return self.pieces.length

    def __getitem__(self, rows: slice) -> Any:
        start = rows.start - rows.start % PIECE
        return self.pieces.at(start)[self.number][rows.start - start : rows.stop - start]


def pieces(length: int, count: int, make: Callable[[int, int], Sequence[Any]]) -> list[Column]:
    """``count`` columns of numbers of which ``make(start, stop)`` gives the rows, as arrays.

    A table of them takes the memory of one piece, however many rows are written.
    """
    made = _Pieces(length, make)
    return [Column(made, number) for number in range(count)]


def is_floats(column: Any) -> bool:
    """Whether a column is an array of doubles."""
    return not isinstance(column, (list, tuple)) and column.dtype == "float64"


def rows_table(names: Sequence[str], rows: Sequence[Sequence[Any]], title: str = "") -> Table:
    """A table from its rows."""
    columns = list(zip(*rows, strict=True)) if rows else [() for _ in names]
    return Table(tuple(names), columns, title=title)


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
