"""The rack and the crank of a linear Geneva, for the full turn of the crank."""

from __future__ import annotations

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.shapes import Contour
from geneva_cli.kinds.linear.rack import RackSizes, locking_sector, rack_contour
from geneva_cli.numerics.arrays import Array, within_half_turn
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.stops import Branches, Pose, Stops, cut, inset_ends, masked
from geneva_cli.parts.turn.turned_parts import TurnedShape


class SlidingStops(Stops):
    """Stops of one machine's rack, which slides by L a radian.

    Levels are positions across the rack, x. Of an arc, ``size`` is the radius and ``excess`` the
    level of the centre. Of a line, ``size`` is 0 and ``excess`` is the slope.
    """

    def rollers(self, centres: Array, inset: float) -> Array:
        """Return rollers about n centres in the fixed frame, as branches on one side of them."""
        (x, y), radius, row = centres.T, self.roller - inset, np.arange(len(centres))
        zero = 0.0 * x
        arc = x - radius, x + radius, zero, zero, zero + radius, x, y / self.L
        return np.array((row, *arc, zero + 1.0, zero))

    def corners(self, outline: Polyarc, pose: Pose) -> Array:
        """Return the convex corners of the crank in n poses, as branches of one level."""
        corners = np.column_stack((outline.x0, outline.y0))[outline.turn_start > 0.0]
        x, y = rotated(corners, pose.crank)
        row, zero = np.repeat(np.arange(len(x)), len(corners)), np.zeros(x.size)
        level, at = self.L + x.ravel(), y.ravel() / self.L
        return np.array((row, level, level, zero, zero, zero, zero, at, zero, zero))

    def branches(self, outline: Polyarc, angle: Array | None, inset: float) -> Array:
        """Return the branches ``inset`` mm inside the rack, or inside the crank at n angles."""
        axis, turn = (0.0, np.zeros(1)) if angle is None else (self.L, angle)
        ends, trims, radii = inset_ends(outline, inset)
        (x0, y0), (x1, y1) = rotated(ends[0, 0], turn), rotated(ends[1, 0], turn)
        x, y = axis + np.array((x0, x1)), np.array((y0, y1))  # (2, n, k)
        bent, flat = np.flatnonzero(outline.arc), np.flatnonzero(~outline.arc)
        left, radius = outline.sense[bent] > 0.0, radii[bent]
        cx, cy = rotated(np.column_stack((outline.cx, outline.cy))[bent], turn)
        cx, zero = axis + cx, 0.0 * cx
        known = np.stack((x[..., bent], np.abs(y[..., bent] - cy) / self.L))
        known = np.where(left, known, known[:, ::-1])
        extremes = np.array(((cx - radius, zero), (cx + radius, zero)))
        trim = np.where(left, trims[:, bent], trims[::-1, bent]) / radius
        towards = np.arctan2(outline.my, outline.mx)[bent] + turn[:, None]
        middle = within_half_turn(towards)
        half = np.arctan2(outline.sin_half[bent], outline.cos_half[bent])
        span = middle - half + trim[0], middle + half - trim[1]
        curve = zero + radius, cx, cy / self.L
        parts = cut(np.ones(cx.shape, dtype=bool), span, known, extremes, curve)
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
        return np.concatenate(parts, axis=1)

    def away(self, branch: Branches, level: Array) -> Array:
        """Return how far places of branches are from those of their centres, at levels inside."""
        off = level - branch.excess
        bow = np.sqrt(np.maximum((branch.size - off) * (branch.size + off), 0.0)) / self.L
        return np.where(branch.size > 0.0, bow, (level - branch.low) * branch.excess)

    def tangents(self, one: Branches, two: Branches) -> tuple[Array, Array]:
        """Return the levels at which branches may be tangent."""
        both = (one.size > 0.0) & (two.size > 0.0)
        arc, line = one.size > 0.0, np.where(one.size > 0.0, two.excess, one.excess) * self.L
        off = np.where(arc, one.size, two.size) * line / np.sqrt(1.0 + line * line)
        centre, p, q = np.where(arc, one.excess, two.excess), one.size, two.size
        same = (one.excess * q + two.excess * p) / (q + p)
        across = (one.excess * q - two.excess * p) / (q - p)
        return np.where(both, same, centre + off), np.where(both, across, centre - off)

    def lean(self, level: Array, pins: Array, close: float) -> Array:
        """Return the sine of the pressure angle where rollers touch, ``close`` mm inside them."""
        return (level - pins[..., 0]) / (self.roller - close)


class RackGaps(Gaps):
    """The gaps between rack, locking sector and roller; five slots are all that a turn reaches."""

    sizes: RackSizes

    def __init__(
        self, assembly: Assembly, sizes: RackSizes, wheel: Contour, crank: list[Contour]
    ) -> None:
        super().__init__(assembly, sizes, wheel, crank)
        # one slot and its neighbours, which are two radii apart
        self.pitch, radius, rack = 2.0, assembly.L, self.wheel
        self.around = rack.subset(np.flatnonzero(np.abs(rack.oy) <= 3.5 * radius))
        # a slot and the recess after it, whose pieces begin between two recesses
        self.one = rack.subset(np.flatnonzero((rack.y0 >= -radius) & (rack.y0 < radius)))
        self.stops = SlidingStops(self.one, self.pitch, self.stops.crank, radius, sizes.roller)


def turned_rack(assembly: Assembly, sizes: RackSizes) -> TurnedShape:
    """Return rack and crank of known sizes."""
    sector = locking_sector(sizes)
    crank, rack = [sector] if sector else [], rack_contour(sizes, 5)
    return TurnedShape(assembly, sizes, crank, RackGaps(assembly, sizes, rack, crank))


def rotated(points: Array, angle: Array) -> tuple[Array, Array]:
    """Return points (k, 2), turned by n angles: x and y, (n, k) both."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y = points.T
    return c * x - s * y, s * x + c * y
