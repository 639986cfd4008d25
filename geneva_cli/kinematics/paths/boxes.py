"""Boxes: an interval of a path for the entry and one for the exit that may contain a pair.

Cubics through values and slopes at the corners of a box show if it can contain a pair; see
``pairs``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from geneva_cli.kinematics.paths.samples import PathPoints, PathSamples, joined, points
from geneva_cli.kinematics.roller_path import RollerPath
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
    count, numbers = angle.shape[1] - 1, _numbers(at)
    first, last = slice(None, -1), slice(1, None)
    turn = angle[:, last] - angle[:, first]
    width = at.phi[:, last] - at.phi[:, first]
    rates = at.turn[:, first], at.turn[:, last]
    low, high = (x + angle[:, first] for x in _span(width, turn, *rates))
    whole = angle[:, -1:]  # a turn later; NaN if the linkage does not close for a full turn
    possible = (width > 0.0) & (whole == whole)
    per_sense = []
    for sense in (1.0, -1.0):
        use = possible & _against(width, turn, *rates, sense)
        some = np.flatnonzero(use.any(axis=1))  # most paths turn one way only
        use = use[some]
        least, most = np.where(use, low[some], np.inf), np.where(use, high[some], -np.inf)
        target = -sense * wanted[some, None]
        # exits from the entry's own interval onwards, over a full turn
        first_exit, last_exit = (
            sliding_window_view(np.hstack((x, x + whole[some])), count, axis=1)[:, :count]
            for x in (least, most)
        )
        near = first_exit <= (most + target)[:, :, None]
        near &= last_exit >= (least + target)[:, :, None]
        near[:, :, 0] = False
        cell, ahead = np.divmod(np.flatnonzero(near), count)
        row, entry = np.divmod(cell, count)
        row = some[row]
        exit_ = (entry + ahead) % count
        corners = (
            _interval(numbers, row * (count + 1) + of, turn[row, of]) for of in (entry, exit_)
        )
        may = _may_meet(*corners)
        per_sense.append((row[may], entry[may], exit_[may], np.full(int(may.sum()), sense)))
    row, entry, exit_, senses = joined(per_sense)
    round_ = np.where(exit_ < entry, 1.0, 0.0)
    start = angle[row, exit_] + whole[row, 0] * round_ - angle[row, entry]
    one, two = (_interval(numbers, row * (count + 1) + of, turn[row, of]) for of in (entry, exit_))
    for end in (two.first, two.last):
        end[0] += math.tau * round_
    return Boxes(samples.which[row], senses, one, two, start)


def _interval(numbers: Array, first: Whole, turn: Array) -> CrankInterval:
    """Intervals that begin at some of the points, and end at the next."""
    return CrankInterval(numbers.take(first, axis=1), numbers.take(first + 1, axis=1), turn)


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
