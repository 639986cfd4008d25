"""Values of a varied key: ``4,6,8``, ``3..12``, ``0..0.9:0.01``, words, or a span."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from decimal import Decimal, InvalidOperation
from typing import NamedTuple, TypeAlias, overload

from geneva_cli.errors import GenevaError, cut
from geneva_cli.specfile.keys import is_whole
from geneva_cli.specfile.settings import Setting, read_value
from geneva_cli.study.ranges import RangeText, range_text

Value: TypeAlias = float | int | str
POINTS_MAX = 100_000_000  # rows of a sweep: some hours and some gigabytes
MIXED_MAX = 1_000_000  # values of a list that contains ranges, all of which are in memory
_WHOLE = re.compile(r"[+-]?\d{1,99}")


class VariedKey(NamedTuple):
    """A varied key and its values in order; a ``span`` means all numbers between two."""

    key: str  # table.key, as in the spec
    values: Sequence[Value]
    span: bool = False

    def __contains__(self, value: object) -> bool:
        """Return True for one of the values, or for a number between the ends of a span."""
        if not self.span:
            return value in self.values
        low, high = map(float, self.values)
        return isinstance(value, float | int) and low <= value <= high


def axis(text: str, random: bool = False) -> VariedKey:
    """Return the varied key and its values from a text ``KEY=VALUES``.

    With ``random`` values are drawn, and LOW..HIGH of a key that takes fractions is a span. Raises
    GenevaError, naming the option, for another text.

    >>> list(axis("drive.A=0..0.9:0.3").values)
    [0.0, 0.3, 0.6, 0.9]
    """
    key, sign, values = text.partition("=")
    said = f"--vary {cut(text.strip())}"
    if not sign or not values.strip() or "." not in key.strip().strip("."):
        raise GenevaError(f"{said}: it must be TABLE.KEY=VALUES, as in --vary drive.A=0..0.9:0.1")
    return _axis(key.strip(), values.strip().strip('"'), said, random)


def refuse_twice(axes: Sequence[VariedKey], given: Sequence[Setting]) -> None:
    """Raise GenevaError for a key that is varied twice, or both varied and set."""
    keys = [a.key for a in axes]
    twice = next((k for k in keys if keys.count(k) > 1), None)
    if twice:
        raise GenevaError(f"--vary {cut(twice)}: given twice; put all its values into one")
    for one in given:
        key = ".".join(map(str, one.path))
        if key in keys:
            raise GenevaError(f"{one.option}: --vary {cut(key)} sets it too; keep one")


def _axis(key: str, text: str, said: str, random: bool) -> VariedKey:
    parts = text.split(",")
    if len(parts) == 1 and (ends := range_text(text, said)):
        if random and not ends.step and not (_whole(ends[:2]) and is_whole(key)):
            return VariedKey(key, _span(ends, said), span=True)
        return VariedKey(key, _range(ends, said))
    values: list[Value] = []
    for part in parts:
        some = range_text(part, said)
        more = _range(some, said) if some else (_one(part, said),)
        _refuse_many(said, len(values) + len(more), MIXED_MAX)
        values += more
    return VariedKey(key, tuple(values))


def _whole(parts: Iterable[str]) -> bool:
    """Return True if all these are whole numbers."""
    return all(_WHOLE.fullmatch(part) for part in parts)


def _span(ends: RangeText, said: str) -> tuple[float, float]:
    """The two ends of a span. Raises GenevaError if the first is not below the second."""
    low, high = float(_decimal(ends.low, said)), float(_decimal(ends.high, said))
    if low >= high:
        raise GenevaError(f"{said}: the first number must be below the second")
    return low, high


def _range(ends: RangeText, said: str) -> Sequence[float]:
    """The values from LOW to HIGH by STEP; whole numbers need no step."""
    if _whole(filter(None, ends)) and ends.low and ends.high:
        first, last, step = int(ends.low), int(ends.high), int(ends.step or 1)
        if step:
            _refuse_many(said, abs((last - first) / step) + 1)
        if step and (some := range(first, last + (1 if step > 0 else -1), step)):
            return some
    low, high = _decimal(ends.low, said), _decimal(ends.high, said)
    if not ends.step and not _whole(ends[:2]):
        raise GenevaError(f"{said}: a range of fractions needs its step: LOW..HIGH:STEP")
    return _steps(low, high, _decimal(ends.step or "1", said), said)


def _one(text: str, said: str) -> Value:
    value = read_value(text, said)
    if isinstance(value, bool) or not isinstance(value, (int, float, str)) or not text.strip():
        raise GenevaError(f"{said}: {cut(text)!r} is neither a number nor a word")
    if isinstance(value, float) and not math.isfinite(value):
        raise GenevaError(f"{said}: {cut(text)} is no finite number")
    return value


def _decimal(text: str, said: str) -> Decimal:
    try:
        value = Decimal(text.strip())
    except InvalidOperation:
        raise GenevaError(f"{said}: {cut(text)!r} is no number") from None
    if not math.isfinite(float(value)):
        raise GenevaError(f"{said}: {cut(text)} is no finite number")
    return value


class Steps(Sequence[float]):
    """LOW, LOW + STEP, ... in decimals: 0..0.9:0.1 holds 0.3 and ends with 0.9.

    They are computed when read, so ten million of them take no memory.
    """

    def __init__(self, low: Decimal, step: Decimal, length: int) -> None:
        self.low, self.step, self.length = low, step, length

    def __len__(self) -> int:
        return self.length

    @overload
    def __getitem__(self, at: int) -> float: ...
    @overload
    def __getitem__(self, at: slice) -> list[float]: ...
    def __getitem__(self, at: int | slice) -> float | list[float]:
        if isinstance(at, slice):
            return [self[i] for i in range(*at.indices(self.length))]
        if not 0 <= at < self.length:
            raise IndexError(at)
        return float(self.low + self.step * at)

    def __repr__(self) -> str:
        return f"Steps({self.low}, {self.step}, {self.length})"


def _steps(low: Decimal, high: Decimal, step: Decimal, said: str) -> Steps:
    """The values from LOW up to HIGH. Raises GenevaError if there are none, or too many."""
    if not step or (high - low) / step < 0:
        raise GenevaError(
            f"{said}: a step of {step:g} does not lead from {low:g} to {high:g}; "
            "give LOW..HIGH:STEP"
        )
    count = (high - low) / step
    _refuse_many(said, count + 1)
    return Steps(low, step, math.floor(count) + 1)


def _refuse_many(said: str, count: float | Decimal, most: int = POINTS_MAX) -> None:
    if not count <= most:
        raise GenevaError(f"{said}: {float(count):.3g} values; at most {most:,}")
