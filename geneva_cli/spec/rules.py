"""What a value in the spec may be, stated once beside its key."""

from __future__ import annotations

import math
from typing import NamedTuple


class Range(NamedTuple):
    """Numbers from ``low`` to ``high``; a round bracket in ``ends`` leaves that end out."""

    low: float
    high: float = math.inf
    ends: str = "[]"

    def __contains__(self, x: object) -> bool:
        if not isinstance(x, (int, float)):
            return False
        above = self.low < x if self.ends[0] == "(" else self.low <= x
        return above and (x < self.high if self.ends[1] == ")" else x <= self.high)

    def __str__(self) -> str:
        if math.isinf(self.low) and math.isinf(self.high):
            return "a finite number"
        if 0.0 < self.low < 1e-6:  # a bound that is there only to keep the arithmetic finite
            return f"above 0 ({self.low:g} to {self.high:g})"
        low = f"{'above' if self.ends[0] == '(' else 'at least'} {self.low:.12g}"
        high = f"{'below' if self.ends[1] == ')' else 'at most'} {self.high:.12g}"
        return low if math.isinf(self.high) else high if math.isinf(self.low) else f"{low}, {high}"


class OneOf(tuple[str, ...]):
    """A word from a list."""

    __slots__ = ()

    def __str__(self) -> str:
        return "one of " + ", ".join(f'"{word}"' for word in self)


POSITIVE = Range(1e-12, 1e12)
NOT_NEGATIVE = Range(0.0, 1e12)
SPEED = Range(1e-9, 1e9)
LENGTH = Range(-1e12, 1e12)
FINITE = Range(-math.inf, math.inf, "()")

Z_MAX = 1_000_000  # most slots (and rollers) that are computed
