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
    starts, n = np.array(x[:-1]), len(x) - 1
    knots = np.concatenate(
        (np.repeat(x[0], SPLINE_DEGREE + 1), x[1:-1], np.repeat(x[-1], SPLINE_DEGREE + 1))
    )
    bases = _bases(knots, n)
    # At a knot five B-splines are not zero. At rest, three coefficients are the end's value.
    bands = bases[SPLINE_DEGREE][:SPLINE_DEGREE, 1:].T
    values = np.array(y[1:-1])
    for k in range(min(2, n - 1)):
        values[k] -= y[0] * bands[k, : 2 - k].sum()
        values[-1 - k] -= y[-1] * bands[-1 - k, 3 + k :].sum()
    inner = _pentadiagonal(bands.tolist(), values.tolist())
    rows = _pieces(knots, np.array([*[y[0]] * 3, *inner, *[y[-1]] * 3]), bases)
    rows[:, 0] = y[:-1]
    rows[0, 1:3] = 0.0
    return PiecewisePolynomial(starts[1:], starts, rows)


def _bases(knots: Array, n: int) -> list[Array]:
    """Values of the B-splines of degrees 0 to 5 at the starts of n pieces: (degree + 1, n) each."""
    first = np.arange(SPLINE_DEGREE, SPLINE_DEGREE + n)
    x, values = knots[first], [np.ones((1, n))]
    for p in range(1, SPLINE_DEGREE + 1):
        rows = np.zeros((p + 1, n))
        for r in range(p):
            low, high = knots[first + 1 + r - p], knots[first + 1 + r]
            share = values[-1][r] / (high - low)
            rows[r] += (high - x) * share
            rows[r + 1] += (x - low) * share
        values.append(rows)
    return values


def _pieces(knots: Array, coefficients: Array, bases: list[Array]) -> Array:
    """Taylor coefficients of a spline at the starts of its pieces, (n, 6)."""
    n = bases[0].shape[1]
    rows, d = np.zeros((n, SPLINE_DEGREE + 1)), coefficients
    for k in range(SPLINE_DEGREE + 1):
        p = SPLINE_DEGREE - k
        for r in range(p + 1):
            rows[:, k] += bases[p][r] * d[r : r + n]
        rows[:, k] /= math.factorial(k)
        if p:
            low = np.arange(k + 1, k + len(d))
            d = p * np.diff(d) / (knots[low + p] - knots[low])
    return rows


def _pentadiagonal(bands: list[list[float]], values: list[float]) -> list[float]:
    """Solve a system whose row i holds columns i - 2 to i + 2.

    B-splines' values are a totally positive matrix (C. de Boor, 1978): no pivots are needed.
    """
    n = len(values)
    for i in range(n):
        for k in range(1, min(3, n - i)):
            factor = bands[i + k][2 - k] / bands[i][2]
            bands[i + k][3 - k] -= factor * bands[i][3]
            bands[i + k][4 - k] -= factor * bands[i][4]
            values[i + k] -= factor * values[i]
    out = [0.0] * (n + 2)
    for i in reversed(range(n)):
        out[i] = (values[i] - bands[i][3] * out[i + 1] - bands[i][4] * out[i + 2]) / bands[i][2]
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
