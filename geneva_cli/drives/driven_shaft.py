"""The shaft between two drives: its rotation as a crank's, and the reactions of its bearings.

The bodies of the second drive load a pin of this shaft, and the drive before pushes it round. A
load on the roller gives the shaft the power F . p' + C w per radian of input, which is the shaft's
torque times its speed g'. So the push follows from that torque and its own lever, whatever links
are between.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Protocol, TypeAlias

from geneva_cli.motion.engagement import Engagement, Vector, cross
from geneva_cli.numerics.arrays import Batchable, choose
from geneva_cli.numerics.jet import Jet, Number, composed, sin_cos

if TYPE_CHECKING:
    from geneva_cli.drives.pushed import PushedCrank

Load: TypeAlias = tuple[Vector, Jet]


class ShaftAngle(Protocol):
    """The shaft's angle by the machine's input angle."""

    def at(self, input_deg: Number, order: int) -> tuple[Number, Jet]:
        """Angle of the shaft in degrees, and in radians with its derivatives."""


class ShaftPath(Batchable):
    """A point of the shaft at the distance 1 from its axis, which turns as a wheel's crank does.

    At mid-motion it points at an external wheel's axis, or away from an internal wheel's. ``sign``
    is 1 for an external wheel, else -1.
    """

    def __init__(self, sign: float, angle: Callable[[Number, int], Jet]) -> None:
        self.sign, self.angle = sign, angle

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Point (x, y) in the fixed frame."""
        s, c = sin_cos(self.angle(input_deg, order))
        return 1.0 - c * self.sign, s


class DrivenShaft(Batchable):
    """Reactions on the shaft and on the second drive's guide, to loads on the roller's body.

    ``push`` is the line along which the drive before pushes the shaft, written for one that turns
    as a crank of the wheel does. It is None for a couple, or for a shaft whose bearings are not
    computed. ``sign`` is 1 for an external wheel, whose crank turns clockwise, else -1.
    """

    def __init__(
        self, own: Engagement, angle: ShaftAngle, push: PushedCrank | None, sign: float
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
            pushed = u * size, v * size
            out.append(((shaft[0] + pushed[0], shaft[1] + pushed[1]), guide))
        return out

    def _own_reactions(
        self, own_deg: Number, angle: Jet, loads: Sequence[Load]
    ) -> list[tuple[Vector, Vector]]:
        """Reactions of the second drive's bodies alone, which are linear in the load."""
        reactions = self.own.reactions
        assert reactions is not None  # ``retimed`` passes engagements with reactions only
        none = angle * 0.0
        one = none + 1.0
        units: list[Load] = [((one, none), none), ((none, one), none), ((none, none), one)]
        path = self.own.path(own_deg, angle.order + 1)
        to_unit = [
            [composed(part, angle) for vector in pair for part in vector]
            for pair in reactions(own_deg, path, units)
        ]
        out = []
        for force, moment in loads:
            columns = zip((*force, moment), to_unit, strict=True)
            parts = [[part * amount for part in unit] for amount, unit in columns]
            x, y, gx, gy = (a + b + c for a, b, c in zip(*parts, strict=True))
            out.append(((x, y), (gx, gy)))
        return out
