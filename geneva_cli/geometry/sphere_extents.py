"""Nearest and farthest distances between boundaries on a sphere, and points or arcs, radians."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.sphere import Region, SphereArc
from geneva_cli.geometry.sphere_arcs import SphereArcs, half_chords
from geneva_cli.numerics.arrays import Array


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
