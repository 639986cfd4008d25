"""The rack and the crank of a linear Geneva, for the full turn of the crank."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.shapes import Contour
from geneva_cli.kept import cached_property
from geneva_cli.kinds.linear.rack import RackSizes, locking_sector, rack_contour
from geneva_cli.kinds.linear.sliding_stops import SlidingStops
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.pairs import Pose
from geneva_cli.parts.turn.stops import Stops


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

    def locking(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """Return the gap between the outlines of crank and rack, mm (n,); see ``Gaps``.

        In the middle of a dwell the ring ends at the rack's edge. Then all corners of an overlap
        lie on both outlines, and its deepest point is elsewhere on a recess.
        """
        gap = super().locking(pose, lead, near)
        meets = np.flatnonzero(gap <= SAME_LENGTH * self.assembly.L)
        if self.crank is not None and len(meets):
            turn = np.broadcast_to(pose.wheel + lead, gap.shape)[meets]
            gap[meets] = np.minimum(gap[meets], -self._depth(self._axis(turn), pose.crank[meets]))
        return gap

    def _depth(self, axis: Array, crank: Array) -> Array:
        """Return how deep recesses lie in the ring next to its ends, at most, mm (n,).

        ``axis`` is the ring's centre in the rack's frame, ``crank`` its angle. A point is as deep
        as it is from the nearer of the ring's outside and its end: the deepest, from both.
        """
        size, recesses = self.sizes, np.flatnonzero(self.wheel.radius == self.sizes.recess)
        cx, cy = self.wheel.cx[recesses][:, None, None], self.wheel.cy[recesses][:, None, None]
        ax, ay = axis.T
        c, s = np.cos(crank), np.sin(crank)
        ends = np.array((1.0, -1.0))[:, None] * size.lock  # the ring's outer corners, along y
        angle = np.arctan2(ay + ends * c - cy, ax - ends * s - cx)  # (recesses, 2, n)
        for _ in range(6):  # Newton: from a start this near two steps reach rounding
            ux, uy = np.cos(angle), np.sin(angle)
            x, y = cx + size.recess * ux - ax, cy + size.recess * uy - ay
            far = np.hypot(x, y)
            value = far - size.lock - (x * c + y * s)
            slope = size.recess * ((uy * c - ux * s) + (y * ux - x * uy) / far)
            angle = angle - value / slope
        depth = np.minimum(size.lock - far, far - size.floor)
        on_rack = x + ax <= size.edge
        deep = np.where(on_rack, np.maximum(depth, 0.0), 0.0)
        out: Array = deep.max(axis=(0, 1), initial=0.0)  # without a recess 0
        return out

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
