"""Which of several extremes are equal: of those the first is told.

Searches of several functions and of one alone find the same extremes by other steps, and so with
other last digits. What counts as equal is said here for all.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array

TIE = 1e-12  # share of an extreme by which another may miss it and be its equal
NOUGHT = 1e-13  # so it may by this share of the function's size: where a root was found it is not 0
MIDDLE = 3.0  # of the quartiles' distance: what is further out is near a pole


def bar(most: Array, size: Array) -> Array:
    """The least value that is the equal of a greatest one, of functions of a greatest ``size``.

    >>> bar(np.array([2.0, 0.0, np.inf]), np.array([2.0, 1.0, 1.0])).tolist()
    [1.999999999998, -1e-13, inf]
    """
    finite = np.isfinite(most)
    tie = np.maximum(TIE * np.abs(np.where(finite, most, 0.0)), NOUGHT * size)
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

    Of a row with a pole those of its middle: near a pole values are of any size, and say nothing
    of what is far from it.
    """
    finite = np.isfinite(rows)
    if finite.all():
        return rows.min(axis=-1), rows.max(axis=-1)
    low = np.where(finite, rows, np.inf).min(axis=-1)
    high = np.where(finite, rows, -np.inf).max(axis=-1)
    lost = np.nonzero(~finite.all(axis=-1) & finite.any(axis=-1))
    if len(lost[0]):
        first, third = quartiles(np.where(finite[lost], rows[lost], np.nan))
        low[lost] = np.maximum(low[lost], first - MIDDLE * (third - first))
        high[lost] = np.minimum(high[lost], third + MIDDLE * (third - first))
    return low, high


def quartiles(rows: Array) -> tuple[Array, Array]:
    """First and third quartile of rows (m, k), of what is a number in each: (m,) both.

    As of ``np.nanquantile``, which takes one row after the other.
    """
    ordered = np.sort(rows, axis=1)  # NaN comes last
    last = np.count_nonzero(~np.isnan(rows), axis=1) - 1
    every = np.arange(len(rows))

    def at(place: Array) -> Array:
        below = np.floor(place).astype(int)
        low, high = ordered[every, below], ordered[every, np.minimum(below + 1, last)]
        return np.asarray(low + (high - low) * (place - below))

    return at(0.25 * last), at(0.75 * last)
