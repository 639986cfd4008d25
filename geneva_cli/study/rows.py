"""Rows of designs in columns, which go from a computation to a file without a list for each row."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Whole

Cell: TypeAlias = float | int | str | bool | None
# Numbers, where infinity is no value, or cells of all sorts.
Column: TypeAlias = "Array | Whole | list[Cell]"


class Rows:
    """Rows of equal columns; iteration yields a list of cells for each row."""

    def __init__(self, columns: Sequence[Column]) -> None:
        self.columns = list(columns)

    def __len__(self) -> int:
        return len(self.columns[0])

    def __iter__(self) -> Iterator[list[Cell]]:
        return map(list, zip(*map(cells_of, self.columns), strict=True))

    def row(self, i: int) -> list[Cell]:
        """The cells of one row."""
        return [cells_of(column[i : i + 1])[0] for column in self.columns]

    def numbers(self, at: int) -> Array:
        """A column as numbers (n,), NaN for cells that hold none; True and False are 1 and 0."""
        column = self.columns[at]
        if isinstance(column, list):
            return np.array([float(v) if isinstance(v, (int, float)) else math.nan for v in column])
        return np.where(np.isinf(column), np.nan, column)

    def taken(self, which: Mask | Whole) -> Rows:
        """Some of the rows, by a mask (n,) or by their numbers."""
        numbers = np.flatnonzero(which) if which.dtype == bool else which
        each = numbers.tolist()
        return Rows(
            [[c[i] for i in each] if isinstance(c, list) else c[numbers] for c in self.columns]
        )

    def replaced(self, which: Whole, rows: Sequence[Sequence[Cell]]) -> Rows:
        """The rows with those of these numbers replaced."""
        columns: list[Column] = []
        for column, cells in zip(self.columns, zip(*rows, strict=True), strict=True):
            changed = [*cells_of(column)]
            for i, cell in zip(which.tolist(), cells, strict=True):
                changed[i] = cell
            columns.append(column_of(changed))
        return Rows(columns)


def rows_of(rows: Sequence[Sequence[Cell]]) -> Rows:
    """Rows from the cells of each row, at least one."""
    return Rows([column_of(cells) for cells in zip(*rows, strict=True)])


def joined(several: Sequence[Rows]) -> Rows:
    """The rows of several, at least one, with equal columns."""
    out: list[Column] = []
    for columns in zip(*[rows.columns for rows in several], strict=True):
        arrays = [column for column in columns if not isinstance(column, list)]
        if len(arrays) == len(columns) and len({array.dtype for array in arrays}) == 1:
            out.append(np.concatenate(arrays))
        else:
            out.append([cell for column in columns for cell in cells_of(column)])
    return Rows(out)


def column_of(cells: Sequence[Cell]) -> Column:
    """A column of cells: an array if all are floats or None, or all are whole numbers."""
    types = {*map(type, cells)}
    if float in types and types <= {float, type(None)}:
        return np.array([math.inf if v is None else v for v in cells], dtype=float)
    if types == {int}:  # all of them: an array of whole numbers has no place for None
        whole = np.array(cells)
        return whole if whole.dtype == np.intp else list(cells)  # of more than 63 bits
    return list(cells)


def cells_of(column: Column) -> list[Cell]:
    """The cells of a column as plain Python values, None for no value."""
    if isinstance(column, list):
        return column
    cells: list[Cell] = column.tolist()
    for i in np.flatnonzero(np.isinf(column)).tolist():
        cells[i] = None
    return cells


def without_infinity(column: Column) -> Column:
    """The column as a table has it: with None, not infinity, for no value."""
    has_all = isinstance(column, list) or np.isfinite(column).all()
    return column if has_all else cells_of(column)
