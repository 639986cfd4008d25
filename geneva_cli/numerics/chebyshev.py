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
    """Return values (..., k) times a matrix (k, n), summed in order.

    BLAS sums in an order that depends on the number of rows and on the processor. Then a single
    design would differ from the same design in a batch.
    """
    # transposed by hand: np.moveaxis takes as long as a product of few rows
    rows = np.ascontiguousarray(values.transpose(-1, *range(values.ndim - 1)))
    out = np.multiply.outer(matrix[0], rows[0])
    term = np.empty(out.shape)  # one for all: allocation takes longer than the products
    for row, value in zip(matrix[1:], rows[1:], strict=True):
        out += np.multiply.outer(row, value, out=term)
    return out.transpose(*range(1, out.ndim), 0)


def at(terms: Array, t: Array) -> Array:
    """Values of series (terms, ...) at places, one for each series or broadcast against them."""
    twice, after, later = 2.0 * t, terms[-1], 0.0
    for c in terms[-2:0:-1]:  # Clenshaw's recurrence
        after, later = c + twice * after - later, after
    return np.asarray(terms[0] + t * after - later)


POINTS = _even_spread(SERIES_DEGREE)  # where functions are sampled
GRID = _even_spread(2 * SERIES_DEGREE)  # where signs are compared: two cells for each point
_SERIES = _to_series()
_SLOPES = _to_slopes()
_TERMS = at(np.eye(SERIES_DEGREE + 1)[..., None], GRID)
_ON_GRID = _product(_SERIES, _TERMS)
_SLOPES_ON_GRID = _product(_product(_SERIES, _SLOPES), _TERMS)


def series(values: Array) -> Array:
    """The terms of the series of values (m, points): (terms, m)."""
    return _product(values, _SERIES).T


def end_slopes(values: Array) -> Array:
    """The slopes of the series of values (m, points) at both ends: (m, 2)."""
    return _product(values, _SLOPES_ON_GRID[:, [0, -1]])


def remainder(values: Array) -> Array:
    """The greatest of the last terms, an estimate of the series' error."""
    # The last three terms together: every other term of an even or odd function is 0.
    greatest: Array = np.abs(_product(values, _SERIES[:, -3:])).max(axis=-1)
    return greatest


def on_grid(values: Array) -> tuple[Array, Array]:
    """Values and slopes of the series at ``GRID``."""
    return _product(values, _ON_GRID), _product(values, _SLOPES_ON_GRID)


def root(terms: Array, low: Array, high: Array, start: Array, slope: Array) -> Array:
    """The zero of each series (terms, m) between ``low`` and ``high``, where its signs differ.

    ``start`` is a place near it, and ``slope`` an estimate of the slope there. The search goes by
    secants; the function itself is evaluated afterwards.
    """
    rises, t, value = at(terms, high) > 0.0, start, at(terms, start)
    for _ in range(3):
        below = (value < 0.0) == rises
        low, high = np.where(below, t, low), np.where(below, high, t)
        new = t - value / slope
        new = np.where((low <= new) & (new <= high), new, 0.5 * (low + high))
        there = at(terms, new)
        slope, t, value = (there - value) / (new - t), new, there
    new = t - value / slope
    return np.where((low <= new) & (new <= high), new, t)
