"""Angular velocity and joint reactions of the link that carries a linkage's roller."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.kinematics.engagement import Vector, cross
from geneva_cli.kinematics.roller_path import RollerPath
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.jet import Jet, Number, sin_cos, turning


class LinkRate(NamedTuple):
    """Angular velocity of the link that carries the roller."""

    path: RollerPath
    middle: float  # the crank's angle at mid-motion
    sense: float

    def __call__(self, tau: Number, order: int) -> Jet:
        """Rate in radians per input radian, positive with the wheel, ``tau`` after mid-motion."""
        x, y = self.path.link(*sin_cos(Jet.variable(tau + self.middle, order + 1)))
        return turning(x, y) * self.sense


class LinkReactions(NamedTuple):
    """Equilibrium of the link, held by the crank's pin at A, and at B along a known line."""

    path: RollerPath
    middle: float  # the crank's angle at mid-motion
    sense: float
    L: float  # millimetres
    x: float  # direction of the line of centres from the wheel's axis, on the path's axes
    y: float

    def __call__(
        self, input_deg: Number, path: Vector, loads: Sequence[tuple[Vector, Jet]]
    ) -> list[tuple[Vector, Vector]]:
        """Reactions of the crank's shaft, equal to those at A, and of the third body."""
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
            out.append((self._turned(F[0] + third[0], F[1] + third[1]), self._turned(*third)))
        return out

    def _turned(self, x: Jet, y: Jet) -> Vector:
        """Transform a vector from the path's axes to the machine's."""
        return x * self.x + y * self.y, (y * self.x - x * self.y) * self.sense
