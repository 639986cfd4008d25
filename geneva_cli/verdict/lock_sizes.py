"""The sizes of lock and horns that their strength depends on, for one machine or a batch.

Parts are sized one design after the other, as their defaults depend on rollers' whole paths.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geneva_cli.analysis.locking import Lock
from geneva_cli.layout.sizes import Layout, sized
from geneva_cli.layout.stressed import lock_of
from geneva_cli.machine.many import alone, designs_in
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.named_tuple import NamedTuple
from geneva_cli.numerics.arrays import parameter


class LockSizes(NamedTuple):
    """Sizes of slot and lock, mm; (m, 1) for m designs, NaN for those without."""

    half_width: float  # half the slot's width: roller and clearance
    lock: Lock  # in its narrowest sector


def design_lock_sizes(mechanism: Mechanism) -> LockSizes | None:
    """The sizes of m designs: numbers if they are equal in all, None if none has a lock."""
    whole = mechanism.spec
    # the parts' sizes depend on these tables; designs that differ in loads only are sized once
    spec = Spec(whole.wheel, whole.drive, whole.motion, whole.size)
    return layouts_lock_sizes([sized(build(alone(spec, i))) for i in range(designs_in(spec))])


def layouts_lock_sizes(layouts: Sequence[Layout | None]) -> LockSizes | None:
    """The sizes of designs whose parts are laid out; None if none has a lock."""
    m = len(layouts)
    rows = np.full((1 + len(Lock._fields), m, 1), np.nan)
    for i, parts in enumerate(layouts):
        if parts is not None and parts[1].lock:
            rows[:, i, 0] = parts[1].half_width, *lock_of(*parts)
    if np.isnan(rows).all():
        return None
    half_width, *lock = (parameter(row) if m > 1 else row.item() for row in rows)
    return LockSizes(half_width, Lock(*lock))
