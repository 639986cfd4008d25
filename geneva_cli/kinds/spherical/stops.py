"""Outlines of circles' arcs on the sphere of a wheel that turns about z: branches for ``stops``.

The region to the left of an arc lies in a cap about the arc's axis. A hollow is the rim of a cap of
more than half the sphere.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from geneva_cli.geometry.sphere_arcs import SphereArcs
from geneva_cli.numerics.arrays import Array, within_half_turn
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.turn.stops import CONCENTRIC, Branches, Stops, cut, masked, merged

Placed = Callable[[Array], Array]


class SphereStops(Stops):
    """Stops of one machine's wheel on a sphere, whose ``edge`` repeats after ``pitch`` radians.

    Levels are angles from z. Of a branch, ``size`` is the angle of its cap, and ``excess`` that of
    the cap's axis from z. ``out`` transforms directions (k, 3) of the crank's frame to the fixed
    one at n angles of the crank: (n, k, 3). A ``roller`` is a cap of this angle.
    """

    def __init__(
        self,
        edge: SphereArcs,
        pitch: float,
        crank: Sequence[SphereArcs],
        out: Callable[[Array, Array], Array],
        roller: float,
    ) -> None:
        self.edge, self.pitch, self.sectors, self.out = edge, pitch, crank, out
        self.roller = roller

    def wheel(self, inset: float) -> Branches:
        """Return the branches of the wheel, ``inset`` radians within its edge."""
        return _branches(self.edge, inset, lambda points: points[None])

    def rollers(self, centres: Array, inset: float) -> Branches:
        """Return the branches of rollers about n centres, directions (n, 3)."""
        far, ahead, zero = polar(centres), azimuth(centres), np.zeros(len(centres))
        cap = zero + self.roller - inset, far, ahead
        (low, at_low), (high, at_high) = _extremes(far, cap[0])
        ends, row = (low, high, at_low, at_high), np.arange(len(centres))
        return merged(Branches(row, *ends, *cap, zero + sign, zero) for sign in (1.0, -1.0))

    def locking(self, crank: Array, inset: float) -> Iterator[tuple[Branches, Branches]]:
        """Yield the branches of each sector at n angles of the crank: sides and convex corners."""
        for sector in self.sectors:
            points = self.out(sector.start[sector.first > SAME_ANGLE], crank)
            row = np.repeat(np.arange(len(crank)), points.shape[1])
            level, at = polar(points).ravel(), azimuth(points).ravel()
            zero = np.zeros(len(row))
            yield (
                _branches(sector, inset, lambda points: self.out(points, crank)),
                Branches(row, level, level, zero, zero, zero, level, at, zero, zero),
            )

    def place(self, branch: Branches, level: Array) -> Array:
        """Return the places of branches at levels: azimuths."""
        size, far = branch.size, branch.excess
        sine = np.sin(0.5 * (size - level + far)) * np.sin(0.5 * (size + level - far))
        cosine = np.sin(0.5 * (level + far - size)) * np.sin(0.5 * (level + far + size))
        angle = 2.0 * np.arctan2(np.sqrt(np.maximum(sine, 0.0)), np.sqrt(np.maximum(cosine, 0.0)))
        angle = np.where(level <= branch.low, branch.at_low, angle)
        return branch.ahead + branch.sign * np.where(level >= branch.high, branch.at_high, angle)

    def tangents(self, one: Branches, two: Branches) -> Iterator[Array]:
        """Yield the levels at which branches may be tangent."""
        p, q = np.cos(one.excess) * np.sin(two.size), np.cos(two.excess) * np.sin(one.size)
        yield np.arccos((p + q) / np.sin(two.size + one.size))
        yield np.arccos((p - q) / np.sin(two.size - one.size))

    def lean(self, level: Array, pins: Array, close: float) -> Array:
        """Return the sine of the pressure angle where rollers touch, ``close`` inside them."""
        radius, far = self.roller - close, polar(pins)
        lean: Array = np.cos(far) - np.cos(radius) * np.cos(level)
        return lean / (np.sin(radius) * np.sin(level))


def _branches(arcs: SphereArcs, inset: float, placed: Placed) -> Branches:
    """Return the branches of a boundary, ``inset`` radians inside it, ``placed`` at n angles."""
    trims = inset * np.tan(0.5 * np.clip((arcs.first, arcs.last), 0.0, 3.0)) / np.sin(arcs.angle)
    size = arcs.angle - inset
    axis, x, y = (placed(each) for each in (arcs.axis, arcs.x, arcs.y))
    far, ahead = polar(axis), azimuth(axis)
    start = np.arctan2(y[..., 2], -x[..., 2]) + trims[0]
    sweep, zero = arcs.sweep - trims.sum(axis=0), 0.0 * far
    same = np.sin(far) < CONCENTRIC
    at = np.abs(far - size)
    middle = azimuth(_point(axis, x, y, size, trims[0] + 0.5 * sweep))
    parts = [masked(same, at, at, zero, zero, zero + size, far, middle, zero, zero + 0.5 * sweep)]
    known = []
    for turn in (trims[0], trims[0] + sweep):
        point = _point(axis, x, y, size, turn)
        off = within_half_turn(azimuth(point) - ahead)
        known.append((polar(point), np.abs(off)))
    levels = np.array(known).swapaxes(0, 1)
    for there, low, high, sign in cut(start, start + sweep, levels, _extremes(far, size)):
        (a, b), (at_a, at_b) = zip(low, high, strict=True)
        cap = zero + size, far, ahead, zero + sign
        parts.append(masked(there & ~same, a, b, at_a, at_b, *cap, zero))
    return merged(parts)


def _extremes(far: Array, size: Array) -> Array:
    """Return level and angle from the axis' azimuth of the nearest and farthest points of rims."""
    least, most, zero = far - size, far + size, 0.0 * far
    over = most > np.pi
    return np.array(
        (
            (np.abs(least), np.where(least < 0.0, np.pi, zero)),
            (np.where(over, 2.0 * np.pi - most, most), np.where(over, np.pi, zero)),
        )
    )


def _point(axis: Array, x: Array, y: Array, size: Array, turn: Array) -> Array:
    """Return the points of rims (n, k, 3) at angles about their axes."""
    flat = np.sin(size)
    c, s = (flat * np.cos(turn))[:, None], (flat * np.sin(turn))[:, None]
    point: Array = np.cos(size)[:, None] * axis + c * x + s * y
    return point


def polar(points: Array) -> Array:
    """Return the angles of directions (..., 3) from z."""
    return np.arctan2(np.hypot(points[..., 0], points[..., 1]), points[..., 2])


def azimuth(points: Array) -> Array:
    """Return the angles of directions (..., 3) about z, from x."""
    return np.arctan2(points[..., 1], points[..., 0])


def about(points: Array, angle: Array) -> Array:
    """Return directions (n, 3), each turned about z by its own angle, radians."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = points.T
    out = np.empty(points.shape)
    out[:, 0], out[:, 1], out[:, 2] = x * c - y * s, x * s + y * c, z
    return out
