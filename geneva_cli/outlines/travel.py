"""Proved bounds of how far a roller moves: its path's formulas, evaluated on intervals."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias, cast

import numpy as np

from geneva_cli.kinematics.engagement import Engagement
from geneva_cli.layout.groove import dwell_rates
from geneva_cli.numerics.arrays import Undecided
from geneva_cli.numerics.intervals import Interval, size_of
from geneva_cli.numerics.jet import Jet, Number

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

    Curve: TypeAlias = Callable[[Number, int], tuple[Jet, Jet]]
    Rates: TypeAlias = tuple[float, float]  # sizes of a curve's two derivatives

UNKNOWN = 1e30  # mm: a bound that is not known, so large that no interval closes with it


class Travel:
    """Bounds of the speed and the second derivative of a curve between two input angles.

    The angles are those of one engagement, from its mid-motion; lengths are mm. ``rates`` has the
    bounds on the cells between ``edges``, infinite if unknown, in units of ``length``. A curve that
    runs all round repeats after ``turn_deg``.
    """

    def __init__(
        self, edges: Sequence[float], rates: Iterable[Rates], length: float, turn_deg: float = 0.0
    ) -> None:
        speed, bend = np.minimum(length * np.array([*rates]).T, UNKNOWN)
        self.edges = np.array(edges)
        if turn_deg:  # an interval may begin in one turn and end in the next
            speed, bend = np.tile(speed, 2), np.tile(bend, 2)
            self.edges = np.concatenate((self.edges, self.edges[1:] + turn_deg))
        self.bend, self.unknown = bend, np.where(speed < UNKNOWN, 0.0, UNKNOWN)
        known = np.where(speed < UNKNOWN, speed, 0.0)
        self.moved = np.concatenate(([0.0], np.cumsum(known * np.radians(np.diff(self.edges)))))

    def most(self, start: Array, end: Array) -> Array:
        """Return how far the curve is at most, on either half of intervals, from their middles."""
        moved = [np.interp(at, self.edges, self.moved) for at in (start, 0.5 * (start + end), end)]
        out: Array = np.diff(moved, axis=0).max(axis=0)
        return np.maximum(out, self._greatest(self.unknown, start, end))

    def aside(self, start: Array, end: Array) -> Array:
        """Return how far the curve is at most from its chord on intervals."""
        out: Array = self._greatest(self.bend, start, end) * np.radians(end - start) ** 2 / 8.0
        return out

    def _greatest(self, values: Array, start: Array, end: Array) -> Array:
        """Return the greatest value of the cells that intervals touch."""
        touch = (self.edges[:-1] <= end[:, None]) & (self.edges[1:] >= start[:, None])
        out: Array = np.where(touch, values, 0.0).max(axis=1)
        return out


def path_travel(engagement: Engagement, length: float, turn_deg: float) -> Travel:
    """Return the travel of a roller's path through a whole turn in the fixed frame."""
    half, path, groove = 0.5 * turn_deg, engagement.path, engagement.groove
    edges = _edges(engagement, -half, half)
    dwell = None if groove is None else dwell_rates(groove)
    rates = [
        dwell
        if dwell and not engagement.entry_deg <= a < b <= engagement.exit_deg
        else curve_rates(path, a, b)
        for a, b in pairwise(edges)
    ]
    return Travel(edges, rates, length, turn_deg)


def slot_travel(engagement: Engagement, length: float) -> Travel:
    """Return the travel of a roller in its slot, in the wheel's frame."""
    edges = _edges(engagement, engagement.entry_deg, engagement.exit_deg)
    rates = [curve_rates(engagement.slot, a, b) for a, b in pairwise(edges)]
    return Travel(edges, rates, length)


def _edges(engagement: Engagement, start: float, end: float) -> list[float]:
    """Return the ends of cells; no formula changes within a cell of the motion."""
    # on cells longer than a degree of the input the bounds are much wider
    count = math.ceil(end - start)
    seams = [x for x in engagement.motion.seams_deg if start < x < end]
    return sorted({*np.linspace(start, end, count + 1).tolist(), *seams})


def curve_rates(curve: Curve, start: float, end: float) -> Rates:
    """Return the greatest sizes of a curve's two derivatives; infinite where none is known.

    Where another formula takes over within a cell, it is halved down to that place.
    """
    speed = bend = 0.0
    left = [(start, end)]
    # an interval may reach over the end of a formula's piece by some 1e-12 degrees: each such place
    # takes 80 halves
    for _ in range(400):
        if not left:
            return speed, bend
        start, end = left.pop()
        try:
            x, y = curve(cast("Number", Interval(start, end)), 2)
        except Undecided:
            middle = 0.5 * (start + end)
            left += [(start, middle), (middle, end)]
            continue
        speed = max(speed, math.hypot(size_of(x.c[1]), size_of(y.c[1])))
        bend = max(bend, 2.0 * math.hypot(size_of(x.c[2]), size_of(y.c[2])))
    return math.inf, math.inf
