"""Round numbers for an axis, and their text."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geneva_cli.figure import Axis, Mark
from geneva_cli.numerics.tolerances import ROUNDED

SHOWN_DIGITS = 6  # a peak's value has these; an axis has more if labels are equal


def ticks(low: float, high: float, most: int, unit: str = "") -> list[float]:
    """Multiples of a round step from ``low`` to ``high``, about ``most`` and never more.

    >>> ticks(-0.3, 1.2, 5), ticks(-60.0, 300.0, 9, "deg")
    ([0.0, 0.5, 1.0], [-45.0, 0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0])
    """
    width = high - low
    if not width > 0.0:
        return [low]
    power = 10.0 ** math.floor(math.log10(width / most))
    steps = [n * power for n in (1.0, 2.0, 2.5, 5.0, 10.0, 20.0, 25.0, 50.0, 100.0)]
    if unit == "deg" and width > 40.0:
        steps = [5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0]  # degrees that people use
        steps += [360.0 * 2**n for n in range(60)]
    for step in steps:
        first, last = math.ceil(low / step - ROUNDED), math.floor(high / step + ROUNDED)
        if last - first < most:
            break
    return [float(f"{n * step:.12g}") + 0.0 for n in range(first, last + 1)]


def labels(at: Sequence[float]) -> list[str]:
    """The numbers of an axis, with enough digits that no two are equal.

    >>> labels([0.0, 0.5, 1.0]), labels([0.0, 2e9]), labels([1e7, 1e7 + 0.5])
    (['0', '0.5', '1'], ['0', '2e+09'], ['10000000', '10000000.5'])
    """
    texts: list[str] = []
    for digits in range(SHOWN_DIGITS, 18):
        texts = [f"{x:.{digits}g}" for x in at]
        if len(set(texts)) == len(set(at)):
            break
    return texts


def named(axis: Axis) -> str:
    """An axis with its unit, such as ``Pin force (N)``."""
    return f"{axis.label} ({axis.unit.replace('deg', '°')})" if axis.unit else axis.label


def mark_text(mark: Mark, unit: str = "°") -> str:
    """A mark as text: its value and its place.

    >>> mark_text(Mark("max", -22.903061866, 649.007123))
    'max 649.007 at -22.90°'
    """
    # A larger place is written with an exponent.
    at = f"{mark.x:.2f}" if abs(mark.x) < 1e5 else f"{mark.x:.{SHOWN_DIGITS}g}"
    at = "0.00" if at == "-0.00" else at
    value = "no bound" if mark.y is None else f"{mark.word} {mark.y + 0.0:.{SHOWN_DIGITS}g}"
    return f"{value} at {at}{unit}"
