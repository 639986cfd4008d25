"""The jump at entry of a crank as built, for deviations of R and of L."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.loads.tolerance.dimensions import Deviations
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.engagement import AsBuilt
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.wheels.as_built import RestingSlot
from geneva_cli.numerics.arrays import Array, Mask, array, parameter


class BuiltJump(NamedTuple):
    """The jump at one engagement's entry in closed form; lengths in millimetres.

    The slot at rest keeps its direction and its offset, which the wheel has. The roller crosses the
    line of centres where the crank has turned by ``at_deg``.
    """

    built: AsBuilt
    sign: float
    offset: float
    L: float
    R: float
    drive: Drive
    at_deg: float

    def __call__(self, by: Deviations) -> tuple[Array, Mask]:
        """Sizes of the jumps, over the input's speed, and a mask of machines that miss the axis.

        A machine that misses it has a jump of 0: its roller meets the mouth instead.
        """
        L = np.atleast_1d(array(by.center_distance_mm.c[0] + self.L))
        l = (by.crank_radius_mm.c[0] + self.R) / L
        across = np.sin(self.built.angle) - self.offset / L
        missed: Mask = abs(across) > l
        with np.errstate(all="ignore"):  # of machines that miss it
            own = self.built
            here = RestingSlot(self.sign, parameter(l), own.angle, parameter(across), own.outer)
            rate = self.drive.crank_rate(array(here.crank_deg) + self.at_deg)
            jump = abs(here.velocity) * rate
        return np.where(missed, 0.0, jump), missed


def built_jumps(mechanism: Mechanism) -> list[BuiltJump]:
    """Entry jump of each engagement of a crank as built; none for other machines."""
    drive, L, out = mechanism.spec.drive, mechanism.center_distance_mm, []
    for i, engagement in enumerate(mechanism.engagements):
        if engagement.built is not None:
            angles = drive.roller_angles_deg
            at_deg = angles[i] if angles else 360.0 * i / drive.rollers
            offset, R = L * engagement.slot.offset, L * mechanism.ratio
            sign = mechanism.spec.wheel.SIGN
            out.append(BuiltJump(engagement.built, sign, offset, L, R, drive, at_deg))
    return out
