"""Regions of a unit sphere that are bounded by arcs of its great and small circles.

Points are unit vectors (x, y, z). A region lies to the left of its boundary, seen from outside.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import permutations
from operator import attrgetter
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH

Vector: TypeAlias = tuple[float, float, float]
Rotation: TypeAlias = tuple[Vector, Vector, Vector]  # of the sphere: the images of x, y and z

POLE: Vector = (0.0, 0.0, 1.0)  # of the wheel in its own frame


class SphereArc(NamedTuple):
    """An arc counterclockwise about an axis, ``angle`` radians from it; the axis is on its left.

    An arc from a point to itself is the whole circle.
    """

    axis: Vector
    angle: float
    start: Vector
    end: Vector

    @property
    def sweep(self) -> float:
        """Angle about its axis, radians, above 0 and at most a whole turn."""
        if self.start == self.end:
            return math.tau
        x, y = self.frame
        return math.atan2(dot(self.end, y), dot(self.end, x)) % math.tau

    def at(self, turn: Array) -> tuple[Array, Array]:
        """Points and their derivatives, (n, 3), at angles about the axis from the start."""
        x, y = np.array(self.frame)
        c, s = np.cos(turn)[:, None], np.sin(turn)[:, None]
        flat = math.sin(self.angle)
        points = math.cos(self.angle) * np.array(self.axis) + flat * (c * x + s * y)
        return points, flat * (c * y - s * x)

    @property
    def back(self) -> SphereArc:
        """The arc in the opposite sense."""
        return SphereArc(opposite(self.axis), math.pi - self.angle, self.end, self.start)

    @property
    def key(self) -> tuple[Vector, Vector, Vector]:
        """The identity of an arc: its ends, and the side of its circle's middle."""
        x, y, z = (round(v, 9) + 0.0 for v in self.axis)
        return self.start, self.end, (x, y, z)

    @property
    def frame(self) -> tuple[Vector, Vector]:
        """Unit vectors square to the axis: towards the start, and a quarter of a turn further."""
        y = unit(cross(self.axis, self.start))
        return cross(y, self.axis), y


class Region(NamedTuple):
    """The region left of one closed boundary, within a quarter of the sphere from ``middle``."""

    boundary: tuple[SphereArc, ...]
    middle: Vector

    @property
    def area(self) -> float:
        """Solid angle, by Gauss and Bonnet: 2 pi minus the turning of the boundary."""
        turned = [math.cos(arc.angle) * arc.sweep for arc in self.boundary]
        for arc, after in zip(self.boundary, (*self.boundary[1:], self.boundary[0]), strict=True):
            back, on = cross(arc.axis, arc.end), cross(after.axis, arc.end)
            turned.append(math.atan2(dot(cross(back, on), arc.end), dot(back, on)))
        return math.tau - math.fsum(turned)

    @property
    def polar_moment(self) -> float:
        """Integral of x² + y² over the region, from its boundary only.

        It is two thirds of the area plus a third of the flow of z along z out of the region: the
        other part is a harmonic of degree 2.
        """
        # 24 points are exact: the integrands are of the second degree in sine and cosine
        nodes, weights = np.polynomial.legendre.leggauss(24)
        flow = 0.0
        for arc in self.boundary:
            half = 0.5 * arc.sweep
            (x, y, z), (dx, dy, _) = (rows.T for rows in arc.at(half * (1.0 + nodes)))
            flow += half * float(weights @ ((dx * y - dy * x) * z))  # to the right of the step
        return (2.0 * self.area + flow) / 3.0


def place(polar: float, azimuth: float) -> Vector:
    """Point at a polar angle from z and an azimuth about z from x, radians."""
    s = math.sin(polar)
    return s * math.cos(azimuth), s * math.sin(azimuth), math.cos(polar)


def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def combined(one: Vector, a: float, other: Vector, b: float) -> Vector:
    """The sum of two vectors, each times a number."""
    x, y, z = (a * p + b * q for p, q in zip(one, other, strict=True))
    return x, y, z


def unit(v: Vector) -> Vector:
    """Unit vector in the direction of a vector."""
    length = math.hypot(*v)
    return v[0] / length, v[1] / length, v[2] / length


def square_to(v: Vector) -> Vector:
    """A unit vector perpendicular to another."""
    least = min(range(3), key=lambda k: abs(v[k]))
    return unit(cross(v, (float(least == 0), float(least == 1), float(least == 2))))


def axis_frame(axis: Vector) -> Rotation:
    """A rotation that takes z to an axis."""
    x = square_to(axis)
    return x, cross(axis, x), axis


def opposite(v: Vector) -> Vector:
    """The opposite vector."""
    return -v[0], -v[1], -v[2]


class Cap(NamedTuple):
    """All points within an angle of a point."""

    middle: Vector
    angle: float

    @property
    def region(self) -> Region:
        """The cap as a region."""
        sideways = square_to(self.middle)
        rim = combined(self.middle, math.cos(self.angle), sideways, math.sin(self.angle))
        return Region((SphereArc(self.middle, self.angle, rim, rim),), self.middle)


def convex_hull(caps: Sequence[Cap]) -> Region:
    """Convex hull of caps that lie within a quarter of the sphere from the first one's middle.

    It has arcs of the caps' rims, and great circles that touch two caps.
    """
    found = list[tuple[int, int, SphereArc]]()  # from one cap to another, with all on their left
    for (i, one), (j, other) in permutations(enumerate(caps), 2):
        # the circle's pole is a quarter of the sphere from each middle, less the cap's angle
        g = dot(one.middle, other.middle)
        square, s, t = 1.0 - g * g, math.sin(one.angle), math.sin(other.angle)
        left = square - s * (s - g * t) - t * (t - g * s)
        if left <= (SAME_LENGTH * square) ** 2:
            continue  # one cap holds the other
        both = combined(one.middle, s - g * t, other.middle, t - g * s)
        pole = unit(combined(both, 1.0, cross(one.middle, other.middle), math.sqrt(left)))
        if all(dot(pole, c.middle) >= math.sin(c.angle) - SAME_LENGTH for c in caps):
            ends = [unit(combined(c.middle, 1.0, pole, -math.sin(c.angle))) for c in (one, other)]
            found.append((i, j, SphereArc(pole, 0.5 * math.pi, *ends)))
    lines, (x, y, _) = list[tuple[int, int, SphereArc]](), axis_frame(caps[0].middle)
    for line in sorted(found, key=lambda line: dot(line[2].start, line[2].end)):
        # of those on one circle, the longest
        if all(math.dist(line[2].axis, one.axis) >= SAME_LENGTH for *_, one in lines):
            lines.append(line)
    if not lines:  # one cap holds all others
        return max(caps, key=attrgetter("angle")).region
    lines.sort(key=lambda line: math.atan2(dot(line[2].axis, y), dot(line[2].axis, x)))
    first, boundary = lines.index(min(lines)), list[SphereArc]()
    lines = lines[first:] + lines[:first]
    for (_, j, arc), (*_, after) in zip(lines, [*lines[1:], lines[0]], strict=True):
        boundary += [arc, SphereArc(*caps[j], arc.end, after.start)]
    return Region(tuple(boundary), caps[0].middle)
