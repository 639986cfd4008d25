"""Certificate of the full turn: a proved lower bound of the gap at every input angle.

Distances at single positions are taken as exact, up to their rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.turn.pairs import Bounds, Clearances, Intervals, TurnedParts, Window
from geneva_cli.parts.turn.play import windows

MOST = 20_000  # intervals of one pair of parts: ten times what the designs take; under a second


class Open(NamedTuple):
    """An interval, degrees, on which the gap is not proved: in its middle, and least."""

    start_deg: float
    end_deg: float
    gap_mm: float
    least_mm: float


class Certificate(NamedTuple):
    """A proved lower bound of the gap, mm, and the number of intervals that it took.

    If an interval is ``open``, it holds elsewhere only. ``between`` names the parts there.
    """

    least_mm: float
    intervals: int
    open: Open | None = None
    between: str = ""


def tolerance_mm(parts: TurnedParts) -> float:
    """Return the tolerance of a certificate by default: how far it is from the smallest gap."""
    # 1 um, or twice the overlap that counts as touching, if that is more
    return max(1e-3, 2.0 * parts.contact)


def certificate(parts: TurnedParts, gap_mm: float, to_mm: float) -> Certificate:
    """Return the certificate that no gap in a full turn is smaller than the smallest by ``to_mm``.

    ``gap_mm`` is the smallest gap of the sampled full turn; an overlap counts as 0.
    """
    # the greatest rounding of a distance; doubles carry 2e-16
    spare = 1e-11 * parts.assembly.L
    target = max(gap_mm, 0.0) - to_mm + spare
    pairs, least, count = parts.pairs(target), math.inf, 0
    todo: list[tuple[str, Callable[[Intervals], Bounds], tuple[float, float]]] = []
    for window in windows(parts):
        if parts.locked:
            ends = window.start, window.end
            todo.append(("locking disc and wheel", partial(pairs.lock, window), ends))
        for span, driver in spans(parts, window):
            for roller in range(len(parts.assembly.rollers)):
                if roller == driver:
                    todo.append(("roller and slot", partial(pairs.driving, roller, span), span))
                else:
                    todo.append(("roller and wheel", partial(pairs.free, roller, window), span))
    for between, pair, ends in todo:
        bound = _halved(parts.gaps, pair, ends, target)
        least, count = min(least, bound.least_mm - spare), count + bound.intervals
        if bound.open:
            start, end = (parts.assembly.shown_deg(x) for x in bound.open[:2])
            shown = bound.open._replace(start_deg=start, end_deg=end)
            return Certificate(least, count, shown, between)
    return Certificate(least, count)


def _halved(
    gaps: Clearances, pair: Callable[[Intervals], Bounds], ends: tuple[float, float], target: float
) -> Certificate:
    """Return a lower bound of a pair's gap, by halving intervals until it is ``target`` mm on each.

    Without success the most doubtful interval is returned as open.
    """
    cuts = np.linspace(*ends, 33)
    start, end = cuts[:-1], cuts[1:]
    least, count = math.inf, 0
    while len(start):
        count += len(start)
        bounds = pair(intervals(gaps, start, end))
        closed = bounds.least >= target
        least = min(least, float(bounds.least[closed].min(initial=math.inf)))
        start, end = start[~closed], end[~closed]
        middle, bound = (each[~closed] for each in bounds)
        collides = bool((middle < target).any())
        if collides or count + 2 * len(start) > MOST:
            i = int(np.argmin(middle if collides else bound))
            left = Open(*(float(each[i]) for each in (start, end, middle, bound)))
            return Certificate(least, count, left)
        half = 0.5 * (start + end)
        start, end = np.concatenate((start, half)), np.concatenate((half, end))
    return Certificate(least, count)


def intervals(gaps: Clearances, start: Array, end: Array) -> Intervals:
    """Return intervals of the input angle, with the turn of crank and wheel on them, and poses.

    Where the wheel turns back, its turn is a whole one: no point moves farther than that.
    """
    pose = gaps.pose(np.concatenate((start, 0.5 * (start + end), end)))
    crank = np.unwrap(pose.crank.reshape(3, -1), axis=0)
    steps = np.diff(pose.wheel.reshape(3, -1), axis=0)
    # the wheel's angle is rounded by less than 1e-12 radians
    turn = np.where((steps < -1e-12).any(axis=0), math.tau, steps.max(axis=0))
    count = len(start)
    poses = [pose.at(slice(i * count, (i + 1) * count)) for i in range(3)]
    return Intervals(start, end, np.abs(np.diff(crank, axis=0)).max(axis=0), turn, *poses)


def spans(parts: TurnedParts, window: Window) -> Iterator[tuple[tuple[float, float], int | None]]:
    """Yield the spans of a motion or dwell, each with the roller that is in its slot, or None.

    Between two rollers of a motion gears drive the wheel, from the deepest position to that of the
    other.
    """
    start, end, motion, rests = window
    assembly = parts.assembly
    if rests or not assembly.motions[motion].engagement.paired:
        yield (start, end), None if rests else motion
        return
    first, last = 2 * motion, 2 * motion + 1
    leaves, meets = (
        start + (assembly.rollers[i].mid - start) % assembly.turn_deg for i in (first, last)
    )
    yield (start, leaves), first
    yield (leaves, meets), None
    yield (meets, end), last
