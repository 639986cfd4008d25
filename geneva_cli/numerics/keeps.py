"""The comparison of a value with its limit, for all checks."""

from __future__ import annotations

import math

from geneva_cli.numerics.tolerances import ROUNDED


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
