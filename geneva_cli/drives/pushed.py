"""Equilibrium of a crank that is turned by a push along a known line: a block, a tooth, a pin."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.motion.engagement import Held, Loads, Vector, cross
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Batchable
from geneva_cli.numerics.jet import Jet, Number, sin_cos, turning

if TYPE_CHECKING:
    from geneva_cli.numerics.jet_functions import Displacement


class CrankRate(NamedTuple):
    """Rate of the crank about its roller's axis: a factor times that of its rotation."""

    advance: Displacement
    factor: float

    def __call__(self, tau: Number, order: int) -> Jet:
        sine, versine = self.advance(tau, order + 1)
        rate: Jet = turning(1.0 - versine, sine) * self.factor
        return rate


class PushedCrank(Batchable, ABC):
    """A crank held by its shaft and pushed round, without friction or mass."""

    @abstractmethod
    def line(self, input_deg: Number, order: int) -> tuple[Vector, Vector]:
        """Point of the push from the crank's axis, over L, and a vector in its direction."""

    def __call__(self, input_deg: Number, path: Vector, loads: Loads) -> Held:
        """Reactions of the crank's shaft, and of the body that pushes the crank, to each load."""
        x, y = (jet.lower for jet in path)
        at, direction = self.line(input_deg, x.order)
        lever, out = cross(at, direction), []
        for force, moment in loads:
            push = (cross((x - 1.0, y), force) + moment) / lever * -1.0
            third = direction[0] * push, direction[1] * push
            out.append(((force[0] + third[0], force[1] + third[1]), third))
        return out


class CirclingPush(PushedCrank):
    """A pin or a block on a circle, which pushes across the line from the crank's axis to it.

    It is at ((c ``k`` + ``x0``) ``scale``, s ``height``) from that axis, over L; c and s are cosine
    and sine of its own crank's angle, which is ``mid`` radians at mid-motion.
    """

    def __init__(self, x0: float, k: float, scale: float, height: float, mid: float) -> None:
        self.x0, self.k, self.scale, self.height, self.mid = x0, k, scale, height, mid

    def line(self, input_deg: Number, order: int) -> tuple[Vector, Vector]:
        s, c = sin_cos(Jet.variable(radians(input_deg) + self.mid, order))
        x, y = (c * self.k + self.x0) * self.scale, s * self.height
        return (x, y), (y * -1.0, x)
