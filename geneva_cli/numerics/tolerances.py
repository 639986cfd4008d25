"""Tolerances that several files share, each with its unit and its reason.

Doubles carry 2e-16; a formula rounds by some 1e-15 of a size, a search by 1e-13, a chain of parts
by 1e-11. Drawings and tables show 1e-6. Tolerances of equality lie between.
"""

from __future__ import annotations

import math

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
    example, a gap of 0 has the rounding error of its outlines. Raises ValueError for another word.
    """
    slack = max(ROUNDED * abs(limit), noise) if math.isfinite(limit) else 0.0
    if must_be == "at least":
        return value >= limit - slack
    if must_be == "at most":
        return value <= limit + slack
    if must_be == "above":
        return value > limit
    raise ValueError(must_be)


def same(value: object, other: object) -> bool:
    """Return True if two values of a table are equal, numbers apart from rounding."""
    if isinstance(value, float) and isinstance(other, float):
        # a play of 0 degrees has a rounding of 1e-14; the least power of a watch is some 1e-12 W
        return math.isclose(value, other, rel_tol=ROUNDED, abs_tol=1e-13)
    return value == other
