"""Arcs of circles on a unit sphere as arrays: distances of points as angles, and facing points."""

import math
from collections.abc import Iterable, Sequence
from itertools import combinations, pairwise
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.sphere import Region, SphereArc, Vector, opposite
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.numerics.tolerances import SAME_ANGLE

# Fractions of an arc at which it is sampled: its start and middle, and points next to its corners.
# A corner itself may lie on an edge where all else overlaps.
ARC_SAMPLES = (0.0, 1e-6, 0.5, 1.0 - 1e-6)


class SphereArcs:
    """Boundaries of arcs, each from the end of the one before; the region is to their left.

    Lengths are arcs on a sphere of a ``radius``. A boundary that is not closed is a part of one,
    and continues smoothly at its ends.
    """

    def __init__(
        self, *boundaries: Sequence[SphereArc], radius: float = 1.0, closed: bool = True
    ) -> None:
        arcs, after = list[SphereArc](), list[int]()
        for boundary in boundaries:
            after += [*range(len(arcs) + 1, len(arcs) + len(boundary)), len(arcs)]
            arcs += boundary
        self.radius, self.axis = radius, np.array([arc.axis for arc in arcs])
        self.x = np.array([arc.frame[0] for arc in arcs])
        self.y = np.cross(self.axis, self.x)
        self.angle = np.array([arc.angle for arc in arcs])
        self.sweep = np.array([arc.sweep for arc in arcs])
        self.starts = np.array([arc.start for arc in arcs])
        every = np.arange(len(arcs))
        self.middles = self.at(every, 0.5 * self.sweep)
        # if a boundary lies in another one, so do some of these points
        self.probes = np.concatenate([self.at(every, part * self.sweep) for part in ARC_SAMPLES])
        axes = {max(axis, opposite(axis)) for axis in (arc.axis for arc in arcs)}
        self.centres = np.array(sorted(axes))  # opposite ones once
        half = np.sin(self.angle) * np.sin(0.25 * self.sweep)
        self.size = 2.0 * radius * np.arcsin(np.minimum(half, 1.0))  # from its middle to its ends
        # left turn of the boundary after each arc, and before it; 0 for none
        end = self.starts[after]
        back, on = np.cross(self.axis, end), np.cross(self.axis[after], end)
        turn = np.arctan2((np.cross(back, on) * end).sum(axis=1), (back * on).sum(axis=1))
        self.turn_end = np.where(np.abs(turn) > SAME_ANGLE, turn, 0.0)
        self.turn_end[-1] *= closed
        self.turn_start = np.empty(len(arcs))
        self.turn_start[after] = self.turn_end

    def __len__(self) -> int:
        return len(self.angle)

    def at(self, which: Whole, turn: Array, inset: float = 0.0) -> Array:
        """Points of some arcs, (n, 3), at angles about their axes from their starts.

        They are ``inset`` radians nearer to the axes.
        """
        c, s, angle = np.cos(turn)[:, None], np.sin(turn)[:, None], self.angle[which, None] - inset
        ahead = c * self.x[which] + s * self.y[which]
        return np.cos(angle) * self.axis[which] + np.sin(angle) * ahead

    def signed(self, points: Array) -> Array:
        """Distances of points (n, 3) from the boundary, negative inside."""
        off, past, short, away = self._nearest(points)
        near, row = np.argmin(away, axis=1), np.arange(len(points))
        past, short, away = (each[row, near] for each in (past, short, away))
        corner = np.where(short < past, self.turn_start[near], self.turn_end[near])
        is_corner = (past > 0.0) & (corner != 0.0)
        outside = np.where(is_corner, corner > 0.0, off[row, near] > 0.0)
        return self.radius * np.where(outside, away, -away)

    def farthest(self, points: Array) -> Array:
        """Distances of points (n, 3) from the farthest point of each arc, (n, k)."""
        return self.radius * (math.pi - self._nearest(-points)[-1])

    def _nearest(self, points: Array) -> tuple[Array, Array, Array, Array]:
        """Angles off circles, past the arcs' ends, short of their starts; to the nearest points."""
        along, sideways = points @ self.x.T, points @ self.y.T
        across = np.hypot(along, sideways)
        off = np.arctan2(across, points @ self.axis.T) - self.angle
        turn = np.remainder(np.arctan2(sideways, along), 2.0 * np.pi)
        past, short = turn - self.sweep, 2.0 * np.pi - turn
        beyond = np.where(past <= 0.0, 0.0, np.minimum(past, short))
        square = np.sin(0.5 * off) ** 2 + np.sin(self.angle) * across * np.sin(0.5 * beyond) ** 2
        return off, past, short, 2.0 * np.arcsin(np.sqrt(np.minimum(square, 1.0)))

    def touching(self, which: Whole, towards: Array) -> tuple[Whole, Array]:
        """Return the points of some arcs (m,) where others may touch, after their indices.

        They are samples, and points that face directions (m, j, 3), or away from them.
        """
        along, sideways = ((towards * v[which, None]).sum(axis=-1) for v in (self.x, self.y))
        turn = np.arctan2(sideways, along) + np.array((0.0, np.pi))[:, None, None]
        turn = np.remainder(turn, 2.0 * np.pi)
        on = np.nonzero(turn <= self.sweep[which, None])
        points = [self.at(which, share * self.sweep[which]) for share in ARC_SAMPLES]
        rows = np.tile(np.arange(len(which)), len(points))
        facing = self.at(which[on[1]], turn[on])
        return np.concatenate((rows, on[1])), np.concatenate((*points, facing))


def polar(points: Array) -> Array:
    """Return the angles of directions (..., 3) from z."""
    return np.arctan2(np.hypot(points[..., 0], points[..., 1]), points[..., 2])


def azimuth(points: Array) -> Array:
    """Return the angles of directions (..., 3) about z, from x."""
    return np.arctan2(points[..., 1], points[..., 0])


def short_arcs(regions: Iterable[Region], step: float, radius: float) -> SphereArcs:
    """Return the boundaries of regions, cut into arcs that turn by at most ``step`` radians."""
    pieces = []
    for arc in (arc for region in regions for arc in region.boundary):
        count = max(1, math.ceil(arc.sweep / step))
        points, _ = arc.at(arc.sweep * np.arange(1, count) / count)
        ends = [arc.start, *[(x, y, z) for x, y, z in points.tolist()], arc.end]
        pieces += [SphereArc(arc.axis, arc.angle, *pair) for pair in pairwise(ends)]
    return SphereArcs(pieces, radius=radius)


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

    def inertia(self, inner: float, outer: float) -> float:
        """The volume's moment of inertia about z, mm⁵."""
        (_, far, up), (_, less, below) = self._integrals(outer), self._integrals(inner)
        own, along, square = far - less, up - below, self.axis[2] ** 2
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
