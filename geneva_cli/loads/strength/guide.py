"""The guide of a rack: the forces at its ends, and the friction at which it locks.

At the crank angle a the roller's centre is x = R (1 - cos a) from its deepest place and y = R sin a
from the line of centres. It presses with F on a wall across x, and friction with mu F along x. With
d = 1 where it drives the rack and -1 where it holds it back, s the sign of its sliding, and the
guide's middle at x0, they turn the rack about that middle by

    M = F (d (x - x0) - s mu (y + d r))

The load and the mass are taken to act along the guide. A guide that is 2 h long bears on its bar at
its two ends, with s mu F/2 + M/(2 h) and s mu F/2 - M/(2 h).

Friction in the guide, nu times both forces, holds the rack back by nu |M|/h. Where that is F, no
force moves the rack: its guide locks. The lever |M|/F is longest at entry and exit, where it is
R - x0 without friction in the slot; while the roller drives, that friction shortens it. So the
guide locks from nu = h/(R - x0) on.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geneva_cli.analysis.forces import QuantityValue
from geneva_cli.kinematics.engagement import Peak
from geneva_cli.loads.summaries import load_peaks
from geneva_cli.named_tuple import NamedTuple

if TYPE_CHECKING:
    from geneva_cli.analysis.contact import Contact
    from geneva_cli.analysis.instant import Instant
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.jet import Jet


class EndForce(NamedTuple):
    """The squared force at one end of a guide, as a quantity of ``load_peaks``."""

    side: float  # 1 for one end, -1 for the other
    middle: float  # x0 over R
    half: float  # h over R

    def __call__(self, i: Instant[Jet], at: Contact[Jet]) -> QuantityValue[Jet]:
        """The square, and the grip that bounds it."""
        rub, radius = i.slides * i.case.friction, i.drives * i.case.radius
        # of a direct crank 1 - cos a is 1 - velocity, and sin a the speed along the slot
        lever = (1.0 - at.velocity - self.middle) * i.drives - (at.along + radius) * rub
        force = i.forces.force * (lever * (0.5 * self.side / self.half) + 0.5 * rub)
        return QuantityValue(force * force, i.grip)


def guide_force(mechanism: Mechanism, middle_mm: float, half_mm: float) -> Peak[float]:
    """The greatest force at an end of a guide, N; infinite if the pin's force has no bound."""
    R = mechanism.center_distance_mm
    ends = {str(side): EndForce(side, middle_mm / R, half_mm / R) for side in (1.0, -1.0)}
    first, second = load_peaks(mechanism, tuple(ends), ends).values()
    most = first if first.max.item() >= second.max.item() else second
    return Peak(math.sqrt(most.max.item()), most.at_deg.item())


def locks_at_friction(mechanism: Mechanism, middle_mm: float, half_mm: float) -> float:
    """The coefficient of friction from which a guide locks itself."""
    return half_mm / (mechanism.center_distance_mm - middle_mm)
