"""Quantities of a batch of designs as arrays, by their whole names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.study.quantities import group_of, in_batch
from geneva_cli.verdict.quantities.designs import Designs

if TYPE_CHECKING:
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.arrays import Array


def columns(machine: Mechanism, names: Sequence[str], count: int) -> list[Array] | None:
    """Quantities of ``count`` designs in one machine, (count,) each.

    A value is infinite where a design has none, and NaN where the design must be built alone. None
    where one of the quantities is not known of these designs together.
    """
    if not in_batch(names):
        return None
    designs, out = Designs(machine, names), []
    for name in names:
        group = group_of()[name]
        found = group.columns(designs)
        if found is None:
            return None
        value = found.get(name.removeprefix(f"{group.table}."))
        value = np.inf if value is None else value
        out.append(np.broadcast_to(np.reshape(value, -1), (count,)))
    return out
