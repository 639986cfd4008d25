"""Check that a roller on its path stays in its slot from entry to exit, and outside it otherwise.

From entry to exit the roller turns the wheel one way and is nearer to its centre than at both ends.
On the way back it is farther away. Samples of the path give both quantities with their slopes. A
condition holds between two samples if no Bernstein coefficient of the cubic through them has the
wrong sign. Otherwise the interval is sampled more closely.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.kinematics.paths.pairs import EndPairs
from geneva_cli.kinematics.paths.samples import points
from geneva_cli.kinematics.roller_path import RollerPath
from geneva_cli.numerics.arrays import Array, Complex, Mask, Number, Which
from geneva_cli.numerics.tolerances import ROUNDED


class PinCourse(NamedTuple):
    """Two quantities that must be positive, each with its slope.

    ``moment`` is that of the pin's velocity about the wheel's centre. ``short`` is the squared
    distance from the centre at entry, less the pin's own.
    """

    moment: Array
    moment_slope: Array
    short: Array
    short_slope: Array


class PlacedWheel(NamedTuple):
    """Wheels by their centres and senses, in a column."""

    centre: Complex
    square: Array  # squared distance from the centre to entry and exit
    sense: Array

    def course(self, p: Complex, v: Complex, a: Complex) -> PinCourse:
        """Both quantities at places, velocities and accelerations of the pin; a row per wheel."""
        ray = (p - self.centre).conj()
        along, slope = ray * v, self.sense * (ray * a).imag
        short = self.square - (ray.real**2 + ray.imag**2)
        return PinCourse(self.sense * along.imag, slope, short, -2.0 * along.real)

    def taken(self, where: Which) -> PlacedWheel:
        """Select some of the wheels."""
        return PlacedWheel._make(part[where] for part in self)


def leaves_slot(
    path: RollerPath,
    wheel: PlacedWheel,
    ends: EndPairs,
    nodes: Array,
    course: PinCourse,
    motion: Array,
) -> Mask:
    """True for each wheel whose roller leaves its slot between samples ``nodes`` since entry."""
    bar = [ROUNDED * np.abs(x).max(axis=1) for x in (course.moment, course.short)]
    fails = np.zeros(len(nodes), dtype=bool)
    inside = nodes[:, :-1] < motion
    row, column = np.nonzero(_open(nodes, course, inside, *(x[:, None] for x in bar)))
    left, right, inside = nodes[row, column], nodes[row, column + 1], inside[row, column]
    for _ in range(4):  # each round cuts an open interval into eight
        if not len(row):
            break
        fraction = np.arange(9) / 8
        places = left[:, None] + (right - left)[:, None] * fraction
        phi = places + ends.at.phi[row, :1]
        at = points(path.roughly(ends.which[row]), phi)
        some = wheel.taken(row).course(at.p, at.v, at.a)
        low, far = (x[row, None] for x in bar)
        wrong = np.where(
            inside[:, None], (some.moment < -low) | (some.short < -far), some.short > far
        )
        fails[row[wrong.any(axis=1)]] = True
        i, j = np.nonzero(_open(places, some, inside[:, None], low, far) & ~fails[row][:, None])
        row, left, right, inside = row[i], places[i, j], places[i, j + 1], inside[i]
    return fails


def peak_bounds(
    nodes: Array, motion: Array, wheel: PlacedWheel, course: PinCourse
) -> tuple[Array, Array]:
    """Bounds of wheels' peak velocities, by the cubics between samples ``nodes`` since entry."""
    width, square = np.diff(nodes, axis=1), wheel.square - course.short
    moments = _coefficients(width, course.moment, course.moment_slope)
    squares = _coefficients(width, square, -course.short_slope)
    inside = nodes[:, 1:] <= motion
    least = most = np.where(inside, moments[0] / squares[0], 0.0)
    # A quotient of cubics is between the quotients of their Bernstein coefficients.
    for moment, square in zip(moments[1:3], squares[1:3], strict=True):
        most = np.maximum(most, np.where(square > 0.0, moment / square, np.inf))
    return least.max(axis=1), most.max(axis=1, where=inside, initial=0.0)


def _open(places: Array, course: PinCourse, inside: Mask, low: Array, far: Array) -> Mask:
    """Intervals in which the cubics do not prove the conditions."""
    width = np.diff(places, axis=1)
    sign = np.where(inside, 1.0, -1.0)
    short = _least(width, course.short, course.short_slope, sign) < -far
    return short | (inside & (_least(width, course.moment, course.moment_slope, 1.0) < -low))


def _least(width: Array, value: Array, slope: Array, sign: Number) -> Array:
    """Least Bernstein coefficient of a cubic between adjacent samples."""
    a, b, c, d = (sign * x for x in _coefficients(width, value, slope))
    least: Array = np.minimum(np.minimum(a, b), np.minimum(c, d))
    return least


def _coefficients(width: Array, value: Array, slope: Array) -> tuple[Array, Array, Array, Array]:
    """Bernstein coefficients of cubics between adjacent samples."""
    a, d, third = value[:, :-1], value[:, 1:], width / 3.0
    return a, a + third * slope[:, :-1], d - third * slope[:, 1:], d
