"""Internal wheels: the crank turns inside the ring of slots."""

from __future__ import annotations

import math
from typing import ClassVar

from geneva_cli.motion.wheels import classic
from geneva_cli.motion.wheels.gearing import Gearing, RollerPlace, radial_place
from geneva_cli.motion.wheels.poses import HalfStep
from geneva_cli.numerics.arrays import choose
from geneva_cli.spec.schema import Example


class Internal(Gearing):
    """The crank turns inside the wheel: more motion than dwell, and no peak inside the motion.

    ``z`` is the number of slots, 3 or more.

    >>> Design(Internal(6)).timing.motion_deg
    240.0
    """

    NAME: ClassVar[str] = "internal"
    EXAMPLE: ClassVar[Example] = Example(
        "an internal wheel: more motion than dwell", {"wheel": {"z": 6}}
    )
    SIGN: ClassVar[float] = -1.0

    def half_motion_deg(self, step: HalfStep) -> float:
        """Crank angle in degrees from entry to the line of centres: 90° + b."""
        return classic.half_motion_deg(self.SIGN, *step)

    def place(self, step: HalfStep, center_distance_mm: float) -> RollerPlace:
        """Place and arm of a roller that passes through a radial slot."""
        return radial_place(self.SIGN, step)

    def matched_ratio(self, v: float) -> float:
        """R/L of the mid condition psi1(0) = l/(1+l) f1(0), with the transmission's ratio f1."""
        able = (v > 0.0) & (v < 0.5)
        ratio: float = choose(able, v, math.nan) / (1.0 - choose(able, v, 0.0))
        return ratio
