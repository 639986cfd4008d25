"""The search for peaks by one scan and Newton's method; a single design is a batch of one.

A peak is at a root of the next derivative, at an end of the motion, or where the law's derivative
jumps. It is refined to the last bit, and never the largest sample of a grid.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias, cast

import numpy as np

from geneva_cli.motion.batch import designs_in, selection, taken
from geneva_cli.motion.engagement import Engagement, Peak, WheelMotion
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Which, blocks, joined
from geneva_cli.numerics.extrema import (
    GROUP,
    Rough,
    Stationary,
    greatest_sizes,
    smooth_pieces,
    stationary_points,
)
from geneva_cli.numerics.tolerances import TIE

ORDERS = {"velocity": 1, "acceleration": 2, "jerk": 3, "power": 2}  # derivatives in the quantity
QUANTITIES = tuple(ORDERS)


PeakArray: TypeAlias = Peak[Array]  # the peaks of m designs: (m,)


class _MotionSamples:
    """A motion's speed and its derivatives, to ten digits, at angles in degrees.

    All quantities are scanned at the same places, one block of designs after the other, so these
    samples are kept.
    """

    def __init__(self, motion: WheelMotion, m: int, quantities: Sequence[str]) -> None:
        self.motion, self.some = motion.rough, selection(motion.rough)
        self.every = slice(0, m)
        self.order = 1 + max(ORDERS[name] for name in quantities)
        self.kept: dict[tuple[int, float], tuple[Array, ...]] = {}

    def __call__(self, x: Array, which: Which, order: int) -> tuple[Array, ...]:
        if not isinstance(which, slice):
            return self._rates(x, which, order)
        key = which.start, float(x[0, 0])
        if key not in self.kept:
            self.kept[key] = self._rates(x, which, self.order)
        return self.kept[key]

    def _rates(self, x: Array, which: Which, order: int) -> tuple[Array, ...]:
        every = isinstance(which, slice) and which == self.every
        motion = self.motion if every else self.some(which)
        # Designs lie side by side in memory: each operation runs along all of them.
        return motion.rough_rates(np.asfortranarray(x), order - 1)


class _QuantityCurve(NamedTuple):
    """A quantity over the input angle in degrees, as a function for ``stationary_points``."""

    some: Callable[[Which], WheelMotion]  # the motion of some designs
    quantity: str

    def __call__(self, x: Array, which: Which, order: int) -> list[Array]:
        p = self.some(which)(np.asfortranarray(x), ORDERS[self.quantity] + order).arrays()
        return by_degrees(_quantity(self.quantity, p[1:]), x, order)


class _RoughCurve(NamedTuple):
    """A quantity to ten digits, from samples."""

    samples: _MotionSamples
    quantity: str

    def __call__(self, x: Array, which: Which, order: int) -> list[Array]:
        p = self.samples(x, which, ORDERS[self.quantity] + order)
        return by_degrees(_quantity(self.quantity, p), x, order)


def _quantity(quantity: str, p: tuple[Array, ...]) -> list[Array]:
    """A quantity and its derivatives from the wheel's speed and its derivatives."""
    if quantity != "power":
        return list(p[ORDERS[quantity] - 1 :])
    out = [p[0] * p[1]]
    if len(p) > 2:
        out.append(p[1] ** 2 + p[0] * p[2])
    if len(p) > 3:
        out.append(3.0 * p[1] * p[2] + p[0] * p[3])
    return out


def by_degrees(rates: Sequence[Array], x: Array, order: int) -> list[Array]:
    """A function and its derivatives up to an order by degrees, from those by radians."""
    return [np.broadcast_to(v * DEGREE**k, x.shape) for k, v in enumerate(rates[: order + 1])]


def motion_peaks(
    motion: WheelMotion, quantities: Sequence[str] = QUANTITIES
) -> dict[str, PeakArray]:
    """Greatest sizes over the motions of m designs, ends included, and their input angles, degrees.

    Closed forms are used where a motion has them.
    """
    peaks: dict[str, PeakArray] = {}
    for name in quantities:
        known = motion.closed_peak(name)
        if known is not None:
            peaks[name] = PeakArray(*(np.ravel(v) for v in np.broadcast_arrays(*known)))
    sought = [name for name in quantities if name not in peaks]
    if sought:
        peaks |= search_peaks(motion, sought)
    for name, peak in peaks.items():
        open_ = np.flatnonzero(np.isnan(peak.max))
        if len(open_):
            rest = search_peaks(taken(motion, open_), [name])[name]
            peak.max[open_], peak.at_deg[open_] = rest
    return peaks


def landmarks(motion: WheelMotion, quantity: str, m: int) -> Stationary:
    """Stationary points of a quantity of m designs, and the ends of its smooth parts, in order.

    Between two consecutive ones it only rises or only falls.
    """
    pieces = smooth_pieces(motion.breaks(m), motion.BREAKS_TO)
    first, last = (np.vstack(ends) for ends in zip(*pieces, strict=True))
    whole = _QuantityCurve(selection(motion), quantity)

    def curve(x: Array, which: Which, order: int) -> list[Array]:
        return whole(x, np.arange(len(last))[which] % m, order)

    every = np.arange(len(last))
    ends = [Stationary(every, x[:, 0], curve(x, every, 0)[0][:, 0]) for x in (first, last)]
    which, x, value = joined([stationary_points(curve, first, last), *ends])
    which = which % m
    order = np.lexsort((x, which))
    return Stationary(which[order], x[order], value[order])


def search_peaks(motion: WheelMotion, quantities: Sequence[str]) -> dict[str, PeakArray]:
    """The peaks from the search only, without closed forms."""
    # mid-motion, where wheels have their narrowest peaks, is one of them
    m = designs_in(motion)
    places = np.hstack([x for x in motion.breaks(m) if not motion.symmetric or np.all(x <= 0.0)])
    parts = [_part(motion, places, block, quantities) for block in blocks(m, GROUP)]
    return {name: joined([part[name] for part in parts]) for name in quantities}


def _part(
    motion: WheelMotion, places: Array, which: slice, quantities: Sequence[str]
) -> dict[str, PeakArray]:
    """Peaks of some of the designs, between their breaks."""
    here = places[which]
    some = motion if len(here) == len(places) else taken(motion, which)
    samples, edges = _MotionSamples(some, len(here), quantities), np.hsplit(here, here.shape[1])
    own, peaks = selection(some), {}
    for name in quantities:
        curve = _QuantityCurve(own, name)
        rough = Rough(_RoughCurve(samples, name), some.ROUGH_TO)
        sizes = greatest_sizes(curve, *edges, rough=rough, unsure=some.BREAKS_TO)
        peaks[name] = PeakArray(*sizes)
    return peaks


def greater(first: PeakArray, other: PeakArray) -> PeakArray:
    """The greater of two sizes; if they are equal, at the place of the first."""
    more = other.max > first.max * (1.0 + TIE)
    return PeakArray(
        np.where(other.max > first.max, other.max, first.max),
        np.where(more, other.at_deg, first.at_deg),
    )


def braking(engagement: Engagement) -> float:
    """Greatest -psi2 of a motion; (m, 1) for m designs."""
    motion = engagement.motion
    m = designs_in(motion)
    which, _, value = landmarks(motion, "acceleration", m)
    most = np.full(m, -np.inf)
    np.maximum.at(most, which, -value)
    one = m == 1 and isinstance(motion.entry_deg, float)
    return float(most[0]) if one else cast("float", most[:, None])
