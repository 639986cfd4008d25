"""Equilibrium of a crank that is turned by a push along a known line: a block, a tooth, a pin."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.motion.engagement import Load, Vector, cross
from geneva_cli.numerics.arrays import Batchable, library
from geneva_cli.numerics.jet import Jet, Number, turning

if TYPE_CHECKING:
    from geneva_cli.numerics.jet_functions import Displacement, Path


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
    """Gears whose axes are ``distance`` over L apart, the driver's on the line of centres."""

    def __init__(self, path: Path, distance: float) -> None:
        self.path, self.distance = path, distance  # the roller turns as the crank does

    def line(self, input_deg: Number, order: int) -> tuple[Vector, Vector]:
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
