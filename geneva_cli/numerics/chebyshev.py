"""Chebyshev series of functions that are sampled at the Chebyshev points of [-1, 1].

Once its terms have fallen to rounding, the series of a smooth function equals it to the last
digits. The size of the last terms estimates the error. Each function is a row of values at
``POINTS``.

    >>> values = np.exp(POINTS)[None]
    >>> bool(abs(at(series(values), np.array([0.3]))[0] - np.exp(0.3)) < 1e-14)
    True
    >>> float(remainder(values)[0]) < 1e-14
    True

Source: L. N. Trefethen, "Approximation Theory and Approximation Practice", SIAM 2013.
"""

from __future__ import annotations

import numpy as np

from geneva_cli.numerics.arrays import Array

SERIES_DEGREE = 16  # of the series: for most loads, its terms have ended between two cuts
MIDDLE = SERIES_DEGREE // 2  # number of the middle point

_order = np.arange(SERIES_DEGREE + 1)


def _even_spread(cells: int) -> Array:
    """Places -cos(pi k / cells), symmetric to the last bit."""
    half = np.cos(np.pi * np.arange(cells // 2) / cells)
    return np.concatenate((-half, [0.0], half[::-1]))


def _terms(t: Array) -> Array:
    """The Chebyshev polynomials at places of any shape: (terms, ...)."""
    out = np.empty((SERIES_DEGREE + 1, *t.shape))
    out[0], out[1] = 1.0, t
    for m in (1, 2, 4, 8):  # T(m + n) = 2 T(m) T(n) - T(m - n)
        out[m + 1 : 2 * m + 1] = 2.0 * out[m] * out[1 : m + 1] - out[:m][::-1]
    return out


def _to_series() -> Array:
    """The matrix from values at the points, a row, to the terms of the series."""
    # the discrete cosine transform of the second kind of points: ends count half
    weight = np.where((_order == 0) | (_order == SERIES_DEGREE), 0.5, 1.0)
    cosines = np.cos(np.pi * np.outer(SERIES_DEGREE - _order, _order) / SERIES_DEGREE)
    return np.asarray(2.0 / SERIES_DEGREE * weight[:, None] * cosines * weight)


def _to_slopes() -> Array:
    """The matrix from the terms of a series, a row, to those of its derivative."""
    rows, columns = np.meshgrid(_order, _order, indexing="ij")
    odd = (rows > columns) & ((rows - columns) % 2 == 1)
    return np.where(odd, 2.0 * rows, 0.0) * np.where(columns == 0, 0.5, 1.0)


def _product(values: Array, matrix: Array) -> Array:
    """Return values (..., k) times a matrix (k, n), n > 1, summed in order.

    BLAS sums in an order that depends on the number of rows and on the processor. Then a single
    design would differ from the same design in a batch.
    """
    rows = np.ascontiguousarray(np.moveaxis(values, -1, 0))
    if rows[0].size <= 128:  # the products of so few fit in the processor's cache
        shape = *matrix.shape, *[1] * (rows.ndim - 1)
        # in this order of memory, NumPy adds the products one after the other
        out = _sum(np.multiply(matrix.reshape(shape), rows[:, None], order="C"))
    else:
        out = np.multiply.outer(matrix[0], rows[0])
        term = np.empty(out.shape)  # one for all: allocation takes longer than the products
        for row, value in zip(matrix[1:], rows[1:], strict=True):
            out += np.multiply.outer(row, value, out=term)
    return np.moveaxis(out, 0, -1)


def _sum(terms: Array) -> Array:
    """The sum over the first axis, in order."""
    if terms[0].size == 1:  # a single value, of which NumPy would add pairs
        return np.asarray(np.add.accumulate(terms)[-1])
    return np.asarray(np.add.reduce(terms))


def _halves(matrix: Array) -> tuple[Array, Array]:
    """The matrices (9, n) and (8, n) that act on ``_even_and_odd`` values, of one (17, n)."""
    first, mirrored = matrix[:MIDDLE], matrix[:MIDDLE:-1]
    return np.concatenate((0.5 * (first + mirrored), matrix[[MIDDLE]])), 0.5 * (first - mirrored)


POINTS = _even_spread(SERIES_DEGREE)  # where functions are sampled
HALF = SERIES_DEGREE  # cells from -1 to 0 of the grid where signs are compared: two for each point
GRID = _even_spread(2 * HALF)
_SERIES = _to_series()
_SLOPES = _to_slopes()
# to terms of even and of odd degree, and to values and slopes on the grid's first half
_EVEN_TERMS, _ODD_TERMS = _halves(_SERIES[:, 0::2])[0], _halves(_SERIES[:, 1::2])[1]
_FIRST_HALF = _terms(GRID[: HALF + 1])
_ON_GRID = _halves(_product(_SERIES, _FIRST_HALF))
_SLOPES_ON_GRID = _halves(_product(_product(_SERIES, _SLOPES), _FIRST_HALF))


def series(values: Array) -> Array:
    """The terms of the series of values (m, points): (terms, m)."""
    even, odd = _even_and_odd(values)
    out = np.empty((SERIES_DEGREE + 1, len(values)))
    out[0::2] = _product(even, _EVEN_TERMS).T
    out[1::2] = _product(odd, _ODD_TERMS).T
    return out


def slopes(terms: Array) -> Array:
    """The terms of the derivatives of series (terms, m)."""
    return _product(terms.T, _SLOPES).T


def remainder(values: Array) -> Array:
    """The greatest of the last terms, an estimate of the series' error."""
    # The last three terms together: every other term of an even or odd function is 0.
    greatest: Array = np.abs(_product(values, _SERIES[:, -3:])).max(axis=-1)
    return greatest


def on_grid(values: Array) -> tuple[Array, Array]:
    """Values and slopes of the series at ``GRID``."""
    even, odd = _even_and_odd(values)
    value = _both_halves(_product(even, _ON_GRID[0]), _product(odd, _ON_GRID[1]))
    # the slope of an odd function is even
    slope = _both_halves(_product(odd, _SLOPES_ON_GRID[1]), _product(even, _SLOPES_ON_GRID[0]))
    return value, slope


def _even_and_odd(values: Array) -> tuple[Array, Array]:
    """Sums (m, points) and differences of values at mirrored points, which halve all products."""
    first, mirrored = values[:, :MIDDLE], values[:, :MIDDLE:-1]
    middle = values[:, MIDDLE : MIDDLE + 1]
    return np.concatenate((first + mirrored, middle), axis=1), first - mirrored


def _both_halves(even: Array, odd: Array) -> Array:
    """Even plus odd functions on the whole grid, from their values on its first half."""
    out = np.empty((len(GRID), len(even)))
    np.add(even.T, odd.T, out=out[: HALF + 1])
    np.subtract(even.T, odd.T, out=out[::-1][: HALF + 1])
    return out.T


def at(terms: Array, t: Array) -> Array:
    """Values of series (terms, ..., m) at one place each: (..., m)."""
    return _sum(terms * _terms(t).reshape(len(terms), *[1] * (terms.ndim - 2), -1))


def root(terms: Array, low: Array, high: Array, start: Array) -> Array:
    """The zero of each series (terms, m) between ``low`` and ``high``, where its signs differ."""
    both, rises, t = np.stack((terms, slopes(terms)), axis=1), at(terms, high) > 0.0, start
    # Newton steps, from a secant on the grid; the function itself is evaluated afterwards
    for _ in range(5):
        value, rate = at(both, t)
        below = (value < 0.0) == rises
        low, high = np.where(below, t, low), np.where(below, high, t)
        new = t - value / rate
        t = np.where((low <= new) & (new <= high), new, 0.5 * (low + high))
    return t
