"""Intervals of doubles: two bounds, rounded outwards at each step, for many numbers at once.

With them the rates of a curve are bounded on many cells. Source: R. E. Moore, R. B. Kearfott and M.
J. Cloud, Introduction to Interval Analysis (2009).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import reduce
from typing import TYPE_CHECKING, Any, Self, TypeAlias, cast

import numpy as np

from geneva_cli.numerics.arrays import Array, Enclosed, Number, Truth, Whole

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Jet

    Bound: TypeAlias = Array | float
    Curve: TypeAlias = Callable[[Number, int], tuple[Jet, Jet]]

NEAR = 1e-9  # radians: a peak of the sine this near to an interval counts as inside
TINY = 2.0**-1074  # the least double
LIBRARY_UNITS = 8  # in the last place: more than the error of NumPy's sines on any processor


class Undecided(ArithmeticError):
    """A comparison that holds for some of the numbers between two bounds and not for others.

    Of several enclosures ``answers`` has each one's own, NaN where it is open.
    """

    def __init__(self, answers: Array | float = math.nan) -> None:
        self.answers = answers


def _operator(
    f: Callable[[Interval, Interval | float], Interval],
) -> Callable[[Interval, Interval | float], Interval]:
    """An operator of intervals and numbers; a jet, for one, brings its own."""

    def operator(x: Interval, y: Interval | float) -> Interval:
        plain = isinstance(y, (Interval, float, int, np.ndarray))
        return f(x, y) if plain else NotImplemented

    return operator


class Interval(Enclosed):
    """Numbers, each between two bounds: arrays (n,), or floats for the same bounds of all."""

    __slots__ = ("high", "low")

    def __init__(self, low: Bound, high: Bound) -> None:
        self.low, self.high = low, high

    @classmethod
    def exact(cls, x: float) -> Self:
        return cls(x, x)

    @property
    def size(self) -> Array:
        """The greatest sizes of its numbers; infinite where a bound is unknown."""
        return np.nan_to_num(np.maximum(-self.low, self.high), nan=math.inf, posinf=math.inf)

    def piece(self, cuts: Sequence[float]) -> int:
        numbers = np.ravel(self.pieces(cuts))
        if np.any(numbers != numbers[0]):
            raise Undecided(numbers.astype(float))
        return int(numbers[0])

    def pieces(self, cuts: Sequence[float]) -> Whole:
        inside = [np.minimum(cut - self.low, self.high - cut) > self.REACH for cut in cuts]
        is_open = np.any(inside, axis=0)
        if np.any(is_open):
            raise Undecided(np.where(is_open, math.nan, 0.0))
        return np.searchsorted(cuts, 0.5 * (self.low + self.high))

    def __neg__(self) -> Interval:
        return Interval(-self.high, -self.low)

    def __abs__(self) -> Interval:
        low, high = np.maximum(self.low, -self.high), np.maximum(-self.low, self.high)
        return Interval(np.maximum(low, 0.0), high)

    @_operator
    def __add__(self, other: Interval | float) -> Interval:
        low, high = _ends(other)
        return _outwards(self.low + low, self.high + high)

    @_operator
    def __sub__(self, other: Interval | float) -> Interval:
        low, high = _ends(other)
        return _outwards(self.low - high, self.high - low)

    @_operator
    def __mul__(self, other: Interval | float) -> Interval:
        if other is self:
            return self**2
        low, high = _ends(other)
        return _between(self.low * low, self.low * high, self.high * low, self.high * high)

    @_operator
    def __truediv__(self, other: Interval | float) -> Interval:
        low, high = _ends(other)
        out = _between(self.low / low, self.low / high, self.high / low, self.high / high)
        return _unknown((low <= 0.0) & (high >= 0.0), out)

    def __pow__(self, power: int) -> Interval:
        base = self if power % 2 else abs(self)
        low, high = base.low, base.high
        for _ in range(power - 1):
            low, high = low * base.low, high * base.high
        return _outwards(low, high, power)

    __radd__, __rmul__ = __add__, __mul__

    def __eq__(self, other: object) -> bool:
        raise TypeError("intervals are not compared")


def _ends(x: Interval | float) -> tuple[Bound, Bound]:
    return (x.low, x.high) if isinstance(x, Interval) else (x, x)


def _outwards(low: Bound, high: Bound, units: int = 1) -> Interval:
    """Intervals with some units in the last place on either side."""
    share = units * 2.0**-52  # a unit in the last place of a number, or more
    out = Interval(low - (share * np.abs(low) + TINY), high + (share * np.abs(high) + TINY))
    return _unknown(np.isnan(low + high), out)


def _unknown(where: Truth, x: Interval) -> Interval:
    """Intervals without bounds where they are not known."""
    if not np.any(where):
        return x
    return Interval(np.where(where, -math.inf, x.low), np.where(where, math.inf, x.high))


def _between(*ends: Bound) -> Interval:
    """Intervals of all numbers between the least and the greatest of some."""
    return _outwards(reduce(np.minimum, ends), reduce(np.maximum, ends))


class _Intervals:
    """The functions of ``math`` that curves need, of intervals."""

    pi = _outwards(math.pi, math.pi)

    def sqrt(self, x: Interval | float) -> Interval:
        low, high = _ends(x)
        with np.errstate(invalid="ignore"):  # no bound where it reaches below 0
            return _outwards(np.sqrt(low), np.sqrt(high))

    def hypot(self, x: Interval, y: Interval) -> Interval:
        return self.sqrt(x**2 + y**2)

    def cos(self, x: Interval | float) -> Interval:
        return self._wave(x, 0.0, np.cos)

    def sin(self, x: Interval | float) -> Interval:
        return self._wave(x, 0.5 * math.pi, np.sin)

    def _wave(self, x: Interval | float, top: float, f: Callable[[Bound], Bound]) -> Interval:
        """Sine or cosine, which is 1 at ``top``."""
        low, high = _ends(x)
        values = f(low), f(high)
        ends = _outwards(np.minimum(*values), np.maximum(*values), LIBRARY_UNITS)
        whole = ~np.less(high - low, math.tau)  # of all values: a turn, or without bounds
        lowest = _passes(low, high, top + math.pi) | whole
        highest = _passes(low, high, top) | whole
        return Interval(
            np.where(lowest, -1.0, np.maximum(ends.low, -1.0)),
            np.where(highest, 1.0, np.minimum(ends.high, 1.0)),
        )


def _passes(low: Bound, high: Bound, at: float) -> Truth:
    """True where ``at``, or a whole number of turns from there, may lie between two angles."""
    below = np.floor((high + NEAR - at) / math.tau) * math.tau + at
    return np.greater_equal(below, low - NEAR)


Interval.library = _Intervals()


def curve_rates(curve: Curve, start: Array, end: Array) -> Array:
    """Return the greatest sizes of a curve's derivatives on n cells (2, n); infinite if unknown.

    Where another formula takes over within a cell, it is halved down to that place.
    """
    rates, tries = np.zeros((2, len(start))), np.zeros(len(start), dtype=int)
    left = [(np.arange(len(start)), start, end)]  # parts of cells: each one's cell, and its ends
    while left:
        part = left.pop()
        # an interval may reach over the end of a formula's piece by some 1e-12 degrees: each such
        # place takes 80 halves
        few = tries[part[0]] < 400
        cell, low, high = part[0][few], part[1][few], part[2][few]
        if not len(cell):
            continue
        try:
            with np.errstate(all="ignore"):
                x, y = curve(cast("Number", Interval(low, high)), 2)
        except Undecided as error:
            answers = np.broadcast_to(error.answers, len(cell))
            for one in sorted(set(answers[~np.isnan(answers)].tolist())):
                some = answers == one
                left.append((cell[some], low[some], high[some]))
            some = np.isnan(answers)
            cell, low, high = cell[some], low[some], high[some]
            half = 0.5 * (low + high)
            left.append((np.tile(cell, 2), np.append(low, half), np.append(half, high)))
        else:
            for k, total in enumerate(rates, start=1):
                both: tuple[Any, ...] = (x.c[k], y.c[k])  # intervals, or doubles that need none
                sizes = [one.size if isinstance(one, Interval) else abs(one) for one in both]
                np.maximum.at(total, cell, k * np.hypot(*sizes))
        np.add.at(tries, cell, 1)
    rates[:, tries >= 400] = math.inf
    return rates
