"""Proved bounds of how far a roller moves: its path's formulas, evaluated on intervals."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias, cast

import numpy as np

from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import Array, Mask, Undecided, Whole
from geneva_cli.numerics.intervals import Interval, size_of
from geneva_cli.numerics.jet import Jet, Number

Curve: TypeAlias = Callable[[Number, int], tuple[Jet, Jet]]

UNKNOWN = 1e30  # mm: a bound that is not known, so large that no interval closes with it


class Travel:
    """Bounds of the speed and the second derivative of a curve between two input angles.

    The angles are those of one engagement, from its mid-motion; lengths are mm. ``rates`` (2, n)
    has the bounds on the n cells between ``edges``, infinite if unknown, in units of ``length``. A
    curve that runs all round repeats after ``turn_deg``.
    """

    def __init__(
        self, edges: Sequence[float], rates: Array, length: float, turn_deg: float = 0.0
    ) -> None:
        speed, bend = np.minimum(length * rates, UNKNOWN)
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
        return self._greatest(self.bend, start, end) * np.radians(end - start) ** 2 / 8.0

    def _greatest(self, values: Array, start: Array, end: Array) -> Array:
        """Return the greatest value of the cells that intervals touch."""
        touch = (self.edges[:-1] <= end[:, None]) & (self.edges[1:] >= start[:, None])
        return np.where(touch, values, 0.0).max(axis=1)


def path_travel(engagement: Engagement, length: float, turn_deg: float) -> Travel:
    """Return the travel of a roller's path through a whole turn in the fixed frame."""
    edges = _edges(engagement, -0.5 * turn_deg, 0.5 * turn_deg)
    start, end = np.array(edges[:-1]), np.array(edges[1:])
    moving = np.full(len(start), True)
    if engagement.groove is not None:
        from geneva_cli.motion.groove_path import dwell_rates

        dwell = dwell_rates(engagement.groove)
        if dwell:
            moving = (engagement.entry_deg <= start) & (end <= engagement.exit_deg)
    rates = np.empty((2, len(start)))
    rates[:, moving] = curve_rates(engagement.path, start[moving], end[moving])
    if not moving.all():
        rates[:, ~moving] = np.array(dwell)[:, None]
    return Travel(edges, rates, length, turn_deg)


def slot_travel(engagement: Engagement, length: float) -> Travel:
    """Return the travel of a roller in its slot, in the wheel's frame."""
    edges = _edges(engagement, engagement.entry_deg, engagement.exit_deg)
    rates = curve_rates(engagement.slot, np.array(edges[:-1]), np.array(edges[1:]))
    return Travel(edges, rates, length)


def _edges(engagement: Engagement, start: float, end: float) -> list[float]:
    """Return the ends of cells; no formula changes within a cell of the motion."""
    # on cells longer than a degree of the input the bounds are much wider
    count = math.ceil(end - start)
    seams = [x for x in engagement.motion.seams_deg if start < x < end]
    return sorted({*np.linspace(start, end, count + 1).tolist(), *seams})


class _Boxes(NamedTuple):
    """Parts of cells: the number of each one's cell, and its ends."""

    cell: Whole
    start: Array
    end: Array

    def some(self, which: Mask) -> _Boxes:
        return _Boxes(self.cell[which], self.start[which], self.end[which])

    def halves(self) -> _Boxes:
        middle = 0.5 * (self.start + self.end)
        starts, ends = (self.start, middle), (middle, self.end)
        return _Boxes(np.tile(self.cell, 2), np.concatenate(starts), np.concatenate(ends))


def curve_rates(curve: Curve, start: Array, end: Array) -> Array:
    """Return the greatest sizes of a curve's two derivatives on n cells (2, n)."""
    rates, tries = np.zeros((2, len(start))), np.zeros(len(start), dtype=int)
    left = [_Boxes(np.arange(len(start)), start, end)]
    while left:
        boxes = left.pop()
        # an interval may reach over the end of a formula's piece by some 1e-12 degrees: each such
        # place takes 80 halves
        boxes = boxes.some(tries[boxes.cell] < 400)
        if not len(boxes.cell):
            continue
        try:
            with np.errstate(all="ignore"):
                x, y = curve(cast("Number", Interval(boxes.start, boxes.end)), 2)
        except Undecided as error:
            answers = np.broadcast_to(error.answers, len(boxes.cell))
            is_open = np.isnan(answers)
            left += [boxes.some(answers == one) for one in sorted(set(answers[~is_open].tolist()))]
            tried = boxes.some(is_open)
            left.append(tried.halves())
        else:
            tried = boxes
            for k, total in enumerate(rates, start=1):
                size = k * np.hypot(size_of(x.c[k]), size_of(y.c[k]))
                np.maximum.at(total, boxes.cell, size)
        np.add.at(tries, tried.cell, 1)
    rates[:, tries >= 400] = math.inf
    return rates
