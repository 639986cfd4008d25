"""Batches of one engagement, divided into groups that are computed together."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from geneva_cli.loads.load_functions import LoadBatch
from geneva_cli.motion.batch import taken
from geneva_cli.numerics.arrays import Array, Number, Whole


def of_groups(
    every: LoadBatch, computed: Callable[[LoadBatch, int], Sequence[Array]]
) -> tuple[Array, ...]:
    """Arrays (rows, m), joined from those that ``computed`` returns for n designs at a time.

    Designs without friction form groups of their own: their torque is bounded even where the force
    is not.
    """
    m = every.case.designs
    out: list[Array] = []
    for part in parts(every.case.all_friction, m):
        some = computed(taken(every, part), len(part))
        out = out or [np.empty((len(rows), m)) for rows in some]
        for whole, rows in zip(out, some, strict=True):
            whole[:, part] = rows
    return tuple(out)


def parts(friction: Number, m: int) -> Iterator[Whole]:
    """The numbers of m designs in groups; designs without friction have groups of their own."""
    group = 4096  # designs that are computed together
    rubs = np.broadcast_to(np.ravel(friction) != 0.0, (m,))
    for those in (np.flatnonzero(~rubs), np.flatnonzero(rubs)):
        for i in range(0, len(those), group):
            yield those[i : i + group]
