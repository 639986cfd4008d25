"""The shaft between two drives: its rotation as a crank's, and the reactions of its bearings.

A load on the roller gives it the power F . p' + C w per radian of input, its torque times its
speed. So the push of the drive before follows from that and its own lever, whatever the links.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from geneva_cli.motion.engagement import Engagement, Load, Vector, cross
from geneva_cli.motion.path_and_slot import NEAR_END
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Batchable, choose, library, narrowed
from geneva_cli.numerics.jet import Jet, Number, atan2, composed, piecewise, sin_cos

if TYPE_CHECKING:
    from geneva_cli.drives.pushed import PushedCrank
    from geneva_cli.drives.transmission import Transmission
    from geneva_cli.numerics.jet_functions import Displacement


def angle_of(advance: Displacement, tau: Number, order: int) -> Jet:
    """Angle by which the driven shaft advances in ``tau`` input radians, radians."""
    sine, versine = advance(tau, order)
    return atan2(sine, 1.0 - versine)


class Timing(Batchable):
    """Angle of a drive's own input shaft over one engagement, by the machine's input angle.

    ``late_deg`` is the own angle by which the engagement follows the one that it repeats. The angle
    is written about entry, mid-motion and exit, so that it is exact at each of them.
    """

    def __init__(self, before: Transmission, own: Engagement, late_deg: float) -> None:
        mid = own.mid_deg + late_deg
        turns = library(mid).floor(mid / 360.0 + 0.5)
        self.before, self.shaft_deg = before, mid
        self.rest_deg = mid - 360.0 * turns  # ``about`` covers one turn of the shaft
        self.ends_deg = (own.entry_deg, 0.0, own.exit_deg)  # of the own shaft
        local = [before.about(self.rest_deg + end) for end in self.ends_deg]
        self.within_deg = local[1][0]  # input angle of mid-motion in that turn
        self.mid_deg = 360.0 * before.turns * turns + self.within_deg
        self.at_deg = tuple(at_deg - self.within_deg for at_deg, _ in local)
        self.advances = tuple(advance for _, advance in local)
        # input angles at which the formula about another place takes over
        self.cuts = [NEAR_END * self.at_deg[0], NEAR_END * self.at_deg[-1]]

    def input_deg(self, own_deg: float) -> float:
        """Machine's input angle at an angle of the driven shaft, both from mid-motion, degrees."""
        return self.before.about(self.rest_deg + own_deg)[0] - self.within_deg

    def __call__(self, input_deg: Number, order: int) -> Jet:
        """Angle of the driven shaft in radians from mid-motion, at input angles in degrees."""
        return self.at(input_deg, order)[1]

    def at(self, input_deg: Number, order: int) -> tuple[Number, Jet]:
        """Angle of the driven shaft in degrees, and in radians with its derivatives."""
        pieces = [partial(self._about, i, order) for i in range(3)]
        own = piecewise(input_deg, self.cuts, pieces)
        return own.c[0], Jet((radians(own.c[0]), *own.c[1:]))

    def _about(self, i: int, order: int, input_deg: Number) -> Jet:
        """Angle of the driven shaft in degrees, with its derivatives in radians."""

        def turned(x: Number, order: int) -> Jet:
            return angle_of(self.advances[i], radians(x - self.at_deg[i]), order)

        own = turned(input_deg, order)
        # the shaft never turns back, so the ends of an enclosure of angles decide
        angle = narrowed(own.c[0], lambda x: turned(x, 0).c[0], input_deg)
        return Jet((self.ends_deg[i] + library(angle).degrees(angle), *own.c[1:]))


class ShaftPath(Batchable):
    """A point of a shaft at the distance 1 from its axis, which turns as a wheel's crank does.

    At mid-motion it points at an external wheel's axis (``sign`` 1), or away from an internal
    wheel's.
    """

    def __init__(self, sign: float, angle: Timing) -> None:
        self.sign, self.angle = sign, angle

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        """Point (x, y) in the fixed frame."""
        s, c = sin_cos(self.angle(input_deg, order))
        return 1.0 - c * self.sign, s


class DrivenShaft(Batchable):
    """Reactions on the shaft between two drives, and on the second one's guide, to loads.

    ``push`` is the line of the push, written for a shaft that turns as a crank
    of the wheel does. It is None for a couple, or for a shaft whose bearings are not computed.
    """

    def __init__(
        self, own: Engagement, angle: Timing, push: PushedCrank | None, sign: float
    ) -> None:
        self.own, self.angle, self.push = own, angle, push
        sense = own.crank_sense
        self.mirror = choose(sense == 0.0, 1.0, sense)
        self.clockwise = choose(sense == 0.0, sign, sense)  # -1 for one that turns the other way

    def __call__(
        self, input_deg: Number, path: Vector, loads: Sequence[Load]
    ) -> list[tuple[Vector, Vector]]:
        """Reactions of the shaft's bearings, and of the guide, to each load."""
        assert self.own.reactions is not None  # ``retimed`` passes engagements with reactions only
        order = path[0].order - 1
        own_deg, angle = self.angle.at(input_deg, order + 1)
        low, rate = angle.lower, angle.derivative()
        # the second drive's bodies alone, which are linear in the load
        none = low * 0.0
        one = none + 1.0
        units: list[Load] = [((one, none), none), ((none, one), none), ((none, none), one)]
        to_unit = [
            [composed(part, low) for vector in pair for part in vector]
            for pair in self.own.reactions(own_deg, self.own.path(own_deg, order + 1), units)
        ]
        if self.push is not None:
            (x, y), (u, v) = self.push.line(input_deg, order)
            y, v = y * self.mirror, v * self.mirror
            lever = cross((x, y), (u, v))
            velocity = path[0].derivative(), path[1].derivative()
            spin = composed(self.own.carrier(own_deg, order), low) * rate
        out = []
        for force, moment in loads:
            columns = zip((*force, moment), to_unit, strict=True)
            parts = [[part * amount for part in unit] for amount, unit in columns]
            shaft_x, shaft_y, *guide = (a + b + c for a, b, c in zip(*parts, strict=True))
            if self.push is not None:
                power = force[0] * velocity[0] + force[1] * velocity[1] + moment * spin
                size = power / (rate * lever) * self.clockwise
                shaft_x, shaft_y = shaft_x + u * size, shaft_y + v * size
            out.append(((shaft_x, shaft_y), (guide[0], guide[1])))
        return out
