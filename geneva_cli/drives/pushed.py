"""Equilibrium of a body that a push along a known line holds: of a block, a tooth or a pin."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.numerics.arrays import Batchable, Number
from geneva_cli.numerics.jet import Jet, Vector, composed, cross, sin_cos, turning

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Displacement, Held, Loads


class CrankRate(NamedTuple):
    """Rate of the crank about its roller's axis: a factor times that of its rotation."""

    advance: Displacement
    factor: float

    def __call__(self, tau: Number, order: int) -> Jet:
        sine, versine = self.advance(tau, order + 1)
        rate: Jet = turning(1.0 - versine, sine) * self.factor
        return rate


def pushed(loads: Loads, arm: Vector, direction: Vector, lever: Jet | float) -> Held:
    """Reactions of a body's pivot, and of what pushes it in a direction, to each load.

    The loads act at ``arm`` from the pivot, lengths over L; ``lever`` is that of the push.
    """
    out = []
    for force, moment in loads:
        push = (cross(arm, force) + moment) / lever * -1.0
        third = direction[0] * push, direction[1] * push
        out.append(((force[0] + third[0], force[1] + third[1]), third))
    return out


class PushedCrank(Batchable, ABC):
    """A crank held by its shaft and pushed round, without friction or mass."""

    @abstractmethod
    def line(self, turn: Jet) -> tuple[Vector, Vector]:
        """Point of the push from the crank's axis, over L, and a vector in its direction."""

    def __call__(self, turn: Jet, path: Vector, loads: Loads) -> Held:
        """Reactions of the crank's shaft, and of the body that pushes the crank, to each load."""
        x, y = (jet.lower for jet in path)
        at, direction = self.line(turn)
        return pushed(loads, (x - 1.0, y), direction, cross(at, direction))


class CirclingPush(PushedCrank):
    """A pin or a block on a circle, which pushes across the line from the crank's axis to it.

    It is at ((c ``k`` + ``x0``) ``scale``, s ``height``) from that axis, over L; c and s are cosine
    and sine of its own crank's angle, which is ``mid`` radians at mid-motion.
    """

    def __init__(self, x0: float, k: float, scale: float, height: float, mid: float) -> None:
        self.x0, self.k, self.scale, self.height, self.mid = x0, k, scale, height, mid

    def line(self, turn: Jet) -> tuple[Vector, Vector]:
        s, c = sin_cos(turn + self.mid)
        x, y = (c * self.k + self.x0) * self.scale, s * self.height
        return (x, y), (y * -1.0, x)


class Mesh(PushedCrank):
    """Gears whose axes are ``distance`` over L apart; ``sense`` is that of the crank's rotation."""

    def __init__(self, advance: Displacement, distance: float, sense: float) -> None:
        self.rate, self.distance, self.sense = CrankRate(advance, 1.0), distance, sense

    def line(self, turn: Jet) -> tuple[Vector, Vector]:
        rate = self.rate(turn.c[0], turn.order + 1)
        i, grows = composed(rate.lower, turn), composed(rate.derivative(), turn)
        none = i * 0.0
        # tangent of the driven gear's curve, (dr, r df), as it turns by df
        tangent = grows / ((i + 1.0) * i) * -1.0, none - self.sense
        return (self.distance / (i + 1.0), none), tangent
