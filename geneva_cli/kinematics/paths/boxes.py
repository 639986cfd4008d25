"""Boxes: an arc of the path for the entry and one for the exit that may contain a pair.

Each point of a pair lies on the line of their chord. Along an arc the line's angle and offset are
cubics of the crank angle. They show if an entry and an exit can have a line in common; see
``pairs``.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np
from numpy.lib.stride_tricks import as_strided

from geneva_cli.kinematics.paths.samples import PathPoints, PathSamples, points
from geneva_cli.kinematics.roller_path import RollerPath
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


def boxes_of(samples: PathSamples, b: Array) -> Boxes:
    """Boxes between adjacent samples that may contain a pair; b are half index angles (m, 1)."""
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
        sides.append((flat, arcs.spans()))
    parts = []
    for sense, ((one, entries), (two, exits)) in ((1.0, sides), (-1.0, sides[::-1])):
        use = possible & arcs.turns(sense)  # the tangent turns alike for both sides
        first, last, turns = _overlaps(use, entries, exits, whole)
        row = first % len(design)
        turn = turns * whole.take(row)
        strip, cubics = one.strip.take(first, axis=-1), two.cubics.take(last, axis=-1)
        near = np.flatnonzero(_may_cross(strip, cubics, turn))
        row, first, last = row[near], first[near], last[near]
        one, two = one.taken(first), two.taken(last)
        two.phi[:] += math.tau * turns[near]
        box = (samples.which[row], np.full(len(row), sense), one, two, turn[near], origin[row])
        parts.append(_crossing(Boxes(*box)))
    boxes: Boxes = joined(parts, -1)
    return boxes


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


def _crossing(boxes: Boxes) -> Boxes:
    """Boxes whose exit may cross the entry's strip, and the other way round."""
    entry, exit_, turn = boxes.entry, boxes.exit, boxes.turn
    by_exit = _may_cross(entry.strip, exit_.cubics, turn)
    return boxes.taken(np.flatnonzero(by_exit & _may_cross(exit_.strip, entry.cubics, -turn)))


def _overlaps(
    use: Mask, entries: tuple[Array, Array], exits: tuple[Array, Array], whole: Array
) -> tuple[Whole, Whole, Whole]:
    """Entries and exits in a turn after each whose spans overlap: their numbers, and turns.

    Angles rise by ``whole`` in a turn. ``turns`` is 1 for an exit in the turn after the entry's.
    """
    count, designs = use.shape
    may = use[:, None] & _later(use, use)

    def single(x: Array) -> NDArray[np.float32]:
        return x.astype(np.float32)  # in order still, so that no overlap is lost

    for least, most, low, high, rise in zip(*entries, *exits, (whole, 0.0), strict=True):
        may &= _later(single(low), single(low + rise)) <= single(most)[:, None]
        may &= _later(single(high), single(high + rise)) >= single(least)[:, None]
    place = np.flatnonzero(may)
    pair, design = np.divmod(place, designs)
    entry, after = np.divmod(pair, count - 1)
    exit_ = entry + after + 1
    turns = exit_ >= count
    return entry * designs + design, (exit_ - count * turns) * designs + design, turns


def _later(this: NDArray[T], following: NDArray[T]) -> NDArray[T]:
    """Values of the other arcs after each arc, (n, n - 1, m), from those of two turns, (n, m)."""
    both = np.concatenate((this, following))
    step, size = both.strides
    return as_strided(both[1:], (len(this), len(this) - 1, both.shape[1]), (step, step, size))


class Crossings(NamedTuple):
    """Crossings of the lines' cubics, and what the cubics show of a box."""

    one: Mask  # True if the box has one pair, near ``phi``
    none: Mask  # True if the box has no pair
    phi: Array


def crossings(boxes: Boxes) -> Crossings:
    """Crossings of the cubics of entry and exit.

    If the directions of the two in the plane of lines are apart, they cross once or not at all.
    """
    entry, exit_ = boxes.entry, boxes.exit
    x, y = np.diff(entry.cubics, axis=1)[:, :, None]
    u, v = np.diff(exit_.cubics, axis=1)[:, None]
    cross = x * v - y * u
    cross *= np.sign(cross[1, 1])
    # Curves that are nearly parallel somewhere may cross twice, within the error of the cubics.
    once = cross.min(axis=(0, 1)) > 0.1 * cross.max(axis=(0, 1))
    place, move = np.full((2, 2, len(once)), 0.5)  # fractions of the widths
    for _ in range(3):  # Newton steps
        (p, (x, y)), (q, (u, v)) = entry.at(place[0]), exit_.at(place[1])
        off, up = q - p
        off += boxes.turn
        move = np.stack((off * v - up * u, off * y - up * x)) / (x * v - y * u)
        place = np.clip(place + move, -OVERLAP, 1.0 + OVERLAP)
    # Fractions of the widths: after a move by less than a twentieth the next would be below a
    # hundredth. The pair itself may be off the crossing by 0.05, and a quarter is safe.
    once &= np.abs(move).max(axis=0) < 0.05
    inside = np.abs(place - 0.5).max(axis=0) <= 0.5 + 0.25
    phi = [arcs.phi + of * arcs.width for arcs, of in zip((entry, exit_), place, strict=True)]
    return Crossings(once & inside, once & ~inside, np.stack(phi, axis=1))


def halved(path: RollerPath, boxes: Boxes, b: Array) -> Boxes:
    """Cut each box into four and keep those that may contain a pair."""
    count = len(boxes.which)
    lean = boxes.sense * (b[boxes.which, 0] - 0.5 * math.pi)
    which, origin, lean = np.tile(boxes.which, 2), np.tile(boxes.origin, 2), np.append(lean, -lean)
    halves = _halves(path.roughly(which), joined([boxes.entry, boxes.exit], -1), origin, lean)
    low, high = halves.spans()
    turns = halves.turns(np.tile(boxes.sense, 4))
    box = np.tile(np.arange(count), 4)
    entry, exit_ = (box + 2 * count * np.repeat(of, count) for of in ((0, 0, 1, 1), (0, 1, 0, 1)))
    exit_ += count
    turn = boxes.turn[box]
    ahead = np.stack((turn, 0.0 * turn))
    overlap = (low[:, exit_] + ahead <= high[:, entry]) & (high[:, exit_] + ahead >= low[:, entry])
    may = np.flatnonzero(overlap.all(axis=0) & turns[entry] & turns[exit_])
    one, two, box, turn = halves.taken(entry[may]), halves.taken(exit_[may]), box[may], turn[may]
    return _crossing(Boxes(boxes.which[box], boxes.sense[box], one, two, turn, boxes.origin[box]))


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
