"""The closed path of a point of a linkage, and velocity and joint reactions of its link."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from typing import Any, NamedTuple, Protocol, Self, cast

from geneva_cli.drives.pushed import pushed
from geneva_cli.numerics.angles import sin_cos_deg
from geneva_cli.numerics.arrays import Array, Batchable, Complex, Which
from geneva_cli.numerics.jet import Held, Jet, Loads, Number, Vector, cross, sin_cos, turning
from geneva_cli.spec.rules import is_array


class Displacement(Protocol):
    """The pin's displacement since a moment, by the crank's rotation d since then."""

    @property
    def velocity(self) -> Complex:
        """Complex velocity at that moment."""

    def __call__(self, sine: Jet, versine: Jet) -> Vector:
        """Displacement (x, y), from sin d and 1 - cos d."""


class LinkPath(Batchable, ABC):
    """The closed path of a point of the link that crank pin A carries, about the crank's axis.

    ``numbers`` are the lengths in mm, the crank's a first, and last the point's coordinates p along
    the link and q across it: floats, or arrays (n, 1) of a batch.
    """

    def __init__(self, *lengths: float, reach_mm: float, angle_deg: float) -> None:
        sine, cosine = sin_cos_deg(angle_deg)
        self.numbers = (*lengths, reach_mm * cosine, reach_mm * sine)

    def of(self, which: Which | tuple[Which, int]) -> Self:
        """Paths of some of the designs; with numbers (n,) for ``which, 0``."""
        some = copy.copy(self)
        some.numbers = tuple(
            cast(float, cast("Array", x)[which]) if is_array(x) else x for x in self.numbers
        )
        return some

    def joint(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """Crank pin A (x, y)."""
        a, *_ = self.numbers
        return cosine * a, sine * a

    @abstractmethod
    def link(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """Unit vector along the link, from A towards B."""

    @abstractmethod
    def turned(self, sine: Array, cosine: Array, order: int) -> tuple[Any, ...]:
        """The same vector as complex numbers, and its rate of rotation with ``order`` slopes."""

    @abstractmethod
    def hold(self, sine: Jet, cosine: Jet) -> tuple[float, tuple[Jet, Jet]]:
        """Distance along the link from A to the other joint B, and the line of the force at B."""

    @abstractmethod
    def about(self, crank: Any, velocity: Any = None) -> Displacement:
        """The point's displacement since a direction of the crank; exactly 0 for no rotation.

        The direction is a complex unit vector, and so is the velocity, if it is known.
        """

    def place(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """Point (x, y) for a crank direction."""
        a, *_, p, q = self.numbers
        x, y = self.link(sine, cosine)
        return x * p - y * q + cosine * a, x * q + y * p + sine * a


class LinkRate(NamedTuple):
    """Angular velocity of the link that carries the roller."""

    path: LinkPath
    middle: float  # the crank's angle at mid-motion
    sense: float

    def __call__(self, tau: Number, order: int) -> Jet:
        """Rate in radians per input radian, positive with the wheel, ``tau`` after mid-motion."""
        x, y = self.path.link(*sin_cos(Jet.variable(tau + self.middle, order + 1)))
        return turning(x, y) * self.sense


class LinkReactions(NamedTuple):
    """Equilibrium of the link, held by the crank's pin at A, and at B along a known line."""

    path: LinkPath
    middle: float  # the crank's angle at mid-motion
    sense: float
    L: float  # millimetres
    x: float  # direction of the line of centres from the wheel's axis, on the path's axes
    y: float

    def __call__(self, turn: Jet, path: Vector, loads: Loads) -> Held:
        """Reactions of the crank's shaft, equal to those at A, and of the third body."""
        sine, cosine = sin_cos(turn + self.middle)
        known = self.path.link, self.path.place, self.path.joint
        (ex, ey), (px, py), (ax, ay) = (f(sine, cosine) for f in known)
        arm, h = self.path.hold(sine, cosine)
        # from A, over L, and from the path's axes to the machine's
        ends = (px - ax, py - ay), (ex * arm, ey * arm), (h[0] * self.L, h[1] * self.L)
        place, held, direction = (
            ((x * self.x + y * self.y) / self.L, (y * self.x - x * self.y) * (self.sense / self.L))
            for x, y in ends
        )
        return pushed(loads, place, direction, cross(held, direction))
