"""Equality of extremes: the first of several equal ones is reported.

Searches of several functions and of one function reach the same extremes by different steps, so
their last digits differ. All use these tolerances.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array


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
        first, third = quartiles(np.where(finite[lost], rows[lost], np.nan))
        beyond = 3.0 * (third - first)  # values farther out are near a pole
        low[lost] = np.maximum(low[lost], first - beyond)
        high[lost] = np.minimum(high[lost], third + beyond)
    return low, high


def quartiles(rows: Array) -> tuple[Array, Array]:
    """First and third quartile of the numbers in each row (m, k), NaN left out: (m,) both.

    Equal to ``np.nanquantile``, which takes one row after the other.
    """
    ordered = np.sort(rows, axis=1)  # NaN comes last
    last = np.count_nonzero(~np.isnan(rows), axis=1) - 1
    every = np.arange(len(rows))

    def at(place: Array) -> Array:
        below = np.floor(place).astype(int)
        low, high = ordered[every, below], ordered[every, np.minimum(below + 1, last)]
        return np.asarray(low + (high - low) * (place - below))

    return at(0.25 * last), at(0.75 * last)
