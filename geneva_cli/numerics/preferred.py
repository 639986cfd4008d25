"""Preferred numbers for default sizes: bores of standard bearings, and rounded numbers."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable
from functools import cache

from geneva_cli.numerics.tolerances import ROUNDED


def rounded_below(most: float) -> float:
    """Return the greatest rounded number up to ``most``, of the series R''20 of ISO 497; or 0."""
    numbers = _rounded()
    i = bisect_right(numbers, most * (1.0 + ROUNDED))
    return numbers[i - 1] if i else 0.0


def rounded_from(least: float, most: float) -> list[float]:
    """Return ``least``, and after it the rounded numbers up to ``most``."""
    return _from(_rounded(), least, most)


def bores_from(least: float, most: float) -> list[float]:
    """Return ``least``, and after it the bores of standard bearings up to ``most`` mm."""
    bores = _bores()
    return _from(bores if bores[0] <= least <= most <= bores[-1] else _rounded(), least, most)


def _from(numbers: tuple[float, ...], least: float, most: float) -> list[float]:
    if not 0.0 < least < most:
        return [least]
    first, end = (bisect_right(numbers, x * (1.0 + ROUNDED)) for x in (least, most))
    return [least, *numbers[first:end]]


def rounded_radius(most: float) -> float:
    """Return the radius up to ``most`` whose diameter is a rounded number; or 0."""
    return 0.5 * rounded_below(2.0 * most)


def bore_radius(most: float) -> float:
    """Return the radius up to ``most`` mm of a standard bearing's bore; or 0."""
    bores, widest = _bores(), 2.0 * most
    if not bores[0] <= widest <= bores[-1]:
        return rounded_radius(most)
    return 0.5 * bores[bisect_right(bores, widest * (1.0 + ROUNDED)) - 1]


@cache
def _rounded() -> tuple[float, ...]:
    """Return the rounded numbers of all decades of sizes, 10 to 90 times each power of ten."""
    tens = (10, 11, 12, 14, 16, 18, 20, 22, 25, 28, 30, 35, 40, 45, 50, 55, 60, 70, 80, 90)
    return tuple(float(f"{n}e{power}") for power in range(-20, 16) for n in tens)


@cache
def _bores() -> tuple[float, ...]:
    """Return the bores of radial bearings by ISO 15, mm, from 1 to 500."""
    small = (1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 17)
    large = (*range(20, 110, 5), *range(110, 200, 10), *range(200, 501, 20))
    return tuple(float(d) for d in (*small, *large))


def to_digits(value: float, digits: int, way: Callable[[float], int]) -> float:
    """Return a value with some significant digits; 0 for a value that is not above 0.

    ``way`` is ``math.floor``, ``math.ceil`` or ``round``.
    """
    if value <= 0.0:
        return 0.0
    unit = 10.0 ** (math.floor(math.log10(value)) + 1 - digits)
    return float(f"{unit * way(value / unit):.{digits}g}")
