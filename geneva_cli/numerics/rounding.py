"""Numbers rounded to some significant digits."""

from __future__ import annotations

import math
from collections.abc import Callable


def to_digits(value: float, digits: int, way: Callable[[float], int]) -> float:
    """Return a value with some significant digits; 0 for a value that is not above 0.

    ``way`` is ``math.floor``, ``math.ceil`` or ``round``.

    >>> to_digits(0.12378, 3, math.floor), to_digits(0.12378, 3, math.ceil)
    (0.123, 0.124)
    """
    if value <= 0.0:
        return 0.0
    unit = 10.0 ** (math.floor(math.log10(value)) + 1 - digits)
    return float(f"{unit * way(value / unit):.{digits}g}")
