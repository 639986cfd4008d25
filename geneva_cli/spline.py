"""Splines of degree 5 through points: four times continuously differentiable.

The coefficients are found in our own order of operations (see ``linear``), so that they are the
same on every processor; SciPy's B-splines evaluate them.

The third derivative of a spline through n even points moves by some 0.4 n³ of the share of its
peak by which the points move: with doubles, 1e-10 at a hundred points, 1e-7 at a thousand.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from geneva_cli.linear import product, solve, solve_banded

if TYPE_CHECKING:
    from geneva_cli.jet import Array

DEGREE = 5
SIDE = 2  # at a knot five of the B-splines are not zero: two on either side of the middle one


def at_rest(x: list[float], y: list[float]) -> Any:
    """The spline through points whose first and second derivative are zero at both ends."""
    from scipy.interpolate import BSpline

    knots = np.array([x[0]] * DEGREE + x + [x[-1]] * DEGREE)
    # At an end knot of full multiplicity that makes the first three coefficients equal.
    known = dict.fromkeys(range(3), y[0]) | {len(x) + 1 + j: y[-1] for j in range(3)}
    rows, right = [], []
    for i, found in enumerate(_basis(x[1:-1], knots)):  # its middle one is the i-th unknown
        row = [0.0] * (2 * SIDE + 1)
        rest = y[i + 1]
        for j, value in found:
            if j in known:
                rest -= value * known[j]
            elif abs(j - 3 - i) <= SIDE:
                row[j - 3 - i + SIDE] = value
        rows.append(row)
        right.append([rest])
    solve_banded(rows, SIDE, right)
    inner = [value for (value,) in right]
    return BSpline(knots, np.array([y[0]] * 3 + inner + [y[-1]] * 3), DEGREE)


def periodic(x: list[float], y: list[float]) -> Any:
    """The periodic spline through points, the last of which is the first a period later.

    At least seven points.
    """
    from scipy.interpolate import BSpline

    n, period = len(x) - 1, x[-1] - x[0]
    before, after = x[-1 - DEGREE : -1], x[1 : DEGREE + 1]
    knots = np.array([v - period for v in before] + x + [v + period for v in after])
    # The unknowns go round: the last two are put aside, and what is left is banded.
    banded = n - SIDE
    rows = [[0.0] * (2 * SIDE + 1) for _ in range(banded)]
    right = [[0.0] * SIDE + [value] for value in y[:banded]]  # the two columns put aside, and y
    last = np.zeros((SIDE, n))
    for i, found in enumerate(_basis(x[:-1], knots)):
        for j, value in found:
            at = (j - SIDE) % n
            if i >= banded:
                last[i - banded, at] += value
            elif at >= banded:
                right[i][at - banded] += value
            elif abs(at - i) <= SIDE:
                rows[i][at - i + SIDE] = value
    solve_banded(rows, SIDE, right)
    solved = np.array(right)
    beside = last[:, banded:] - product(last[:, :banded], solved[:, :SIDE])
    rest = np.array(y[banded:n]) - product(last[:, :banded], solved[:, SIDE:])[:, 0]
    aside = solve(beside, rest)
    inner = solved[:, SIDE] - product(solved[:, :SIDE], aside[:, None])[:, 0]
    c = np.concatenate((inner, aside))
    c = np.roll(c, SIDE)  # unknown i is the coefficient of the B-spline i + 2
    return BSpline(knots, np.concatenate((c, c[:DEGREE])), DEGREE)


def _basis(x: list[float], knots: Array) -> Iterator[list[tuple[int, float]]]:
    """For each place the B-splines that are not zero there: number and value."""
    from scipy.interpolate import BSpline

    found = BSpline.design_matrix(np.array(x), knots, DEGREE)
    ends, numbers, values = found.indptr.tolist(), found.indices.tolist(), found.data.tolist()
    for a, b in pairwise(ends):
        yield [(j, value) for j, value in zip(numbers[a:b], values[a:b], strict=True) if value]
