"""An index of directions, to find quickly those near a given one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array


class AngularIndex:
    """Directions (n,), radians from -pi to pi, sorted for quick lookup.

    >>> places = AngularIndex(np.array([0.0, 3.1, -3.1]))
    >>> owner, which = places.within(np.array([0.1, math.pi]), 0.2)
    >>> owner.tolist(), which.tolist()
    ([0, 1, 1], [0, 1, 2])
    """

    def __init__(self, direction: Array) -> None:
        order = np.argsort(direction)
        turns = np.repeat((-math.tau, 0.0, math.tau), len(order))
        self._order = np.tile(order, 3)  # three turns; the middle one is from -pi to pi
        self._direction = np.tile(direction[order], 3) + turns

    def within(self, ahead: Array, half: float) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return the entries within ``half`` radians on either side of each of m directions.

        Returns the index of the direction that each entry belongs to, ascending, and the entry's
        index.
        """
        middle = np.remainder(ahead + math.pi, math.tau) - math.pi
        first = np.searchsorted(self._direction, middle - half)
        many = np.searchsorted(self._direction, middle + half) - first
        owner = np.repeat(np.arange(len(ahead)), many)
        place = np.arange(len(owner)) + np.repeat(first - np.cumsum(many) + many, many)
        return owner, self._order[place]


def half_angle(reach: float, away: float) -> float:
    """Return half the angle, radians, that a disc of radius ``reach`` spans from ``away``."""
    return math.asin(reach / away) if reach < away else math.pi
