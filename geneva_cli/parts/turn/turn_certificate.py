"""Certificate of the full turn: a proved lower bound of the gap at every input angle.

Distances at single positions are taken as exact, up to their rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.turn.play import windows
from geneva_cli.parts.turn.stops import Pose
from geneva_cli.parts.turn.turned_parts import Intervals, TurnedParts, Window

if TYPE_CHECKING:
    from geneva_cli.parts.turn.turned_parts import Clearances

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
    todo: list[tuple[str, Callable[[Intervals], tuple[Array, Array]], tuple[float, float]]] = []
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
            start, end, *gap = bound.open
            shown = parts.assembly.shown_deg
            return Certificate(least, count, Open(shown(start), shown(end), *gap), between)
    return Certificate(least, count)


def _halved(
    gaps: Clearances,
    pair: Callable[[Intervals], tuple[Array, Array]],
    ends: tuple[float, float],
    target: float,
) -> Certificate:
    """Return a lower bound of a pair's gap, by halving intervals until it is ``target`` mm on each.

    Without success the most doubtful interval is returned as open.
    """
    cuts = np.linspace(*ends, 33)
    start, end = cuts[:-1], cuts[1:]
    least, count = math.inf, 0
    while len(start):
        count += len(start)
        middle, bound = pair(intervals(gaps, start, end))
        closed = bound >= target
        least = min(least, float(bound[closed].min(initial=math.inf)))
        table = np.array((start, end, middle, bound))[:, ~closed]
        start, end, middle, bound = table
        collides = bool((middle < target).any())
        if collides or count + 2 * len(start) > MOST:
            i = int(np.argmin(middle if collides else bound))
            return Certificate(least, count, Open(*table[:, i].tolist()))
        half = 0.5 * (start + end)
        start, end = np.concatenate((start, half)), np.concatenate((half, end))
    return Certificate(least, count)


def intervals(gaps: Clearances, start: Array, end: Array) -> Intervals:
    """Return intervals of the input angle, with the turn of crank and wheel on them, and poses.

    Where the wheel turns back, its turn is a whole one: no point moves farther than that.
    """
    pose, count = gaps.pose(np.concatenate((start, 0.5 * (start + end), end))), len(start)
    wheel, crank = pose.wheel.reshape(3, count), pose.crank.reshape(3, count)
    steps = np.diff(wheel, axis=0)
    # the wheel's angle is rounded by less than 1e-12 radians
    turn = np.where((steps < -1e-12).any(axis=0), math.tau, steps.max(axis=0))
    crank_turn = np.abs(np.diff(np.unwrap(crank, axis=0), axis=0)).max(axis=0)
    poses = map(Pose, wheel, crank, pose.pins.reshape(3, count, *pose.pins.shape[1:]))
    return Intervals(start, end, crank_turn, turn, *poses)


def spans(parts: TurnedParts, window: Window) -> list[tuple[tuple[float, float], int | None]]:
    """Return the spans of a motion or dwell, each with the roller that is in its slot, or None.

    Between two rollers of a motion gears drive the wheel, from the deepest position to that of the
    other.
    """
    start, end, motion, rests = window
    assembly = parts.assembly
    if rests or not assembly.motions[motion].engagement.paired:
        return [((start, end), None if rests else motion)]
    first, last = 2 * motion, 2 * motion + 1
    leaves = start + (assembly.rollers[first].mid - start) % assembly.turn_deg
    meets = start + (assembly.rollers[last].mid - start) % assembly.turn_deg
    return [((start, leaves), first), ((leaves, meets), None), ((meets, end), last)]
