"""Arcs of circles on a unit sphere as arrays: distances of points as angles, and facing points."""

import math
from collections.abc import Iterable, Sequence
from itertools import combinations, pairwise
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.sphere import Region, SphereArc, Vector, dot
from geneva_cli.numerics.arrays import Array, Whole, within_half_turn
from geneva_cli.numerics.tolerances import SAME_ANGLE


def _distances(off: Array, across: Array, beyond: Array) -> Array:
    """Return the angles between points and the nearest points of arcs.

    A point is ``off`` the arc's circle, and about the axis ``beyond`` the arc's end. ``across`` is
    the product of the sines of both angles from the axis.
    """
    square = np.sin(0.5 * off) ** 2 + across * np.sin(0.5 * beyond) ** 2
    return 2.0 * np.arcsin(np.sqrt(np.minimum(square, 1.0)))


class SphereArcs:
    """A boundary of arcs, each from the end of the one before; its region is to its left.

    If it is not closed, it is a part of a boundary and continues smoothly at its ends.
    """

    def __init__(self, arcs: Sequence[SphereArc], closed: bool = True) -> None:
        self.axis = np.array([arc.axis for arc in arcs])
        self.x = np.array([arc.ahead for arc in arcs])
        self.y = np.cross(self.axis, self.x)
        self.angle = np.array([arc.angle for arc in arcs])
        self.sweep = np.array([arc.sweep for arc in arcs])
        self.start = np.array([arc.start for arc in arcs])
        self.middle = self.at(np.arange(len(arcs)), 0.5 * self.sweep)
        half = np.sin(self.angle) * np.sin(0.25 * self.sweep)
        self.size = 2.0 * np.arcsin(np.minimum(half, 1.0))  # angle from its middle to its ends
        back = np.roll([arc.travel(arc.end) for arc in arcs], 1, axis=0)
        on = np.array([arc.travel(arc.start) for arc in arcs])
        sideways = (np.cross(back, on) * self.start).sum(axis=1)
        # left turn of the boundary before each arc,
        self.first = np.arctan2(sideways, (back * on).sum(axis=1))
        if not closed:
            self.first[0] = 0.0
        self.last = np.roll(self.first, -1)  # and after it

    def __len__(self) -> int:
        return len(self.angle)

    def at(self, which: Whole, turn: Array) -> Array:
        """Points of some of the arcs, (n, 3), at angles about their axes from their starts."""
        c, s = np.cos(turn)[:, None], np.sin(turn)[:, None]
        flat = np.sin(self.angle[which])[:, None]
        ahead = c * self.x[which] + s * self.y[which]
        return np.cos(self.angle[which])[:, None] * self.axis[which] + flat * ahead

    def signed(self, points: Array) -> Array:
        """Distances of points (n, 3) from the boundary, radians, negative inside."""
        off, past, short, away = self._nearest(points)
        near, row = np.argmin(away, axis=1), np.arange(len(points))
        past, short, away = (each[row, near] for each in (past, short, away))
        corner = np.where(short < past, self.first[near], self.last[near])
        corner = np.where((past > 0.0) & (np.abs(corner) > SAME_ANGLE), corner, 0.0)
        outside = np.where(corner != 0.0, corner > 0.0, off[row, near] > 0.0)
        return np.where(outside, away, -away)

    def distances(self, points: Array) -> Array:
        """Distances of points (n, 3) from each arc, radians, (n, k)."""
        return self._nearest(points)[-1]

    def _nearest(self, points: Array) -> tuple[Array, Array, Array, Array]:
        """Angles off circles, past the arcs' ends, short of their starts; distances."""
        along, sideways = points @ self.x.T, points @ self.y.T
        across = np.hypot(along, sideways)
        off = np.arctan2(across, points @ self.axis.T) - self.angle
        turn = np.remainder(np.arctan2(sideways, along), 2.0 * np.pi)
        past, short = turn - self.sweep, 2.0 * np.pi - turn
        beyond = np.where(past <= 0.0, 0.0, np.minimum(past, short))
        return off, past, short, _distances(off, np.sin(self.angle) * across, beyond)

    def facing(self, which: Whole, towards: Array) -> tuple[Whole, Array]:
        """Points of some arcs that face directions (n, 3), or away; the direction's index first."""
        along = (towards * self.x[which]).sum(axis=1)
        turn = np.arctan2((towards * self.y[which]).sum(axis=1), along)
        owner, points = [], []
        for opposite in (0.0, np.pi):
            at = np.remainder(turn + opposite, 2.0 * np.pi)
            on = np.flatnonzero(at <= self.sweep[which])
            owner.append(on)
            points.append(self.at(which[on], at[on]))
        return np.concatenate(owner), np.concatenate(points)


class Circle(NamedTuple):
    """A circle on the sphere, ``angle`` radians from its axis, with azimuths from x towards y."""

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
    """Return the distance from each point, (n, 3), to the farthest point of each arc, (n, k)."""
    return math.pi - boundary.distances(-points)


def from_circle(boundary: SphereArcs, circle: Circle, middle: Array, half: Array) -> Array:
    """Return the distances of arcs of a circle from a boundary that they do not cross, (n,).

    They are from azimuths ``middle - half`` to ``middle + half``.
    """
    # two circles are nearest to each other on the great circle through both axes
    every = np.arange(len(boundary))
    _, facing = boundary.facing(every, np.tile(circle.axis, (len(every), 1)))
    polar, azimuth = circle.seen(np.concatenate((boundary.start, facing)))
    away = within_half_turn(azimuth - middle[:, None])
    beyond = np.maximum(np.abs(away) - half[:, None], 0.0)
    across = math.sin(circle.angle) * np.sin(polar)
    from_points = _distances(polar - circle.angle, across, beyond).min(axis=1)
    ends = [circle.at(end) for end in (middle - half, middle + half)]
    from_ends = [boundary.distances(end).min(axis=1) for end in ends]
    return np.minimum.reduce((from_points, *from_ends))


def short_arcs(regions: Iterable[Region], step: float) -> SphereArcs:
    """Return the boundaries of regions, cut into arcs that turn by at most ``step`` radians."""
    pieces = []
    for arc in (arc for region in regions for arc in region.boundary):
        count = max(1, math.ceil(arc.sweep / step))
        points, _ = arc.at(arc.sweep * np.arange(1, count) / count)
        ends = [arc.start, *[(x, y, z) for x, y, z in points.tolist()], arc.end]
        pieces += [SphereArc(arc.axis, arc.angle, *pair) for pair in pairwise(ends)]
    return SphereArcs(pieces)


class RoundHole(NamedTuple):
    """A cylinder about a direction from the centre; radius in mm, less than the spheres'.

    The volume that it removes from a shell is in closed form, by c = sqrt(1 - (q/R)²), where it
    meets a sphere.
    """

    axis: Vector
    radius: float

    def angle(self, sphere: float) -> float:
        """Half the angle of the hole, seen from the centre, where it meets a sphere, radians."""
        return math.asin(min(1.0, self.radius / sphere))

    def volume(self, inner: float, outer: float) -> float:
        """Volume between two spheres, mm³."""
        return self._integrals(outer)[0] - self._integrals(inner)[0]

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
