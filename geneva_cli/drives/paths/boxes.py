"""Boxes: an arc of the path for the entry and one for the exit that may contain a pair.

Each point of a pair lies on the line of their chord. Along an arc the line's angle and offset are
cubics of the crank angle. They show if an entry and an exit can have a line in common; see
``pairs``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np
from numpy.lib.stride_tricks import as_strided

from geneva_cli.drives.paths.samples import PathPoints, PathSamples, points
from geneva_cli.drives.roller_path import RollerPath
from geneva_cli.numerics.arrays import Array, Complex, Mask, Number, Whole, joined

if TYPE_CHECKING:
    from numpy.typing import NDArray

T = TypeVar("T", np.float32, np.bool_)

# Possible error of a quantity's cubics, as a fraction of their range in a box. It is ample: of
# 184,000 wheels of random linkages none is lost with 0, and 9 % are with -0.05.
CUBIC_ERROR = 0.03
OVERLAP = 0.5  # fraction of an arc's width by which its pair may lie outside it


class Arcs(NamedTuple):
    """Arcs of paths, and the lines of their points, as (angle, offset) in a plane.

    ``cubics`` are the Bernstein coefficients of both. ``strip`` is the vector from the first line
    to the last, with the least and greatest cross product of it and the coefficients.
    """

    phi: Array  # (n,), crank angle of the first point
    width: Array  # (n,), crank angle from the first point to the last
    cubics: Array  # (2, 4, n)
    strip: Array  # (4, n)

    def taken(self, where: Whole) -> Arcs:
        """Select some of the arcs."""
        return Arcs._make(part.take(where, axis=-1) for part in self)

    def at(self, place: Array) -> tuple[Array, Array]:
        """Lines at fractions of the width, and their slopes per width: (2, n)."""
        rest, rows = 1.0 - place, self.cubics.swapaxes(0, 1)
        a, b, c = (rows[i] * rest + rows[i + 1] * place for i in range(3))
        a, b = a * rest + b * place, b * rest + c * place
        return a * rest + b * place, 3.0 * (b - a)

    def turns(self, sense: Number) -> Mask:
        """True if the tangent may turn against a wheel that turns in a direction."""
        a, b, c, d = self.cubics[0] * sense
        least: Array = np.minimum(np.minimum(b - a, c - b), d - c)
        return least <= 0.0

    def spans(self) -> tuple[Array, Array]:
        """Least and greatest angles and offsets of the lines: (2, n)."""
        low, high = self.cubics.min(axis=1), self.cubics.max(axis=1)
        margin = CUBIC_ERROR * (high - low)
        return low - margin, high + margin


class Boxes(NamedTuple):
    """Arcs for entry and exit, whose lines may agree after a turn of the first exit's."""

    which: Whole
    sense: Array  # sense of rotation of the wheel
    entry: Arcs
    exit: Arcs
    turn: Array
    origin: Complex  # point from which the offsets are measured

    def taken(self, where: Whole) -> Boxes:
        """Select some of the boxes."""
        which, sense, entry, exit_, turn, origin = self
        sides = entry.taken(where), exit_.taken(where)
        return Boxes(which[where], sense[where], *sides, turn[where], origin[where])


def boxes_of(samples: PathSamples, b: Array) -> Iterator[Boxes]:
    """Boxes between adjacent samples that may contain a pair, for each sense of the wheel.

    b are half index angles (m, 1).
    """
    at, lean = samples.at, 0.5 * math.pi - b[samples.which, 0]
    # Near a sharp bend all lines pass one point. Measured from there their offsets are small.
    design = np.arange(len(lean))
    origin = at.p[np.abs(at.turn).argmax(axis=0), design]
    angle = samples.angle + np.angle(at.t[0])
    whole = angle[-1] - angle[0]  # NaN if the linkage does not close for a full turn
    phi, width = at.phi[:-1], np.diff(at.phi, axis=0)
    possible = (width > 0.0) & np.isfinite(angle[:-1] + whole)
    sides = []
    for side in (-1.0, 1.0):
        lines = _lines(at, angle, origin, side * lean)
        arcs = _arcs(phi, width, lines[:, :-1], lines[:, 1:])
        flat = Arcs._make(x.reshape(*x.shape[:-2], -1) for x in arcs)
        sides.append((flat, [_two_turns(span, whole) for span in arcs.spans()]))
    for sense, ((one, entries), (two, exits)) in ((1.0, sides), (-1.0, sides[::-1])):
        use = possible & arcs.turns(sense)  # the tangent turns alike for both sides
        row, first, last, turns = _overlaps(use, entries, exits)
        turn = turns * whole.take(row)
        near = _crossing(one, first, two, last, turn)
        row, entry, exit_ = row[near], one.taken(first[near]), two.taken(last[near])
        exit_.phi[:] += math.tau * turns[near]
        senses = np.full(len(row), sense)
        yield Boxes(samples.which[row], senses, entry, exit_, turn[near], origin[row])


def _lines(at: PathPoints, angle: Array, origin: Complex, lean: Array) -> Array:
    """Angles and offsets of lines, and their slopes; ``lean`` is the angle from the tangent."""
    from_origin = (at.p - origin) * (at.t * np.exp(1j * lean)).conj()
    lines = np.empty((4, *angle.shape))
    np.add(angle, lean, out=lines[0])
    lines[1], lines[2] = from_origin.imag, at.turn
    np.multiply(at.speed, -np.sin(lean), out=lines[3])
    lines[3] -= at.turn * from_origin.real
    return lines


def _arcs(phi: Array, width: Array, first: Array, last: Array) -> Arcs:
    """Arcs between points with lines ``first`` and ``last``."""
    third, cubics, strip = width / 3.0, *(np.empty((*x, *width.shape)) for x in ((2, 4), (4,)))
    cubics[:, 0], cubics[:, 3] = first[:2], last[:2]
    np.add(first[:2], third * first[2:], out=cubics[:, 1])
    np.subtract(last[:2], third * last[2:], out=cubics[:, 2])
    along = np.subtract(last[:2], first[:2], out=strip[:2])
    across = along[0] * cubics[1] - along[1] * cubics[0]
    across.min(axis=0, out=strip[2])
    across.max(axis=0, out=strip[3])
    return Arcs(phi, width, cubics, strip)


def _may_cross(strip: Array, cubics: Array, turn: Array) -> Mask:
    """True if an arc of lines turned by ``turn`` may cross the strip of another arc."""
    across = strip[0] * cubics[1] - strip[1] * cubics[0]
    past = strip[1] * turn
    least, most = across.min(axis=0) - strip[3] - past, across.max(axis=0) - strip[2] - past
    margin = CUBIC_ERROR * (most - least)
    may: Mask = (least <= margin) & (most >= -margin)
    return may


def _crossing(one: Arcs, first: Whole, two: Arcs, last: Whole, turn: Array) -> Whole:
    """Pairs of arcs for entry and exit of which each may cross the strip of the other."""
    strip, cubics = one.strip.take(first, axis=-1), two.cubics.take(last, axis=-1)
    near = np.flatnonzero(_may_cross(strip, cubics, turn))
    strip, cubics = two.strip.take(last[near], axis=-1), one.cubics.take(first[near], axis=-1)
    return near[_may_cross(strip, cubics, -turn[near])]


def _two_turns(values: Array, whole: Array) -> NDArray[np.float32]:
    """Angles and offsets (2, n, m) in a turn and the next, (2, 2 n, m); angles rise by ``whole``.

    Single numbers are in the same order, so that no overlap is lost.
    """
    next_turn = values + np.stack((whole, 0.0 * whole))[:, None]
    return np.concatenate((values, next_turn), axis=1, dtype=np.float32, casting="same_kind")


def _overlaps(
    use: Mask, entries: Sequence[NDArray[np.float32]], exits: Sequence[NDArray[np.float32]]
) -> tuple[Whole, Whole, Whole, Mask]:
    """Entries and exits in a turn after each whose spans overlap: design, numbers, and turns.

    Spans are the least and greatest angles and offsets in two turns. ``turns`` is 1 for an exit in
    the turn after the entry's.
    """
    count, designs = use.shape
    may = use[:, None] & _later(np.concatenate((use, use)))
    for least, most, low, high in zip(*entries, *exits, strict=True):
        may &= _later(low) <= most[:count, None]
        may &= _later(high) >= least[:count, None]
    place = np.flatnonzero(may)
    pair = place // designs
    entry = pair // (count - 1)
    exit_ = pair - (count - 2) * entry + 1
    design = place - designs * pair
    turns = exit_ >= count
    return design, entry * designs + design, (exit_ - count * turns) * designs + design, turns


def _later(both: NDArray[T]) -> NDArray[T]:
    """Values of the other arcs after each arc, (n, n - 1, m), from those of two turns, (2 n, m)."""
    count, (step, size) = len(both) // 2, both.strides
    return as_strided(both[1:], (count, count - 1, both.shape[1]), (step, step, size))


def cross_once(boxes: Boxes) -> Mask:
    """True for boxes whose lines agree once at most.

    The directions of entry and exit in the plane of lines are apart. Curves that are nearly
    parallel somewhere may cross twice, within the error of the cubics.
    """
    x, y = np.diff(boxes.entry.cubics, axis=1)[:, :, None]
    u, v = np.diff(boxes.exit.cubics, axis=1)[:, None]
    cross = x * v - y * u
    cross *= np.sign(cross[1, 1])
    apart: Mask = cross.min(axis=(0, 1)) > 0.1 * cross.max(axis=(0, 1))
    return apart


def crossings(boxes: Boxes) -> Array:
    """Crank angles at which the cubics of entry and exit cross, in two rows."""
    entry, exit_ = boxes.entry, boxes.exit
    place = np.full((2, len(boxes.which)), 0.5)  # fractions of the widths
    for _ in range(3):  # Newton steps: the pair itself may be off the crossing by 0.05
        (p, (x, y)), (q, (u, v)) = entry.at(place[0]), exit_.at(place[1])
        off, up = q - p
        off += boxes.turn
        place += np.stack((off * v - up * u, off * y - up * x)) / (x * v - y * u)
        np.clip(place, -OVERLAP, 1.0 + OVERLAP, out=place)
    sides = zip((entry, exit_), place, strict=True)
    return np.stack([arcs.phi + of * arcs.width for arcs, of in sides])


def halved(path: RollerPath, boxes: Boxes, b: Array) -> Boxes:
    """Cut each box into four and keep those that may contain a pair."""
    count = len(boxes.which)
    lean = boxes.sense * (b[boxes.which, 0] - 0.5 * math.pi)
    which, origin, lean = np.tile(boxes.which, 2), np.tile(boxes.origin, 2), np.append(lean, -lean)
    halves = _halves(path.roughly(which), joined([boxes.entry, boxes.exit]), origin, lean)
    turns = halves.turns(np.tile(boxes.sense, 4))
    box = np.tile(np.arange(count), 4)
    # in order: first halves of the entries, first halves of the exits, and the last halves of both
    entry, exit_ = (box + 2 * count * np.repeat(of, count) for of in ((0, 0, 1, 1), (0, 1, 0, 1)))
    exit_ += count
    turn = boxes.turn[box]
    may = turns[entry] & turns[exit_]
    for low, high, ahead in zip(*halves.spans(), (turn, 0.0), strict=True):
        may &= low.take(exit_) + ahead <= high.take(entry)
        may &= high.take(exit_) + ahead >= low.take(entry)
    may = np.flatnonzero(may)
    entry, exit_, box, turn = entry[may], exit_[may], box[may], turn[may]
    near = _crossing(halves, entry, halves, exit_, turn)
    box, one, two = box[near], halves.taken(entry[near]), halves.taken(exit_[near])
    return Boxes(boxes.which[box], boxes.sense[box], one, two, turn[near], boxes.origin[box])


def _halves(path: RollerPath, arcs: Arcs, origin: Complex, lean: Array) -> Arcs:
    """First halves of arcs, and after them the last halves."""
    width = 0.5 * arcs.width
    at = points(path, (arcs.phi + width)[:, None]).taken((slice(None), 0))
    angle, near = np.angle(at.t), arcs.at(np.full(len(width), 0.5))[0][0] - lean
    middle = _lines(at, angle + math.tau * np.round((near - angle) / math.tau), origin, lean)
    a, b, c, d = arcs.cubics.swapaxes(0, 1)
    first, last = (np.concatenate((x, 3.0 * y / arcs.width)) for x, y in ((a, b - a), (d, d - c)))
    halves: Arcs = joined(
        [_arcs(arcs.phi, width, first, middle), _arcs(at.phi, width, middle, last)], -1
    )
    return halves
