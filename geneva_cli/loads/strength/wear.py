"""The wear of a slot's walls, by Archard's law.

A pin that does not turn wears a volume of k ∫ N |v_s| dt off the wall on which it presses. Spread
over the face that the contact sweeps on that wall, it is the wall's mean depth. Both walls of a
slot differ: where the torque never reverses, one of them takes all. A curved slot has an entry and
an exit, with two walls each.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, Mask, Number, Whole


class Rubbing(NamedTuple):
    """Pieces of n designs' motions, in order, in each of which one wall is rubbed one way."""

    design: Whole
    moved_m: Array  # along the slot, positive away from the wheel's axis
    work: Array  # ∫ N |v_s| dt, J
    wall: Array  # 1 where the wall that drives the wheel bears, -1 where the other does
    branch: Array  # of the slot: 0 of a straight one; -1 entry, 1 exit of a curved one

    def in_rows(self, n: int) -> Rubbing:
        """The pieces of each design as a row, padded with zeros: (n, k) each."""
        number = np.arange(len(self.design)) - np.searchsorted(self.design, self.design)
        shape = n, int(number.max()) + 1
        out = []
        for row in self:
            padded = np.zeros(shape)
            padded[self.design, number] = row
            out.append(padded)
        return Rubbing._make(out)


def greatest_rubbing_N(pieces: Rubbing, n: int) -> Array:
    """The work over the swept length of the wall that has the most of it: (n,), J/m or N.

    NaN for a design whose contact sweeps no wall.
    """
    _, moved, work, wall, branch = pieces.in_rows(n)
    after = np.cumsum(moved, axis=1)
    low, high = np.minimum(after, after - moved), np.maximum(after, after - moved)
    each = []
    for own in ((wall == d) & (branch == b) for d in (1.0, -1.0) for b in (0.0, -1.0, 1.0)):
        if own.any():
            with np.errstate(invalid="ignore"):  # no contact on this wall
                each.append(np.where(own, work, 0.0).sum(axis=1) / _covered(low, high, own))
    most: Array = np.fmax.reduce(each)
    return most


def _covered(low: Array, high: Array, own: Mask) -> Array:
    """The length of the union of each row's ``own`` intervals: (n,)."""
    low, high = np.where(own, low, np.inf), np.where(own, high, -np.inf)
    order = np.argsort(low, axis=1)
    low, high = (np.take_along_axis(row, order, axis=1) for row in (low, high))
    before = np.maximum.accumulate(high, axis=1)[:, :-1]
    low[:, 1:] = np.maximum(low[:, 1:], before)
    length: Array = np.maximum(high - low, 0.0).sum(axis=1)
    return length


def wears_mm(mechanism: Mechanism, rubbing_N: Sequence[Number]) -> Array | None:
    """Mean wear depths in a million passages of the wall that wears most: mm, (m,).

    ``rubbing_N`` are the ``greatest_rubbing_N`` of the engagements; the slot with the most counts.
    None without ``wear_mm3_Nm`` or ``face_width_mm``.
    """
    spec = mechanism.spec
    k, width = spec.material_wheel.wear_mm3_Nm, spec.size.face_width_mm
    if k is None or width is None:
        return None
    rate = np.ravel(1e6 * k / (width * 1000.0))
    worn: Array = np.max([rate * np.ravel(one) for one in rubbing_N], axis=0)
    return worn
