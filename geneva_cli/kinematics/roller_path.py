"""The closed path of a linkage's roller."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from decimal import Decimal
from typing import TYPE_CHECKING, Protocol, TypeGuard, cast

from geneva_cli.numerics.arrays import array, parameter
from geneva_cli.numerics.batchable import Batchable
from geneva_cli.numerics.jet import Jet, Number, sin_cos
from geneva_cli.spec.rules import is_array

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Long, Which


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
