"""Outlines of lines and arcs in the plane of a wheel that turns: their branches for ``stops``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.motion.plane_motion import turned_points
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.parts.turn.stops import CONCENTRIC, Branches, Stops, cut, masked, merged


class TurningStops(Stops):
    """Stops of one machine's wheel, which turns about the origin.

    ``outline`` is the wheel's, or one sector of it that repeats after ``pitch`` radians. The crank
    is in its own frame, with its axis at (L, 0). Of a branch, ``size`` is the curvature, and
    ``excess`` how much farther from the origin the centre is than the radius; of a line the
    distance of its foot.
    """

    def __init__(
        self, outline: Polyarc, pitch: float, crank: Polyarc | None, L: float, roller: float
    ) -> None:
        self.outline, self.pitch, self.crank, self.L = outline, pitch, crank, L
        self.roller = roller

    def wheel(self, inset: float) -> Branches:
        """Return the branches of the wheel, ``inset`` mm within its outline, in its own frame."""
        return self.branches(self.outline, np.zeros((1, 2)), np.zeros(1), inset)

    def rollers(self, centres: Array, inset: float) -> Branches:
        """Return the branches of rollers about n centres, in the fixed frame."""
        far, ahead = np.hypot(*centres.T), np.arctan2(centres[:, 1], centres[:, 0])
        radius = self.roller - inset
        excess, zero = far - radius, 0.0 * far
        ends = np.abs(excess), far + radius, np.where(excess < 0.0, np.pi, 0.0), zero
        row, bend = np.arange(len(far)), zero + 1.0 / radius
        return merged(
            Branches(row, *ends, bend, excess, ahead, zero + sign, zero) for sign in (1.0, -1.0)
        )

    def locking(self, crank: Array, inset: float) -> Iterator[tuple[Branches, Branches]]:
        """Yield the branches of the crank at n angles: its sides and its convex corners."""
        if self.crank is None:
            return
        origin = np.tile((self.L, 0.0), (len(crank), 1))
        corners = np.column_stack((self.crank.x0, self.crank.y0))[self.crank.turn_start > 0.0]
        points = origin[:, None] + rotated(corners, crank)
        row = np.repeat(np.arange(len(crank)), len(corners))
        yield (
            self.branches(self.crank, origin, crank, inset),
            self.points(row, points.reshape(-1, 2)),
        )

    def points(self, row: Whole, points: Array) -> Branches:
        """Return the branches of points (n, 2)."""
        level, zero = np.hypot(*points.T), np.zeros(len(points))
        ahead = np.arctan2(points[:, 1], points[:, 0])
        return Branches(row, level, level, zero, zero, zero, level, ahead, zero, zero)

    def branches(self, outline: Polyarc, origin: Array, angle: Array, inset: float) -> Branches:
        """Return the branches of an outline at n places (n, 2), turned by n angles.

        They are ``inset`` mm inside it. At convex corners they end where adjacent pieces meet.
        """
        axis = turned_points(-origin, -angle)
        side = outline.distances(axis[:, :1], axis[:, 1:]).side - inset
        towards = np.arctan2(outline.my, outline.mx) + angle[:, None]
        ends = inset_ends(outline, inset)
        seen = ends.points - axis[:, None]  # (2, n, k, 2)
        arcs = self._arcs(outline, axis, side, towards, ends, seen)
        return merged((*arcs, *self._lines(outline, side, towards, seen)))

    def _arcs(
        self, outline: Polyarc, axis: Array, side: Array, towards: Array, ends: Ends, seen: Array
    ) -> Iterator[Branches]:
        bent = np.flatnonzero(outline.arc)
        left, radius, zero = outline.sense[bent] > 0.0, ends.radius[bent], 0.0 * side[:, bent]
        x, y = outline.cx[bent] - axis[:, :1], outline.cy[bent] - axis[:, 1:]
        far, mx, my = np.hypot(x, y), outline.mx[bent], outline.my[bent]
        same = far < CONCENTRIC * radius
        excess, bend = np.where(left, -side[:, bent], side[:, bent]), zero + 1.0 / radius
        middle = np.arctan2(x * my - y * mx, x * mx + y * my)
        half = np.arctan2(outline.sin_half[bent], outline.cos_half[bent])
        at = zero + radius
        yield masked(same, at, at, zero, zero, bend, excess, towards[:, bent], zero, zero + half)
        px, py = seen[:, :, bent, 0], seen[:, :, bent, 1]
        known = np.stack((np.hypot(px, py), np.arctan2(np.abs(x * py - y * px), x * px + y * py)))
        least, most = np.abs(excess), far + radius
        extremes = np.array(((least, np.where(excess < 0.0, np.pi, 0.0)), (most, zero)))
        known = np.where(left, known, known[:, ::-1])
        trims = np.where(left, ends.trims[:, bent], ends.trims[::-1, bent]) / radius
        span = middle - half + trims[0], middle + half - trims[1]
        for there, low, high, sign in cut(*span, known, extremes):
            levels, angles = zip(low, high, strict=True)
            ahead = towards[:, bent] - middle
            yield masked(there & ~same, *levels, *angles, bend, excess, ahead, zero + sign, zero)

    def _lines(
        self, outline: Polyarc, side: Array, towards: Array, seen: Array
    ) -> Iterator[Branches]:
        flat = np.flatnonzero(~outline.arc)
        foot, zero, inside = np.abs(side[:, flat]), 0.0 * side[:, flat], side[:, flat] >= 0.0
        ahead = towards[:, flat] + np.where(inside, 0.0, np.pi)
        seen = seen[:, :, flat]
        along = outline.mx[flat] * seen[..., 1] - outline.my[flat] * seen[..., 0]
        along, level = np.where(inside, along, -along), np.hypot(seen[..., 0], seen[..., 1])
        for sign in (1.0, -1.0):
            near, far = np.sort(sign * along, axis=0)
            low = np.where(near > 0.0, level.min(axis=0), foot)
            high = np.where(sign * along[0] > sign * along[1], level[0], level[1])
            angles = np.arctan2(np.maximum(near, 0.0), foot), np.arctan2(far, foot)
            yield masked(far > 0.0, low, high, *angles, zero, foot, ahead, zero + sign, zero)

    def place(self, branch: Branches, level: Array) -> Array:
        """Return the places of branches at levels."""
        bend, excess = branch.size, branch.excess
        twice = 2.0 + bend * excess
        sine = (twice - bend * level) * (level - excess)
        cosine = (twice + bend * level) * (level + excess)
        angle = 2.0 * np.arctan2(np.sqrt(np.maximum(sine, 0.0)), np.sqrt(np.maximum(cosine, 0.0)))
        # near its nearest or farthest point a piece's level tells little of its place
        angle = np.where(level <= branch.low, branch.at_low, angle)
        return branch.ahead + branch.sign * np.where(level >= branch.high, branch.at_high, angle)

    def tangents(self, one: Branches, two: Branches) -> Iterator[Array]:
        """Yield the levels at which branches may be tangent."""
        p, q = (each.excess * (2.0 + each.size * each.excess) for each in (one, two))
        yield np.sqrt((p + q) / (one.size + two.size))
        yield np.sqrt((p - q) / (one.size - two.size))

    def lean(self, level: Array, pins: Array, close: float) -> Array:
        """Return the sine of the pressure angle where rollers touch, ``close`` mm inside them."""
        radius, square = self.roller - close, (pins * pins).sum(axis=-1)
        out = (level * level + radius * radius - square) / (2.0 * radius)  # along the normal
        lean: Array = (out + close) / np.sqrt(level * level + close * (2.0 * out + close))
        return lean


class Ends(NamedTuple):
    """Pieces inside an outline: both ends of each, how much shorter they are there, and radii."""

    points: Array  # (2, 1, k, 2)
    trims: Array  # (2, k), mm
    radius: Array


def inset_ends(outline: Polyarc, inset: float) -> Ends:
    """Return the ends of pieces ``inset`` mm inside an outline."""
    turns = np.array((outline.turn_start, outline.turn_end))
    trims = inset * np.tan(0.5 * np.clip(turns, 0.0, 3.0))
    sense = np.where(outline.sense < 0.0, -1.0, 1.0)
    nx, ny, c = sense * outline.mx, sense * outline.my, outline.cos_half
    points = []
    for way, x, y, trim in (
        (-1.0, outline.x0, outline.y0, trims[0]),
        (1.0, outline.x1, outline.y1, -trims[1]),
    ):
        s = way * sense * outline.sin_half
        ux, uy = c * nx - s * ny, s * nx + c * ny  # out of the material
        points.append(np.column_stack((x - inset * ux - trim * uy, y - inset * uy + trim * ux)))
    return Ends(np.array(points)[:, None], trims, outline.radius - outline.sense * inset)


def rotated(points: Array, angle: Array) -> Array:
    """Return points (k, 2), turned by n angles, (n, k, 2)."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y = points.T
    return np.stack((c * x - s * y, s * x + c * y), axis=-1)
