"""The closed path of a linkage's roller, and velocity and joint reactions of its link."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from collections.abc import Sequence
from decimal import Decimal
from typing import NamedTuple, Protocol, TypeGuard, cast

from geneva_cli.motion.engagement import Vector, cross
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Array, Batchable, Long, Which, array, parameter
from geneva_cli.numerics.jet import Jet, Number, sin_cos, turning
from geneva_cli.spec.rules import is_array


class PointDisplacement(Protocol):
    """The pin's displacement since a moment, as a function of the crank's rotation since then."""

    def __call__(self, sine: Jet, versine: Jet) -> tuple[Jet, Jet]:
        """Displacement (x, y), from sin d and 1 - cos d of the crank's rotation d since then."""


def rounded(x: Number | Decimal | Long) -> float:
    """Round a Decimal, or long doubles, to doubles; a single number to a float."""
    return parameter(array(x).astype(float)) if _are_many(x) else float(x)


def exactly(x: Decimal | Long) -> float:
    """Exact number typed as a float, for formulas written for floats."""
    return cast(float, x)


class RollerPath(Batchable, ABC):
    """A roller's closed path about the crank's axis, in millimetres.

    ``rough`` holds its numbers: floats, or arrays (n, 1) of a batch. ``exact`` holds them as
    Decimals of 50 digits, or as long doubles for a batch. The type checker sees floats, since the
    formulas are written for floats.
    """

    rough: tuple[float, ...]
    exact: tuple[float, ...]

    def of(self, which: Which) -> RollerPath:
        """Paths of some of the designs."""
        some = self.roughly(which)
        some.exact = _some(self.exact, which)
        return some

    def roughly(self, which: Which) -> RollerPath:
        """Paths of some of the designs, without their exact numbers."""
        some = copy.copy(self)
        some.rough = _some(self.rough, which)
        return some

    def in_long_doubles(self) -> RollerPath:
        """The path with long doubles as exact numbers, as in a batch."""
        import numpy as np  # a batch has imported it; a list of keys needs none

        some = copy.copy(self)
        long = (np.longdouble(str(x)) if isinstance(x, Decimal) else x for x in self.exact)
        some.exact = tuple(long)
        return some

    @abstractmethod
    def link(self, sine: Jet, cosine: Jet, exact: bool = False) -> tuple[Jet, Jet]:
        """Unit vector along the link that carries the roller; with ``exact``, of exact numbers."""

    @abstractmethod
    def joint(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """Crank pin A, which carries the link."""

    @abstractmethod
    def hold(self, sine: Jet, cosine: Jet) -> tuple[float, tuple[Jet, Jet]]:
        """Distance along the link from A to the other joint B, and the line of the force at B."""

    @abstractmethod
    def place(self, sine: Jet, cosine: Jet, exact: bool = False) -> tuple[Jet, Jet]:
        """Pin (x, y) for a crank direction."""

    @abstractmethod
    def about(self, sine: float, cosine: float) -> PointDisplacement:
        """The pin's displacement since the crank had this direction; exactly 0 for no rotation.

        Sine and cosine are exact numbers.
        """

    def at(self, phi: Number, order: int) -> tuple[Jet, Jet]:
        """Pin (x, y) for a crank angle in radians."""
        return self.place(*sin_cos(Jet.variable(phi, order)))


def _some(numbers: tuple[float, ...], which: Which) -> tuple[float, ...]:
    return tuple(parameter(array(x)[which]) if _are_many(x) else x for x in numbers)


def _are_many(x: object) -> TypeGuard[Array]:
    """Return True for an array of designs' numbers."""
    return is_array(x) and cast("Array", x).ndim > 0


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
