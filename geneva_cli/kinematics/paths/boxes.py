"""Boxes: an interval of a path for the entry and one for the exit that may contain a pair.

Cubics through values and slopes at the corners of a box show if it can contain a pair; see
``pairs``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from geneva_cli.kinematics.paths.samples import PathPoints, PathSamples, joined, points
from geneva_cli.kinematics.roller_path import RollerPath

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask, Number, Which, Whole

THIRD = 1.0 / 3.0
CUBIC_ERROR = 0.1  # possible error of a quantity's cubics, as a fraction of their range in a box
OVERLAP = 0.5  # fraction of a box's width by which its pair may lie outside it


class CrankInterval(NamedTuple):
    """An interval of crank angles: the points at both ends, and the turn between them."""

    first: PathPoints
    last: PathPoints
    turn: Array

    def taken(self, where: Which) -> CrankInterval:
        """Select some of the intervals."""
        return CrankInterval(self.first.taken(where), self.last.taken(where), self.turn[where])


class Boxes(NamedTuple):
    """Intervals for entry and exit; ``turn`` is the turn from the first entry to the first exit."""

    which: Whole
    sense: Array  # sense of rotation of the wheel
    entry: CrankInterval
    exit: CrankInterval
    turn: Array

    def taken(self, where: Which) -> Boxes:
        """Select some of the boxes."""
        entry, exit_ = (side.taken(where) for side in (self.entry, self.exit))
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
        may = _may_meet_of(at, width, row, entry, exit_)
        per_sense.append((row[may], entry[may], exit_[may], np.full(int(may.sum()), sense)))
    row, entry, exit_, senses = joined(per_sense)
    round_ = np.where(exit_ < entry, 1.0, 0.0)
    start = angle[row, exit_] + whole[row, 0] * round_ - angle[row, entry]
    one, two = (
        CrankInterval(at.at_samples(row, of), at.at_samples(row, of + 1), turn[row, of])
        for of in (entry, exit_)
    )
    near_end, far_end = (
        end._replace(phi=end.phi + math.tau * round_) for end in (two.first, two.last)
    )
    two = CrankInterval(near_end, far_end, two.turn)
    return Boxes(samples.which[row], senses, one, two, start)


def _may_meet_of(at: PathPoints, width: Array, row: Whole, entry: Whole, exit_: Whole) -> Mask:
    """Mask of the boxes between samples whose chord may be parallel to the sum of the tangents."""
    count = at.phi.shape[1]
    numbers = np.stack([x.ravel() for x in _numbers(at)])
    corners = [
        [np.take(numbers, row * count + of + i, axis=1) for i in (0, 1)] for of in (entry, exit_)
    ]
    return _may_be_zero(corners[0], corners[1], width[row, entry], width[row, exit_])


def _numbers(at: PathPoints) -> tuple[Array, ...]:
    """Position, unit tangent, speed and turn rate of points."""
    return at.p.real, at.p.imag, at.t.real, at.t.imag, at.speed, at.turn


def _may_turn(boxes: Boxes, wanted: Array) -> Mask:
    """True if both ends may turn against the wheel, and the tangent by the wanted angle."""
    spans = []
    good = np.ones(len(boxes.which), dtype=bool)
    for side in (boxes.entry, boxes.exit):
        width = side.last.phi - side.first.phi
        rates = side.first.turn, side.last.turn
        good &= _against(width, side.turn, *rates, boxes.sense)
        spans.append(_span(width, side.turn, *rates))
    (e_low, e_high), (x_low, x_high) = spans
    target = -boxes.sense * wanted[boxes.which] - boxes.turn
    return good & (x_low - e_high <= target) & (x_high - e_low >= target)


def _may_meet(boxes: Boxes) -> Mask:
    """True if the chord may be parallel to the sum of the tangents."""
    entry, exit_ = boxes.entry, boxes.exit
    corners = [[_numbers(side.first), _numbers(side.last)] for side in (entry, exit_)]
    return _may_be_zero(corners[0], corners[1], _width(entry), _width(exit_))


def _width(side: CrankInterval) -> Array:
    width: Array = side.last.phi - side.first.phi
    return width


def _across(one: Sequence[Array], two: Sequence[Array]) -> tuple[Array, Array, Array]:
    """Component of the chord across the sum of tangents, and its slopes by entry and by exit."""
    px, py, tx, ty, v, w = one
    qx, qy, ux, uy, v_out, w_out = two
    cx, cy, q = qx - px, qy - py, ux * ty - uy * tx
    by_entry = v * q + w * (cx * tx + cy * ty)
    by_exit = v_out * q + w_out * (cx * ux + cy * uy)
    return cx * (ty + uy) - cy * (tx + ux), by_entry, by_exit


def _may_be_zero(
    entries: Sequence[Sequence[Array]], exits: Sequence[Sequence[Array]], wide: Array, high: Array
) -> Mask:
    """True if the chord's component across may vanish in boxes of this width and height."""
    least, most = np.full(wide.shape, np.inf), np.full(wide.shape, -np.inf)
    for i, one in enumerate(entries):
        for j, two in enumerate(exits):
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
    wide, high = _width(entry), _width(exit_)
    over = boxes.turn + boxes.sense * wanted[boxes.which]
    steps = []
    for i, one in enumerate((_numbers(entry.first), _numbers(entry.last))):
        for j, two in enumerate((_numbers(exit_.first), _numbers(exit_.last))):
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
    phi = np.stack((entry.first.phi + middle[0] * wide, exit_.first.phi + middle[1] * high), axis=1)
    # the corners agree if they lead to places within a tenth of the box's width
    return NewtonSteps(apart <= 0.1, outside <= OVERLAP, phi)


def halved(path: RollerPath, boxes: Boxes, wanted: Array) -> Boxes:
    """Cut each box into four and keep those that may contain a pair."""
    halves = []
    for side in (boxes.entry, boxes.exit):
        phi = 0.5 * (side.first.phi + side.last.phi)
        middle = points(path.roughly(boxes.which), phi[:, None]).taken((slice(None), 0))
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
            parts.append(part.taken(np.flatnonzero(_may_meet(part))))
    halved: Boxes = joined(parts)
    return halved


def _side(first: PathPoints, last: PathPoints) -> CrankInterval:
    return CrankInterval(first, last, np.angle(last.t * first.t.conj()))
