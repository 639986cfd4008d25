"""Boxes: an interval of a path for the entry and one for the exit that may contain a pair.

Cubics through values and slopes at the corners of a box show if it can contain a pair; see
``pairs``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.kinematics.paths.samples import PathPoints, PathSamples, joined, points
from geneva_cli.kinematics.roller_path import RollerPath
from geneva_cli.numerics.arrays import Array, Mask, Number, Whole

THIRD = 1.0 / 3.0
# Possible error of a quantity's cubics, as a fraction of their range in a box. It is ample: of
# 122,000 wheels of random linkages none is lost with 0, and 4 % are with -0.05.
CUBIC_ERROR = 0.1
OVERLAP = 0.5  # fraction of a box's width by which its pair may lie outside it


class CrankInterval(NamedTuple):
    """Intervals of crank angles: the points at both ends, and the turn between them.

    Rows of a point are crank angle, position (x, y), unit tangent (x, y), speed and turn rate.
    """

    ends: Array  # (7, 2, n)
    turn: Array  # (n,)

    def taken(self, where: Whole) -> CrankInterval:
        """Select some of the intervals."""
        return CrankInterval._make(part.take(where, axis=-1) for part in self)

    @property
    def phi(self) -> Array:
        """Crank angles of both ends, (2, n)."""
        phi: Array = self.ends[0]
        return phi

    @property
    def width(self) -> Array:
        """Crank angle from the first point to the last."""
        first, last = self.phi
        width: Array = last - first
        return width

    @property
    def rates(self) -> Array:
        """Rates at which the tangent turns at both ends, (2, n)."""
        rates: Array = self.ends[6]
        return rates


class Boxes(NamedTuple):
    """Intervals for entry and exit; ``turn`` is the turn from the first entry to the first exit."""

    which: Whole
    sense: Array  # sense of rotation of the wheel
    entry: CrankInterval
    exit: CrankInterval
    turn: Array

    def taken(self, where: Whole) -> Boxes:
        """Select some of the boxes."""
        entry, exit_ = self.entry.taken(where), self.exit.taken(where)
        return Boxes(self.which[where], self.sense[where], entry, exit_, self.turn[where])


def _span(width: Array, turn: Array, first: Array, last: Array) -> tuple[Array, Array]:
    """Least and greatest Bernstein coefficient of an angle's cubic that changes by ``turn``."""
    a, c = THIRD * width * first, turn - THIRD * width * last
    low = np.minimum(np.minimum(a, c), np.minimum(turn, 0.0))
    high = np.maximum(np.maximum(a, c), np.maximum(turn, 0.0))
    margin = CUBIC_ERROR * (high - low)
    return low - margin, high + margin


def _against(width: Array, turn: Array, first: Array, last: Array, sense: Number) -> Mask:
    """True if the tangent turns against the wheel anywhere in an interval."""
    middle = 1.5 * turn / width - 0.25 * (first + last)
    return np.minimum(np.minimum(first * sense, last * sense), middle * sense) <= 0.0


def boxes_of(samples: PathSamples, wanted: Array) -> Boxes:
    """Boxes between adjacent samples that may contain a pair."""
    at, angle = samples.at, samples.angle
    count = angle.shape[1] - 1
    first, last = slice(None, -1), slice(1, None)
    turn = angle[:, last] - angle[:, first]
    numbers, to_next = _numbers(at), np.pad(turn, ((0, 0), (0, 1)))
    width = at.phi[:, last] - at.phi[:, first]
    rates = at.turn[:, first], at.turn[:, last]
    low, high = (x + angle[:, first] for x in _span(width, turn, *rates))
    whole = angle[:, -1:]  # a turn later; NaN if the linkage does not close for a full turn
    possible = (width > 0.0) & np.isfinite(low + high + whole)
    parts = []
    for sense in (1.0, -1.0):
        use = possible & _against(width, turn, *rates, sense)
        # spans of the tangent's turn against the wheel, over two turns of the crank
        spans = (-high, -low) if sense > 0.0 else (low, high)
        least, most = (np.hstack((x, x - sense * whole)) for x in spans)
        entry, exit_ = _turned_between(np.hstack((use, use)), least, most, wanted)
        row, entry = np.divmod(entry, 2 * count)
        exit_ %= 2 * count
        round_ = exit_ // count
        exit_ %= count
        start = angle[row, exit_] + whole[row, 0] * round_ - angle[row, entry]
        one, two = (_interval(numbers, to_next, row * (count + 1) + of) for of in (entry, exit_))
        two.phi[:] += math.tau * round_
        every = Boxes(samples.which[row], np.full(len(row), sense), one, two, start)
        parts.append(every.taken(np.flatnonzero(_corners(one, two).may_vanish())))
    boxes: Boxes = joined(parts, -1)
    return boxes


def _turned_between(use: Mask, low: Array, high: Array, wanted: Array) -> tuple[Whole, Whole]:
    """Places of entries in the first half of the rows, and of exits in a turn after each.

    Between the two a row's angle, whose spans are ``low`` to ``high``, may grow by ``wanted``.
    """
    place = np.flatnonzero(use)
    row, column = np.divmod(place, use.shape[1])
    low, high = low.ravel().take(place), high.ravel().take(place)
    entry = np.flatnonzero(column < use.shape[1] // 2)
    mine = row[entry]
    least, most = low[entry] + wanted[mine], high[entry] + wanted[mine]
    # The greatest end so far and the least start from here on rise in each row, and from row to row
    # if each is set apart from the one before it. So a search in them bounds the exits of an entry.
    apart = 1.0 + 2.0 * max(np.abs(low).max(initial=0.0), np.abs(high).max(initial=0.0))
    ends = np.maximum.accumulate(high + apart * row)
    starts = np.minimum.accumulate((low + apart * row)[::-1])[::-1]
    error = 1e-9  # radians: more than rounding of a thousand rows
    begin = np.searchsorted(ends, least + (apart * mine - error))
    end = np.searchsorted(starts, most + (apart * mine + error), side="right")
    begin = np.maximum(begin, entry + 1)
    counts = np.maximum(np.minimum(end, entry + np.bincount(mine)[mine]) - begin, 0)
    of = np.repeat(np.arange(len(entry)), counts)
    exit_ = np.arange(len(of)) + np.repeat(begin - (np.cumsum(counts) - counts), counts)
    near = np.flatnonzero((low[exit_] <= most[of]) & (high[exit_] >= least[of]))
    return place[entry[of[near]]], place[exit_[near]]


def _interval(numbers: Array, turn: Array, first: Whole) -> CrankInterval:
    """Intervals that begin at some of the points, and end at the next."""
    return CrankInterval(numbers.take((first, first + 1), axis=1), turn.take(first))


def _numbers(at: PathPoints) -> Array:
    """Numbers of points, in the rows of ``CrankInterval``."""
    rows = (at.phi, at.p.real, at.p.imag, at.t.real, at.t.imag, at.speed, at.turn)
    return np.stack([x.ravel() for x in rows])


def _corners(entry: CrankInterval, exit_: CrankInterval) -> Corners:
    """Component of the chord across the sum of tangents, at the corners of boxes."""
    _, px, py, tx, ty, v, w = entry.ends[:, :, None]
    _, qx, qy, ux, uy, v_out, w_out = exit_.ends[:, None]
    cx, cy, q = qx - px, qy - py, ux * ty - uy * tx
    by_entry = v * q + w * (cx * tx + cy * ty)
    by_exit = v_out * q + w_out * (cx * ux + cy * uy)
    away = cx * (ty + uy) - cy * (tx + ux)
    return Corners(away, by_entry * entry.width, by_exit * exit_.width)


class Corners(NamedTuple):
    """A quantity at the corners of boxes (2, 2, n), and its slopes per width of the box.

    The first index is 0 or 1 for the start or end of the entry's interval, the second for the exit.
    """

    value: Array
    by_entry: Array
    by_exit: Array

    def may_vanish(self) -> Mask:
        """True if the quantity may be 0 in the box, by cubics through values and slopes."""
        outward = np.array([THIRD, -THIRD])[:, None]
        e, x = self.by_entry * outward[:, None], self.by_exit * outward
        least, most = (
            f(f(self.value + g(e, 0.0) + g(x, 0.0), axis=0), axis=0)
            for f, g in ((np.min, np.minimum), (np.max, np.maximum))
        )
        margin = CUBIC_ERROR * (most - least)
        may: Mask = (least <= margin) & (most >= -margin)
        return may


class NewtonSteps(NamedTuple):
    """Newton steps from the corners of a box, and the pair to which they lead."""

    one: Mask  # True if all of them lead to one pair, in the box or near it
    none: Mask  # True if bounds show that the box has no pair
    phi: Array


def newton_steps(boxes: Boxes, wanted: Array) -> NewtonSteps:
    """Newton step from each corner of a box; if all lead to one place in it, it has one pair.

    If they lead to a place outside, it may still have a pair: the steps of opposite corners of a
    sharp bend can agree by chance.
    """
    entry, exit_ = boxes.entry, boxes.exit
    across, ahead = _corners(entry, exit_), np.array([0.0, 1.0])[:, None]
    rest = boxes.turn + boxes.sense * wanted[boxes.which]
    rest = rest + ahead * exit_.turn - ahead[:, None] * entry.turn
    turn, turn_out = entry.rates[:, None] * -entry.width, exit_.rates * exit_.width
    det = across.by_entry * turn_out - across.by_exit * turn
    e = (rest * across.by_exit - across.value * turn_out) / det + ahead[:, None]
    x = (across.value * turn - rest * across.by_entry) / det + ahead
    # A sum of both quantities that hardly varies with one of the angles bounds the other one.
    may = np.ones(len(det[0, 0]), dtype=bool)
    for own, other in ((turn_out, across.by_exit), (turn, across.by_entry)):
        c, d = own.sum(axis=(0, 1)), other.sum(axis=(0, 1))
        pairs = zip(across, (rest, turn, turn_out), strict=True)
        may &= Corners._make(c * f - d * g for f, g in pairs).may_vanish()
    places = np.stack((e, x))  # side, corner, box; in widths of the box
    middle = places.mean(axis=(1, 2))
    apart = np.abs(places - middle[:, None, None]).max(axis=(0, 1, 2))
    outside = np.abs(middle - 0.5).max(axis=0) - 0.5
    phi = [x.phi[0] + of * x.width for x, of in zip((entry, exit_), middle, strict=True)]
    # the corners agree if they lead to places within a tenth of the box's width
    one = (apart <= 0.1) & (outside <= OVERLAP) & may
    return NewtonSteps(one, ~may, np.stack(phi, axis=1))


def halved(path: RollerPath, boxes: Boxes, wanted: Array) -> Boxes:
    """Cut each box into four and keep those that may contain a pair."""
    count = len(boxes.which)
    both: CrankInterval = joined([boxes.entry, boxes.exit], -1)
    halves = _halves(path, np.tile(boxes.which, 2), both)  # first and last, of entry and exit
    start, end = halves.rates
    low, high = _span(halves.width, halves.turn, start, end)
    against = _against(halves.width, halves.turn, start, end, np.tile(boxes.sense, 4))
    box = np.tile(np.arange(count), 4)
    entry, exit_ = (box + 2 * count * np.repeat(of, count) for of in ((0, 0, 1, 1), (0, 1, 0, 1)))
    exit_ += count
    # from the first entry of a quarter to its first exit
    turned = np.concatenate((0.0 * both.turn, halves.turn[: 2 * count]))
    turn = boxes.turn[box] + turned[exit_] - turned[entry]
    target = -boxes.sense[box] * wanted[boxes.which[box]] - turn
    near = (low[exit_] - high[entry] <= target) & (high[exit_] - low[entry] >= target)
    may = np.flatnonzero(near & against[entry] & against[exit_])
    sides = halves.taken(entry[may]), halves.taken(exit_[may])
    box = box[may]
    quarters = Boxes(boxes.which[box], boxes.sense[box], *sides, turn[may])
    return quarters.taken(np.flatnonzero(_corners(*sides).may_vanish()))


def _halves(path: RollerPath, which: Whole, whole: CrankInterval) -> CrankInterval:
    """First halves of intervals, and after them the last halves."""
    phi = 0.5 * (whole.phi[0] + whole.phi[1])
    middle = _numbers(points(path.roughly(which), phi[:, None]))
    first, last = whole.ends.swapaxes(0, 1)
    ends = np.concatenate(((first, middle), (middle, last)), axis=-1).swapaxes(0, 1)
    (a, c), (b, d) = ends[3:5]
    return CrankInterval(ends, np.arctan2(a * d - b * c, a * c + b * d))
