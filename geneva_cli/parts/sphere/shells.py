"""The shells of a spherical machine as a full turn has them: where they stand, lengths and gaps."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.sphere import Region
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly, assembled
from geneva_cli.parts.outlines import CONTACT
from geneva_cli.parts.sizes import wall_min
from geneva_cli.parts.sphere.fitted import fitted
from geneva_cli.parts.sphere.gaps import BallGaps
from geneva_cli.parts.sphere.sizes import Ball

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


class BallLengths(NamedTuple):
    """Arcs of the sphere, mm, but for ``rim`` and ``outer``, which are from the wheel's axis."""

    roller: float
    half_width: float
    rim: float
    outer: float  # the sphere's radius, where the wheel reaches round it
    arm: float
    horn: float
    wall_min: float


class Shells(NamedTuple):
    """Wheel and crank on a sphere, and the gaps between them."""

    assembly: Assembly
    ball: Ball
    sizes: BallLengths
    crank: list[Region]
    gaps: BallGaps

    @property
    def close(self) -> float:
        """The overlap, mm, that is rounding."""
        return SAME_LENGTH * self.ball.radius_mm

    @property
    def contact(self) -> float:
        """The overlap, mm, up to which parts count as touching."""
        return CONTACT * self.ball.radius_mm

    def over(self, assembly: Assembly) -> Shells:
        """The same parts where another assembly has them."""
        return self._replace(assembly=assembly)

    def in_wheel(self, motion: int, at: Array) -> Array:
        """Where a motion's roller is in the wheel's frame, mm, at input angles (n,): (n, 3)."""
        out: Array = self.ball.radius_mm * self.gaps.in_wheel(motion, at)
        return out

    def past_mouth(self, motion: int, at: Array) -> Array:
        """How far that is in its slot, past the mouth's corners, mm, (n,)."""
        polar = np.arccos(np.clip(self.gaps.in_wheel(motion, at)[:, 2], -1.0, 1.0))
        past: Array = self.ball.radius_mm * (self.ball.mouth - polar)
        return past


def shells(mechanism: Mechanism, advice: bool = True) -> Shells:
    """The shells of a machine. Raises GenevaError, naming the key, where its sizes leave none; with
    ``advice`` also the roller that leaves some.
    """
    found, locks = fitted(mechanism, advice)
    L, where = found.radius_mm, assembled(mechanism)
    lengths = BallLengths(
        roller=L * found.roller,
        half_width=L * found.half_width,
        rim=L * math.sin(found.rim),
        outer=L if found.rim > 0.5 * math.pi else 0.0,
        arm=L * math.sin(found.arm),
        horn=L * (found.arm - found.half_width - found.recess),
        wall_min=wall_min(mechanism.spec.size, L),
    )
    return Shells(where, found, lengths, locks, BallGaps(where, found, locks))
