"""The dimensions of stressed parts, and of the lock, for one machine or a batch.

Parts are sized one design after the other, as their defaults depend on rollers' whole paths.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple, cast

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.motion.batch import designs_in, taken
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.records import thing
from geneva_cli.numerics.arrays import Record, parameter, record_of
from geneva_cli.numerics.jet import Array
from geneva_cli.parts.outlines.cut_outlines import cut_lock
from geneva_cli.parts.outlines.outline_sizes import Layout, sized
from geneva_cli.parts.sizes.stressed import Stressed, stressed


class LockSizes(NamedTuple):
    """Sizes of slot and lock, mm; (m, 1) for m designs, NaN for those without."""

    half_width: float  # half the slot's width: roller and clearance
    lock: Lock  # in its narrowest sector


def design_lock_sizes(mechanism: Mechanism) -> LockSizes | None:
    """The sizes of m designs, (m, 1), or numbers for one; None if none has a lock."""
    whole = mechanism.spec
    # the parts' sizes depend on these tables; designs that differ in loads only are sized once
    spec = Spec(whole.wheel, whole.drive, whole.motion, whole.size, drive_before=whole.drive_before)
    return layouts_lock_sizes([sized(build(taken(spec, i))) for i in range(designs_in(spec))])


def layouts_lock_sizes(layouts: Sequence[Layout | None]) -> LockSizes | None:
    """The sizes of designs whose parts are laid out; None if none has a lock."""
    locks = [
        LockSizes(one[1].half_width, cut_lock(*one)) if one and one[1].lock else None
        for one in layouts
    ]
    return batched(locks, as_numbers)


def batched(
    records: Sequence[Record | None], column: Callable[[Array], object] = np.asarray
) -> Record | None:
    """The records of m designs as one; None if no design has one.

    Each number of it is ``column`` of the (m,) numbers of the designs, NaN for those without.
    """
    like = next((one for one in records if one is not None), None)
    if like is None:
        return None

    def member(k: int) -> object:
        each = [None if one is None else one[k] for one in records]
        if isinstance(like[k], tuple):
            return batched(cast("Sequence[tuple[object, ...] | None]", each), column)
        return column(np.array([math.nan if one is None else one for one in each], dtype=float))

    return record_of(like, [member(k) for k in range(len(like))])


def as_numbers(values: Array) -> float:
    """Numbers (m,) as those of a machine: (m, 1), or one number."""
    return parameter(values[:, None]) if len(values) > 1 else values.item()


def stressed_parts(machine: Mechanism, layout: Layout | None) -> Stressed | None:
    """The stressed parts of a design, flat ones by their layout; None if they do not fit."""
    if layout or machine.spec.is_flat or not machine.spec.has_parts:
        return stressed(*layout) if layout else None
    try:
        own = thing(machine.spec.wheel.NAME, "stressed")
        return own(machine) if own else None
    except GenevaError:  # the check of the parts reports the error
        return None
