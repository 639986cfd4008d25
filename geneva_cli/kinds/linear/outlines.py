"""The rack and the crank of a linear Geneva, for the full turn of the crank."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.kinds.linear.rack import RackSizes, locking_sector, rack_contour
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.stops import Branches, Curve, Pieces, Stops, inset_ends
from geneva_cli.parts.turn.turned_parts import TurnedShape


class SlidingStops(Stops):
    """Stops of one machine's rack, which slides by L a radian.

    Levels are positions across the rack, x. Of an arc, ``size`` is the radius and ``excess`` the
    level of the centre. Of a line, ``size`` is 0 and ``excess`` is the slope.
    """

    def circle(self, centres: Array, radius: float) -> Curve:
        """Return the curves of circles about n centres."""
        x, y = centres.T
        return 0.0 * x + radius, x, y / self.moves.L

    def extremes(self, curve: Curve) -> Array:
        """Return levels of nearest and farthest points, at the place of the centre."""
        size, x, _ = curve
        levels = np.array((x - size, x + size))
        return np.array((levels, 0.0 * levels))

    def pieces(self, outline: Polyarc, angle: Array | None, inset: float) -> Pieces:
        """Return the pieces ``inset`` mm inside the rack, or inside the crank at n angles."""
        ends, sweep, radius = inset_ends(outline, inset)
        arc, seen = outline.arc, self.fixed((*ends, outline.centres), angle)
        *levels, x = (points[..., 0] for points in seen)
        *places, y = (points[..., 1] / self.moves.L for points in seen)
        run, rise = levels[1] - levels[0], places[1] - places[0]
        # lines along the travel have one level, up to their rounding
        level = ~arc & (np.abs(run) <= SAME_ANGLE * np.hypot(run, self.moves.L * rise))
        slope = rise / np.where(arc | level, 1.0, run)
        foot = np.where(level, 0.5 * (places[0] + places[1]), np.where(run > 0.0, *places))
        ahead = np.where(arc, y, foot)
        away = places - ahead
        known = np.array((levels, np.where(arc | level, np.abs(away), away)))
        first = np.arctan2(self.moves.L * (y - places[0]), x - levels[0])
        # a line has no nearest and no farthest point: it lies between them
        span = np.where(arc, (first, first + sweep), np.reshape((-2.0, -1.0), (2, 1, 1)))
        curve = np.where(arc, radius, 0.0 * run), np.where(arc, x, slope), ahead
        return known, span, curve, level

    def away(self, branch: Branches, level: Array) -> Array:
        """Return how far places of branches are from those of their centres, at levels inside."""
        off = level - branch.excess
        bow = np.sqrt(np.maximum((branch.size - off) * (branch.size + off), 0.0)) / self.moves.L
        return np.where(branch.size > 0.0, bow, (level - branch.low) * branch.excess)

    def tangents(self, one: Branches, two: Branches) -> tuple[Array, Array]:
        """Return the levels at which branches may be tangent."""
        both = (one.size > 0.0) & (two.size > 0.0)
        arc, line = one.size > 0.0, np.where(one.size > 0.0, two.excess, one.excess) * self.moves.L
        off = np.where(arc, one.size, two.size) * line / np.sqrt(1.0 + line * line)
        centre, p, q = np.where(arc, one.excess, two.excess), one.size, two.size
        same = (one.excess * q + two.excess * p) / (q + p)
        across = (one.excess * q - two.excess * p) / (q - p)
        return np.where(both, same, centre + off), np.where(both, across, centre - off)

    def lean(self, level: Array, side: Branches, close: float) -> Array:
        """Return the sine of the pressure angle where a round side touches."""
        return (level - side.excess) / side.size


class RackGaps(Gaps):
    """The gaps between rack, locking sector and roller; five slots are all that a turn reaches."""

    STOPS: ClassVar[type[Stops]] = SlidingStops

    def sector(self) -> tuple[float, Whole, float]:
        """Return the distance of slots over the radius, pieces of one, and places around it."""
        # a slot and the recess after it, whose pieces begin between two recesses
        radius, y = self.assembly.L, self.wheel.y0
        return 2.0, np.flatnonzero((y >= -radius) & (y < radius)), 3.5


def turned_rack(assembly: Assembly, sizes: RackSizes) -> TurnedShape:
    """Return rack and crank of known sizes."""
    sector = locking_sector(sizes)
    crank, rack = [sector] if sector else [], rack_contour(sizes, 5)
    return TurnedShape(assembly, sizes, crank, RackGaps(assembly, sizes, rack, crank))
