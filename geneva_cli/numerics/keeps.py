"""The comparison of a value with its limit, which all checks share."""

from __future__ import annotations

import math

from geneva_cli.numerics.tolerances import ROUNDED


def keeps(value: float, must_be: str, limit: float, noise: float = 0.0) -> bool:
    """Whether a value is "at least", "at most" or "above" a limit, but for rounding.

    ``noise`` is the rounding of the value itself, where that is larger than the limit's (a gap
    that should be 0 is known as nearly as the outlines are). Raises ValueError for another word.
    """
    slack = max(ROUNDED * abs(limit), noise) if math.isfinite(limit) else 0.0
    if must_be == "at least":
        return value >= limit - slack
    if must_be == "at most":
        return value <= limit + slack
    if must_be == "above":
        return value > limit
    raise ValueError(must_be)
