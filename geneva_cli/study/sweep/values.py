"""The values that a key is varied through: ``4,6,8``, ``3..12``, ``0:0.9:0.01``, words, a span."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from decimal import Decimal, InvalidOperation
from typing import NamedTuple, TypeAlias, overload

from geneva_cli.errors import GenevaError, cut
from geneva_cli.specfile.settings import Setting, read_value

Value: TypeAlias = float | int | str
POINTS_MAX = 100_000_000  # rows of a sweep: some hours, some gigabytes
_WHOLE = r"\s*([+-]?\d{1,99})\s*"
_RANGE = re.compile(rf"{_WHOLE}\.\.{_WHOLE}")


class VariedKey(NamedTuple):
    """A varied key, and its values in order; a ``span`` has two, and all between them."""

    key: str  # table.key, as in the spec
    values: Sequence[Value]
    span: bool = False

    def __contains__(self, value: object) -> bool:
        """Whether it is one of the values, or between the two ends of a span."""
        if not self.span:
            return value in self.values
        low, high = map(float, self.values)
        return isinstance(value, float | int) and low <= value <= high


def axis(text: str, random: bool = False) -> VariedKey:
    """What ``KEY=VALUES`` varies; ``random`` where values are drawn, and LOW:HIGH is a span.

    Raises GenevaError, naming the option, for what is none.

    >>> list(axis("drive.A=0:0.9:0.3").values)
    [0.0, 0.3, 0.6, 0.9]
    """
    key, sign, values = text.partition("=")
    said = f"--vary {cut(text.strip())}"
    if not sign or not values.strip() or "." not in key.strip().strip("."):
        raise GenevaError(f"{said}: it must be TABLE.KEY=VALUES, as in --vary drive.A=0:0.9:0.1")
    return _axis(key.strip(), values.strip().strip('"'), said, random)


def refuse_twice(axes: Sequence[VariedKey], given: Sequence[Setting]) -> None:
    """Raise GenevaError for a key that is varied twice, or varied and set: of both only one would
    be looked at.
    """
    keys = [a.key for a in axes]
    twice = next((k for k in keys if keys.count(k) > 1), None)
    if twice:
        raise GenevaError(f"--vary {cut(twice)}: given twice; put all its values into one")
    for one in given:
        key = ".".join(map(str, one.path))
        if key in keys:
            raise GenevaError(f"{one.said}: --vary {cut(key)} sets it too; keep one")


def _axis(key: str, text: str, said: str, random: bool) -> VariedKey:
    whole = _RANGE.fullmatch(text)
    if whole:
        low, high = int(whole[1]), int(whole[2])
        _refuse_many(said, high - low + 1)
        return VariedKey(key, _some(said, range(low, high + 1)))
    if ":" in text:
        ends = [_decimal(part, said) for part in text.split(":")]
        if len(ends) == 3:
            first, last, step = ends
            return VariedKey(key, _steps(first, last, step, said))
        if len(ends) == 2 and random and ends[0] < ends[1]:
            return VariedKey(key, tuple(map(float, ends)), span=True)
        raise GenevaError(
            f"{said}: a range is LOW:HIGH:STEP" + (", or LOW:HIGH with LOW below" if random else "")
        )
    if ".." in text:
        raise GenevaError(
            f"{said}: LOW..HIGH is of whole numbers; other ranges are LOW:HIGH:STEP"
            + (" or LOW:HIGH" if random else "")
        )
    return VariedKey(key, tuple(_one(part, said) for part in text.split(",")))


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
    """LOW, LOW + STEP, ... in decimals: 0:0.9:0.1 holds 0.3 and ends with 0.9.

    Ten million of them take no memory.
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
    """The values from LOW up to HIGH. Raises GenevaError where there are none, or too many."""
    if not step or (high - low) / step < 0:
        raise GenevaError(
            f"{said}: a step of {step:g} never comes from {low:g} to {high:g}; give LOW:HIGH:STEP"
        )
    count = (high - low) / step
    _refuse_many(said, count + 1)
    return Steps(low, step, math.floor(count) + 1)


def _some(said: str, values: range) -> range:
    if not values:
        raise GenevaError(f"{said}: no value at all; give LOW..HIGH with LOW below HIGH")
    return values


def _refuse_many(said: str, count: float | Decimal) -> None:
    if not count <= POINTS_MAX:
        raise GenevaError(f"{said}: {float(count):.3g} values; at most {POINTS_MAX:,}")
