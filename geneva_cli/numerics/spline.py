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
    from scipy.interpolate import PPoly, make_interp_spline  # of table laws alone

    rest = [(1, 0.0), (2, 0.0)]
    spline = PPoly.from_spline(make_interp_spline(x, y, SPLINE_DEGREE, bc_type=(rest, rest)))
    # powers in rising order, without the pieces of no width between the knots at either end
    rows: Array = spline.c[::-1, SPLINE_DEGREE:-SPLINE_DEGREE].T.copy()
    rows[:, 0] = y[:-1]
    rows[0, 1:3] = 0.0
    starts = np.array(x[:-1])
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
