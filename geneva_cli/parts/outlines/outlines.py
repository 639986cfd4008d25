"""The outlines of wheel and crank, with the sizes and the positions that they are cut for."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.shapes import Contour
from geneva_cli.motion.engagement import Engagement
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.turn.gaps import Gaps


class Outlines(NamedTuple):
    """The outlines of wheel and crank, for drawings and for the full turn.

    ``slots`` has the walls of each kind of slot. ``close`` is the overlap, mm, that counts as
    rounding or as the walls' tolerance. ``gaps`` has all recesses of a wheel, also that which a
    stop leaves convex.
    """

    assembly: Assembly
    sizes: Sizes
    slots: dict[Engagement, Contour]
    wheel: Contour
    crank: list[Contour]
    relief: str
    gaps: Gaps
    close: float

    @property
    def relief_depth(self) -> float:
        """The distance of the crank's outline from its axis at the bottom of a relief, mm."""
        return abs(float(Polyarc(self.crank).signed(np.zeros((1, 2)))[0]))

    @property
    def has_arm(self) -> bool:
        """True if the machine has an arm: a crank with rollers on pins."""
        return self.assembly.full.spec.drive.ONE_ARM and self.sizes.pin > 0.0
