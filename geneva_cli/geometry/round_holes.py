"""Round holes through shells of a sphere."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.sphere import Region, Vector, dot
from geneva_cli.geometry.sphere_arcs import SphereArcs


class RoundHole(NamedTuple):
    """A cylinder about a direction from the centre; radius in mm, less than the spheres'.

    The volume that it removes from a shell is in closed form, by c = sqrt(1 - (q/R)²), where it
    meets a sphere.

    >>> hole = RoundHole((0.0, 0.0, 1.0), 3.0)
    >>> half_rings = 2.0 / 3.0 * math.pi * 4.0**3  # the rest of half a ball: h³ for any R
    >>> halves = 2.0 / 3.0 * math.pi * (5.0**3 - 3.0**3)
    >>> round((halves - hole.volume(3.0, 5.0)) / half_rings, 12)
    1.0
    """

    axis: Vector
    radius: float

    def angle(self, sphere: float) -> float:
        """Half the angle of the hole, seen from the centre, where it meets a sphere, radians."""
        return math.asin(min(1.0, self.radius / sphere))

    def volume(self, inner: float, outer: float) -> float:
        """Volume between two spheres, mm³."""
        return self._integrals(outer)[0] - self._integrals(inner)[0]

    def first(self, inner: float, outer: float) -> float:
        """Integral of the height along its axis, mm⁴."""
        return 0.5 * math.pi * self.radius**2 * (outer - inner) * (outer + inner)

    def inertia(self, inner: float, outer: float, about: Vector) -> float:
        """The volume's moment of inertia about an axis through the centre, mm⁵."""
        (_, far, up), (_, less, below) = self._integrals(outer), self._integrals(inner)
        own, along = far - less, up - below
        square = dot(self.axis, about) ** 2
        return own * square + (0.5 * own + along) * (1.0 - square)

    def _integrals(self, R: float) -> tuple[float, float, float]:
        """Integrals of 1, and of the squares of the distance from the axis and of the height."""
        square = (self.radius / R) ** 2
        c = math.sqrt(1.0 - square)
        left = square / (1.0 + c)  # 1 - c without cancellation
        volume = math.tau / 3.0 * R**3 * left * (1.0 + c + c * c)
        off = left * left * (((3.0 * c + 6.0) * c + 4.0) * c + 2.0)
        up = left * ((((c + 1.0) * c + 1.0) * c + 1.0) * c + 1.0)
        return volume, math.tau / 15.0 * R**5 * off, math.tau / 15.0 * R**5 * up


def least_wall(within: Region, holes: Sequence[RoundHole], sphere: float) -> float:
    """Return the least wall between holes, and from holes to a boundary, on a sphere, mm."""
    angles = [hole.angle(sphere) for hole in holes]
    away = SphereArcs(within.boundary).signed(np.array([hole.axis for hole in holes]))
    least = float((-away - angles).min())
    for (one, a), (other, b) in combinations(zip(holes, angles, strict=True), 2):
        apart = 2.0 * math.asin(min(1.0, 0.5 * math.dist(one.axis, other.axis)))
        least = min(least, apart - a - b)
    return sphere * least
