"""Quintic splines through points: four times continuously differentiable, at rest at both ends.

In plain arithmetic, for the same bytes on every processor.
"""

import math
from collections.abc import Sequence
from decimal import Decimal
from itertools import pairwise

import numpy as np

from geneva_cli.numerics.arrays import SINGLE, Array, N, pieces_of
from geneva_cli.numerics.jet import taylor

SPLINE_DEGREE = 5


class PiecewisePolynomial:
    """A piecewise polynomial: piece i, in powers of x - origins[i], lies up to cuts[i].

    ``rows`` (n, degree + 1) are the pieces' coefficients, the constant first.
    """

    def __init__(self, cuts: Array, origins: Array, rows: Array) -> None:
        self.cuts, self.origins, self.rows = cuts, origins, rows
        self._scalars = cuts.tolist(), origins.tolist(), rows.tolist()
        self._columns = list(rows.T.copy())

    def __call__(self, x: N, order: int) -> list[N]:
        """Taylor coefficients 0 to ``order`` at a number, an array or enclosures of numbers."""
        cuts, origins, rows = self._scalars
        index = pieces_of(x, cuts) if isinstance(x, SINGLE) else self.cuts.searchsorted(x)
        if isinstance(index, int):
            return taylor(x - origins[index], rows[index], order)
        return taylor(x - self.origins[index], [c[index] for c in self._columns], order)


def at_rest(x: Sequence[float], y: Sequence[float]) -> PiecewisePolynomial:
    """Return the spline through points whose first two derivatives are zero at both ends."""
    starts, h, rise = np.array(x[:-1]), np.diff(x), np.diff(y)
    before, after, (low, high) = h[:-1], h[1:], (rise[:-1], rise[1:])
    # Slope and curvature at the points inside are unknown, in turn: those of the point before, of
    # the point and of the one after. The fourth and the third derivative do not jump there.
    bands, values = np.zeros((len(before), 2, 7)), np.zeros((len(before), 2))
    for column, (fourth, third) in enumerate(
        (
            (168.0 / before**3, -24.0 / before**2),
            (24.0 / before**2, -3.0 / before),
            (192.0 / before**3 + 192.0 / after**3, 36.0 / after**2 - 36.0 / before**2),
            (36.0 / after**2 - 36.0 / before**2, 9.0 / before + 9.0 / after),
            (168.0 / after**3, 24.0 / after**2),
            (-24.0 / after**2, -3.0 / after),
        )
    ):
        bands[:, 0, column + 1], bands[:, 1, column] = fourth, third
    values[:, 0] = 360.0 * (low / before**4 + high / after**4)
    values[:, 1] = 60.0 * (high / after**3 - low / before**3)
    inner = _solved(bands.reshape(-1, 7).tolist(), values.ravel().tolist())
    slope, bend = np.pad(np.reshape(inner, (-1, 2)).T, ((0, 0), (1, 1)))
    (p, q), (u, v) = (slope[:-1] * h, slope[1:] * h), (bend[:-1] * h * h, bend[1:] * h * h)
    third = (10.0 * rise - 6.0 * p - 4.0 * q - 1.5 * u + 0.5 * v) / h**3
    fourth = (-15.0 * rise + 8.0 * p + 7.0 * q + 1.5 * u - v) / h**4
    fifth = (6.0 * rise - 3.0 * p - 3.0 * q - 0.5 * u + 0.5 * v) / h**5
    rows = np.column_stack((y[:-1], slope[:-1], 0.5 * bend[:-1], third, fourth, fifth))
    return PiecewisePolynomial(starts[1:], starts, rows)


def _solved(bands: list[list[float]], values: list[float]) -> list[float]:
    """Solve a system whose row i holds columns i - 3 to i + 3, without pivots."""
    n = len(values)
    for i in range(n):
        for k in range(1, min(4, n - i)):
            factor = bands[i + k][3 - k] / bands[i][3]
            for j in range(1, 4):
                bands[i + k][3 - k + j] -= factor * bands[i][3 + j]
            values[i + k] -= factor * values[i]
    out = [0.0] * (n + 3)
    for i in reversed(range(n)):
        later = sum(bands[i][3 + j] * out[i + j] for j in range(1, 4))
        out[i] = (values[i] - later) / bands[i][3]
    return out[:n]


def doubt(x: Sequence[float], y: Sequence[float], order: int) -> tuple[int, float]:
    """Decimals of points, and the change of a derivative from half a unit of the last decimal.

    The inverse of the matrix of B-splines' values has signs like a chessboard (C. de Boor and A.
    Pinkus, 1977), so errors of alternating sign move a spline most.
    """
    exponents = [Decimal(repr(v)).normalize().as_tuple().exponent for v in y]
    decimals = max(0, *[-e for e in exponents if isinstance(e, int)])
    unit = 10.0**-decimals
    off = [max(unit, math.ulp(v)) / (2 if k % 2 else -2) for k, v in enumerate(y)]
    off[0] = off[-1] = 0.0
    pieces = at_rest(x, off)
    middles = [0.5 * (a + b) for a, b in pairwise(x)]
    most = np.abs(pieces(np.array([*x, *middles]), order)[order]).max()
    return decimals, math.factorial(order) * float(most)
