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
from geneva_cli.numerics.arrays import Array, Complex, Mask, Which
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


class PlacedWheel(NamedTuple):
    """Wheels by their centres and senses: (wheels,)."""

    centre: Complex  # mm, on the path's axes
    square: Array  # squared distance from the centre to entry and exit, mm²
    sense: Array  # 1 if the wheel turns counterclockwise, or -1

    def course(self, p: Complex, v: Complex, a: Complex) -> PinCourse:
        """Both quantities at places, velocities and accelerations of the pin: (n, wheels)."""
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
    """True for each wheel whose roller leaves its slot between samples.

    ``nodes`` are the crank angles of the samples since entry. At them ``course`` has no wrong sign.
    """
    bar = [ROUNDED * np.abs(x).max(axis=0) for x in (course.moment, course.short)]
    fails = np.zeros(len(motion), dtype=bool)
    inside = nodes[:-1] < motion
    i, which = np.nonzero(_open(nodes, course, inside, *bar))
    left, right, inside = nodes[i, which], nodes[i + 1, which], inside[i, which]
    for _ in range(4):  # each round cuts an open interval into eight
        if not len(which):
            break
        places = left + (right - left) * (np.arange(9) / 8)[:, None]
        phi = places + ends.at.phi[which, 0]
        at = points(path.roughly(ends.which[which]), phi.T)
        some = wheel.taken(which).course(at.p.T, at.v.T, at.a.T)
        low, far = (x[which] for x in bar)
        wrong = np.where(inside, (some.moment < -low) | (some.short < -far), some.short > far)
        fails[which[wrong.any(axis=0)]] = True
        i, j = np.nonzero(_open(places, some, inside, low, far) & ~fails[which])
        which, left, right, inside = which[j], places[i, j], places[i + 1, j], inside[j]
    return fails


def peak_bounds(
    nodes: Array, motion: Array, wheel: PlacedWheel, course: PinCourse
) -> tuple[Array, Array]:
    """Bounds of wheels' peak velocities, by the cubics between samples ``nodes`` since entry."""
    width, square = np.diff(nodes, axis=0), wheel.square - course.short
    moments = _coefficients(width, course.moment, course.moment_slope)
    squares = _coefficients(width, square, -course.short_slope)
    inside = nodes[1:] <= motion
    least = most = moments[0] / squares[0]
    # A quotient of cubics is between the quotients of their Bernstein coefficients.
    for moment, square in zip(moments[1:3], squares[1:3], strict=True):
        most = np.maximum(most, np.where(square > 0.0, moment / square, np.inf))
    return tuple(np.where(inside, x, 0.0).max(axis=0) for x in (least, most))


def _open(places: Array, course: PinCourse, inside: Mask, low: Array, far: Array) -> Mask:
    """Intervals in which the cubics do not prove the conditions, which hold at their ends."""
    width = np.diff(places, axis=0)
    _, *moments, _ = _coefficients(width, course.moment, course.moment_slope)
    _, *shorts, _ = _coefficients(width, course.short, course.short_slope)
    short = np.where(inside, np.minimum(*shorts), -np.maximum(*shorts)) < -far
    return short | (inside & (np.minimum(*moments) < -low))


def _coefficients(width: Array, value: Array, slope: Array) -> tuple[Array, Array, Array, Array]:
    """Bernstein coefficients of cubics between adjacent samples."""
    a, d, third = value[:-1], value[1:], width / 3.0
    return a, a + third * slope[:-1], d - third * slope[1:], d
