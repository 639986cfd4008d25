"""Quintic splines through points: four times continuously differentiable, at rest at both ends."""

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
    a, b, (low, high) = h[:-1], h[1:], (rise[:-1], rise[1:])
    # Slope and curvature at the points inside are unknown. The fourth and the third derivative do
    # not jump there: a row each, by those of the point before, of the point and of the one after.
    before, here, after = (
        np.moveaxis(np.array(rows), -1, 0)
        for rows in (
            ((168.0 / a**3, 24.0 / a**2), (-24.0 / a**2, -3.0 / a)),
            (
                (192.0 / a**3 + 192.0 / b**3, 36.0 / b**2 - 36.0 / a**2),
                (36.0 / b**2 - 36.0 / a**2, 9.0 / a + 9.0 / b),
            ),
            ((168.0 / b**3, -24.0 / b**2), (24.0 / b**2, -3.0 / b)),
        )
    )
    known = np.array((360.0 * (low / a**4 + high / b**4), 60.0 * (high / b**3 - low / a**3))).T
    for i in range(1, len(known)):
        factor = before[i] @ np.linalg.inv(here[i - 1])
        here[i] -= factor @ after[i - 1]
        known[i] -= factor @ known[i - 1]
    rates = np.zeros((len(x), 2))
    for i in reversed(range(len(known))):
        rates[i + 1] = np.linalg.solve(here[i], known[i] - after[i] @ rates[i + 2])
    slope, bend = rates.T
    (p, q), (u, v) = (slope[:-1] * h, slope[1:] * h), (bend[:-1] * h * h, bend[1:] * h * h)
    third = (10.0 * rise - 6.0 * p - 4.0 * q - 1.5 * u + 0.5 * v) / h**3
    fourth = (-15.0 * rise + 8.0 * p + 7.0 * q + 1.5 * u - v) / h**4
    fifth = (6.0 * rise - 3.0 * p - 3.0 * q - 0.5 * u + 0.5 * v) / h**5
    rows = np.column_stack((y[:-1], slope[:-1], 0.5 * bend[:-1], third, fourth, fifth))
    return PiecewisePolynomial(starts[1:], starts, rows)


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
