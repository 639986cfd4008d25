"""The angles that a wheel of any outline may have, at each angle of its crank.

The wheel's axis is the origin, and the crank's axis is at (L, 0). At crank angle 0 the first
roller points to the wheel's axis, for an internal wheel away from it. The wheel turns
counterclockwise as the crank's angle rises.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator
from copy import copy
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.motion.pivots import PlaneMotion
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.parts.turn.stops import Branches, Meetings, Stops

SAME = 1e-12  # radians: intervals of adjacent pieces leave no gap
BLOCK = 32  # crank angles that are computed together, as much the same pieces are near then

Intervals: TypeAlias = tuple[Whole, Array, Array]  # rows, starts and ends


class Range(NamedTuple):
    """A range of the wheel's angle, radians: free, or blocked by an overlap."""

    is_free: bool
    low: float
    high: float


class FreeRanges:
    """Free ranges of a wheel at any angles of its crank; both outlines in their own frames, in mm.

    ``sense`` is 1 for an external wheel, -1 for an internal one. Parts that overlap by at most
    ``slack`` mm count as touching. The outline may repeat after ``pitch`` radians.
    """

    def __init__(
        self, wheel: Polyarc, crank: Polyarc, L: float, sense: float, pitch: float, slack: float
    ) -> None:
        far = levels(crank)[1].max()
        low, high = levels(wheel)
        wheel = wheel.subset(np.flatnonzero((high >= L - far - slack) & (low <= L + far + slack)))
        low, high = levels(crank)
        crank = crank.subset(np.flatnonzero(L - high <= levels(wheel)[1].max(initial=0.0)))
        self.crank, self.L, self.sense, self.slack = crank, L, sense, slack
        which = wheel.one_sector(pitch, slack)
        self.period = math.tau if which is None else pitch
        sector = wheel if which is None else wheel.subset(which)
        # one sector stands for all, so that rounded numbers of a drawing make no difference
        self.stops = Stops(sector, self.period, crank, 0.0, PlaneMotion(L))
        self.own = self.stops.branches(sector, None, 0.0)

    def with_slack(self, slack: float) -> FreeRanges:
        """Return the ranges in which parts may overlap by another ``slack``, mm."""
        out = copy(self)
        out.slack = slack
        return out

    def crank_direction(self, crank_angle: Array) -> Array:
        """Return the direction of the crank's x axis, radians, at crank angles (n,)."""
        return np.pi - crank_angle if self.sense > 0.0 else crank_angle

    def at(self, crank_angle: Array) -> Ranges:
        """Return the free ranges at crank angles (n,), radians."""
        parts = [(np.zeros(0, dtype=int), np.zeros(0), np.zeros(0))]
        for first in range(0, len(crank_angle), BLOCK):
            for row, start, end, *_ in self.meetings(crank_angle[first : first + BLOCK]):
                parts.append((first + row, start, end))
        row, start, end = map(np.concatenate, zip(*parts, strict=True))
        return Ranges((row, start, end), len(crank_angle), self.period)

    def meetings(self, crank_angle: Array) -> Iterator[Meetings]:
        """Yield the pairs of branches that meet at crank angles (n,), which are near each other."""
        direction, crank, moves = self.crank_direction(crank_angle), self.crank, self.stops.moves
        reach = crank.size + 0.5 * np.ptp(direction) * np.hypot(*crank.middles.T)
        middle = 0.5 * (direction[:1] + direction[-1:])
        far, own = moves.level(moves.from_crank(crank.middles, middle))[0], Branches(*self.own)
        low, high = own.low.min(initial=np.inf), own.high.max(initial=0.0)
        some = np.flatnonzero((far - reach <= high) & (far + reach >= low))
        if len(some):
            near = self.stops.branches(crank.subset(some), direction, self.slack)
            yield from self.stops.meetings(near, self.own)


class Ranges:
    """The free ranges of n poses, from the intervals that are blocked in them."""

    def __init__(self, intervals: Intervals, count: int, period: float) -> None:
        self.period = period
        row, start, end = intervals
        shift = period * np.floor(start / period)
        row, start, end = union(row, start - shift - SAME, end - shift + SAME)
        # with the copies a period before and after, those that cross an end of the period merge
        copy = np.repeat((0.0, -period, period), len(row))
        row, start, end = union(np.tile(row, 3), np.tile(start, 3) + copy, np.tile(end, 3) + copy)
        self.intervals = row, start, end
        self.ends = np.searchsorted(row, np.arange(count + 1)).tolist()
        self.low, self.high = start.tolist(), end.tolist()

    def around(self, i: int, angle: float) -> Range:
        """Return the range about an angle of the wheel, radians, in the i-th pose."""
        shift = self.period * math.floor(angle / self.period)
        first, last = self.ends[i], self.ends[i + 1]
        k = bisect_left(self.low, angle - shift, first, last)
        before = self.high[k - 1] + shift if k > first else angle - 0.5 * self.period
        after = self.low[k] + shift if k < last else angle + 0.5 * self.period
        if angle < before:
            return Range(False, self.low[k - 1] + shift, before)
        return Range(True, before, after)


def union(row: Whole, start: Array, end: Array) -> Intervals:
    """Return the union of intervals in each row: rows, starts and ends, ascending."""
    if not len(row):
        return row, start, end
    order = np.lexsort((start, row))
    row, start, end = row[order], start[order], end[order]
    # rows are far apart on one axis, so that one running maximum serves all of them
    spread = 2.0 * (float(np.abs(start).max()) + float(np.abs(end).max()) + 1.0)
    reach = np.maximum.accumulate(end + spread * row)
    begins = np.append(True, (start + spread * row)[1:] > reach[:-1])
    first = np.flatnonzero(begins)
    return row[first], start[first], np.maximum.reduceat(end, first)


def levels(outline: Polyarc) -> tuple[Array, Array]:
    """Return the least and greatest distance of each piece from the origin, mm."""
    origin = np.zeros((1, 2))
    return outline.distances(*origin.T)[0], outline.farthest(origin)[0]
