"""Balls: numbers with an error bound, from Arb (python-flint, the optional extra ``certify``).

A ball holds every number within its radius of its middle. A formula of balls gives a ball that
holds every value of the formula. F. Johansson, "Arb: efficient arbitrary-precision midpoint-radius
interval arithmetic", IEEE Transactions on Computers 66 (2017).
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Sequence
from typing import Self, cast

from flint import arb

from geneva_cli.numerics.arrays import Enclosed, Number
from geneva_cli.numerics.intervals import Undecided


def _operator(f: Callable[[arb, arb], arb]) -> Callable[[Ball, Ball | float], Ball]:
    """An operator of a ball and a number; a jet, for one, brings its own."""

    def operator(x: Ball, y: Ball | float) -> Ball:
        plain = isinstance(y, (Ball, float, int))
        return Ball(f(x.arb, arb_of(y))) if plain else NotImplemented

    return operator


class Ball(Enclosed):
    """A number between two bounds.

    >>> third = Ball.exact(1.0) / 3.0
    >>> third < 0.5, third.bounds()
    (True, (0.33333333333333326, 0.33333333333333337))
    >>> float(third)
    Traceback (most recent call last):
    TypeError: an enclosure is no float
    """

    __slots__ = ("arb",)

    def __init__(self, value: arb) -> None:
        self.arb = value

    @classmethod
    def exact(cls, x: float) -> Self:
        """The ball of one double."""
        return cls(arb(x))

    @classmethod
    def between(cls, a: float, b: float) -> Self:
        """A ball that holds the numbers from a to b."""
        return cls(arb(a).union(arb(b)))

    def bounds(self) -> tuple[float, float]:
        """Doubles below and above every number of it; infinite where there is no bound."""
        return below(self.arb.lower()), -below(-self.arb.upper())

    def piece(self, cuts: Sequence[float]) -> int:
        """Number of the piece between ``cuts`` that holds its middle."""
        # 2^-24 of a radius is rounding: Arb's radii have 30 bits, and each step rounds them up.
        middle, radius = float(self.arb.mid()), float(self.arb.rad()) * (1.0 - 2.0**-24)
        for cut in cuts:
            if radius - abs(cut - middle) > self.REACH:
                raise Undecided
        return bisect_left(cuts, middle)

    def rising(self, f: Callable[[Number], Number]) -> Number:
        """Hull of the values of a function at both ends: all values of one that rises."""
        low, high = (f(cast("float", Ball(x))) for x in (self.arb.lower(), self.arb.upper()))
        return cast("float", Ball(arb_of(low).union(arb_of(high))))

    def __neg__(self) -> Ball:
        return Ball(-self.arb)

    def __abs__(self) -> Ball:
        return Ball(abs(self.arb))

    __add__ = _operator(arb.__add__)
    __sub__ = _operator(arb.__sub__)
    __mul__ = _operator(arb.__mul__)
    __truediv__ = _operator(arb.__truediv__)

    def __pow__(self, power: int) -> Ball:
        return Ball(self.arb**power)

    __radd__, __rmul__ = __add__, __mul__

    def __lt__(self, other: Ball | float) -> bool:
        return _decided(self.arb < arb_of(other), self.arb >= arb_of(other))

    def __le__(self, other: Ball | float) -> bool:
        return _decided(self.arb <= arb_of(other), self.arb > arb_of(other))

    def __eq__(self, other: object) -> bool:
        return _decided(self.arb == arb_of(other), self.arb != arb_of(other))


def _decided(yes: bool, no: bool) -> bool:
    """Return the answer to a comparison; raises Undecided where it is open."""
    if yes == no:
        raise Undecided
    return yes


def arb_of(x: object) -> arb:
    """A formula's number; where the formula does not depend on its balls, it is a double."""
    return x.arb if isinstance(x, Ball) else arb(cast("float", x))


def below(x: arb) -> float:
    """The greatest double that is not above an exact number; without bound for none."""
    if x.is_nan():
        return -math.inf
    near = float(x)
    return near if arb(near) <= x else math.nextafter(near, -math.inf)


def _of_one(f: Callable[[arb], arb]) -> Callable[[object, Ball | float], Ball]:
    return lambda _, x: Ball(f(arb_of(x)))


class _Balls:
    """The functions of ``math``, of balls."""

    sin, cos, sqrt, asin = map(_of_one, (arb.sin, arb.cos, arb.sqrt, arb.asin))

    @property
    def pi(self) -> Ball:
        return Ball(arb.pi())

    def hypot(self, x: Ball, y: Ball) -> Ball:
        return self.sqrt(x**2 + y**2)

    def degrees(self, x: Ball) -> Ball:
        return x * (180.0 / self.pi)

    def copysign(self, x: Ball, y: float) -> Ball:
        return abs(x) if y > 0.0 else -abs(x)

    def atan2(self, y: Ball | float, x: Ball | float) -> Ball:
        return Ball(arb.atan2(arb_of(y), arb_of(x)))


Ball.library = _Balls()
