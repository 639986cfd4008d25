"""The greatest values of functions of many designs and their places, updated as values arrive.

Of several equal extremes the first is reported. Searches of several functions and of one function
reach the same extremes by different steps, so their last digits differ. All use the tolerances of
``bar``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask, Whole
    from geneva_cli.numerics.smooth_pieces import SmoothPieces


class GreatestValues:
    """The greatest values of functions of n designs, and the first places that have them.

    With ``sized`` these are the greatest sizes; else the greatest values, and the greatest values
    of the functions' negatives. Values that differ only by rounding are equal: the earlier place
    counts.
    """

    def __init__(self, functions: int, n: int, sized: bool) -> None:
        self.senses = (1.0,) if sized else (1.0, -1.0)
        self.sized = sized
        self.most = np.full((len(self.senses), functions, n), -np.inf)
        self.size = np.zeros((functions, n))  # of samples, without those near poles
        self.sample = np.full(self.most.shape, np.nan)  # the place of a greatest sample
        self.known: list[tuple[int, Whole, Whole, Array, Array]] = []

    def _sided(self, sense: float, value: Array) -> Array:
        """Sizes, or values times the sense: 1 for the greatest values, -1 for the least."""
        return np.abs(value) if self.sized else sense * value

    def add(self, number: Whole, design: Whole, x: Array, value: Array) -> None:
        """Add values (m,) of functions, by their numbers, at ends and extremes."""
        for side, sense in enumerate(self.senses):
            own = self._sided(sense, value)
            _raise(self.most[side], number, design, own)
            self.known.append((side, number, design, x, own))

    def add_samples(self, pieces: SmoothPieces, x: Array) -> None:
        """Add samples of pieces at places (m, k); only those within each piece count."""
        design, (a, b), every = pieces.rows.design, pieces.rows.x, np.arange(len(x))
        outside = (x < a[:, None]) | (x > b[:, None])
        first, number = outside.argmin(axis=1), np.arange(len(pieces.value))[:, None]
        for side, sense in enumerate(self.senses):
            own = np.where(outside, -np.inf, self._sided(sense, pieces.value))
            best = own.argmax(axis=2)
            top, place = own[number, every, best], x[every, best]
            _raise(self.most[side], number, design, top)
            of, row = np.nonzero(top == self.most[side][:, design])
            self.sample[side, of, design[row]] = place[of, row]
            of, row = np.nonzero(top == np.inf)
            if len(of):  # a pole at the first sample of a piece counts from the piece's start
                start = np.where(best[of, row] == first[row], a[row], place[of, row])
                self.known.append((side, of, design[row], start, top[of, row]))

    def add_sizes(self, pieces: SmoothPieces) -> None:
        """Update the sizes of functions from samples of whole spans, unbounded ones known."""
        design, value = pieces.rows.design, pieces.value
        endless = np.isinf(self.most).any(axis=0)[:, design]
        # a piece divided at a pole has one end of any size
        size = np.abs(value)
        top = size >= size.max(axis=2, keepdims=True)
        low, high = usual(np.where(top & endless[..., None], np.inf, value))
        _raise(self.size, np.arange(len(value))[:, None], design, np.fmax(-low, high))

    def least(self, side: int) -> Array:
        """The least values that count as greatest: (functions, n)."""
        return bar(self.most[side], self.size)

    def may_be(self, number: Whole, design: Whole, low: Array, high: Array) -> Mask:
        """Masks of functions between ``low`` and ``high`` that may have one of the greatest values.

        ``number`` are the functions' numbers. Nothing exceeds an unbounded value.
        """
        out = np.full(np.shape(low), False)
        for side, sense in enumerate(self.senses):
            reach = np.maximum(high, -low) if self.sized else high if sense > 0.0 else -low
            least = self.least(side)[number, design]
            out |= ~(reach < least) & (least < np.inf)
        return out

    def places(self) -> Array:
        """The first places of the greatest values."""
        first = np.full(self.most.shape, np.inf)
        least = [self.least(side) for side in range(len(self.senses))]
        for side, number, design, x, value in self.known:
            near = value >= least[side][number, design]
            np.fmin.at(first[side], (number[near], design[near]), x[near])
        return np.where(np.isinf(first), self.sample, first)


def _raise(most: Array, number: Whole, design: Whole, value: Array) -> None:
    """Set greatest values (functions, n) to values that are greater."""
    index = number * most.shape[1] + design  # flat indices: NumPy is ten times as fast with them
    np.fmax.at(most.reshape(-1), index.reshape(-1), value.reshape(-1))


def bar(most: Array, size: Array) -> Array:
    """The least value that counts as equal to a greatest one.

    ``size`` is the functions' greatest size.

    >>> bar(np.array([2.0, 0.0, np.inf]), np.array([2.0, 1.0, 1.0])).tolist()
    [1.999999999998, -1e-13, inf]
    """
    finite = np.isfinite(most)
    # Extremes within 1e-12 of their size are equal. So are values within 1e-13 of the function's
    # size: at a computed root it is not exactly 0.
    tie = np.maximum(1e-12 * np.abs(np.where(finite, most, 0.0)), 1e-13 * size)
    return np.where(finite, most - tie, most)


def first_greatest(value: Array, place: Array, size: Array) -> tuple[Array, Array]:
    """The greatest of values in rows (k, n), and the first place of its equals: (n,) each.

    >>> first_greatest(np.array([[0.0], [1e-17]]), np.array([[10.0], [20.0]]), np.array([1.0]))
    (array([1.e-17]), array([10.]))
    """
    most = value.max(axis=0)
    first = np.argmax(value >= bar(most, size), axis=0)
    return most, np.take_along_axis(place, first[None], axis=0)[0]


def usual(rows: Array) -> tuple[Array, Array]:
    """The least and the greatest finite value of rows (..., k), each of which has one.

    In a row with a pole, outliers are left out. Near a pole values are of any size, and say nothing
    about values far from it.
    """
    finite = np.isfinite(rows)
    if finite.all():
        return rows.min(axis=-1), rows.max(axis=-1)
    low = np.where(finite, rows, np.inf).min(axis=-1)
    high = np.where(finite, rows, -np.inf).max(axis=-1)
    lost = np.nonzero(~finite.all(axis=-1) & finite.any(axis=-1))
    if len(lost[0]):
        ordered = np.sort(np.where(finite[lost], rows[lost], np.nan), axis=1)  # NaN comes last
        every, last = np.arange(len(ordered)), finite[lost].sum(axis=1) - 1
        first, third = ordered[every, last // 4], ordered[every, 3 * last // 4]  # quartiles
        beyond = 3.0 * (third - first)  # values farther out are near a pole
        low[lost] = np.maximum(low[lost], first - beyond)
        high[lost] = np.minimum(high[lost], third + beyond)
    return low, high
