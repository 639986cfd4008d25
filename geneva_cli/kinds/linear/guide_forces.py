"""The guide of a rack: the forces at its ends, and the friction at which it locks.

At the crank angle a the roller's centre is x = R (1 - cos a) from its deepest place and y = R sin a
from the line of centres. It presses with F on a wall across x, and friction with mu F along x. With
d = 1 where it drives the rack and -1 where it holds it back, s the sign of its sliding, and the
guide's middle at x0, they turn the rack about that middle by

    M = F (d (x - x0) - s mu (y + d r))

The load and the mass are taken to act along the guide. A guide that is 2 h long bears on its bar at
its two ends, with s mu F/2 + M/(2 h) and s mu F/2 - M/(2 h).

Friction in the guide, nu times the sizes of both forces, holds the rack back by D = nu times the
greater of |M|/h and mu F. The rack's balance along its travel is d F = T/R + D, and the input pays
D y' on top. Both are in ``guide_friction``. The friction is taken to act in the bar's middle: half
a bar's width moves M by nu mu F/2 of it.

Where D is F, no force moves the rack: its guide locks. While the roller drives, friction in the
slot takes mu |y + r| from the lever |M|/F. It is longest at entry, R - x0 - mu (R - r); above the
greatest real friction it is negative, and longest at exit. So the guide locks from nu = h over the
greatest of R - x0 - mu (R - r), mu (R + r) - (R - x0) and mu h.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.kinds.linear.guide_friction import RackGuide
from geneva_cli.kinds.linear.guide_place import guide_place
from geneva_cli.loads.forces import QuantityValue
from geneva_cli.loads.instant import Instant
from geneva_cli.loads.load_peaks import load_peaks
from geneva_cli.motion.engagement import Peak
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.jet import Jet


class EndForce(NamedTuple):
    """The squared force at one end of a guide, as a quantity of ``load_peaks``."""

    side: float  # 1 for one end, -1 for the other

    def __call__(self, i: Instant[Jet]) -> QuantityValue[Jet]:
        """The square, and the grip that bounds it."""
        rub = i.slides * i.case.friction
        guide = i.case.guide
        assert isinstance(guide, RackGuide)
        lever = guide.lever(i.case, i.at, i.drives, i.slides) * i.drives
        force = i.force_N * (lever * (0.5 * self.side / guide.half) + 0.5 * rub)
        return QuantityValue(force * force, i.grip)


def guide_force(mechanism: Mechanism) -> Peak[float]:
    """The greatest force at an end of a guide, N; infinite if the pin's force has no bound."""
    ends = {str(side): EndForce(side) for side in (1.0, -1.0)}
    first, second = load_peaks(mechanism, tuple(ends), ends).values()
    most = first if first.max.item() >= second.max.item() else second
    return Peak(math.sqrt(most.max.item()), most.at_deg.item())


def locks_at_friction(mechanism: Mechanism) -> float:
    """The friction from which a guide locks itself, with the slot's own friction as it is."""
    place, mu = guide_place(mechanism), mechanism.spec.load.friction
    R, r = mechanism.center_distance_mm, mechanism.roller_radius_mm
    far = R - place.middle
    levers = (far - mu * (R - r), mu * (R + r) - far, mu * place.half)
    return place.half / max(levers)
