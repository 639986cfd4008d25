"""The closed path of a linkage's roller."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from decimal import Decimal
from typing import TYPE_CHECKING, Protocol, cast

import numpy as np

from geneva_cli.numerics.arrays import array, parameter
from geneva_cli.numerics.digits import PI
from geneva_cli.numerics.jet import Jet, Number, sin_cos

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Long, Which

LONG_PI = np.longdouble(str(PI))


class PointDisplacement(Protocol):
    """The pin's displacement since a moment, as a function of the crank's angle since then."""

    def __call__(self, sine: Jet, versine: Jet) -> tuple[Jet, Jet]:
        """(x, y), from sin d and 1 - cos d of the crank's angle d since then."""


def rounded(x: Number | Decimal | Long) -> float:
    """A Decimal, or long doubles, rounded to doubles; one number as a float."""
    if isinstance(x, Decimal) or not np.ndim(x):
        return float(x)
    return parameter(np.asarray(x, dtype=np.float64))


def exactly(x: Decimal | Long) -> float:
    """An exact number typed as a float, for formulas written for floats: it computes alike."""
    return cast(float, x)


class RollerPath(ABC):
    """A roller's closed path about the crank's axis, in millimetres.

    ``rough`` are its numbers: floats, or arrays (n, 1) of many designs. ``exact`` are the same as
    Decimals of 50 digits, or of many designs as long doubles: to the type checker floats too, for
    which the formulas are written.
    """

    rough: tuple[float, ...]
    exact: tuple[float, ...]

    def of(self, which: Which) -> RollerPath:
        """The paths of some of the designs."""
        some = self.roughly(which)
        some.exact = _some(self.exact, which)
        return some

    def roughly(self, which: Which) -> RollerPath:
        """The paths of some of the designs, without their exact numbers."""
        some = copy.copy(self)
        some.rough = _some(self.rough, which)
        return some

    def in_long_doubles(self) -> RollerPath:
        """The path with long doubles for exact numbers, as for many designs."""
        some = copy.copy(self)
        long = (np.longdouble(str(x)) if isinstance(x, Decimal) else x for x in self.exact)
        some.exact = tuple(long)
        return some

    @abstractmethod
    def link(self, sine: Jet, cosine: Jet, exact: bool = False) -> tuple[Jet, Jet]:
        """A unit vector on the link that carries the roller; exact: jets of such numbers."""

    @abstractmethod
    def joint(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """The crank's pin A, which carries the link."""

    @abstractmethod
    def hold(self, sine: Jet, cosine: Jet) -> tuple[float, tuple[Jet, Jet]]:
        """The other joint B's distance from A along the link, and the line of the force there."""

    @abstractmethod
    def place(self, sine: Jet, cosine: Jet, exact: bool = False) -> tuple[Jet, Jet]:
        """The pin (x, y) for a crank of this direction."""

    @abstractmethod
    def about(self, sine: float, cosine: float) -> PointDisplacement:
        """The pin's displacement since the crank had this direction, exactly 0 at no turn.

        Sine and cosine are exact.
        """

    def at(self, phi: Number, order: int) -> tuple[Jet, Jet]:
        """The pin for a crank angle in radians."""
        return self.place(*sin_cos(Jet.variable(phi, order)))


def _some(numbers: tuple[float, ...], which: Which) -> tuple[float, ...]:
    return tuple(parameter(array(x)[which]) if np.ndim(x) else x for x in numbers)
