"""Boxes: an arc of the path for the entry and one for the exit that may contain a pair.

Each point of a pair lies on the line of their chord. Along an arc the line's angle and offset are
cubics of the crank angle. They show if an entry and an exit can have a line in common; see
``pairs``.
"""

from __future__ import annotations

import math
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.kinematics.paths.samples import PathPoints, PathSamples, joined, points
from geneva_cli.kinematics.roller_path import RollerPath
from geneva_cli.numerics.arrays import Array, Complex, Mask, Number, Whole

# Possible error of a quantity's cubics, as a fraction of their range in a box. It is ample: of
# 184,000 wheels of random linkages none is lost with 0, and 9 % are with -0.05.
CUBIC_ERROR = 0.03
OVERLAP = 0.5  # fraction of an arc's width by which its pair may lie outside it

Span: TypeAlias = "tuple[Array, Array]"  # least and greatest angles


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
        return (np.diff(self.cubics[0], axis=0) * sense).min(axis=0) <= 0.0

    def angles(self, sign: float) -> Span:
        """Least and greatest angle of the lines, times a sign."""
        angle = sign * self.cubics[0]
        low, high = angle.min(axis=0), angle.max(axis=0)
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
    at, lean = samples.at, 0.5 * math.pi - b[samples.which]
    # Near a sharp bend all lines pass one point. Measured from there their offsets are small.
    sharpest = np.abs(at.turn).argmax(axis=1)[:, None]
    origin = np.take_along_axis(at.p, sharpest, axis=1)
    angle = samples.angle + np.angle(at.t[:, :1])
    # a turn later; NaN if the linkage does not close for a full turn
    whole = angle[:, -1:] - angle[:, :1]
    sides = []
    for side in (-1.0, 1.0):
        lines = _lines(at, angle, origin, side * lean)
        sides.append(_arcs(at.phi[:, :-1], np.diff(at.phi), lines[..., :-1], lines[..., 1:]))
    possible = (sides[0].width > 0.0) & np.isfinite(sides[0].cubics[0].sum(axis=0) + whole)
    parts = []
    for sense, (entry, exit_) in ((1.0, sides), (-1.0, sides[::-1])):
        use = possible & entry.turns(sense)
        places = _overlaps(use, entry.angles(-sense), exit_.angles(-sense), -sense * whole)
        one, two = (
            Arcs._make(x.reshape(*x.shape[:-2], -1) for x in arcs) for arcs in (entry, exit_)
        )
        row, first, last, turns = places
        turn = turns * whole.take(row)
        strip, cubics = one.strip.take(first, axis=-1), two.cubics.take(last, axis=-1)
        near = np.flatnonzero(_may_cross(strip, cubics, turn))
        row, first, last, turns = places[:, near]
        one, two = one.taken(first), two.taken(last)
        two.phi[:] += math.tau * turns
        box = (samples.which[row], np.full(len(row), sense), one, two, turn[near], origin[row, 0])
        parts.append(_crossing(Boxes(*box)))
    boxes: Boxes = joined(parts, -1)
    return boxes


def _lines(at: PathPoints, angle: Array, origin: Complex, lean: Array) -> Array:
    """Angles and offsets of lines, and their slopes; ``lean`` is the angle from the tangent."""
    from_origin = (at.p - origin) * (at.t * np.exp(1j * lean)).conj()
    slope = -at.speed * np.sin(lean) - at.turn * from_origin.real
    return np.stack((angle + lean, from_origin.imag, at.turn, slope))


def _arcs(phi: Array, width: Array, first: Array, last: Array) -> Arcs:
    """Arcs between points with lines ``first`` and ``last``."""
    third = width / 3.0
    ends = first[:2], first[:2] + third * first[2:], last[:2] - third * last[2:], last[:2]
    cubics = np.stack(ends, axis=1)
    along = last[:2] - first[:2]
    across = along[0] * cubics[1] - along[1] * cubics[0]
    return Arcs(phi, width, cubics, np.stack((*along, across.min(axis=0), across.max(axis=0))))


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


def _overlaps(use: Mask, entries: Span, exits: Span, whole: Array) -> Whole:
    """Entries and exits in a turn after each whose angles overlap: row, entry, exit and turns.

    Angles rise by ``whole`` in a turn. Entries and exits are numbered through all rows. ``turns``
    is 1 for an exit in the turn after the entry's.
    """
    rows, count = use.shape
    place = np.flatnonzero(np.hstack((use, use)))
    row = place // (2 * count)
    column = place - row * (2 * count)
    turns = column >= count
    own = place - count * (row + turns)  # number of the arc
    later = whole.take(row) * turns
    low, high = (x.take(own) + later for x in exits)
    entry = np.flatnonzero(~turns)
    mine, arc = row.take(entry), own.take(entry)
    least, most = (x.take(arc) for x in entries)
    # The greatest end so far and the least start from here on rise in each row. Counted in cells
    # of the angle, they bound the exits of an entry.
    cells = 4 * count
    base = low.min(initial=0.0)
    scale = (cells - 1) / max(high.max(initial=0.0) - base, 1e-9)

    def cell(angle: Array, row: Whole) -> Whole:
        return np.clip((angle - base) * scale, 0.0, cells - 1.0).astype(int) + cells * row

    ends = np.maximum.accumulate(cell(high, row))
    starts = np.minimum.accumulate(cell(low, row)[::-1])
    below = np.zeros(rows * cells + 1, dtype=int)
    np.cumsum(np.bincount(ends, minlength=rows * cells), out=below[1:])
    up_to = np.cumsum(np.bincount(starts, minlength=rows * cells))
    begin = np.maximum(below.take(cell(least, mine)), entry + 1)
    end = np.minimum(up_to.take(cell(most, mine)), entry + np.bincount(mine)[mine])
    counts = np.maximum(end - begin, 0)
    of = np.repeat(np.arange(len(entry)), counts)
    exit_ = np.arange(len(of)) + np.repeat(begin - (np.cumsum(counts) - counts), counts)
    near = np.flatnonzero((low.take(exit_) <= most.take(of)) & (high.take(exit_) >= least.take(of)))
    of, exit_ = of.take(near), exit_.take(near)
    return np.stack((mine.take(of), arc.take(of), own.take(exit_), turns.take(exit_)))


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
    low, high = halves.angles(1.0)
    turns = halves.turns(np.tile(boxes.sense, 4))
    box = np.tile(np.arange(count), 4)
    entry, exit_ = (box + 2 * count * np.repeat(of, count) for of in ((0, 0, 1, 1), (0, 1, 0, 1)))
    exit_ += count
    turn = boxes.turn[box]
    overlap = (low[exit_] + turn <= high[entry]) & (high[exit_] + turn >= low[entry])
    may = np.flatnonzero(overlap & turns[entry] & turns[exit_])
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
