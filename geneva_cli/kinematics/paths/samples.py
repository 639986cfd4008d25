"""Samples of a closed path, close enough that its direction is known between them.

Between two samples the direction is the cubic of their directions and of the rates at which they
turn. If that does not predict the turn to the next sample, the path is sampled again midway. It is
so too if the turn is large or the rates differ by much, since they may predict the turn by chance.
All this happens near a cusp.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.kinematics.roller_path import RollerPath
from geneva_cli.numerics.arrays import (
    Array,
    Complex,
    Mask,
    Which,
    Whole,
    blocks,
    joined,
    numbers_of,
)

Where: TypeAlias = "Which | tuple[slice | int | Whole, slice | int | Whole]"


class PathPoints(NamedTuple):
    """Points of a path at crank angles ``phi``.

    Position, velocity and acceleration are complex numbers, as is the unit tangent ``t``. ``turn``
    is the rate at which the tangent turns.
    """

    phi: Array
    p: Complex
    v: Complex
    a: Complex
    t: Complex
    speed: Array
    turn: Array

    def taken(self, where: Where) -> PathPoints:
        """Select some of the points."""
        if not isinstance(where, np.ndarray):
            return PathPoints._make(part[where] for part in self)
        numbers = numbers_of(where)
        return PathPoints._make(part.take(numbers, axis=0) for part in self)

    def at_samples(self, row: Whole, column: Whole) -> PathPoints:
        """Select single points of rows of points: (m,)."""
        numbers = row * self.phi.shape[1] + column
        return PathPoints._make(part.take(numbers) for part in self)


class PathSamples(NamedTuple):
    """Samples of a full turn, one column per design: the last row is the first, one turn later.

    ``angle`` is the tangent's angle since the first sample, in radians and without jumps. Columns
    with fewer samples repeat their last one.
    """

    which: Whole  # numbers of the designs
    at: PathPoints
    angle: Array


def points(path: RollerPath, phi: Array) -> PathPoints:
    """Points of the path; a row holds the angles of one design."""
    x, y = path.at(phi, 2)
    shape = np.broadcast_shapes(*(np.shape(c) for c in (*x.c, *y.c)))
    (px, vx, ax), (py, vy, ay) = x.arrays(), y.arrays()
    square = vx * vx + vy * vy
    turn = (vx * ay - vy * ax) / square
    speed = np.broadcast_to(np.sqrt(square), shape)
    over = np.where(speed == 0.0, 0.0, 1.0 / speed)  # no direction where the point is at rest
    places = ((px, py), (vx, vy), (ax, ay), (vx * over, vy * over))
    p, v, a, t = (_complex(*place, shape) for place in places)
    return PathPoints(np.broadcast_to(phi, shape), p, v, a, t, speed, turn)


def _complex(x: Array, y: Array, shape: tuple[int, ...]) -> Complex:
    both = np.empty_like(x, dtype=complex, shape=shape)  # in memory in the order of x
    both.real, both.imag = x, y
    return both


def sampled(path: RollerPath, count: int) -> Iterator[PathSamples]:
    """Samples of all ``count`` designs, in blocks with similar numbers of samples."""
    steps = 24  # samples of a turn that every path has
    # Samples begin after 0.3 of a step: symmetrical paths have their cusps at 0 and at pi.
    phi = np.array([(i + 0.3) * (math.tau / steps) for i in range(steps + 1)])
    every = np.arange(count)
    # samples of 256 designs stay in the processor's cache
    base = joined(
        [_rows(path.roughly(every[i]), phi, len(every[i])) for i in blocks(count, 256)], 0
    )
    left, right = (base.taken((slice(None), x)) for x in (slice(None, -1), slice(1, None)))
    row, column = np.nonzero(_missed(left, right, _turned(left, right)))
    extra = _between(path, row, left.at_samples(row, column), right.at_samples(row, column))
    whose, flat = np.repeat(every, steps + 1), PathPoints._make(x.ravel() for x in base)
    if extra:
        whose, flat = joined([(whose, flat), extra], 0)
    # by designs and crank angles: a turn and the first step are less than 8 radians
    place = np.argsort(8.0 * whose + flat.phi)
    counts = np.bincount(whose, minlength=count)
    starts = np.cumsum(counts) - counts
    order = np.argsort(counts, kind="stable")
    for part in blocks(count, 256):  # their samples and boxes stay in the processor's cache
        which = order[part]
        rows = np.arange(counts[which].max(initial=1))[:, None]
        # After its own last sample a column repeats it.
        at = flat.taken(place[starts[which] + np.minimum(rows, counts[which] - 1)])
        angle = np.zeros(at.phi.shape)
        turned = _turned(at.taken(slice(None, -1)), at.taken(slice(1, None)))
        np.cumsum(turned, axis=0, out=angle[1:])
        yield PathSamples(which, at, angle)


def _rows(path: RollerPath, phi: Array, count: int) -> PathPoints:
    """Points at the same angles for ``count`` designs."""
    at = points(path, phi[None])
    return PathPoints._make(np.broadcast_to(part, (count, len(phi))) for part in at)


def _turned(left: PathPoints, right: PathPoints) -> Array:
    """Turn of the tangent from one sample to the next, less than half a turn."""
    (a, b), (c, d) = ((one.t.real, one.t.imag) for one in (left, right))
    turn: Array = np.arctan2(a * d - b * c, a * c + b * d)
    return turn


def _missed(left: PathPoints, right: PathPoints, turned: Array) -> Mask:
    """True where the rates at two samples do not predict the turn between them."""
    half = 0.5 * (right.phi - left.phi)
    # radians; an arc turns by less than a pair for three slots does, which is pi/3
    wrong = (np.abs(turned - half * (left.turn + right.turn)) > 0.05) | (np.abs(turned) > 1.0)
    # Rates that differ this much belong to a sharp bend, whose turn they predict by chance only.
    return wrong | (half * np.abs(right.turn - left.turn) > 0.25)  # radians


def _between(
    path: RollerPath, which: Whole, left: PathPoints, right: PathPoints
) -> tuple[Whole, PathPoints] | None:
    """Extra samples between samples of designs, until every turn is predicted."""
    added = []
    for _ in range(14):  # halvings: a bend within a crank angle of 1e-5 radians is a cusp
        if not len(which):
            break
        phi = 0.5 * (left.phi + right.phi)
        middle = points(path.roughly(which), phi[:, None]).taken((slice(None), 0))
        added.append((which, middle))
        halves = ((left, middle), (middle, right))
        missed = [_missed(*half, _turned(*half)) for half in halves]
        left, right = (
            joined([half[side].taken(m) for half, m in zip(halves, missed, strict=True)], 0)
            for side in (0, 1)
        )
        which = np.concatenate([which[m] for m in missed])
    return joined(added, 0) if added else None
