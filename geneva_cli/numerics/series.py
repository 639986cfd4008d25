"""Series of functions from their samples at the Chebyshev points of [-1, 1]: (..., points, m).

L. N. Trefethen, "Approximation Theory and Approximation Practice", SIAM 2013.
"""

import numpy as np

from geneva_cli.numerics.arrays import Array

DEGREE = 16  # of the series: for most loads, its terms have ended between two cuts


def product(matrix: Array, values: Array) -> Array:
    """A matrix (n, k) times values (..., k, m), summed in order."""
    return np.asarray(np.einsum("nk,...km->...nm", matrix, values))


def at(terms: Array, t: Array) -> Array:
    """Values of series (terms, ...) at places, one for each series or broadcast against them."""
    twice, after, later = 2.0 * t, terms[-1], 0.0
    for c in terms[-2:0:-1]:  # Clenshaw's recurrence
        after, later = c + twice * after - later, after
    return np.asarray(terms[0] + t * after - later)


# Where functions are sampled, and where signs are compared, with two cells for each point: places
# -cos(pi k / cells), symmetric to the last bit.
POINTS: Array = np.sin(0.5 * np.pi * np.arange(-DEGREE, DEGREE + 1, 2) / DEGREE)
GRID: Array = np.sin(0.25 * np.pi * np.arange(-2 * DEGREE, 2 * DEGREE + 1, 2) / DEGREE)

_k = np.arange(DEGREE + 1)
_ends = np.where(_k % DEGREE == 0, 0.5, 1.0)  # the first and the last count half
# from samples to terms: the discrete cosine transform of the second kind of points
SERIES = 2.0 / DEGREE * _ends[:, None] * np.cos(np.pi * np.outer(_k, DEGREE - _k) / DEGREE) * _ends
_rise = _k - _k[:, None]
# from the terms of a series to those of its derivative
_DERIVED = np.where((_rise > 0) & (_rise % 2 == 1), 2.0 * _k, 0.0)
_DERIVED[0] *= 0.5
_TERMS = at(np.eye(DEGREE + 1)[..., None], GRID).T
# from samples to values and to slopes at ``GRID``
_VALUES, _SLOPES = product(_TERMS, SERIES), product(_TERMS, product(_DERIVED, SERIES))


def on_grid(values: Array) -> tuple[Array, Array]:
    """Values and slopes at ``GRID`` of the series from samples."""
    return product(_VALUES, values), product(_SLOPES, values)


def remainder(values: Array) -> Array:
    """The greatest of the last three terms, an estimate of the series' error: (..., m)."""
    return np.asarray(np.abs(product(SERIES[-3:], values)).max(axis=-2))


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
