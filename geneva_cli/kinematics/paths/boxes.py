"""Boxes: an interval of a path for the entry and one for the exit that may contain a pair.

Cubics through values and slopes at the corners of a box show if it can contain a pair; see
``pairs``.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.kinematics.paths.samples import PathPoints, PathSamples, joined, points
from geneva_cli.kinematics.roller_path import RollerPath

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask, Number, Whole

THIRD = 1.0 / 3.0
CUBIC_ERROR = 0.1  # possible error of a quantity's cubics, as a fraction of their range in a box
OVERLAP = 0.5  # fraction of a box's width by which its pair may lie outside it


class CrankInterval(NamedTuple):
    """Intervals of crank angles: the points at both ends, and the turn between them.

    Rows of a point are crank angle, position (x, y), unit tangent (x, y), speed and turn rate.
    """

    first: Array  # (7, n)
    last: Array
    turn: Array  # (n,)

    def taken(self, where: Whole) -> CrankInterval:
        """Select some of the intervals."""
        return CrankInterval._make(part.take(where, axis=-1) for part in self)

    @property
    def width(self) -> Array:
        """Crank angle from the first point to the last."""
        width: Array = self.last[0] - self.first[0]
        return width


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
    numbers = np.vstack((_numbers(at), np.pad(turn, ((0, 0), (0, 1))).ravel()))
    width = at.phi[:, last] - at.phi[:, first]
    rates = at.turn[:, first], at.turn[:, last]
    low, high = (x + angle[:, first] for x in _span(width, turn, *rates))
    whole = angle[:, -1:]  # a turn later; NaN if the linkage does not close for a full turn
    possible = (width > 0.0) & (whole == whole)
    parts = []
    for sense in (1.0, -1.0):
        use = possible & _against(width, turn, *rates, sense)
        # spans of the tangent's turn against the wheel, over two turns of the crank
        spans = [np.hstack((x, x + whole)) * -sense for x in (low, high)]
        entry, exit_ = _turned_between(np.hstack((use, use)), *spans[:: int(-sense)], wanted)
        row, entry = np.divmod(entry, 2 * count)
        exit_ %= 2 * count
        round_ = exit_ // count
        exit_ %= count
        start = angle[row, exit_] + whole[row, 0] * round_ - angle[row, entry]
        one, two = (_interval(numbers, row * (count + 1) + of) for of in (entry, exit_))
        for end in (two.first, two.last):
            end[0] += math.tau * round_
        every = Boxes(samples.which[row], np.full(len(row), sense), one, two, start)
        parts.append(every.taken(np.flatnonzero(_may_meet(one, two))))
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


def _interval(numbers: Array, first: Whole) -> CrankInterval:
    """Intervals that begin at some of the points, and end at the next."""
    at = numbers.take(first, axis=1)
    return CrankInterval(at[:-1], numbers[:-1].take(first + 1, axis=1), at[-1])


def _numbers(at: PathPoints) -> Array:
    """Numbers of points, in the rows of ``CrankInterval``."""
    rows = (at.phi, at.p.real, at.p.imag, at.t.real, at.t.imag, at.speed, at.turn)
    return np.stack([x.ravel() for x in rows])


def _may_turn(boxes: Boxes, wanted: Array) -> Mask:
    """True if both ends may turn against the wheel, and the tangent by the wanted angle."""
    spans = []
    good = np.ones(len(boxes.which), dtype=bool)
    for side in (boxes.entry, boxes.exit):
        shape = side.width, side.turn, side.first[6], side.last[6]
        good &= _against(*shape, boxes.sense)
        spans.append(_span(*shape))
    (e_low, e_high), (x_low, x_high) = spans
    target = -boxes.sense * wanted[boxes.which] - boxes.turn
    return good & (x_low - e_high <= target) & (x_high - e_low >= target)


def _across(one: Array, two: Array) -> tuple[Array, Array, Array]:
    """Component of the chord across the sum of tangents, and its slopes by entry and by exit."""
    _, px, py, tx, ty, v, w = one
    _, qx, qy, ux, uy, v_out, w_out = two
    cx, cy, q = qx - px, qy - py, ux * ty - uy * tx
    by_entry = v * q + w * (cx * tx + cy * ty)
    by_exit = v_out * q + w_out * (cx * ux + cy * uy)
    return cx * (ty + uy) - cy * (tx + ux), by_entry, by_exit


def _may_meet(entry: CrankInterval, exit_: CrankInterval) -> Mask:
    """True if the chord may be parallel to the sum of the tangents in boxes of two intervals."""
    wide, high = entry.width, exit_.width
    least, most = np.full(wide.shape, np.inf), np.full(wide.shape, -np.inf)
    for i, one in enumerate((entry.first, entry.last)):
        for j, two in enumerate((exit_.first, exit_.last)):
            away, by_entry, by_exit = _across(one, two)
            e = by_entry * wide * (-THIRD if i else THIRD)
            x = by_exit * high * (-THIRD if j else THIRD)
            least = np.minimum(least, away + np.minimum(e, 0.0) + np.minimum(x, 0.0))
            most = np.maximum(most, away + np.maximum(e, 0.0) + np.maximum(x, 0.0))
    margin = CUBIC_ERROR * (most - least)
    may: Mask = (least <= margin) & (most >= -margin)
    return may


class NewtonSteps(NamedTuple):
    """Newton steps from the corners of a box: agreement, nearness, and the pair they lead to."""

    alike: Mask
    near: Mask  # True if the pair is in the box or near it
    phi: Array


def newton_steps(boxes: Boxes, wanted: Array) -> NewtonSteps:
    """Newton step from each corner of a box; if all lead to one place, the box has one pair."""
    entry, exit_ = boxes.entry, boxes.exit
    wide, high = entry.width, exit_.width
    over = boxes.turn + boxes.sense * wanted[boxes.which]
    steps = []
    for i, one in enumerate((entry.first, entry.last)):
        for j, two in enumerate((exit_.first, exit_.last)):
            away, by_entry, by_exit = _across(one, two)
            rest = over + j * exit_.turn - i * entry.turn
            turn, turn_out = one[-1], two[-1]
            det = by_entry * turn_out + by_exit * turn
            e = (rest * by_exit - away * turn_out) / det
            x = -(rest * by_entry + away * turn) / det
            steps.append((i + e / wide, j + x / high))
    places = np.array(steps)  # indices: corner, side, box; in widths of the box
    middle = places.mean(axis=0)
    apart = np.abs(places - middle).max(axis=(0, 1))
    outside = np.abs(middle - 0.5).max(axis=0) - 0.5
    phi = np.stack((entry.first[0] + middle[0] * wide, exit_.first[0] + middle[1] * high), axis=1)
    # the corners agree if they lead to places within a tenth of the box's width
    return NewtonSteps(apart <= 0.1, outside <= OVERLAP, phi)


def halved(path: RollerPath, boxes: Boxes, wanted: Array) -> Boxes:
    """Cut each box into four and keep those that may contain a pair."""
    halves = []
    for side in (boxes.entry, boxes.exit):
        phi = 0.5 * (side.first[0] + side.last[0])
        middle = _numbers(points(path.roughly(boxes.which), phi[:, None]))
        halves.append((_side(side.first, middle), _side(middle, side.last)))
    parts = []
    for i, entry in enumerate(halves[0]):
        for j, exit_ in enumerate(halves[1]):
            turn = boxes.turn
            if i:
                turn = turn - halves[0][0].turn
            if j:
                turn = turn + halves[1][0].turn
            part = Boxes(boxes.which, boxes.sense, entry, exit_, turn)
            part = part.taken(np.flatnonzero(_may_turn(part, wanted)))
            parts.append(part.taken(np.flatnonzero(_may_meet(part.entry, part.exit))))
    halved: Boxes = joined(parts, -1)
    return halved


def _side(first: Array, last: Array) -> CrankInterval:
    (a, b), (c, d) = first[3:5], last[3:5]
    return CrankInterval(first, last, np.arctan2(a * d - b * c, a * c + b * d))
