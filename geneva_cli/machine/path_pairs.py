"""Entry and exit on a roller's closed path: the pairs of places that a wheel's slots could take.

A wheel with straight radial slots takes a roller without shock where the roller's path enters along
one slot and leaves along the next, equally far from the wheel's centre O: with the unit tangents t1
and t2 there,

    O = P1 + rho t1 = P2 - rho t2 ,    the angle from -t1 to t2 = the index angle 2b ,

so that the chord P2 - P1 is parallel to t1 + t2. All the way between them the pin goes round the
wheel's centre one way. So the tangent, seen from its ray, turns from -t1 to t2 without passing the
ray again, and from entry to exit it turns by pi - 2b in all, against the wheel; at either end
it turns that way too, or not at all.

That makes the search one of boxes: an interval of crank angles between two samples for the entry,
and one for the exit. A box is laid aside where the turn, or the chord's part across t1 + t2, has
one sign in all of it, as the cubics through the samples' values and slopes have it. What is left
is halved, until both change so evenly over the box that Newton finds its only pair.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from geneva_cli.machine.path_samples import Points, Samples, joined, points
from geneva_cli.machine.roller_path import Path

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask, Number, Which, Whole

THIRD = 1.0 / 3.0
ALIKE = 0.1  # of a box's width, by which its corners may differ in where they say the pair is
ROUNDING = 1e-9
MARGIN = 0.1  # of what a quantity's cubics span in a box, by which they may be wrong
HALVINGS = 8  # of a box
BESIDE = 0.5  # of a box's width, by which its pair may lie beside it
STEPS = 12  # of Newton in a box
CLOSE = 1e-6  # radians: after so short a step of Newton, half of the digits and all of them next
FLAT = 1e-5  # of the index angle along the family of pairs: less slope is a double root
DOUBTFUL = 1e-5  # radians of the index angle: nearer than that without a root, it may be double


class Pairs(NamedTuple):
    """Pairs of places of designs, entry first, in two columns."""

    which: Whole
    at: Points

    def taken(self, where: Which) -> Pairs:
        """Some of the pairs."""
        return Pairs(self.which[where], self.at.taken(where))


class Found(NamedTuple):
    """Pairs; and places where there is none, or where a double root may be."""

    pairs: Pairs
    doubtful: Pairs


class Residual(NamedTuple):
    """What is left of both conditions, and their slopes.

    ``away``: the chord's part across the sum of the tangents, with slopes by entry and by exit;
    ``excess`` of the index angle, which turns with the tangents. ``det`` is of both.
    """

    away: Array
    by_entry: Array
    by_exit: Array
    excess: Array
    det: Array
    sense: Array


class _Side(NamedTuple):
    """An interval of crank angles: the places at both ends, and the turn between them."""

    first: Points
    last: Points
    turn: Array

    def taken(self, where: Which) -> _Side:
        return _Side(self.first.taken(where), self.last.taken(where), self.turn[where])


class _Boxes(NamedTuple):
    """Intervals for entry and exit; ``turn`` is that from the first entry to the first exit."""

    which: Whole
    sense: Array  # of the wheel
    entry: _Side
    exit: _Side
    turn: Array

    def taken(self, where: Which) -> _Boxes:
        entry, exit_ = (side.taken(where) for side in (self.entry, self.exit))
        return _Boxes(self.which[where], self.sense[where], entry, exit_, self.turn[where])


def pairs(path: Path, samples: Iterable[Samples], b: Array) -> Found:
    """All pairs of designs of half an index angle b, (n, 1), from samples of their paths."""
    wanted = math.pi - 2.0 * b[:, 0]
    boxes = joined([_of_samples(some, wanted[some.which]) for some in samples])
    found = []
    for depth in range(HALVINGS + 1):
        told = _told(boxes, wanted)
        last = depth == HALVINGS
        tried = np.arange(len(told.near)) if last else np.flatnonzero(told.alike & told.near)
        ends, close = _solved(path, boxes.taken(tried), told.phi[tried], b)
        found.append(ends.taken(close))
        rest = np.concatenate((np.flatnonzero(~told.alike), tried[~close]))
        if last or not len(rest):
            break
        boxes = _halved(path, boxes.taken(rest))
        boxes = boxes.taken(_may_turn(boxes, wanted))
        boxes = boxes.taken(_may_meet(boxes))
    ends = ends.taken(np.flatnonzero(~close))
    near = np.flatnonzero(np.abs(residual(ends, b).excess) < DOUBTFUL)
    return Found(joined(found), ends.taken(near))


def _span(width: Array, turn: Array, first: Array, last: Array) -> tuple[Array, Array]:
    """The least and the greatest of a cubic's coefficients (Bernstein) that turns by ``turn``."""
    a, c = THIRD * width * first, turn - THIRD * width * last
    low = np.minimum(np.minimum(a, c), np.minimum(turn, 0.0))
    high = np.maximum(np.maximum(a, c), np.maximum(turn, 0.0))
    margin = MARGIN * (high - low)
    return low - margin, high + margin


def _against(width: Array, turn: Array, first: Array, last: Array, sense: Number) -> Mask:
    """Whether the tangent turns against the wheel anywhere in an interval."""
    middle = 1.5 * turn / width - 0.25 * (first + last)
    return np.minimum(np.minimum(first * sense, last * sense), middle * sense) <= 0.0


def _of_samples(samples: Samples, wanted: Array) -> _Boxes:
    """Boxes of neighbouring samples in which there may be a pair."""
    at, angle = samples.at, samples.angle
    count = angle.shape[1] - 1
    first, last = slice(None, -1), slice(1, None)
    turn = angle[:, last] - angle[:, first]
    width = at.phi[:, last] - at.phi[:, first]
    rates = at.turn[:, first], at.turn[:, last]
    low, high = (x + angle[:, first] for x in _span(width, turn, *rates))
    whole = angle[:, -1:]  # a turn later; no number where the linkage does not close all round
    possible = (width > 0.0) & (whole == whole)
    found = []
    for sense in (1.0, -1.0):
        use = possible & _against(width, turn, *rates, sense)
        least, most = np.where(use, low, np.inf), np.where(use, high, -np.inf)
        target = -sense * wanted[:, None]
        # exits from the entry's own interval on, a turn round
        first_exit, last_exit = (
            sliding_window_view(np.concatenate((x, x + whole), axis=1), count, axis=1)[:, :count]
            for x in (least, most)
        )
        near = first_exit <= (most + target)[:, :, None]
        near &= last_exit >= (least + target)[:, :, None]
        near[:, :, 0] = False
        cell, ahead = np.divmod(np.flatnonzero(near), count)
        row, entry = np.divmod(cell, count)
        exit_ = (entry + ahead) % count
        may = _may_meet_of(at, width, row, entry, exit_)
        found.append((row[may], entry[may], exit_[may], np.full(int(may.sum()), sense)))
    row, entry, exit_, way = joined(found)
    round_ = np.where(exit_ < entry, 1.0, 0.0)
    start = angle[row, exit_] + whole[row, 0] * round_ - angle[row, entry]
    one, two = (
        _Side(at.taken((row, of)), at.taken((row, of + 1)), turn[row, of]) for of in (entry, exit_)
    )
    near_end, far_end = (
        end._replace(phi=end.phi + math.tau * round_) for end in (two.first, two.last)
    )
    two = _Side(near_end, far_end, two.turn)
    return _Boxes(samples.which[row], way, one, two, start)


def _may_meet_of(at: Points, width: Array, row: Whole, entry: Whole, exit_: Whole) -> Mask:
    """``_may_meet`` of boxes between samples."""
    count = at.phi.shape[1]
    numbers = np.stack([x.ravel() for x in _numbers(at)])
    corners = [
        [np.take(numbers, row * count + of + i, axis=1) for i in (0, 1)] for of in (entry, exit_)
    ]
    return _may_be_zero(corners[0], corners[1], width[row, entry], width[row, exit_])


def _numbers(at: Points) -> tuple[Array, ...]:
    """Place, unit tangent, speed and turn."""
    return at.p.real, at.p.imag, at.t.real, at.t.imag, at.speed, at.turn


def _may_turn(boxes: _Boxes, wanted: Array) -> Mask:
    """Whether both ends may turn against the wheel, and the tangent by what is wanted."""
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


def _may_meet(boxes: _Boxes) -> Mask:
    """Whether the chord may be parallel to the tangents' sum."""
    entry, exit_ = boxes.entry, boxes.exit
    corners = [[_numbers(side.first), _numbers(side.last)] for side in (entry, exit_)]
    return _may_be_zero(corners[0], corners[1], _width(entry), _width(exit_))


def _width(side: _Side) -> Array:
    width: Array = side.last.phi - side.first.phi
    return width


def _across(one: Sequence[Array], two: Sequence[Array]) -> tuple[Array, Array, Array]:
    """The chord's part across the tangents' sum, and its slopes by entry and by exit."""
    px, py, tx, ty, v, w = one
    qx, qy, ux, uy, v_out, w_out = two
    cx, cy, q = qx - px, qy - py, ux * ty - uy * tx
    by_entry = v * q + w * (cx * tx + cy * ty)
    by_exit = v_out * q + w_out * (cx * ux + cy * uy)
    return cx * (ty + uy) - cy * (tx + ux), by_entry, by_exit


def _may_be_zero(
    entries: Sequence[Sequence[Array]], exits: Sequence[Sequence[Array]], wide: Array, high: Array
) -> Mask:
    """Whether the chord's part across may vanish in boxes so wide and so high."""
    least, most = np.full(wide.shape, np.inf), np.full(wide.shape, -np.inf)
    for i, one in enumerate(entries):
        for j, two in enumerate(exits):
            away, by_entry, by_exit = _across(one, two)
            e = by_entry * wide * (-THIRD if i else THIRD)
            x = by_exit * high * (-THIRD if j else THIRD)
            least = np.minimum(least, away + np.minimum(e, 0.0) + np.minimum(x, 0.0))
            most = np.maximum(most, away + np.maximum(e, 0.0) + np.maximum(x, 0.0))
    margin = MARGIN * (most - least)
    may: Mask = (least <= margin) & (most >= -margin)
    return may


class _Told(NamedTuple):
    """Whether all corners of a box tell the same of the pair that is nearest, and what."""

    alike: Mask
    near: Mask  # whether it is in the box or beside it
    phi: Array


def _told(boxes: _Boxes, wanted: Array) -> _Told:
    """Where a step of Newton leads from each corner: if to one place, the box has one pair."""
    entry, exit_ = boxes.entry, boxes.exit
    wide, high = _width(entry), _width(exit_)
    over = boxes.turn + boxes.sense * wanted[boxes.which]
    told = []
    for i, one in enumerate((_numbers(entry.first), _numbers(entry.last))):
        for j, two in enumerate((_numbers(exit_.first), _numbers(exit_.last))):
            away, by_entry, by_exit = _across(one, two)
            rest = over + j * exit_.turn - i * entry.turn
            turn, turn_out = one[-1], two[-1]
            det = by_entry * turn_out + by_exit * turn
            e = (rest * by_exit - away * turn_out) / det
            x = -(rest * by_entry + away * turn) / det
            told.append((i + e / wide, j + x / high))
    places = np.array(told)  # corner, side, box; in widths of the box
    middle = places.mean(axis=0)
    apart = np.abs(places - middle).max(axis=(0, 1))
    beside = np.abs(middle - 0.5).max(axis=0) - 0.5
    phi = np.stack((entry.first.phi + middle[0] * wide, exit_.first.phi + middle[1] * high), axis=1)
    return _Told(apart <= ALIKE, beside <= BESIDE, phi)


def _halved(path: Path, boxes: _Boxes) -> _Boxes:
    """Four boxes of each."""
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
            parts.append(_Boxes(boxes.which, boxes.sense, entry, exit_, turn))
    halved: _Boxes = joined(parts)
    return halved


def _side(first: Points, last: Points) -> _Side:
    return _Side(first, last, np.angle(last.t * first.t.conj()))


def ends_at(path: Path, which: Whole, phi: Array) -> Pairs:
    """Places of designs at entry and exit angles, in two columns."""
    return Pairs(which, points(path.roughly(which), phi))


def residual(ends: Pairs, b: Array) -> Residual:
    """Of pairs of places, and of all designs' half index angles (m, 1)."""
    at = ends.at
    (p, q), (t, u), (v, w) = at.p.T, at.t.T, at.v.T
    chord, both = q - p, (t + u).conj()
    turn, turn_out = at.turn.T
    by_exit = (w * both + chord * (1j * turn_out * u).conj()).imag
    by_entry = (chord * (1j * turn * t).conj() - v * both).imag
    angle = np.angle(-u * t.conj())
    sense = np.copysign(1.0, angle)
    excess = sense * angle - 2.0 * b[ends.which, 0]
    det = by_entry * turn_out + by_exit * turn
    return Residual((chord * both).imag, by_entry, by_exit, excess, det, sense)


def newton(ends: Pairs, rest: Residual) -> Array:
    """The step of Newton from places, in two columns."""
    turn, turn_out = ends.at.turn.T
    excess = rest.sense * rest.excess
    by_entry = excess * rest.by_exit - rest.away * turn_out
    by_exit = -excess * rest.by_entry - rest.away * turn
    step: Array = np.stack((by_entry, by_exit), axis=1) / rest.det[:, None]
    return step


def _solved(path: Path, boxes: _Boxes, phi: Array, b: Array) -> tuple[Pairs, Mask]:
    """Newton from places in boxes: where it ends, and whether that is a pair in the box."""
    low = np.stack((boxes.entry.first.phi, boxes.exit.first.phi), axis=1)
    high = np.stack((boxes.entry.last.phi, boxes.exit.last.phi), axis=1)
    width = high - low
    phi = np.clip(phi, low - BESIDE * width, high + BESIDE * width)
    close = np.zeros(len(phi), dtype=bool)
    live = np.arange(len(phi))
    for _ in range(STEPS):
        if not len(live):
            break
        ends = ends_at(path, boxes.which[live], phi[live])
        rest = residual(ends, b)
        move = newton(ends, rest)
        move *= np.minimum(1.0, (width[live] / np.abs(move)).min(axis=1))[:, None]
        phi[live] += move
        off = np.maximum(low[live] - phi[live], phi[live] - high[live]) / width[live]
        inside = (off <= BESIDE + ROUNDING).all(axis=1)
        done = np.abs(move).max(axis=1) < CLOSE
        close[live] = done & inside
        live = live[~done & inside]
    return ends_at(path, boxes.which, phi), close
