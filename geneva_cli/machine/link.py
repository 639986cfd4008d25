"""The link that carries the roller, cut free from its machine: how it turns, what holds it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.machine.engagement import Vector, cross
from geneva_cli.machine.roller_path import Path
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.jet import Jet, Number, atan2, sin_cos


class Link(NamedTuple):
    """The link that carries the roller, from mid-motion on."""

    path: Path
    middle: float  # the crank's angle there
    sense: float

    def __call__(self, tau: Number, order: int) -> Jet:
        """How fast it turns, positive with the wheel."""
        x, y = self.path.link(*sin_cos(Jet.variable(tau + self.middle, order + 1)))
        return atan2(y, x).derivative() * self.sense


class LinkJoints(NamedTuple):
    """The link cut free: the crank's pin A holds it, and a third body at B along a known line."""

    path: Path
    middle: float  # the crank's angle at mid-motion
    sense: float
    L: float  # millimetres
    x: float  # direction of the line of centres from the wheel's axis, on the path's axes
    y: float

    def __call__(
        self, input_deg: Number, path: Vector, loads: Sequence[tuple[Vector, Jet]]
    ) -> list[tuple[Vector, Vector]]:
        """Reactions of the crank's shaft, which are those at A, and of the third body."""
        tau = Jet.variable(radians(input_deg) + self.middle, path[0].order - 1)
        sine, cosine = sin_cos(tau)
        ex, ey = self.path.link(sine, cosine)
        px, py = self.path.place(sine, cosine)
        ax, ay = self.path.joint(sine, cosine)
        arm, h = self.path.hold(sine, cosine)
        place, lever = (px - ax, py - ay), cross((ex * arm, ey * arm), h)
        out = []
        for force, moment in loads:
            across = force[1] * self.sense
            F = (force[0] * self.x - across * self.y, force[0] * self.y + across * self.x)
            push = (cross(place, F) + moment * (self.sense * self.L)) / lever * -1.0  # about A
            third = h[0] * push, h[1] * push
            out.append(((F[0] + third[0], F[1] + third[1]), third))
        return out
