"""Rows of a sweep computed as arrays, for designs that one batch machine can represent."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.machine.many import Many, many, may_vary
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.spec import Spec
from geneva_cli.study.batches import columns
from geneva_cli.study.fields import Cell
from geneva_cli.study.sweep.values import Value


class Batch:
    """Rows that differ in numbers only, and the indices of those that belong to this group."""

    def __init__(self, rows: Sequence[Sequence[Value]], members: list[int]) -> None:
        self.rows, self.members = rows, members

    def spec(self, read: Callable[[Sequence[Value]], Spec]) -> Spec | None:
        """The first valid spec among the first 20 members; None if there is none."""
        for i in self.members[:20]:
            try:
                return read(self.rows[i])
            except GenevaError:
                continue
        return None

    def built(self, spec: Spec, keys: Sequence[str], wide: Sequence[int]) -> Many:
        """The batch machine of all members."""
        varied = {keys[k]: np.array([self.rows[i][k] for i in self.members]) for k in wide}
        return many(spec, varied)


def groups(rows: Sequence[Sequence[Value]], wide: Sequence[int]) -> Iterator[Batch]:
    """Groups of rows that differ only in the keys numbered ``wide``, which may be arrays."""
    apart: dict[tuple[Value, ...], list[int]] = {}
    for i, row in enumerate(rows):
        apart.setdefault(tuple(v for k, v in enumerate(row) if k not in wide), []).append(i)
    yield from (Batch(rows, members) for members in apart.values())


def wide_keys(spec: Spec, keys: Sequence[str], rows: Sequence[Sequence[Value]]) -> list[int]:
    """The numbers of the keys whose values may be arrays in a machine of this spec."""
    numeric = [k for k in range(len(keys)) if all(not isinstance(row[k], str) for row in rows)]
    return [k for k in numeric if _may(spec, keys[k])]


def _may(spec: Spec, key: str) -> bool:
    try:
        return may_vary(spec, key)
    except GenevaError:  # the key belongs to another kind of machine
        return False


def table(
    rows: Sequence[Sequence[Value]],
    keys: Sequence[str],
    names: Sequence[str],
    read: Callable[[Sequence[Value]], Spec],
) -> Mapping[int, list[Cell]]:
    """Quantities of the designs that can be computed as arrays, by their numbers in ``rows``.

    ``read`` makes the spec of a row. A missing design must be computed alone, or cannot be built.
    """
    out: dict[int, list[Cell]] = {}
    for members, machine in machines(rows, keys, read):
        _fill(out, members, machine, names)
    return out


def machines(
    rows: Sequence[Sequence[Value]],
    keys: Sequence[str],
    read: Callable[[Sequence[Value]], Spec],
) -> Iterator[tuple[list[int], Mechanism]]:
    """Yield batch machines of the rows' designs, each with the numbers of its designs.

    ``read`` makes the spec of a row.
    """
    words = [k for k in range(len(keys)) if any(isinstance(row[k], str) for row in rows)]
    for rough in groups(rows, [k for k in range(len(keys)) if k not in words]):
        spec = rough.spec(read)
        if spec is None:
            continue
        own = [rows[i] for i in rough.members]
        wide = wide_keys(spec, keys, own)
        if not wide:
            continue
        for fine in groups(own, wide):
            here = fine.spec(read)
            if here is None:
                continue
            built = fine.built(here, keys, wide)
            if built.machine is not None:
                which = [fine.members[i] for i in built.which.tolist()]
                yield [rough.members[i] for i in which], built.machine


def _fill(
    out: dict[int, list[Cell]], members: Sequence[int], machine: Mechanism, names: Sequence[str]
) -> None:
    values = columns(machine, names, len(members))
    if values is None:
        return
    for i, row in zip(members, np.column_stack(values).tolist(), strict=True):
        if not any(map(math.isnan, row)):
            out[i] = [None if math.isinf(value) else value for value in row]
