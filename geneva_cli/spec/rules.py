"""Rules for values in the spec, each written once next to its key; ranges as text."""

import math
import sys
from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple

from geneva_cli.errors import GenevaError

# Least size of a number but 0. Smaller ones lose their digits, and all of them in a product.
TINY = 1e-300


class Range(NamedTuple):
    """Numbers from ``low`` to ``high``, 0 or at least ``TINY`` in size.

    A round bracket in ``ends`` excludes that end. ``words`` may stand for a computed number.
    """

    low: float
    high: float
    ends: str = "[]"
    words: tuple[str, ...] = ()

    def __contains__(self, x: object) -> bool:
        return isinstance(x, (int, float)) and bool(self.holds(x))

    def holds(self, x: Any) -> Any:
        """True if a number is in the range; for an array, a truth value for each number."""
        above = self.low < x if self.ends[0] == "(" else self.low <= x
        below = x < self.high if self.ends[1] == ")" else x <= self.high
        return above & below & ((x == 0) | (abs(x) >= TINY))

    def __str__(self) -> str:
        low = f"{'above' if self.ends[0] == '(' else 'at least'} {self.low:.12g}"
        high = f"{'below' if self.ends[1] == ')' else 'at most'} {self.high:.12g}"
        text = f"{low}, {high}"
        if 0.0 < self.low < 1e-6:  # a bound that only keeps the arithmetic finite
            text = f"above 0 ({self.low:g} to {self.high:g})"
        for number, word in enumerate(self.words):
            text += f'{"" if number else ","} or "{word}"'
        return text


class OneOf(tuple[str, ...]):
    """A word from a list."""

    __slots__ = ()

    def __str__(self) -> str:
        return "one of " + ", ".join(f'"{word}"' for word in self)


class Csv:
    """Pairs u,s from a CSV file, u ascending; the key ``file`` names it in the spec."""

    STEP_MIN = 0.9e-4  # least step of u: closer points make a spline of rounding errors
    SIZE_MAX = 10.0  # of s
    POINTS_MIN = 6

    def __str__(self) -> str:
        return 'such as "points.csv"'

    def fault(self, pairs: Sequence[tuple[float, float]], i: int) -> str:
        """Fault of the i-th pair, compared with the one before it; empty if it is valid."""
        u, s = pairs[i]
        if not (math.isfinite(u) and abs(s) <= self.SIZE_MAX):
            return f"u and s must be finite, s from -{self.SIZE_MAX:g} to {self.SIZE_MAX:g}"
        if i and u < pairs[i - 1][0] + self.STEP_MIN:
            return (
                f"u = {u:.12g} must exceed the one before it by at least {self.STEP_MIN:g}: "
                "use fewer points, since derivatives of closer ones are rounding"
            )
        return ""


POSITIVE = Range(1e-12, 1e12)
NOT_NEGATIVE = Range(0.0, 1e12)
SPEED = Range(1e-9, 1e9)
LENGTH = Range(-1e12, 1e12)
TOOL_MM = Range(0.0, 1000.0, "(]")  # kerfs and cutters: no beam, no milling cutter is wider
Z_MAX = 1_000_000  # most slots (and rollers) that are computed
# types of usual keys
Positive = Annotated[float | None, POSITIVE]
NotNegative = Annotated[float | None, NOT_NEGATIVE]
FromZero = Annotated[float, NOT_NEGATIVE]
Height = Annotated[float | None, LENGTH]


def require_mm(option: str, value: float, allowed: Range, of: str = "") -> None:
    """Raise GenevaError, naming the option, for millimetres outside of their range.

    ``of`` says what the range's upper end is.
    """
    if value not in allowed:
        raise GenevaError(f"{option} {value:g}: must be {allowed} mm{of and f', {of}'}")


def plain(x: Any) -> Any:
    """Return a scalar of NumPy as the number, word or truth value of Python that it is."""
    numpy = sys.modules.get("numpy")
    generic = vars(numpy).get("generic") if numpy else None
    return x.item() if generic is not None and isinstance(x, generic) else x


def is_array(x: object) -> bool:
    """True if it is a NumPy array; NumPy is not imported for this check.

    Another thread may be importing NumPy now. Before its module has the class, no array exists.
    """
    numpy = sys.modules.get("numpy")
    array = vars(numpy).get("ndarray") if numpy else None
    return array is not None and isinstance(x, array)


def range_text(text: str, option: str) -> tuple[str, str, str] | None:
    """Return both ends and the step of a range; None for a text without ``..``.

    A part that is left out is empty. ``option``, with its value, begins the text of errors. Raises
    GenevaError for a step without its range, or without a number.
    """
    ends, colon, step = text.partition(":")
    low, dots, high = ends.partition("..")
    if colon and not (dots and step.strip()):
        raise GenevaError(f"{option}: a range is LOW..HIGH:STEP or LOW..HIGH, as 0..0.9:0.1")
    return (low.strip(), high.strip(), step.strip()) if dots else None
