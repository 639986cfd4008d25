"""The rack and the crank of a linear Geneva, for the full turn of the crank."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.shapes import Contour
from geneva_cli.kept import cached_property
from geneva_cli.kinds.linear.rack import RackSizes, locking_sector, rack_contour
from geneva_cli.numerics.arrays import Array, Whole, within_half_turn
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.stops import (
    Branches,
    Stops,
    TurningStops,
    cut,
    inset_ends,
    masked,
    merged,
    rotated,
)


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
        middle = within_half_turn(towards)
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


class RackGaps(Gaps):
    """The gaps between rack, locking sector and roller at any positions.

    The rack has five slots: no part reaches more in one turn, even if the rack is half a step off.
    A rack has its recesses up to both ends, so that its ends come no nearer to the crank.
    """

    sizes: RackSizes

    def _sector(self) -> None:
        """Reduce the rack to one slot and its neighbours; the slots are two radii apart."""
        self.pitch, radius = 2.0, self.assembly.L
        self.around = self.wheel.subset(np.flatnonzero(np.abs(self.wheel.oy) <= 3.5 * radius))

    @cached_property
    def _stops(self) -> Stops:
        """Stops of a slot and the recess after it, whose pieces begin between two recesses."""
        radius, start = self.assembly.L, self.wheel.y0
        one = self.wheel.subset(np.flatnonzero((start >= -radius) & (start < radius)))
        return SlidingStops(one, self.pitch, self.crank, radius, self.sizes.roller)


class RackOutlines(NamedTuple):
    """Rack and crank, and the gaps between them."""

    assembly: Assembly
    sizes: RackSizes
    crank: list[Contour]
    gaps: RackGaps


def turned_rack(assembly: Assembly, sizes: RackSizes) -> RackOutlines:
    """Return rack and crank of known sizes."""
    sector = locking_sector(sizes)
    crank, rack = [sector] if sector else [], rack_contour(sizes, 5)
    return RackOutlines(assembly, sizes, crank, RackGaps(assembly, sizes, rack, crank))
