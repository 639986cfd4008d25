"""An index of places on a wheel or rack, to find quickly those near a given one."""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.numerics.arrays import Array, Whole


class PlaceIndex:
    """Places (n,), radians, sorted for quick lookup.

    With a finite ``period`` they are directions, from -period/2 to period/2.

    >>> places = PlaceIndex(np.array([0.0, 3.1, -3.1]), math.tau)
    >>> owner, which = places.within(np.array([0.1, math.pi]), 0.2)
    >>> owner.tolist(), which.tolist()
    ([0, 1, 1], [0, 1, 2])
    """

    def __init__(self, place: Array, period: float) -> None:
        self._order, self._period = np.argsort(place), period
        self._place = place[self._order]
        if math.isfinite(period):
            turns = np.repeat((-period, 0.0, period), len(place))
            self._order = np.tile(self._order, 3)  # three periods; lookups are in the middle one
            self._place = np.tile(self._place, 3) + turns

    def within(self, ahead: Array, half: float) -> tuple[Whole, Whole]:
        """Return the entries within ``half`` radians on either side of each of m places.

        Returns the index of the place that each entry belongs to, ascending, and the entry's index.
        """
        middle = ahead
        if math.isfinite(self._period):
            middle = np.remainder(ahead + 0.5 * self._period, self._period) - 0.5 * self._period
        first = np.searchsorted(self._place, middle - half)
        many = np.searchsorted(self._place, middle + half) - first
        owner = np.repeat(np.arange(len(ahead)), many)
        place = np.arange(len(owner)) + np.repeat(first - np.cumsum(many) + many, many)
        return owner, self._order[place]
