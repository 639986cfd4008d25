"""Intervals of doubles: two bounds, rounded outwards at each step.

A formula of intervals gives an interval that holds every value of the formula. It is wider than a
ball of Arb (``balls``), and needs no library. It never becomes a float, and never answers a
comparison that it cannot decide.

R. E. Moore, R. B. Kearfott and M. J. Cloud, Introduction to Interval Analysis (2009).
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Sequence
from typing import ClassVar, NoReturn, cast

from geneva_cli.numerics.arrays import Enclosed, Library, Number, Undecided

NEAR = 1e-9  # radians: a peak of the sine this near to an interval counts as inside
TINY = 2.0**-1074  # the least double
LIBRARY_UNITS = 2  # in the last place: greatest error of a function of ``math``


class Interval(Enclosed):
    """A number between two bounds.

    >>> third = Interval(1.0, 1.0) / 3.0
    >>> third.low < 1.0 / 3.0 < third.high, third < 0.5
    (True, True)
    """

    __slots__ = ("high", "low")
    __array_ufunc__ = None  # NumPy's numbers leave the arithmetic to the interval
    library: ClassVar[Library]

    def __init__(self, low: float, high: float) -> None:
        self.low, self.high = low, high

    @property
    def size(self) -> float:
        """The greatest size of its numbers; infinite where a bound is unknown."""
        size = max(-self.low, self.high)
        return math.inf if math.isnan(size) else size

    def piece(self, cuts: Sequence[float]) -> int:
        """Number of the piece between ``cuts`` that holds its middle.

        Raises Undecided if it reaches over a cut by more than ``REACH``.
        """
        for cut in cuts:
            if min(cut - self.low, self.high - cut) > self.REACH:
                raise Undecided(f"the cut {cut!r} is inside {self!r}")
        return bisect_left(cuts, 0.5 * (self.low + self.high))

    def rising(self, f: Callable[[Number], Number]) -> Number:
        """Interval of the values of a function that rises: from its lower end to its upper."""
        low, high = (_ends(cast("float", f(_number(x, x)))) for x in (self.low, self.high))
        return _number(low[0], high[1])

    def __repr__(self) -> str:
        return f"Interval({self.low!r}, {self.high!r})"

    def __float__(self) -> NoReturn:
        raise TypeError("an interval is no float")

    def __bool__(self) -> NoReturn:
        raise TypeError("an interval has no truth value")

    def __neg__(self) -> Interval:
        return Interval(-self.high, -self.low)

    def __abs__(self) -> Interval:
        if self.low < 0.0 < self.high:
            return Interval(0.0, max(-self.low, self.high))
        return self if self.low >= 0.0 else -self

    def __add__(self, other: Interval | float) -> Interval:
        low, high = _ends(other)
        return _outwards(self.low + low, self.high + high)

    def __sub__(self, other: Interval | float) -> Interval:
        low, high = _ends(other)
        return _outwards(self.low - high, self.high - low)

    def __rsub__(self, other: Interval | float) -> Interval:
        return -(self - other)

    def __mul__(self, other: Interval | float) -> Interval:
        if other is self:
            return self**2
        low, high = _ends(other)
        ends = self.low * low, self.low * high, self.high * low, self.high * high
        return _outwards(min(ends), max(ends))

    def __truediv__(self, other: Interval | float) -> Interval:
        low, high = _ends(other)
        if low <= 0.0 <= high:
            return Interval(-math.inf, math.inf)
        ends = self.low / low, self.low / high, self.high / low, self.high / high
        return _outwards(min(ends), max(ends))

    def __rtruediv__(self, other: Interval | float) -> Interval:
        return Interval(*_ends(other)) / self

    def __pow__(self, power: int) -> Interval:
        if power < 0:
            return 1.0 / self**-power
        base = self if power % 2 else abs(self)
        return _outwards(base.low**power, base.high**power, power)

    __radd__, __rmul__ = __add__, __mul__

    def __lt__(self, other: Interval | float) -> bool:
        low, high = _ends(other)
        return self._decided(self.high < low, self.low >= high, other)

    def __le__(self, other: Interval | float) -> bool:
        low, high = _ends(other)
        return self._decided(self.high <= low, self.low > high, other)

    def __gt__(self, other: Interval | float) -> bool:
        return not self <= other

    def __ge__(self, other: Interval | float) -> bool:
        return not self < other

    def __eq__(self, other: object) -> bool:
        low, high = _ends(cast("float", other))
        equal = self.low == self.high == low == high
        return self._decided(equal, self.high < low or self.low > high, other)

    __hash__ = None  # type: ignore[assignment]


def _ends(x: Interval | float) -> tuple[float, float]:
    return (x.low, x.high) if isinstance(x, Interval) else (x, x)


def _number(low: float, high: float) -> float:
    """An interval as the float that it is to the type checker."""
    return cast("float", Interval(low, high))


def _outwards(low: float, high: float, units: int = 1) -> Interval:
    """An interval with some units in the last place on either side."""
    if math.isnan(low) or math.isnan(high):
        return Interval(-math.inf, math.inf)
    share = units * 2.0**-52  # a unit in the last place of a number, or more
    return Interval(low - (share * abs(low) + TINY), high + (share * abs(high) + TINY))


def _rising(f: Callable[[float], float]) -> Callable[[object, Interval | float], Interval]:
    """A function that rises everywhere in its domain."""

    def of(_: object, x: Interval | float) -> Interval:
        try:
            low, high = (f(end) for end in _ends(x))
        except (ValueError, OverflowError):
            return Interval(-math.inf, math.inf)
        return _outwards(low, high, LIBRARY_UNITS)

    return of


class _Intervals:
    """The functions of ``math``, of intervals."""

    sqrt, exp, asin = map(_rising, (math.sqrt, math.exp, math.asin))
    pi = _outwards(math.pi, math.pi)

    def acos(self, x: Interval | float) -> Interval:
        return self.pi / 2.0 - self.asin(x)

    def cos(self, x: Interval | float) -> Interval:
        return self._wave(x, 0.0, math.cos)

    def sin(self, x: Interval | float) -> Interval:
        return self._wave(x, 0.5 * math.pi, math.sin)

    def _wave(self, x: Interval | float, top: float, f: Callable[[float], float]) -> Interval:
        """Sine or cosine, which is 1 at ``top``."""
        low, high = _ends(x)
        if not high - low < math.tau:
            return Interval(-1.0, 1.0)
        ends = _outwards(min(f(low), f(high)), max(f(low), f(high)), LIBRARY_UNITS)
        return Interval(
            -1.0 if _passes(low, high, top + math.pi) else max(ends.low, -1.0),
            1.0 if _passes(low, high, top) else min(ends.high, 1.0),
        )

    def hypot(self, x: Interval | float, y: Interval | float) -> Interval:
        return self.sqrt(Interval(*_ends(x)) ** 2 + Interval(*_ends(y)) ** 2)

    def atan2(self, y: Interval | float, x: Interval | float) -> Interval:
        """The angle of a box that does not reach the negative x axis."""
        (a, b), (c, d) = _ends(x), _ends(y)
        if a <= 0.0 and c <= 0.0 <= d:
            raise Undecided("the origin, or the negative x axis, is inside")
        angles = [math.atan2(v, u) for u in (a, b) for v in (c, d)]
        return _outwards(min(angles), max(angles), LIBRARY_UNITS)

    def degrees(self, x: Interval | float) -> Interval:
        return x * (180.0 / self.pi)

    def floor(self, x: Interval) -> float:
        low, high = math.floor(x.low), math.floor(x.high)
        if low != high:
            raise Undecided(f"a whole number is inside {x!r}")
        return float(low)

    def copysign(self, x: Interval | float, y: Interval | float) -> Interval:
        size = abs(Interval(*_ends(x)))
        return size if y > 0.0 else -size


def _passes(low: float, high: float, at: float) -> bool:
    """True if ``at``, or a whole number of turns from there, may lie between two angles."""
    below = math.floor((high + NEAR - at) / math.tau) * math.tau + at
    return below >= low - NEAR


Interval.library = cast("Library", _Intervals())


def size_of(x: Number) -> float:
    """The greatest size of a formula's number: an interval, or a double that needs none."""
    return x.size if isinstance(x, Interval) else abs(cast("float", x))
