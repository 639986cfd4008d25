"""Tolerances that several files share, each with its unit and its reason; and rounded sizes.

Doubles carry 2e-16; a formula rounds by some 1e-15 of a size, a search by 1e-13, a chain of parts
by 1e-11. Drawings and tables show 1e-6. Tolerances of equality lie between. Default sizes are
rounded numbers, or bores of standard bearings.
"""

import math
from bisect import bisect_right
from collections.abc import Callable
from itertools import product, starmap

from geneva_cli.numerics.angles import of_each
from geneva_cli.numerics.arrays import SINGLE, Array, N, Number, choose, larger

# Fraction of the centre distance, or of a sphere's radius: lengths and places nearer to each other
# are equal. 1e-7 mm of 100 mm is the size of an atom, and a hundred times the rounding of a chain.
SAME_LENGTH = 1e-9

# Radians, or a cosine near 0: directions nearer to each other are equal; SAME_LENGTH as an angle.
SAME_ANGLE = 1e-9

# Degrees: input angles nearer to each other are equal; angles are shown to 1e-6.
SAME_INPUT_DEG = 1e-9

# Fraction of a quantity's greatest size, or of a limit: smaller differences are rounding. Values
# are computed to 1e-12 or so, loads (by search) to 1e-10, and nobody can measure a billionth.
ROUNDED = 1e-9

# Fraction of a peak's size: two peaks that differ by less are equal. Jets err by up to 31 units in
# the last place, 7e-15; for a product of two factors, ten times that is safe.
TIE = 1e-13

# mm or radians on a drawing sheet: lines, radii, centres and directions nearer to each other are
# equal; no plotter shows the difference.
SAME_ON_SHEET = 1e-6

# mm: a cutter as wide as a slot by this much enters it, and a path this near to a part does not cut
# it: a thousandth of a machine's accuracy.
SAME_CUT_MM = 1e-5


def keeps(value: float, must_be: str, limit: float, noise: float = 0.0) -> bool:
    """Return True if a value is "at least", "at most" or "above" a limit, apart from rounding.

    ``noise`` is the rounding error of the value itself, if that is larger than the limit's. For
    example, a gap of 0 has the rounding error of its outlines.
    """
    slack = choose(abs(limit) < math.inf, larger(ROUNDED * abs(limit), noise), 0.0)
    if must_be == "at least":
        return value >= limit - slack
    if must_be == "at most":
        return value <= limit + slack
    return value > limit


def same(value: object, other: object) -> bool:
    """Return True if two values of a table are equal, numbers apart from rounding."""
    if isinstance(value, float) and isinstance(other, float):
        # a play of 0 degrees has a rounding of 1e-14; the least power of a watch is some 1e-12 W
        return math.isclose(value, other, rel_tol=ROUNDED, abs_tol=1e-13)
    return value == other


# Rounded numbers of all decades of sizes, 10 to 90 times each power of ten.
_TENS = (10, 11, 12, 14, 16, 18, 20, 22, 25, 28, 30, 35, 40, 45, 50, 55, 60, 70, 80, 90)
_ROUNDED = [*map(float, starmap("{1}e{0}".format, product(range(-20, 16), _TENS)))]
# Bores of radial bearings by ISO 15, mm.
_SMALL = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 12.0, 15.0, 17.0)
_LARGE = (*range(20, 110, 5), *range(110, 200, 10), *range(200, 501, 20))
_BORES = [*_SMALL, *map(float, _LARGE)]


def rounded_below(most: N) -> N:
    """Return the greatest rounded number up to ``most``, of the series R''20 of ISO 497; or 0."""
    if isinstance(most, SINGLE):
        i = bisect_right(_ROUNDED, most * (1.0 + ROUNDED))
        return _ROUNDED[i - 1] if i else 0.0
    import numpy as np

    numbers = np.array([0.0, *_ROUNDED])
    rounded: Array = numbers[np.searchsorted(_ROUNDED, most * (1.0 + ROUNDED), "right")]
    return rounded


def sizes_from(least: float, most: float, bores: bool = False) -> list[float]:
    """Return ``least``, and after it the rounded numbers up to ``most``.

    Of ``bores`` those of standard bearings, where both are in their range, mm.
    """
    sizes: list[float] = trials_from(least, most, bores)[0].tolist()
    return sizes


def trials_from(least: Number, most: Number, bores: bool = False) -> Array:
    """Return the numbers of ``sizes_from`` of m designs, (m, k), from numbers or (m, 1).

    The last one of a design fills its row.
    """
    import numpy as np

    least, most = np.atleast_2d(least), np.atleast_2d(most)
    within = (_BORES[0] <= least) & (least <= most) & (most <= _BORES[-1]) & bores
    # the numbers up to both ends, of the two series one behind the other
    ends = np.stack(np.broadcast_arrays(least, most)) * (1.0 + ROUNDED)
    of_bores = len(_ROUNDED) + np.searchsorted(_BORES, ends, "right")
    below, upto = np.where(within, of_bores, np.searchsorted(_ROUNDED, ends, "right"))
    count = np.where((least > 0.0) & (least < most), upto - below, 0)
    k = np.minimum(np.arange(count.max() + 1), count)
    numbers = np.array([*_ROUNDED, *_BORES])
    return np.where(k > 0, numbers[np.maximum(below + k - 1, 0)], least)


def rounded_radius(most: N) -> N:
    """Return the radius up to ``most`` whose diameter is a rounded number; or 0."""
    return 0.5 * rounded_below(2.0 * most)


def bore_radius(most: float) -> float:
    """Return the radius up to ``most`` mm of a standard bearing's bore; or 0."""
    if not isinstance(most, SINGLE):
        return of_each(lambda radius: (bore_radius(radius),), most)[0]
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
