"""Samples of a closed path, close enough that its direction is known between them.

Between two samples the direction is the cubic of their directions and of the rates at which they
turn. If that does not predict the turn to the next sample, the path is sampled again midway. It is
so too if the turn is large or the rates differ by much, since they may predict the turn by chance.
All this happens near a cusp.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import accumulate
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.drives.roller_path import RollerPath
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
    motion = (_complex(*place, shape) for place in zip(x.arrays(), y.arrays(), strict=True))
    return _points(np.broadcast_to(phi, shape), *motion)


def _points(phi: Array, p: Complex, v: Complex, a: Complex) -> PathPoints:
    """Points with a known position, velocity and acceleration."""
    x, y = v.real, v.imag
    square = x * x + y * y
    speed = np.sqrt(square)
    over = np.where(speed == 0.0, 0.0, 1.0 / speed)  # no direction where the point is at rest
    turn = (x * a.imag - y * a.real) / square
    return PathPoints(phi, p, v, a, _complex(x * over, y * over, v.shape), speed, turn)


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
    parts = (every[i] for i in blocks(count, 256))
    base = joined([_rows(path.roughly(i), phi, len(i)) for i in parts], 0)
    ends = [base.taken((slice(None), i)) for i in (slice(None, -1), slice(1, None))]
    row, column = np.nonzero(_missed(*ends))
    extra = _between(path, row, *(end.taken((row, column)) for end in ends))
    # The rest of the samples' numbers follow from these, faster than they are put in order.
    whose, *motion = joined([(np.repeat(every, steps + 1), *(x.ravel() for x in base[:4])), *extra])
    # by designs and crank angles: a turn and the first step are less than 8 radians
    place = np.argsort(8.0 * whose + motion[0])
    counts = np.bincount(whose, minlength=count)
    starts = np.cumsum(counts) - counts
    order = np.argsort(counts, kind="stable")
    for part in blocks(count, 256):  # their samples and boxes stay in the processor's cache
        which = order[part]
        rows = np.arange(counts[which].max(initial=1))[:, None]
        # After its own last sample a column repeats it.
        number = place[starts[which] + np.minimum(rows, counts[which] - 1)]
        at = _points(*(x.take(number) for x in motion))
        turned = _turned(at.t[:-1], at.t[1:])
        # by rows: NumPy's own sum along columns takes five times as long
        angle = np.stack(list(accumulate(turned, initial=np.zeros(len(which)))))
        yield PathSamples(which, at, angle)


def _rows(path: RollerPath, phi: Array, count: int) -> PathPoints:
    """Points at the same angles for ``count`` designs."""
    at = points(path, phi[None])
    return PathPoints._make(np.broadcast_to(part, (count, len(phi))) for part in at)


def _turned(t: Complex, u: Complex) -> Array:
    """Turn from one tangent to the next, less than half a turn."""
    (a, b), (c, d) = (t.real, t.imag), (u.real, u.imag)
    turn: Array = np.arctan2(a * d - b * c, a * c + b * d)
    return turn


def _missed(left: PathPoints, right: PathPoints) -> Mask:
    """True where the rates at two samples do not predict the turn between them."""
    half, turned = 0.5 * (right.phi - left.phi), _turned(left.t, right.t)
    # radians; an arc turns by less than a pair for three slots does, which is pi/3
    wrong = (np.abs(turned - half * (left.turn + right.turn)) > 0.05) | (np.abs(turned) > 1.0)
    # Rates that differ this much belong to a sharp bend, whose turn they predict by chance only.
    return wrong | (half * np.abs(right.turn - left.turn) > 0.25)  # radians


def _between(
    path: RollerPath, which: Whole, left: PathPoints, right: PathPoints
) -> list[tuple[Whole, Array, Complex, Complex, Complex]]:
    """Extra samples between samples of designs, until every turn is predicted."""
    added = []
    for _ in range(14):  # halvings: a bend within a crank angle of 1e-5 radians is a cusp
        if not len(which):
            break
        phi = 0.5 * (left.phi + right.phi)
        at = points(path.roughly(which), phi[:, None]).taken((slice(None), 0))
        added.append((which, *at[:4]))
        starts, ends = joined([left, at]), joined([at, right])
        missed = np.flatnonzero(_missed(starts, ends))
        left, right = starts.taken(missed), ends.taken(missed)
        which = np.concatenate((which, which))[missed]
    return added
