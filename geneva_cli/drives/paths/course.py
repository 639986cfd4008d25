"""Check that a roller on its path stays in its slot from entry to exit, and outside it otherwise.

From entry to exit the roller turns the wheel one way and is nearer to its centre than at both ends.
On the way back it is farther away. Samples of the path give both quantities with their slopes. A
condition holds between two samples if no Bernstein coefficient of the cubic through them has the
wrong sign. Otherwise the interval is sampled more closely.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.drives.paths.samples import points
from geneva_cli.drives.roller_path import RollerPath
from geneva_cli.numerics.arrays import Array, Complex, Mask, Which, Whole
from geneva_cli.numerics.tolerances import ROUNDED


class PinCourse(NamedTuple):
    """Two quantities that must be positive, each with its slope: (places, wheels).

    Lengths are in mm, slopes per radian of the crank. ``moment`` is that of the pin's velocity
    about the wheel's centre. ``short`` is the squared distance from the centre at entry, less the
    pin's own.
    """

    moment: Array
    moment_slope: Array
    short: Array
    short_slope: Array


class PathWheels(NamedTuple):
    """Wheels of the designs numbered in ``which``: (wheels,).

    ``phi`` holds the crank angles at entry and exit in two columns. The peak velocity is between
    ``least`` and ``most``.
    """

    which: Whole
    phi: Array
    centre: Complex  # mm, on the path's axes
    square: Array  # squared distance from the centre to entry and exit, mm²
    sense: Array  # 1 if the wheel turns counterclockwise on the path's axes, or -1
    least: Array
    most: Array

    def course(self, p: Complex, v: Complex, a: Complex) -> PinCourse:
        """Both quantities at places, velocities and accelerations of the pin: (n, wheels)."""
        ray = (p - self.centre).conj()
        along, slope = ray * v, self.sense * (ray * a).imag
        short = self.square - (ray.real**2 + ray.imag**2)
        return PinCourse(self.sense * along.imag, slope, short, -2.0 * along.real)

    def taken(self, where: Which) -> PathWheels:
        """Select some of the wheels."""
        return PathWheels._make(part[where] for part in self)


class OpenIntervals(NamedTuple):
    """Intervals in which cubics do not prove the conditions, which hold at both ends: (n,).

    ``left`` and ``right`` are crank angles since entry. ``low`` and ``far`` are the rounding of the
    wheel's moments and squared distances.
    """

    wheel: Whole  # numbers of the wheels
    left: Array
    right: Array
    inside: Mask  # True between entry and exit
    low: Array
    far: Array


def open_intervals(nodes: Array, course: PinCourse, motion: Array) -> OpenIntervals:
    """Open intervals between samples of all wheels.

    ``nodes`` are the crank angles of the samples since entry. At them ``course`` has no wrong sign.
    """
    bars = [ROUNDED * np.abs(x).max(axis=0) for x in (course.moment, course.short)]
    return _open(np.arange(len(motion)), nodes, course, nodes[:-1] < motion, *bars)


def leaves_slot(path: RollerPath, wheels: PathWheels, intervals: OpenIntervals) -> Mask:
    """True for each wheel whose roller leaves its slot in an open interval."""
    fails = np.zeros(len(wheels.which), dtype=bool)
    for _ in range(4):  # each round cuts an open interval into eight
        which, left, right, inside, low, far = intervals
        if not len(which):
            break
        places = left + (right - left) * (np.arange(9) / 8)[:, None]
        own = wheels.taken(which)
        at = points(path.roughly(own.which), (places + own.phi[:, 0]).T)
        some = own.course(at.p.T, at.v.T, at.a.T)
        wrong = np.where(inside, (some.moment < -low) | (some.short < -far), some.short > far)
        fails[which[wrong.any(axis=0)]] = True
        intervals = _open(which, places, some, inside, low, far)
        going_on = ~fails[intervals.wheel]
        intervals = OpenIntervals._make(x[going_on] for x in intervals)
    return fails


def bounded(wheels: PathWheels, nodes: Array, motion: Array, course: PinCourse) -> PathWheels:
    """Wheels with bounds of their peak velocities, by the cubics between samples since entry."""
    width, square = np.diff(nodes, axis=0), wheels.square - course.short
    moments = _coefficients(width, course.moment, course.moment_slope)
    squares = _coefficients(width, square, -course.short_slope)
    inside = nodes[1:] <= motion
    least = most = moments[0] / squares[0]
    # A quotient of cubics is between the quotients of their Bernstein coefficients.
    for moment, square in zip(moments[1:3], squares[1:3], strict=True):
        most = np.maximum(most, np.where(square > 0.0, moment / square, np.inf))
    least, most = (np.where(inside, x, 0.0).max(axis=0) for x in (least, most))
    return wheels._replace(least=least, most=most)


def _open(
    wheel: Whole, places: Array, course: PinCourse, inside: Mask, low: Array, far: Array
) -> OpenIntervals:
    """Open intervals between adjacent places, which are of one wheel in each column."""
    width = np.diff(places, axis=0)
    _, *moments, _ = _coefficients(width, course.moment, course.moment_slope)
    _, *shorts, _ = _coefficients(width, course.short, course.short_slope)
    short = np.where(inside, np.minimum(*shorts), -np.maximum(*shorts)) < -far
    inside = np.broadcast_to(inside, short.shape)
    i, j = np.divmod(np.flatnonzero(short | (inside & (np.minimum(*moments) < -low))), len(wheel))
    return OpenIntervals(wheel[j], places[i, j], places[i + 1, j], inside[i, j], low[j], far[j])


def _coefficients(width: Array, value: Array, slope: Array) -> tuple[Array, Array, Array, Array]:
    """Bernstein coefficients of cubics between adjacent samples."""
    a, d, third = value[:-1], value[1:], width / 3.0
    return a, a + third * slope[:-1], d - third * slope[1:], d
