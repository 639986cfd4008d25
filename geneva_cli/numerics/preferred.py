"""Preferred numbers for default sizes: bores of standard bearings, and rounded numbers."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable

from geneva_cli.numerics.tolerances import ROUNDED

# Rounded numbers of all decades of sizes, 10 to 90 times each power of ten.
_TENS = (10, 11, 12, 14, 16, 18, 20, 22, 25, 28, 30, 35, 40, 45, 50, 55, 60, 70, 80, 90)
_ROUNDED = list[float]()
for _power in range(-20, 16):
    for _n in _TENS:
        _ROUNDED.append(float(f"{_n}e{_power}"))
# Bores of radial bearings by ISO 15, mm.
_SMALL = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 12.0, 15.0, 17.0)
_LARGE = map(float, (*range(20, 110, 5), *range(110, 200, 10), *range(200, 501, 20)))
_BORES = [*_SMALL, *_LARGE]


def rounded_below(most: float) -> float:
    """Return the greatest rounded number up to ``most``, of the series R''20 of ISO 497; or 0."""
    i = bisect_right(_ROUNDED, most * (1.0 + ROUNDED))
    return _ROUNDED[i - 1] if i else 0.0


def sizes_from(least: float, most: float, bores: bool = False) -> list[float]:
    """Return ``least``, and after it the rounded numbers up to ``most``.

    Of ``bores`` those of standard bearings, where both are in their range, mm.
    """
    numbers = _BORES if bores and _BORES[0] <= least <= most <= _BORES[-1] else _ROUNDED
    if not 0.0 < least < most:
        return [least]
    first = bisect_right(numbers, least * (1.0 + ROUNDED))
    return [least, *numbers[first : bisect_right(numbers, most * (1.0 + ROUNDED))]]


def rounded_radius(most: float) -> float:
    """Return the radius up to ``most`` whose diameter is a rounded number; or 0."""
    return 0.5 * rounded_below(2.0 * most)


def bore_radius(most: float) -> float:
    """Return the radius up to ``most`` mm of a standard bearing's bore; or 0."""
    widest = 2.0 * most
    if not _BORES[0] <= widest <= _BORES[-1]:
        return 0.5 * rounded_below(widest)
    return 0.5 * _BORES[bisect_right(_BORES, widest * (1.0 + ROUNDED)) - 1]


def to_digits(value: float, digits: int, way: Callable[[float], int]) -> float:
    """Return a value with some significant digits; 0 for a value that is not above 0.

    ``way`` is ``math.floor``, ``math.ceil`` or ``round``.
    """
    if value <= 0.0:
        return 0.0
    unit = 10.0 ** (math.floor(math.log10(value)) + 1 - digits)
    return float(f"{unit * way(value / unit):.{digits}g}")
