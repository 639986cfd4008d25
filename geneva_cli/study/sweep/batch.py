"""Rows of a sweep computed as arrays, for designs that one batch machine can represent."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.machine.many import many, may_vary
from geneva_cli.machine.spec import Spec
from geneva_cli.study.batches import Batch, cells_of, number_rows
from geneva_cli.study.fields import Cell
from geneva_cli.study.sweep.values import Value


def table(
    rows: Sequence[Sequence[Value]],
    keys: Sequence[str],
    names: Sequence[str],
    read: Callable[[Sequence[Value]], Spec],
) -> Mapping[int, list[Cell]]:
    """Quantities of the designs that can be computed as arrays, by their numbers in ``rows``.

    ``read`` makes the spec of a row. A missing design must be computed alone, or cannot be built.
    """
    known = number_rows(machines(rows, keys, read), names)
    return {i: cells for i, row in known.items() if (cells := cells_of(row))}


def machines(
    rows: Sequence[Sequence[Value]],
    keys: Sequence[str],
    read: Callable[[Sequence[Value]], Spec],
) -> Iterator[Batch]:
    """Yield batch machines of the rows' designs, each with the numbers of its designs.

    ``read`` makes the spec of a row. Rows that share their words are machines of one kind, which
    tells which of their numbers may be arrays; the rows of a batch share the others too.
    """
    numbers = [k for k in range(len(keys)) if not any(isinstance(row[k], str) for row in rows)]
    for kind in _groups(rows, range(len(rows)), numbers):
        spec = _first_spec(rows, kind, read)
        wide = [k for k in numbers if spec and _may_vary(spec, keys[k])]
        for members in _groups(rows, kind, wide) if wide else ():
            spec = _first_spec(rows, members, read)
            if spec is None:
                continue
            batch = many(spec, {keys[k]: np.array([rows[i][k] for i in members]) for k in wide})
            if batch.machine is not None:
                yield [members[i] for i in batch.which.tolist()], batch.machine


def _groups(
    rows: Sequence[Sequence[Value]], members: Sequence[int], wide: Collection[int]
) -> Iterator[list[int]]:
    """Groups of the members that differ only in the keys numbered ``wide``."""
    groups: dict[tuple[Value, ...], list[int]] = {}
    for i in members:
        common = tuple(v for k, v in enumerate(rows[i]) if k not in wide)
        groups.setdefault(common, []).append(i)
    yield from groups.values()


def _first_spec(
    rows: Sequence[Sequence[Value]],
    members: Sequence[int],
    read: Callable[[Sequence[Value]], Spec],
) -> Spec | None:
    """The first valid spec among the first 20 members; None if there is none."""
    for i in members[:20]:
        try:
            return read(rows[i])
        except GenevaError:
            continue
    return None


def _may_vary(spec: Spec, key: str) -> bool:
    try:
        return may_vary(spec, key)
    except GenevaError:  # the key belongs to another kind of machine
        return False
