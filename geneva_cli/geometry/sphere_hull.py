"""The convex hull of caps of a sphere, and distances from its arcs.

As on a plane (``hull``), it has arcs of the caps' rims, and great circles that touch two caps.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.sphere import (
    Region,
    SphereArc,
    Vector,
    combined,
    cross,
    dot,
    square_to,
    unit,
)
from geneva_cli.geometry.sphere_arcs import SphereArcs, half_chords
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH


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


class Tangent(NamedTuple):
    """A great circle from one cap to another, with all caps on its left."""

    pole: Vector
    to: int
    start: Vector
    end: Vector


def convex_hull(caps: Sequence[Cap]) -> Region:
    """Convex hull of caps that lie within a quarter of the sphere from the first one's middle.

    >>> from geneva_cli.geometry.sphere import place
    >>> two = convex_hull([Cap((0.0, 0.0, 1.0), 0.2), Cap(place(0.6, 0.0), 0.1)])
    >>> [round(arc.angle, 3) for arc in two.boundary]
    [1.571, 0.1, 1.571, 0.2]
    """
    leaving = [list(_tangents(i, caps)) for i in range(len(caps))]
    first = next((tangents[0] for tangents in leaving if tangents), None)
    if first is None:  # one cap holds all others
        return max(caps, key=lambda cap: cap.angle).region
    boundary: list[SphereArc] = []
    here = first
    while True:
        middle, angle = caps[here.to]
        after = min(leaving[here.to], key=lambda t: _turn(middle, here.end, t.start))
        boundary.append(SphereArc(here.pole, 0.5 * math.pi, here.start, here.end))
        boundary.append(SphereArc(middle, angle, here.end, after.start))
        if after is first:
            return Region(tuple(boundary), caps[0].middle)
        here = after


def _tangents(i: int, caps: Sequence[Cap]) -> Iterator[Tangent]:
    """Tangents that leave a cap; of several on one great circle, the one to the farthest cap."""
    candidates: list[tuple[float, Tangent]] = []
    for j in range(len(caps)):
        pole = _pole(caps[i], caps[j]) if j != i else None
        if pole is None or any(dot(pole, c.middle) < math.sin(c.angle) - SAME_LENGTH for c in caps):
            continue
        ends = [unit(combined(caps[k].middle, 1.0, pole, -math.sin(caps[k].angle))) for k in (i, j)]
        candidates.append((dot(*ends), Tangent(pole, j, *ends)))
    for near, one in candidates:
        if not any(far < near and _same(one.pole, other.pole) for far, other in candidates):
            yield one


def _pole(one: Cap, other: Cap) -> Vector | None:
    """Pole of the great circle from one cap to another that has both on its left, or None.

    Its distance from each middle is a quarter of the sphere minus the cap's angle.
    """
    g = dot(one.middle, other.middle)
    square = 1.0 - g * g
    s, t = math.sin(one.angle), math.sin(other.angle)
    if square <= 0.0:
        return None
    a, b = (s - g * t) / square, (t - g * s) / square
    left = (1.0 - (a * s + b * t)) / square
    if left <= SAME_LENGTH * SAME_LENGTH:
        return None  # one cap holds the other
    both = combined(one.middle, a, other.middle, b)
    return unit(combined(both, 1.0, cross(one.middle, other.middle), math.sqrt(left)))


def _turn(middle: Vector, start: Vector, end: Vector) -> float:
    """Angle about a middle from one point of a rim to another, counterclockwise."""
    return SphereArc(middle, 0.0, start, end).sweep


def _same(one: Vector, other: Vector) -> bool:
    return math.dist(one, other) < SAME_LENGTH


class Circle(NamedTuple):
    """A circle on the sphere, ``angle`` radians from its axis; x, y and the axis are unit vectors.

    Azimuths on it are from x towards y.
    """

    axis: Array
    x: Array
    y: Array
    angle: float

    def seen(self, points: Array) -> tuple[Array, Array]:
        """Return the angles of points (n, 3) from the axis, and their azimuths, radians."""
        along, sideways = points @ self.x, points @ self.y
        polar = np.arctan2(np.hypot(along, sideways), points @ self.axis)
        return polar, np.arctan2(sideways, along)

    def at(self, azimuth: Array) -> Array:
        """Return the points of the circle at azimuths, (n, 3)."""
        c, s = np.cos(azimuth)[:, None], np.sin(azimuth)[:, None]
        flat = math.sin(self.angle)
        return math.cos(self.angle) * self.axis + flat * (c * self.x + s * self.y)


def farthest(boundary: SphereArcs, points: Array) -> Array:
    """Return the distance from each point, (n, 3), to the farthest point of each arc, (n, k).

    That is nearest to the opposite point.
    """
    return math.pi - boundary.distances(-points)


class FromCircle:
    """Distances of arcs of one circle from a boundary, which they do not cross."""

    def __init__(self, boundary: SphereArcs, circle: Circle) -> None:
        self.boundary, self.circle = boundary, circle
        # Two circles are nearest to each other on the great circle through both axes.
        every = np.arange(len(boundary))
        _, facing = boundary.facing(every, np.tile(circle.axis, (len(every), 1)))
        points = np.concatenate((boundary.start, facing))
        self.polar, self.azimuth = circle.seen(points)

    def __call__(self, middle: Array, half: Array) -> Array:
        """Return the least distances of arcs from azimuths ``middle - half`` to ``middle + half``.

        They are at a corner of the boundary, or at one of its points that face the circle's axis,
        or at an end of the arc.
        """
        away = np.remainder(self.azimuth - middle[:, None] + math.pi, math.tau) - math.pi
        beyond = np.maximum(np.abs(away) - half[:, None], 0.0)
        across = math.sin(self.circle.angle) * np.sin(self.polar)
        square = half_chords(self.polar - self.circle.angle, across, beyond).min(axis=1)
        from_points = 2.0 * np.arcsin(np.sqrt(np.minimum(square, 1.0)))
        ends = [self.circle.at(end) for end in (middle - half, middle + half)]
        from_ends = [self.boundary.distances(end).min(axis=1) for end in ends]
        return np.minimum.reduce((from_points, *from_ends))


def short_arcs(regions: Iterable[Region], step: float) -> SphereArcs:
    """Return the boundaries of regions, cut into arcs that turn by at most ``step`` radians."""
    arcs = [arc for region in regions for arc in region.boundary]
    return SphereArcs([one for arc in arcs for one in _cut(arc, step)])


def _cut(arc: SphereArc, step: float) -> list[SphereArc]:
    count = max(1, math.ceil(arc.sweep / step))
    points, _ = arc.at(arc.sweep * np.arange(1, count) / count)
    ends = [arc.start, *[(float(x), float(y), float(z)) for x, y, z in points], arc.end]
    return [SphereArc(arc.axis, arc.angle, a, b) for a, b in zip(ends[:-1], ends[1:], strict=True)]
