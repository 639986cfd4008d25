"""The sizes of the horns of racks, for one machine or a batch."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.numerics.arrays import parameter
from geneva_cli.outlines.rack import rack_sizes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geneva_cli.machine.mechanism import Mechanism


def rack_horns(machines: Sequence[Mechanism]) -> tuple[float, float] | None:
    """Half the slot's width and the recess's radius of racks, (m, 1); None if none has a lock.

    They are NaN for a rack without a lock, and for one that cannot be cut.
    """
    rows = np.full((2, len(machines), 1), np.nan)
    for i, machine in enumerate(machines):
        try:
            sizes = rack_sizes(machine)
        except GenevaError:  # the check of the parts reports the error
            continue
        if sizes.lock:
            rows[:, i, 0] = sizes.half_width, sizes.recess
    if np.isnan(rows).all():
        return None
    half_width, recess = (parameter(row) if len(machines) > 1 else row.item() for row in rows)
    return half_width, recess
