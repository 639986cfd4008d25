"""The error of the wheel's angle during a motion of a straight slot, for any deviations.

Deviations dL of the centre distance and dR of the crank's radius move the roller's centre from p to
p + (dL, 0) + dR/R (p - hub). The slot follows it, off by the error of its own angle and by the
clearance c between roller and wall, on one side or the other:

    psi = arg p + asin((e + c) / |p|),    dpsi/dR = L sin(phi) / |p|²,  dpsi/dL = -R sin(phi) / |p|²

The slopes are a plain crank's. e is the distance of the slot's axis from the wheel's centre.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.analysis.blows import arm_mm
from geneva_cli.analysis.tolerance.dimensions import Deviations
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.arrays import array, choose
from geneva_cli.numerics.jet import Jet, Number, atan2, sqrt

LOOKS = 361  # input angles at which a motion is sampled
CLOSER = 12  # samplings, each about the greatest of the last and a tenth as wide


class MotionError(NamedTuple):
    """The error of one engagement's motion as a function of deviations; lengths in mm."""

    engagement: Engagement
    L: float
    arm: float  # R; without effect where no crank's arm carries the roller
    clearance: float  # roller to slot, per side

    def __call__(self, by: Deviations, input_deg: Number, side: Number) -> Jet:
        """The wheel's angle less its true one, radians; ``side`` (1, -1) is the wall that bears."""
        x, y = (self.L * z.c[0] for z in self.engagement.path(input_deg, 0))
        offset = self.L * self.engagement.slot.offset
        share = by.crank_radius_mm * (1.0 / self.arm)
        moved = share * (x - self.L * self.engagement.hub) + by.center_distance_mm
        px, py = moved + x, share * y + y
        free = self.room(by)
        free = free * choose(free.c[0] > 0.0, 1.0, 0.0)
        turned = atan2(share * y * x - moved * y, px * x + py * y)
        beside = _asin(free * side + offset, px * px + py * py)
        true = np.arcsin(offset / np.hypot(x, y))
        out: Jet = turned + (beside - true) + by.slot_angle_deg
        return out

    def room(self, by: Deviations) -> Jet:
        """The clearance per side, mm; below 0 the roller does not go into the slot."""
        return by.slot_clearance + self.clearance

    def greatest(self, by: Deviations) -> tuple[float, float, float]:
        """The greatest error of any of the machines, radians, its input angle and its side."""
        each = Deviations(*[Jet([np.atleast_1d(z)[:, None] for z in jet.c]) for jet in by])
        best = (-1.0, 0.0, 1.0)
        for side in (1.0, -1.0):
            low, high = self.engagement.entry_deg, self.engagement.exit_deg
            for _ in range(CLOSER):
                at = np.linspace(low, high, LOOKS)
                off = (array(self(each, at, side).c[0]) * side).max(axis=0)
                i = int(np.argmax(off))
                best = max(best, (float(off[i]), float(at[i]), side), key=_size)
                step = (at[1] - at[0]) * LOOKS / 20.0
                low = max(self.engagement.entry_deg, at[i] - step)
                high = min(self.engagement.exit_deg, at[i] + step)
        return best


def _size(found: tuple[float, float, float]) -> float:
    return found[0]


def _asin(height: Jet, square: Jet) -> Jet:
    """The angle whose sine is a height over the root of a square."""
    left = square - height * height
    return atan2(height, sqrt(left))


def motion_errors(mechanism: Mechanism) -> list[MotionError]:
    """The motion error of each engagement; none for curved slots, which are solved for."""
    L, clearance = mechanism.center_distance_mm, mechanism.spec.size.allowances.slot_clearance_mm
    if mechanism.engagements[0].slot.curved:
        return []
    return [MotionError(e, L, arm_mm(mechanism, e), clearance) for e in mechanism.engagements]
