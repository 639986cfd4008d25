"""A roller's closed path about the crank's axis, which a linkage describes."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from decimal import Decimal
from typing import Any, Protocol

import numpy as np

from geneva_cli.numerics.digits import PI
from geneva_cli.numerics.jet import Coefficient, Jet, sin_cos

LONG_PI = np.longdouble(str(PI))


class Way(Protocol):
    """The pin's way since a moment."""

    def __call__(self, sine: Jet, versine: Jet) -> tuple[Jet, Jet]:
        """(x, y), from sin d and 1 - cos d of the crank's angle d since then."""


def rounded(x: Any) -> Any:
    """A Decimal, or long doubles, rounded to doubles; one number as a float."""
    if isinstance(x, Decimal) or not np.ndim(x):
        return float(x)
    return np.asarray(x, dtype=np.float64)


class Path(ABC):
    """A roller's closed path about the crank's axis, in millimetres.

    ``rough`` are its numbers: floats, or arrays (n, 1) of many designs. ``exact`` are the same as
    Decimals of 50 digits, or of many designs as long doubles.
    """

    rough: Any
    exact: Any

    def of(self, which: Any) -> Path:
        """The paths of some of the designs."""
        some = copy.copy(self)
        for name in ("rough", "exact"):
            numbers = (x[which] if np.ndim(x) else x for x in vars(self)[name])
            vars(some)[name] = type(self.rough)(*numbers)
        return some

    def roughly(self, which: Any) -> Path:
        """The paths of some of the designs, without their exact numbers."""
        some = copy.copy(self)
        some.rough = type(self.rough)(*(x[which] if np.ndim(x) else x for x in self.rough))
        return some

    def in_long_doubles(self) -> Path:
        """The path with long doubles for exact numbers, as for many designs."""
        some = copy.copy(self)
        long = (np.longdouble(str(x)) if isinstance(x, Decimal) else x for x in self.exact)
        some.exact = type(self.exact)(*long)
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
    def about(self, sine: Any, cosine: Any) -> Way:
        """The pin's way since the crank stood there, written so that it vanishes there; sine and
        cosine are exact.
        """

    def at(self, phi: Coefficient, order: int) -> tuple[Jet, Jet]:
        """The pin for a crank angle in radians."""
        return self.place(*sin_cos(Jet.variable(phi, order)))
