"""Many designs at once, built as batch machines where possible, and their quantities as arrays."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import BEFORE, Spec
from geneva_cli.motion.many import many, may_vary
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.study.fields import Cell, Rows, cells_of
from geneva_cli.verdict.quantities.groups import GROUP_OF, Designs

Batch: TypeAlias = tuple[Whole, Mechanism]  # the numbers of some designs, and their machine


def numbers(batches: Iterable[Batch], names: Sequence[str], count: int) -> Array:
    """The quantities ``names`` (q, n) of n = ``count`` designs of batches, as ``columns`` does.

    NaN for a design of no batch, or whose engagements have no common number.
    """
    out = np.full((len(names), count), np.nan)
    for members, machine in batches if names else ():
        out[:, members] = columns(machine, names, len(members))
    return out


def batch_machines(specs: Sequence[Spec]) -> Iterator[Batch]:
    """Batch machines, each with the indices of its specs.

    A spec that cannot be built is in none of them.
    """
    return SpecGroups(specs).machines(np.arange(len(specs)))


def batch_rows(rows: Rows, read: Callable[[Sequence[Cell]], Spec]) -> Iterator[Batch]:
    """Batch machines of rows of values of keys, each with the numbers of its rows.

    ``read`` makes the spec of a row, which takes longer than the row's share of a batch: it is
    called for the first rows of a batch only. Rows that share their words are machines of one kind,
    which tells which of their numbers may be arrays; the rows of a batch share the others too.
    """
    numbers = [
        key
        for key, column in rows.columns.items()
        if not (column.dtype == object and any(isinstance(cell, str) for cell in column))
    ]

    def first_spec(members: Whole) -> Spec | None:
        for i in members[:20].tolist():
            with suppress(GenevaError):
                return read(rows.row(i))
        return None

    def groups(members: Whole, wide: Sequence[str]) -> Iterable[Whole]:
        """The members in groups that are equal in all columns but these."""
        shared = [cells_of(rows.columns[key][members]) for key in rows.columns if key not in wide]
        if not shared:
            return [members]
        alike: dict[object, list[int]] = {}
        for i, cells in zip(members.tolist(), zip(*shared, strict=True), strict=True):
            alike.setdefault(cells, []).append(i)
        return map(np.array, alike.values())

    for kind in groups(np.arange(len(rows)), numbers):
        wide = []
        if spec := first_spec(kind):
            wide = [key for key in numbers if may_vary(spec, key)]
        for members in groups(kind, wide) if wide else ():
            if spec := spec if members is kind else first_spec(members):
                own = rows.taken(members).columns
                varied = {key: np.array(own[key].tolist()) for key in wide}
                yield from built(spec, varied, members)


def built(spec: Spec, varied: Mapping[str, Array], members: Whole) -> Iterator[Batch]:
    """The machine of a spec with its keys varied (n,), if any of its designs can be built.

    Keys with one value throughout are no arrays in it.
    """
    same = {key for key, value in varied.items() if not (value != value[0]).any()}
    same -= {next(iter(varied))} if len(same) == len(varied) else set()
    batch = many(spec, {key: v[0].item() if key in same else v for key, v in varied.items()})
    if batch.machine is not None:
        yield members[batch.which], batch.machine


# Loads, sizes and all the rest: equal in a batch, as their keys do not vary in it.
_SHARED = [
    name
    for name in Spec._parameters
    if name not in ("wheel", "drive", "drive_before", "motion", "path", "title")
]


class SpecGroups:
    """Specs in groups that can be batches: with equal values of all that may not be an array."""

    def __init__(self, specs: Sequence[Spec]) -> None:
        self.specs = specs
        self._own: list[dict[str, float]] = []  # of each spec the numbers that may vary
        groups, each = dict[object, int](), list[int]()
        for spec in specs:
            before, law = type(spec.drive_before), spec.motion and spec.motion.law
            kinds = type(spec.wheel), type(spec.drive), before, law
            own, shape = dict[str, float](), [kinds, *map(vars(spec).get, _SHARED)]
            for table in ("wheel", "drive", BEFORE, "motion"):  # where specs of a target differ
                for key, value in spec.table(table).items():
                    name = f"{table}.{key}"
                    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
                    if is_number and may_vary(spec, name):
                        own[name] = value
                    else:
                        shape.append((name, value))
            self._own.append(own)
            each.append(groups.setdefault(tuple(shape), len(groups)))
        self._group = np.array(each, dtype=np.intp)

    def machines(self, of: Whole, keys: Mapping[str, Array] = {}) -> Iterator[Batch]:
        """Batch machines of specs by their numbers (n,), each with the indices of its numbers.

        ``keys`` are values (n,) in place of the specs' own; NaN for a key that a spec keeps, and
        infinite where there is no machine.
        """
        group = self._group[of]
        for one in dict.fromkeys(group.tolist()):
            which = np.flatnonzero(group == one)
            own = [self._own[i] for i in of[which].tolist()]
            varied = {key: np.array([one[key] for one in own]) for key in own[0]}
            for key in varied.keys() & keys.keys():
                value = keys[key][which]
                varied[key] = np.where(np.isnan(value), varied[key], value)
            able = np.isfinite([*varied.values()]).all(axis=0)
            if able.any():
                varied = {key: value[able] for key, value in varied.items()}
                yield from built(self.specs[of[which[0]]], varied, which[able])


def columns(machine: Mechanism, names: Sequence[str], count: int) -> list[Array]:
    """Quantities of ``count`` designs in one batch machine, (count,) each.

    All can be computed for a batch. A value is infinite where it is undefined.
    """
    designs, out = Designs(machine, names), list[Array]()
    for name in names:
        value = GROUP_OF[name].columns(designs)[name]
        row = np.ravel(np.inf if value is None else value)
        out.append(np.broadcast_to(np.where(np.isnan(row), np.inf, row), (count,)))
    return out
