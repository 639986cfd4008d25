"""Equilibrium of a crank that is turned by a push along a known line: a block, a tooth, a pin.

So is the shaft between two drives. The bodies of the second drive load a pin of it, and the drive
before pushes it round. A load on the roller gives it the power F . p' + C w per radian of input,
which is its torque times its speed. So the push follows from that torque and its own lever,
whatever links are between.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from geneva_cli.motion.engagement import Engagement, Load, Path, Vector, cross
from geneva_cli.numerics.arrays import Batchable, choose, library
from geneva_cli.numerics.jet import Jet, Number, composed, sin_cos, turning

if TYPE_CHECKING:
    from geneva_cli.drives.retimed import Timing


class PushedCrank(Batchable, ABC):
    """A crank held by its shaft and pushed round, without friction or mass."""

    @abstractmethod
    def line(self, input_deg: Number, order: int) -> tuple[Vector, Vector]:
        """Point of the push from the crank's axis, over L, and a vector in its direction."""

    def __call__(
        self, input_deg: Number, path: Vector, loads: Sequence[Load]
    ) -> list[tuple[Vector, Vector]]:
        """Reactions of the crank's shaft, and of the body that pushes the crank, to each load."""
        x, y = (jet.lower for jet in path)
        at, direction = self.line(input_deg, x.order)
        lever, out = cross(at, direction), []
        for force, moment in loads:
            push = (cross((x - 1.0, y), force) + moment) / lever * -1.0
            third = direction[0] * push, direction[1] * push
            out.append(((force[0] + third[0], force[1] + third[1]), third))
        return out


class Mesh(PushedCrank):
    """Gears whose axes are ``distance`` over L apart, the driver's on the line of centres.

    The point of contact divides the distance as i : 1, where i is the crank's speed over the
    input's. The gears push along the common tangent of their pitch curves. The pressure angle of
    real teeth is neglected.
    """

    def __init__(self, path: Path, distance: float) -> None:
        self.path, self.distance = path, distance  # the roller turns as the crank does

    def line(self, input_deg: Number, order: int) -> tuple[Vector, Vector]:
        """Point of contact and direction of the push, from the pitch radius C/(1 + i).

        The radius of the driven gear changes by -C i'/(1 + i)² per radian of input.
        """
        x, y = self.path(input_deg, order + 2)
        rate = turning(x - 1.0, y)
        i, slope = Jet(rate.c[: order + 1]), rate.derivative()
        # sense of the crank's rotation; the ratio itself is a size
        sense = library(i.c[0]).copysign(1.0, i.c[0])
        size, grows = i * sense, slope * sense
        none = i * 0.0
        # tangent of the driven gear's curve, (dr, r df), as it turns by df
        across = none - sense
        return (self.distance / (size + 1.0), none), (grows / ((size + 1.0) * size) * -1.0, across)


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
