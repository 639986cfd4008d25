"""A required number, or a range of it: ``0.8``, ``1/3``, ``0.8..``, ``1..2``."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.numerics.tolerances import ROUNDED


class AllowedSpan(NamedTuple):
    """All numbers from ``low`` to ``high``, both included; one number if they are equal."""

    low: float = -math.inf
    high: float = math.inf

    @property
    def exact(self) -> bool:
        """Return True for a single number."""
        return self.low == self.high

    @property
    def empty(self) -> bool:
        """Return True if no number is in it."""
        return not self.low <= self.high

    def over(self, other: AllowedSpan) -> AllowedSpan:
        """The range of a/b, for positive a of this range and b of the other."""
        low = self.low / other.high if math.isfinite(other.high) else 0.0
        high = self.high / other.low if other.low > 0.0 else math.inf
        return AllowedSpan(max(low, 0.0), high)

    def mirrored(self, whole: float) -> AllowedSpan:
        """The range of ``whole`` less a number."""
        return AllowedSpan(whole - self.high, whole - self.low)

    def times(self, factor: float) -> AllowedSpan:
        """The range of a positive multiple."""
        return AllowedSpan(self.low * factor, self.high * factor)

    def within(self, other: AllowedSpan) -> AllowedSpan:
        """The common part of two ranges; numbers that differ only by rounding are equal.

        >>> AllowedSpan(1.0, 3.0).within(AllowedSpan(2.0, 4.0))
        AllowedSpan(low=2.0, high=3.0)
        """
        low, high = max(self.low, other.low), min(self.high, other.high)
        if low > high and math.isclose(low, high, rel_tol=ROUNDED):
            return self if self.exact else other if other.exact else AllowedSpan(low, low)
        return AllowedSpan(low, high)

    def words(self, what: str, unit: str = "") -> str:
        """The requirement in words: ``a dwell of at least 0.8 s``."""
        if self.exact:
            return f"{what} {self.low:.7g}{unit}"
        if not self.low > -math.inf:
            return f"{what} at most {self.high:.7g}{unit}"
        if not self.high < math.inf:
            return f"{what} at least {self.low:.7g}{unit}"
        return f"{what} {self.low:.7g} to {self.high:.7g}{unit}"
