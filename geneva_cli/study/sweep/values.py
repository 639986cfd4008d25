"""Values of a varied key: ``4,6,8``, ``3..12``, ``0..0.9:0.01``, words, or a span."""

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.spec.rules import range_text
from geneva_cli.spec.units import in_unit_of, unit_key
from geneva_cli.specfile.keys import is_whole
from geneva_cli.specfile.reader import Setting, parted, read_value
from geneva_cli.study.fields import Column, column_of

Value: TypeAlias = float | int | str
POINTS_MAX = 100_000_000  # rows of a sweep: some hours and some gigabytes


class VariedKey(NamedTuple):
    """A varied key and its values in order; a ``span`` means all numbers between two."""

    key: str  # table.key, as in the spec
    values: Sequence[Value]
    span: bool = False

    @property
    def words(self) -> list[str]:
        """The values that are words."""
        values = self.values if isinstance(self.values, tuple) else ()  # others are ranges
        return [value for value in values if isinstance(value, str)]

    def column(self, numbers: Whole) -> Column:
        """The values with these numbers, (n,)."""
        if isinstance(self.values, Steps):
            return self.values.column(numbers)
        return column_of([self.values[i] for i in numbers.tolist()])

    def between(self, fractions: Array) -> Column:
        """The values at fractions (n,) of the span, or of the list, from 0 to below 1."""
        if self.span:
            low, high = map(float, self.values)
            return low + (high - low) * fractions
        last = len(self.values) - 1
        return self.column(np.minimum((fractions * len(self.values)).astype(np.intp), last))


def axis(text: str, random: bool = False) -> VariedKey:
    """Return the varied key and its values from a text ``KEY=VALUES``.

    With ``random`` values are drawn, and LOW..HIGH of a key that takes fractions is a span.
    """
    option, key, values = parted(text, "--vary", "KEY=VALUES, as in --vary drive.A=0..0.9:0.1")
    return _axis(key, values.strip('"'), option, random)


def numbers(text: str, option: str) -> list[float]:
    """The numbers of a list with ranges, in their order, for an option that is no key."""
    option = f"{option} {cut(text.strip())}"
    values = _axis("", text.strip(), option, random=False).values
    _refuse_many(option, len(values), 1_000_000)
    out = [float(x) for x in values if isinstance(x, float | int) and not isinstance(x, bool)]
    if len(out) < len(values):
        raise GenevaError(f"{option}: it must be numbers, as 30,45 or -60..60:10")
    return out


def refuse_twice(axes: Sequence[VariedKey], settings: Sequence[Setting]) -> None:
    """Raise GenevaError for a key that is varied twice, or both varied and set."""
    keys = [a.key for a in axes]
    twice = next((k for k in keys if keys.count(k) > 1), None)
    if twice:
        raise GenevaError(f"--vary {cut(twice)}: given twice; put all its values into one")
    for one in settings:
        key = ".".join(map(str, one.path))
        if key in keys:
            raise GenevaError(f"{one.option}: --vary {cut(key)} sets it too; keep one")


def _axis(key: str, text: str, option: str, random: bool) -> VariedKey:
    parts = text.split(",")
    if len(parts) == 1 and (ends := range_text(text, option)):
        if random and not ends[2] and not (_whole(ends[:2]) and is_whole(key)):
            low, high = float(_decimal(ends[0], option)), float(_decimal(ends[1], option))
            if low >= high:
                raise GenevaError(f"{option}: the first number must be below the second")
            return VariedKey(key, (low, high), span=True)
        return VariedKey(key, _range(ends, option))
    values: list[Value] = []
    for part in parts:
        ends = range_text(part, option)
        more: Sequence[Value] = _range(ends, option) if ends else (_one(key, part, option),)
        _refuse_many(option, len(values) + len(more), 1_000_000)  # all of them are in memory
        values += more
    return VariedKey(key, tuple(values))


def _whole(parts: Iterable[str]) -> bool:
    return all(re.fullmatch(r"[+-]?\d{1,99}", part) for part in parts)


def _range(ends: tuple[str, str, str], option: str) -> Sequence[float]:
    """The values from LOW to HIGH by STEP; whole numbers need no step."""
    low, high, step = (_decimal(text, option) for text in (*ends[:2], ends[2] or "1"))
    if not ends[2] and not _whole(ends[:2]):
        raise GenevaError(f"{option}: a range of fractions needs its step: LOW..HIGH:STEP")
    if not step or (high - low) / step < 0:
        raise GenevaError(
            f"{option}: a step of {step:g} does not lead from {low:g} to {high:g}; "
            "give LOW..HIGH:STEP"
        )
    _refuse_many(option, (high - low) / step + 1)
    places = -min(0, *(int(x.as_tuple().exponent) for x in (low, high, step)))
    first, last, by = (int(x.scaleb(places)) for x in (low, high, step))
    whole = range(first, last + (1 if by > 0 else -1), by)
    return whole if _whole(filter(None, ends)) else Steps(whole, 10**places)


def _one(key: str, text: str, option: str) -> Value:
    """A number, a word, or true or false; a text with a unit is a number in the key's unit."""
    value = read_value(text, option)
    if isinstance(value, str) and text.strip()[-1:].isalnum() and unit_key(key):
        try:
            value = in_unit_of(key, text)
        except GenevaError as error:
            raise GenevaError(f"{option}: {error}") from None
    if not isinstance(value, (int, float, str)) or not text.strip():
        raise GenevaError(f"{option}: {cut(text)!r} is neither a number nor a word")
    if isinstance(value, float) and not math.isfinite(value):
        raise GenevaError(f"{option}: {cut(text)} is no finite number")
    return value


def _decimal(text: str, option: str) -> Decimal:
    try:
        value = Decimal(text.strip())
    except InvalidOperation:
        raise GenevaError(
            f'{option}: "{cut(text)}" is no number; '
            "a range is LOW..HIGH or LOW..HIGH:STEP, as 3..12 or 0..0.9:0.1"
        ) from None
    _, digits, exponent = value.as_tuple()
    if not isinstance(exponent, int) or exponent < -22 or len(digits) + exponent > 285:
        raise GenevaError(f"{option}: {cut(text)} is no finite number of at most 22 decimals")
    return value


@dataclass(frozen=True)
class Steps(Sequence[float]):
    """Whole numbers over a power of ten: 0..0.9:0.1 holds 0.3 and ends with 0.9.

    They are computed when read, so ten million of them take no memory.
    """

    whole: range
    divisor: int  # up to 1e22, which a float holds exactly

    def __len__(self) -> int:
        return len(self.whole)

    def __getitem__(self, at: int) -> float:  # type: ignore[override]
        return self.whole[at] / self.divisor

    def column(self, numbers: Whole) -> Array:
        """The values with these numbers, (n,)."""
        whole = self.whole.start + self.whole.step * numbers.astype(float)
        values: Array = whole / float(self.divisor)
        return values


def _refuse_many(option: str, count: float | Decimal, most: int = POINTS_MAX) -> None:
    if not count <= most:
        raise GenevaError(f"{option}: {float(count):.3g} values; at most {most:,}")
