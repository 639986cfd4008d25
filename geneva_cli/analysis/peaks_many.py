"""Peaks of many designs at once: those of ``peaks``, by one scan and one Newton for all of them.

>>> import numpy as np
>>> from geneva_cli import External, SideCrank
>>> from geneva_cli.machine.many import many
>>> from geneva_cli.machine.spec import Spec
>>> found = many(Spec(External(6), SideCrank(A=0.0)), {"drive.A": np.array([0.0, 0.6, 2.0])})
>>> found.spread(worst_of_many(found.machine, ["velocity"])["velocity"].max)
array([1.   , 0.625,   nan])
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geneva_cli.machine.engagement import Engagement, Motion
from geneva_cli.machine.many import taken
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.roots import TIE
from geneva_cli.numerics.roots_many import peaks_many

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array
    from geneva_cli.numerics.roots_many import Which

ABOVE = {"velocity": 1, "acceleration": 2, "jerk": 3, "power": 2}  # derivatives in the quantity
QUANTITIES = tuple(ABOVE)


class PeakOfMany(NamedTuple):
    """The greatest size of a quantity in each design, and its first signed input angle: (m,)."""

    max: Array
    at_deg: Array


class _Curve(NamedTuple):
    """A quantity over the input angle in degrees, as ``roots_many`` asks for it."""

    motion: Motion
    quantity: str

    def __call__(self, x: Array, which: Which, order: int) -> list[Array]:
        # Designs lie side by side in memory: each operation runs along all of them.
        angles = np.asfortranarray(x)
        p = taken(self.motion, which)(angles, ABOVE[self.quantity] + order).derivatives()
        if self.quantity == "power":
            out = [p[1] * p[2], p[2] ** 2 + p[1] * p[3], 3.0 * p[2] * p[3]]
            if order > 1:
                out[2] = out[2] + p[1] * p[4]
        else:
            out = list(p[ABOVE[self.quantity] :])
        return [np.broadcast_to(v * DEGREE**k, x.shape) for k, v in enumerate(out[: order + 1])]


def peak_of_many(motion: Motion, quantity: str) -> PeakOfMany:
    """The greatest size of one quantity over the motions of m designs, ends included."""
    known = motion.known(quantity)
    if known is not None:
        return PeakOfMany(*(np.ravel(v) for v in np.broadcast_arrays(*known)))
    breaks = [x for x in motion.breaks_deg if not motion.symmetric or np.all(x <= 0.0)]
    m = np.size(motion(motion.entry_deg, 1).c[1] + motion.entry_deg)
    places = [np.broadcast_to(x, (m, 1)) for x in breaks]
    best: PeakOfMany | None = None
    curve = _Curve(motion, quantity)
    for a, b in zip(places, places[1:], strict=False):
        # A break belongs to the piece before it; the piece after begins one double later.
        start = a if best is None else np.nextafter(a, np.inf)
        here = PeakOfMany(*peaks_many(curve, start, np.maximum(start, b)))
        best = here if best is None else _greater(best, here)
    assert best is not None  # a motion has an entry and an exit
    return best


def _greater(first: PeakOfMany, other: PeakOfMany) -> PeakOfMany:
    """The greater of two peaks; of two that are one the first."""
    more = other.max > first.max * (1.0 + TIE)
    return PeakOfMany(
        np.where(more, other.max, first.max), np.where(more, other.at_deg, first.at_deg)
    )


def peaks_of_many(
    engagement: Engagement, quantities: Sequence[str] = QUANTITIES
) -> dict[str, PeakOfMany]:
    """The peaks of one engagement of m designs, at its own input angles."""
    return {name: peak_of_many(engagement.motion, name) for name in quantities}


def worst_of_many(
    mechanism: Mechanism, quantities: Sequence[str] = QUANTITIES
) -> dict[str, PeakOfMany]:
    """The greatest peaks over all engagements; angles are the machine's input angles."""
    best: dict[str, PeakOfMany] = {}
    for engagement in mechanism.engagements:
        for name, found in peaks_of_many(engagement, quantities).items():
            at_deg: Any = engagement.mid_deg + found.at_deg[:, None]
            here = PeakOfMany(found.max, np.ravel(mechanism.shown_deg(at_deg)))
            best[name] = _greater(best[name], here) if name in best else here
    return best
