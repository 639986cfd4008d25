"""Outlines of circles' arcs on the sphere of a wheel that turns about z: branches for ``stops``.

The region to the left of an arc lies in a cap about the arc's axis. A hollow is the rim of a cap of
more than half the sphere.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from geneva_cli.geometry.sphere_arcs import SphereArcs
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.numerics.arrays import Array, within_half_turn
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.turn.stops import CONCENTRIC, Branches, Pose, Stops, cut, masked

Out: TypeAlias = Callable[[Array, Array], Array]


class SphereStops(Stops):
    """Stops of one machine's wheel on a sphere, by the ``edge`` of one of its equal slots.

    Levels are angles from z. Of a branch, ``size`` is the angle of its cap, and ``excess`` that of
    the cap's axis from z. ``out`` transforms directions (k, 3) of the crank's frame to the fixed
    one at n angles of the crank: (n, k, 3). A roller is a cap.
    """

    def __init__(self, edge: SphereArcs, crank: list[SphereArcs], out: Out, ball: Ball) -> None:
        super().__init__(edge, 2.0 * ball.half_step, crank, ball.radius_mm, ball.roller)
        self.out = out

    def first(self, pose: Pose, most: float, close: float) -> tuple[Array, Array]:
        """Return the stops as on a plane, of parts that may overlap by ``close`` mm."""
        return super().first(pose, most, close / self.L)

    def rollers(self, centres: Array, inset: float) -> Array:
        """Return rollers about n centres, directions (n, 3), as branches on one side of them."""
        far, ahead, zero = polar(centres), azimuth(centres), np.zeros(len(centres))
        cap = zero + self.roller - inset, far, ahead
        (low, at_low), (high, at_high) = _extremes(far, cap[0])
        row = np.arange(len(centres))
        return np.array((row, low, high, at_low, at_high, *cap, zero + 1.0, zero))

    def corners(self, outline: SphereArcs, pose: Pose) -> Array:
        """Return the convex corners of a sector in n poses, as branches of one level."""
        points = self.out(outline.start[outline.first > SAME_ANGLE], pose.crank)
        row = np.repeat(np.arange(len(pose.crank)), points.shape[1])
        level, at, zero = polar(points).ravel(), azimuth(points).ravel(), np.zeros(len(row))
        return np.array((row, level, level, zero, zero, zero, level, at, zero, zero))

    def branches(self, outline: SphereArcs, angle: Array | None, inset: float) -> Array:
        """Return the branches ``inset`` radians inside the edge, or a sector at n angles."""
        trims = inset * np.tan(0.5 * np.clip((outline.first, outline.last), 0.0, 3.0))
        trims, size = trims / np.sin(outline.angle), outline.angle - inset
        axis, x, y = outline.axis[None], outline.x[None], outline.y[None]
        if angle is not None:
            axis, x, y = self.out(axis[0], angle), self.out(x[0], angle), self.out(y[0], angle)
        far, ahead = polar(axis), azimuth(axis)
        start = np.arctan2(y[..., 2], -x[..., 2]) + trims[0]
        sweep, zero = outline.sweep - trims.sum(axis=0), 0.0 * far
        same = np.sin(far) < CONCENTRIC
        at, cap = np.abs(far - size), (zero + size, far, ahead)
        middle = azimuth(_point(axis, x, y, size, trims[0] + 0.5 * sweep))
        round_ = at, at, zero, zero, zero + size, far, middle, zero, zero + 0.5 * sweep
        known = []
        for turn in (trims[0], trims[0] + sweep):
            point = _point(axis, x, y, size, turn)
            off = within_half_turn(azimuth(point) - ahead)
            known.append((polar(point), np.abs(off)))
        levels = np.array(known).swapaxes(0, 1)
        parts = cut(~same, (start, start + sweep), levels, _extremes(far, size), cap)
        return np.concatenate((masked(same, *round_), *parts), axis=1)

    def away(self, branch: Branches, level: Array) -> Array:
        """Return how far azimuths of branches are from those of their caps, at levels inside."""
        size, far = branch.size, branch.excess
        sine = np.sin(0.5 * (size - level + far)) * np.sin(0.5 * (size + level - far))
        cosine = np.sin(0.5 * (level + far - size)) * np.sin(0.5 * (level + far + size))
        return 2.0 * np.arctan2(np.sqrt(np.maximum(sine, 0.0)), np.sqrt(np.maximum(cosine, 0.0)))

    def tangents(self, one: Branches, two: Branches) -> tuple[Array, Array]:
        """Return the levels at which branches may be tangent."""
        p, q = np.cos(one.excess) * np.sin(two.size), np.cos(two.excess) * np.sin(one.size)
        both = np.arccos((p + q) / np.sin(two.size + one.size))
        return both, np.arccos((p - q) / np.sin(two.size - one.size))

    def lean(self, level: Array, pins: Array, close: float) -> Array:
        """Return the sine of the pressure angle where rollers touch, ``close`` inside them."""
        radius, far = self.roller - close, polar(pins)
        return (np.cos(far) - np.cos(radius) * np.cos(level)) / (np.sin(radius) * np.sin(level))


def _extremes(far: Array, size: Array) -> Array:
    """Return level and angle from the axis' azimuth of the nearest and farthest points of rims."""
    least, most, zero = far - size, far + size, 0.0 * far
    over = most > np.pi
    nearest = np.abs(least), np.where(least < 0.0, np.pi, zero)
    return np.array((nearest, (np.where(over, 2.0 * np.pi - most, most), np.pi * over)))


def _point(axis: Array, x: Array, y: Array, size: Array, turn: Array) -> Array:
    """Return the points of rims (n, k, 3) at angles about their axes."""
    flat = np.sin(size)
    c, s = (flat * np.cos(turn))[:, None], (flat * np.sin(turn))[:, None]
    return np.cos(size)[:, None] * axis + c * x + s * y


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
