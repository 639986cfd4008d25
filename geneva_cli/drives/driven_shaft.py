"""The shaft between two drives: its rotation as a crank's, and the reactions of its bearings.

The bodies of the second drive load a pin of this shaft, and the drive before pushes it round. A
load on the roller gives the shaft the power F . p' + C w per radian of input, which is the shaft's
torque times its speed. So the push follows from that torque and its own lever, whatever links are
between.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from geneva_cli.drives.pushed import PushedCrank
from geneva_cli.motion.engagement import Displacement, Engagement, Load, Vector, cross
from geneva_cli.motion.path_and_slot import cuts
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.arrays import Array, Batchable, array, choose, library, narrowed
from geneva_cli.numerics.jet import Jet, Number, atan2, composed, piecewise, sin_cos
from geneva_cli.numerics.roots import boundary

if TYPE_CHECKING:
    from geneva_cli.drives.transmission import Transmission


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
        self.within_deg = local[1].input_deg  # input angle of mid-motion in that turn
        self.mid_deg = 360.0 * before.turns * turns + self.within_deg
        self.even = local[1].even
        self.at_deg = tuple(one.input_deg - self.within_deg for one in local)
        self.advances = tuple(one.advance for one in local)
        # input angles at which the formula about another place takes over, or the gears' own
        self.cuts = cuts(self.at_deg)
        self.changes_deg = tuple(
            at + cut / DEGREE
            for at, one in zip(self.at_deg, local, strict=True)
            for cut in one.cuts
        )

    def of(self, other: Engagement, ahead_deg: float) -> Timing:
        """The timing of another engagement, whose mid-motion is earlier by an own angle."""
        return Timing(self.before, other, self.shaft_deg - ahead_deg - other.mid_deg)

    def input_deg(self, own_deg: float) -> float:
        """Machine's input angle at an angle of the driven shaft, both from mid-motion, degrees."""
        return self.before.about(self.rest_deg + own_deg).input_deg - self.within_deg

    def inputs_deg(self, own_deg: Array) -> Array:
        """Machine's input angles at angles of the driven shaft within the motion, degrees."""
        first, last = (array(self.at_deg[k]) + 0.0 * own_deg for k in (0, -1))
        return boundary(lambda x: array(self.at(x, 0)[0]) <= own_deg, first, last)

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
        turn, advance = radians(input_deg - self.at_deg[i]), self.advances[i]
        turned = angle_of(advance, turn, order)
        # the shaft never turns back, so the ends of an enclosure of angles decide
        angle = narrowed(
            turned.c[0], lambda x: angle_of(advance, radians(x - self.at_deg[i]), 0).c[0], input_deg
        )
        return Jet((self.ends_deg[i] + library(angle).degrees(angle), *turned.c[1:]))

    def vector(self, own: Callable[[Number, int], Vector], x: Number, order: int) -> Vector:
        """A vector of the own drive by the machine's input angle."""
        at, turned = self.at(x, order)
        a, b = own(at, order)
        return composed(a, turned), composed(b, turned)


class ShaftPath(Batchable):
    """A point of a shaft at the distance 1 from its axis, which turns as a wheel's crank does.

    At mid-motion it points at an external wheel's axis, or away from an internal wheel's. ``sign``
    is 1 for an external wheel, else -1.
    """

    def __init__(self, sign: float, angle: Callable[[Number, int], Jet]) -> None:
        self.sign, self.angle = sign, angle

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        """Point (x, y) in the fixed frame."""
        s, c = sin_cos(self.angle(input_deg, order))
        return 1.0 - c * self.sign, s


class DrivenShaft(Batchable):
    """Reactions on the shaft between two drives, and on the second one's guide, to loads.

    ``push`` is the line along which the drive before pushes the shaft, written for one that turns
    as a crank of the wheel does. It is None for a couple, or for a shaft whose bearings are not
    computed. ``sign`` is 1 for an external wheel, whose crank turns clockwise, else -1.
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
        order = path[0].order - 1
        own_deg, angle = self.angle.at(input_deg, order + 1)
        reactions = self._own_reactions(own_deg, angle.lower, loads)
        if self.push is None:
            return reactions
        (x, y), (u, v) = self.push.line(input_deg, order)
        y, v = y * self.mirror, v * self.mirror
        lever, rate = cross((x, y), (u, v)), angle.derivative()
        velocity = path[0].derivative(), path[1].derivative()
        spin = composed(self.own.carrier(own_deg, order), angle.lower) * rate
        out = []
        for (force, moment), (shaft, guide) in zip(loads, reactions, strict=True):
            power = force[0] * velocity[0] + force[1] * velocity[1] + moment * spin
            size = power / (rate * lever) * self.clockwise
            out.append(((shaft[0] + u * size, shaft[1] + v * size), guide))
        return out

    def _own_reactions(
        self, own_deg: Number, angle: Jet, loads: Sequence[Load]
    ) -> list[tuple[Vector, Vector]]:
        """Reactions of the second drive's bodies alone, which are linear in the load."""
        assert self.own.reactions is not None  # ``retimed`` passes engagements with reactions only
        none = angle * 0.0
        one = none + 1.0
        units: list[Load] = [((one, none), none), ((none, one), none), ((none, none), one)]
        path = self.own.path(own_deg, angle.order + 1)
        to_unit = [
            [composed(part, angle) for vector in pair for part in vector]
            for pair in self.own.reactions(own_deg, path, units)
        ]
        out = []
        for force, moment in loads:
            columns = zip((*force, moment), to_unit, strict=True)
            parts = [[part * amount for part in unit] for amount, unit in columns]
            x, y, gx, gy = (a + b + c for a, b, c in zip(*parts, strict=True))
            out.append(((x, y), (gx, gy)))
        return out


def angle_of(advance: Displacement, tau: Number, order: int) -> Jet:
    """Angle by which the driven shaft advances in ``tau`` input radians, radians."""
    sine, versine = advance(tau, order)
    return atan2(sine, 1.0 - versine)
