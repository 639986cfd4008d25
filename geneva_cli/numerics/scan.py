"""Looking over whole functions at once: sampled until nothing is stepped over.

Several functions of one variable are sampled together, as arrays, on several spans. A span is
halved where the cubic through two neighbours' values and slopes does not predict the middle, as in
``roots.extrema``; it begins with places that crowd towards both its ends, where mechanisms have
their narrowest features.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import read_only
from geneva_cli.numerics.cubics import touches
from geneva_cli.numerics.roots import DEEPEST, PREDICTED, SCAN

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask, Whole

# places and the numbers of their spans -> values and slopes, a row for each function
Functions: TypeAlias = "Callable[[Array, Whole], tuple[Array, Array]]"

ROUNDING = 1e-12  # share of a value that no sampling makes any surer
NOISE = 4e-15  # share of a function's greatest size that has no sign: some roundings
TINY = 1e-16  # share of a value that no double shows
NARROW = 1e-6  # share of all spans within which a place is told well enough
MOST = 65_536  # places, and as many more as 16 times those that it begins with
CROWDED = 16  # places towards each end, each four times as near to it as the one before


class NeverSeen(Exception):
    """Functions of which more is seen the nearer one looks, without an end: they are rounding."""


class Scan(NamedTuple):
    """Samples in order of span and place; rows of ``value`` and ``slope`` are the functions'."""

    x: Array
    span: Whole
    value: Array
    slope: Array

    @property
    def joined(self) -> Mask:
        """For each sample but the last: whether the next one is of the same span."""
        same: Mask = self.span[1:] == self.span[:-1]
        return same

    def row(self, number: int) -> Scan:
        """The same samples of one function alone."""
        one = slice(number, number + 1)
        return Scan(self.x, self.span, self.value[one], self.slope[one])

    def first(self, count: int) -> Scan:
        """The same samples of the first functions alone."""
        return Scan(self.x, self.span, self.value[:count], self.slope[:count])

    def noise(self, row: int) -> float:
        """Size of a function's values that is rounding, beside its greatest."""
        size = abs(self.value[row])
        return NOISE * float(np.max(size[np.isfinite(size)], initial=0.0))

    def changes(self, row: int) -> tuple[Whole, Whole]:
        """The samples between which a function changes sign: those before, and those after.

        What is rounding beside the function's greatest size has no sign: between two samples there
        may be some of it.
        """
        value = self.value[row]
        sure = np.flatnonzero(abs(value) > self.noise(row))
        negative, span = np.signbit(value[sure]), self.span[sure]
        turns = (negative[:-1] != negative[1:]) & (span[:-1] == span[1:])
        return sure[:-1][turns], sure[1:][turns]


@cache
def _unit() -> Array:
    """The places that a span from 0 to 1 begins with."""
    near = 0.25 ** np.arange(2, 2 + CROWDED)
    unit = np.sort(np.concatenate((np.arange(SCAN + 1) / SCAN, near, 1.0 - near)))
    # each once; np.unique would import numpy.ma, a sixth of a short run
    once: Array = unit[np.diff(unit, prepend=-1.0) > 0.0]
    return read_only(once)


def scan(
    functions: Functions, spans: Sequence[tuple[float, float]], signed: slice = slice(0)
) -> Scan:
    """Samples so near that a cubic between neighbours is within a share of each function's range.

    A value that is not finite marks a place where the function has none: nothing is asked of it.
    Of the functions ``signed`` no two changes of sign lie between neighbours: where both tangents
    head for zero and meet beyond it, there is another sample.

    Raises NeverSeen past ``MOST`` places; what has digits takes some hundreds a span.
    """
    unit = _unit()
    a, b = (np.array(side)[:, None] for side in zip(*spans, strict=True))
    x = a + (b - a) * unit
    x[:, -1:] = b
    span = np.repeat(np.arange(len(spans)), len(unit))
    with np.errstate(all="ignore"):
        return _refined(functions, x.ravel(), span, signed)


def _refined(functions: Functions, x: Array, span: Whole, signed: slice) -> Scan:
    value, slope = functions(x, span)
    every = [(x, span, value, slope)]
    same: Mask = span[1:] == span[:-1]
    left = _taken((x[:-1], span[:-1], value[:, :-1], slope[:, :-1]), same)
    right = _taken((x[1:], span[1:], value[:, 1:], slope[:, 1:]), same)
    low, high = _range(value)
    left_over = MOST + 16 * len(x)
    for _ in range(DEEPEST):
        x = 0.5 * (left[0] + right[0])
        open_: Mask = (x > left[0]) & (x < right[0])
        if not open_.any():
            break
        x, left, right = x[open_], _taken(left, open_), _taken(right, open_)
        left_over -= len(x)
        if left_over < 0:
            raise NeverSeen
        value, slope = functions(x, left[1])
        middle = (x, left[1], value, slope)
        every.append(middle)
        least, most = _range(value)
        low, high = np.fmin(low, least), np.fmax(high, most)
        predicted = 0.5 * (left[2] + right[2]) + (right[0] - x) * (left[3] - right[3]) / 4.0
        bar = PREDICTED * (high - low) + ROUNDING * np.fmax(np.abs(high), np.abs(low))
        missed = np.any(np.abs(value - predicted) > bar, axis=0)
        noise = NOISE * np.fmax(np.abs(high), np.abs(low))[signed]
        missed |= _may_cross(left, middle, noise, signed) | _may_cross(middle, right, noise, signed)
        here = _taken(middle, missed)
        left, right = (
            _joined(_taken(left, missed), here),
            _joined(here, _taken(right, missed)),
        )
    whole = [np.concatenate(parts, axis=-1) for parts in zip(*every, strict=True)]
    order = np.lexsort((whole[0], whole[1]))
    return read_only(Scan(*(part[..., order] for part in whole)))


_Part: TypeAlias = "tuple[Array, Whole, Array, Array]"


def _may_cross(one: _Part, two: _Part, noise: Array, signed: slice) -> Mask:
    """Whether functions that have a sign at both places may change it twice between them."""
    v, w, d, e = (rows[signed] for rows in (one[2], two[2], one[3], two[3]))
    sure = (np.abs(v) > noise) & (np.abs(w) > noise)
    return np.asarray((touches(two[0] - one[0], v, d, w, e) & sure).any(axis=0))


def _taken(part: _Part, where: Mask) -> _Part:
    x, span, value, slope = part
    return x[where], span[where], value[:, where], slope[:, where]


def _joined(one: _Part, two: _Part) -> _Part:
    x, span, value, slope = (np.concatenate(p, axis=-1) for p in zip(one, two, strict=True))
    return x, span, value, slope


def _range(value: Array) -> tuple[Array, Array]:
    """The least and the greatest finite value of each row, as columns."""
    finite = np.isfinite(value)
    low = np.where(finite, value, np.inf).min(axis=1, keepdims=True)
    high = np.where(finite, value, -np.inf).max(axis=1, keepdims=True)
    return low, high


def hopeful(found: Scan, row: int) -> list[int]:
    """Samples after which a function may reach a maximum that no sample is far above.

    The function rises there and falls at the next sample. What it may reach between is bounded by
    the cubic's slopes, and by what the scan lets a cubic miss.
    """
    value, slope = found.value[row], found.slope[row]
    width = float(np.ptp(found.x))
    if not np.isfinite(value).any():
        return []
    low, high = (float(side[row, 0]) for side in _range(found.value))
    if high - low <= ROUNDING * max(abs(low), abs(high)):
        return []  # a constant, whose slopes are rounding
    with np.errstate(invalid="ignore"):
        turns = (slope[:-1] > 0.0) & (slope[1:] <= 0.0) & found.joined
        rise = np.diff(found.x) * (slope[:-1] - slope[1:]) * (4.0 / 27.0)
        top = np.maximum(value[:-1], value[1:])
        reach = top + rise + 4.0 * PREDICTED * (high - low)
        # where a narrow pair holds no more than rounding, its samples are the top
        more = (rise > TINY * max(abs(low), abs(high))) | (np.diff(found.x) > NARROW * width)
        return [int(i) for i in np.flatnonzero(turns & more & (reach >= high))]
