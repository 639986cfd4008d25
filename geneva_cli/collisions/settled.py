"""Proof that a gap stays above a bound at every input angle, by halving intervals."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.collisions.pairs import Intervals, Pair
from geneva_cli.named_tuple import NamedTuple

if TYPE_CHECKING:
    from geneva_cli.collisions.machine_parts import Clearances
    from geneva_cli.numerics.jet import Array

MOST = 20_000  # intervals of one pair of parts: ten times what the designs take; under a second


class Open(NamedTuple):
    """An interval of input angles, degrees, on which the gap was not proved.

    ``gap_mm`` is the gap in its middle, ``least_mm`` the proved lower bound on it.
    """

    start_deg: float
    end_deg: float
    gap_mm: float
    least_mm: float


class Settled(NamedTuple):
    """A lower bound of the gap, mm, the number of intervals, and one that was left, if any."""

    least: float
    intervals: int
    open: Open | None


def settled(gaps: Clearances, pair: Pair, ends: tuple[float, float], target: float) -> Settled:
    """Return a lower bound of a pair's gap between two input angles, at least ``target`` mm.

    Intervals are halved until the bound on each is at least ``target``. Without success the most
    doubtful interval is returned as open.
    """
    # 32 intervals at first
    cuts = np.linspace(*ends, 33)
    start, end = cuts[:-1], cuts[1:]
    least, count = math.inf, 0
    while len(start):
        count += len(start)
        bounds = pair(intervals(gaps, start, end))
        closed = bounds.least >= target
        least = min(least, float(bounds.least[closed].min(initial=math.inf)))
        start, end = start[~closed], end[~closed]
        collides = bounds.middle[~closed] < target
        if collides.any() or count + 2 * len(start) > MOST:
            known = bounds.middle if collides.any() else bounds.least
            i = int(np.argmin(known[~closed]))
            values = (float(each[~closed][i]) for each in bounds)
            return Settled(least, count, Open(float(start[i]), float(end[i]), *values))
        middle = 0.5 * (start + end)
        start, end = np.concatenate((start, middle)), np.concatenate((middle, end))
    return Settled(least, count, None)


def intervals(gaps: Clearances, start: Array, end: Array) -> Intervals:
    """Return intervals of the input angle, with the turn of crank and wheel on them.

    Where the wheel turns back, the ends do not bound its turn. A whole turn does: no point moves
    farther than twice its radius.
    """
    pose = gaps.pose(np.concatenate((start, 0.5 * (start + end), end)))
    crank = np.unwrap(pose.crank.reshape(3, -1), axis=0)
    steps = np.diff(pose.wheel.reshape(3, -1), axis=0)
    # the wheel's angle is rounded by less than 1e-12 radians
    turn = np.where((steps < -1e-12).any(axis=0), math.tau, steps.max(axis=0))
    return Intervals(start, end, np.abs(np.diff(crank, axis=0)).max(axis=0), turn)
