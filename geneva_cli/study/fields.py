"""The quantities of a design by their names, as ``acceleration.max``, and rows of designs.

A group of quantities is computed only where one of them is requested. Rows are kept in columns,
which go from a computation to a file without a list for each row.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from operator import attrgetter
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.table import Table
from geneva_cli.verdict.quantities.groups import GROUP_OF, QuantityGroup
from geneva_cli.verdict.quantities.quantity_names import in_batch, whole_name

Cell: TypeAlias = float | int | str | bool | None
# Numbers, where infinity is no value, or objects: cells of all sorts.
Column: TypeAlias = "np.ndarray[Any, Any]"


class Rows:
    """Rows of equal columns by their names; iteration yields a list of cells for each row."""

    def __init__(self, columns: Mapping[str, Column]) -> None:
        self.columns = dict(columns)

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))

    def __iter__(self) -> Iterator[list[Cell]]:
        return map(list, zip(*map(cells_of, self.columns.values()), strict=True))

    def row(self, i: int) -> list[Cell]:
        """The cells of one row."""
        return [cells_of(column[i : i + 1])[0] for column in self.columns.values()]

    def numbers(self, name: str) -> Array:
        """A column as numbers (n,), NaN for cells that hold none; True and False are 1 and 0."""
        column = self.columns[name]
        if column.dtype == object:
            return np.array([float(v) if isinstance(v, (int, float)) else math.nan for v in column])
        return np.where(np.isinf(column), np.nan, column)

    def taken(self, which: Mask | Whole | slice) -> Rows:
        """Some of the rows, by a mask (n,) or by their numbers."""
        return Rows({name: column[which] for name, column in self.columns.items()})

    def replaced(self, which: Whole, rows: Iterable[Sequence[Cell]]) -> Rows:
        """The rows with those of these numbers replaced."""
        changed: list[Sequence[Cell]] = [*self]
        for i, row in zip(which.tolist(), rows, strict=True):
            changed[i] = row
        return rows_of(self.columns, changed)


def rows_of(names: Iterable[str], rows: Sequence[Sequence[Cell]]) -> Rows:
    """Rows of named columns from the cells of each row, at least one."""
    return Rows(dict(zip(names, map(column_of, zip(*rows, strict=True)), strict=True)))


def joined(several: Sequence[Rows]) -> Rows:
    """The rows of several, at least one, with equal columns."""
    out = dict[str, Column]()
    for name in several[0].columns:
        columns = [rows.columns[name] for rows in several]
        is_alike = len({column.dtype for column in columns}) == 1
        own = columns if is_alike else [column_of(cells_of(c), object) for c in columns]
        out[name] = np.concatenate(own)
    return Rows(out)


def column_of(cells: Sequence[Cell], kind: type | None = None) -> Column:
    """A column of cells: of floats if all are floats or None, of whole numbers, or of objects."""
    types = {*map(type, cells)}
    if kind is None and float in types and types <= {float, type(None)}:
        return np.array([math.inf if v is None else v for v in cells], dtype=float)
    # an array of whole numbers has no place for None, nor for more than 63 bits
    column = np.array(cells, dtype=kind or (None if types == {int} else object))
    return column if column.dtype in (np.intp, object) else column.astype(object)


def cells_of(column: Column) -> list[Cell]:
    """The cells of a column as plain Python values, None for no value."""
    cells: list[Cell] = column.tolist()
    for i in np.flatnonzero(np.isinf(column)).tolist() if column.dtype == float else ():
        cells[i] = None
    return cells


def values(parts: Parts, groups: Iterable[QuantityGroup]) -> dict[str, Cell]:
    """The quantities of some groups, without tables and multi-line texts.

    An unbounded quantity is None, as in the report's json.
    """
    out: dict[str, Cell] = {}
    for name, value in chain.from_iterable(group.values(parts).items() for group in groups):
        if not isinstance(value, (tuple, Table)):
            is_unbounded = isinstance(value, float) and math.isinf(value)
            out[name] = None if is_unbounded else value
    return out


class Pick(NamedTuple):
    """Quantities to show, by their whole names."""

    names: tuple[str, ...] = ()

    @property
    def groups(self) -> tuple[QuantityGroup, ...]:
        """The groups that contain them, those that make parts last."""
        groups = {GROUP_OF[name].names: GROUP_OF[name] for name in self.names}.values()
        # another group may compute all names of a short one as well
        own = [one for one in groups if not any(set(one.names) < set(x.names) for x in groups)]
        return tuple(sorted(own, key=attrgetter("makes_parts")))

    @property
    def batched(self) -> tuple[str, ...]:
        """The names of the quantities that a batch of designs can compute."""
        return tuple(name for name in self.names if in_batch([name]))

    def of(self, mechanism: Mechanism) -> list[Cell]:
        """The values of the quantities for a machine; None if one does not apply."""
        return self.of_parts(parts_of(mechanism))

    def of_parts(self, parts: Parts, bounds: Iterable[Constraint] = ()) -> list[Cell]:
        """The values of the quantities for a machine's parts; None if one does not apply.

        The parts are not made if another value breaks a bound: what needs parts is then None.
        """
        cells = values(parts, [group for group in self.groups if not group.makes_parts])
        if all(bound.kept(cells[bound.name]) for bound in bounds if bound.name in cells):
            cells |= values(parts, [group for group in self.groups if group.makes_parts])
        return [cells.get(name) for name in self.names]


def pick(requested: Sequence[str]) -> Pick:
    """The quantities of these names, as ``whole_name`` resolves them; each once."""
    return Pick(tuple(dict.fromkeys(map(whole_name, requested))))
