"""Outlines of lines and arcs beside a rack that slides along y: their branches for ``stops``."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.turn.stops import Branches, cut, masked, merged
from geneva_cli.parts.turn.turning_stops import TurningStops, inset_ends, rotated


class SlidingStops(TurningStops):
    """Stops of one machine's rack, which slides by L a radian.

    Levels are positions across the rack, x. Of an arc, ``size`` is the radius and ``excess`` the
    level of the centre. Of a line, ``size`` is 0 and ``excess`` is the slope.
    """

    def rollers(self, centres: Array, inset: float) -> Branches:
        """Return the branches of rollers about n centres, in the fixed frame."""
        (x, y), radius, row = centres.T, self.roller - inset, np.arange(len(centres))
        zero = 0.0 * x
        arc = x - radius, x + radius, zero, zero, zero + radius, x, y / self.L
        return merged(Branches(row, *arc, zero + sign, zero) for sign in (1.0, -1.0))

    def points(self, row: Whole, points: Array) -> Branches:
        """Return the branches of points (n, 2)."""
        (x, y), zero = points.T, np.zeros(len(points))
        return Branches(row, x, x, zero, zero, zero, zero, y / self.L, zero, zero)

    def branches(self, outline: Polyarc, origin: Array, angle: Array, inset: float) -> Branches:
        """Return the branches of an outline at n places (n, 2), turned by n angles."""
        ends = inset_ends(outline, inset)
        points = np.array([origin[:, None] + rotated(each[0], angle) for each in ends.points])
        x, y = np.moveaxis(points, -1, 0)  # (2, n, k)
        bent, flat = np.flatnonzero(outline.arc), np.flatnonzero(~outline.arc)
        left, radius = outline.sense[bent] > 0.0, ends.radius[bent]
        centre = np.column_stack((outline.cx, outline.cy))[bent]
        cx, cy = np.moveaxis(origin[:, None] + rotated(centre, angle), -1, 0)
        zero = 0.0 * cx
        known = np.stack((x[..., bent], np.abs(y[..., bent] - cy) / self.L))
        known = np.where(left, known, known[:, ::-1])
        extremes = np.array(((cx - radius, zero), (cx + radius, zero)))
        trims = np.where(left, ends.trims[:, bent], ends.trims[::-1, bent]) / radius
        towards = np.arctan2(outline.my, outline.mx)[bent] + angle[:, None]
        middle = np.remainder(towards + np.pi, 2.0 * np.pi) - np.pi
        half = np.arctan2(outline.sin_half[bent], outline.cos_half[bent])
        span = middle - half + trims[0], middle + half - trims[1]
        parts = []
        for there, low, high, sign in cut(*span, known, extremes):
            levels, places = zip(low, high, strict=True)
            arc = zero + radius, cx, cy / self.L
            parts.append(masked(there, *levels, *places, *arc, zero + sign, zero))
        x, y = x[..., flat], y[..., flat] / self.L
        rise, run = y[1] - y[0], x[1] - x[0]
        # lines along the travel have one level, up to their rounding
        across = np.abs(run) > SAME_ANGLE * np.hypot(run, self.L * rise)
        start, zero = np.where(run > 0.0, y[0], y[1]), 0.0 * run
        slope = rise / np.where(across, run, 1.0)
        line = np.minimum(*x), np.maximum(*x), zero, slope * np.abs(run), zero, slope, start
        parts.append(masked(across, *line, zero + 1.0, zero))
        line = x[0], x[0], zero, zero, zero, zero, 0.5 * (y[0] + y[1])
        parts.append(masked(~across, *line, zero, 0.5 * np.abs(rise)))
        return merged(parts)

    def place(self, branch: Branches, level: Array) -> Array:
        """Return the places of branches at levels."""
        off = level - branch.excess
        bow = np.sqrt(np.maximum((branch.size - off) * (branch.size + off), 0.0)) / self.L
        away = np.where(branch.size > 0.0, bow, (level - branch.low) * branch.excess)
        away = np.where(level <= branch.low, branch.at_low, away)
        return branch.ahead + branch.sign * np.where(level >= branch.high, branch.at_high, away)

    def tangents(self, one: Branches, two: Branches) -> Iterator[Array]:
        """Yield the levels at which branches may be tangent."""
        both = (one.size > 0.0) & (two.size > 0.0)
        arc, line = one.size > 0.0, np.where(one.size > 0.0, two.excess, one.excess) * self.L
        off = np.where(arc, one.size, two.size) * line / np.sqrt(1.0 + line * line)
        for way in (1.0, -1.0):
            arcs = one.excess * two.size + way * two.excess * one.size
            beside = np.where(arc, one.excess, two.excess) + way * off
            yield np.where(both, arcs / (two.size + way * one.size), beside)

    def lean(self, level: Array, pins: Array, close: float) -> Array:
        """Return the sine of the pressure angle where rollers touch, ``close`` mm inside them."""
        lean: Array = (level - pins[..., 0]) / (self.roller - close)
        return lean
