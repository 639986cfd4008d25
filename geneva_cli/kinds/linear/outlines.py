"""The rack and the crank of a linear Geneva, for the full turn of the crank."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.shapes import Contour
from geneva_cli.kept import cached_property
from geneva_cli.kinds.linear.rack import RackSizes, locking_sector, rack_contour, rack_sizes
from geneva_cli.kinds.linear.sliding_stops import SlidingStops
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly, assembled
from geneva_cli.parts.outlines.outlines import CONTACT
from geneva_cli.parts.turn.bounds import FlatPairs
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.stops import Stops


class RackGaps(Gaps):
    """The gaps between rack, locking sector and roller at any positions.

    The rack has five slots: no part reaches more in one turn, even if the rack is half a step off.
    A rack has its recesses up to both ends, so that its ends come no nearer to the crank.
    """

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

    @property
    def close(self) -> float:
        """The overlap, mm, that counts as rounding."""
        return SAME_LENGTH * self.assembly.L

    @property
    def contact(self) -> float:
        """The overlap, mm, up to which parts count as touching."""
        return CONTACT * self.assembly.L

    def over(self, assembly: Assembly) -> RackOutlines:
        """Return these parts with another assembly."""
        return self._replace(assembly=assembly)

    def in_wheel(self, motion: int, at: Array, lead: Array | float = 0.0) -> Array:
        """Return the roller's centre in the rack's frame, mm, at input angles (n,): (n, 2).

        The rack is pushed on by ``lead`` radians of its pinion.
        """
        return self.assembly.in_wheel(motion, at, lead)

    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far the roller is in its slot, beyond the rack's edge, mm, (n,)."""
        return self.sizes.edge - self.assembly.driving(motion, at)[:, 0]

    def pairs(self, target: float) -> FlatPairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""
        return FlatPairs(self.gaps, self.crank, target, self.sizes.edge)


def rack_outlines(mechanism: Mechanism) -> RackOutlines:
    """Return rack and crank of a machine. Raises GenevaError, naming the key, if no sizes fit."""
    return turned_rack(assembled(mechanism), rack_sizes(mechanism))


def turned_rack(assembly: Assembly, sizes: RackSizes) -> RackOutlines:
    """Return rack and crank of known sizes."""
    sector = locking_sector(sizes)
    crank, rack = [sector] if sector else [], rack_contour(sizes, 5)
    return RackOutlines(assembly, sizes, crank, RackGaps(assembly, sizes, rack, crank))
