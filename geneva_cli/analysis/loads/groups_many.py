"""Many designs of one engagement in groups that are worked out together."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.loads.loaded_many import Machine
from geneva_cli.machine.many import taken

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Number, Whole

GROUP = 4096  # designs whose stretches are found together


def of_groups(
    every: Machine, found: Callable[[Machine, int], Sequence[Array]]
) -> tuple[Array, ...]:
    """Arrays (rows, n) that are found of n designs at a time, as those of all: (rows, m).

    Designs without friction are apart from those with: a torque whose force has no bound has
    itself a bound without friction alone.
    """
    m = every[1].designs
    out: list[Array] = []
    for part in parts(every[1].friction, m):
        some = found(taken(every, part), len(part))
        out = out or [np.empty((len(rows), m)) for rows in some]
        for whole, rows in zip(out, some, strict=True):
            whole[:, part] = rows
    return tuple(out)


def parts(friction: Number, m: int) -> Iterator[Whole]:
    """The numbers of m designs in groups; those without friction are apart."""
    rubs = np.broadcast_to(np.ravel(friction) != 0.0, (m,))
    for those in (np.flatnonzero(~rubs), np.flatnonzero(rubs)):
        for i in range(0, len(those), GROUP):
            yield those[i : i + GROUP]
