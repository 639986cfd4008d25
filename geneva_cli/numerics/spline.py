"""Splines of degree 5 through points, four times continuously differentiable, to the last digit.

A spline's jerk multiplies what rounds in its equations by some third power of the number of
points. So they are solved in 50 digits, in one order of operations: the same on every processor.
What is left is rounded once: the Taylor coefficients at both ends of each interval, from the nearer
of which a value is written.

Unknown are the first and second derivative v, a at the knots; on an interval of length h with the
rise d the quintic of Hermite then has, at its end and its start,

    s''' / 3   = 20 d/h³ - (8 v0 + 12 v1)/h² + (3 a1 - a0)/h,   20 d/h³ - (12 v0 + 8 v1)/h²
                                                                      - (3 a0 - a1)/h
    s'''' / 12 = 30 d/h⁴ - (14 v0 + 16 v1)/h³ + (3 a1 - 2 a0)/h²,
                                      - 30 d/h⁴ + (16 v0 + 14 v1)/h³ + (3 a0 - 2 a1)/h²

which agree from either side of a knot: two equations a knot, with its two neighbours.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Sequence
from decimal import Decimal, localcontext
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple, TypeAlias

from geneva_cli.numerics.arrays import Array, N, read_only
from geneva_cli.numerics.digits import FIFTY

Row: TypeAlias = list[Decimal]
Block: TypeAlias = tuple[Row, Row]  # two equations; a column a right side
ZERO = Decimal(0)
NOTHING = Decimal("1e-40")  # less is what 50 digits leave of a zero, as of the rest at an end


class Exact(NamedTuple):
    """A piecewise polynomial of 50 digits: knots, and each piece's coefficients at its left end."""

    x: list[Decimal]
    c: list[Row]

    def integral(self) -> Exact:
        """Its integral from the first knot, one degree higher."""
        out, sum_ = [], ZERO
        with localcontext(FIFTY):
            for (a, b), c in zip(pairwise(self.x), self.c, strict=True):
                out.append([sum_, *[v / (k + 1) for k, v in enumerate(c)]])
                sum_ = shifted(out[-1], b - a)[0]
        return Exact(self.x, out)

    def end(self) -> Decimal:
        """Its value at the last knot."""
        with localcontext(FIFTY):
            return shifted(self.c[-1], self.x[-1] - self.x[-2])[0]

    def rounded(self) -> Pieces:
        """In doubles: two pieces an interval, one about either end, each coefficient rounded once.

        A piece's origin is the double nearest to its knot, and its coefficients are those there.
        """
        cuts: list[float] = []
        origins: list[float] = []
        rows: list[list[float]] = []
        with localcontext(FIFTY):
            for (a, b), c in zip(pairwise(self.x), self.c, strict=True):
                left, right = float(a), float(b)
                for origin in (left, right):
                    origins.append(origin)
                    at = shifted(c, Decimal(origin) - a)
                    rows.append([float(v) if abs(v) > NOTHING else 0.0 for v in at])
                cuts += [0.5 * (left + right), right]
        return Pieces(cuts[:-1], origins, rows)


class Pieces:
    """A piecewise polynomial in doubles: piece i, about origins[i], lies up to cuts[i]."""

    def __init__(self, cuts: list[float], origins: list[float], rows: list[list[float]]) -> None:
        self.cuts, self.origins, self.rows = cuts, origins, rows

    @cached_property
    def _arrays(self) -> tuple[Array, Array, Array]:
        import numpy as np

        return read_only(
            (np.array(self.cuts), np.array(self.origins), np.array(self.rows).T.copy())
        )

    def __call__(self, x: N, order: int) -> Sequence[N]:
        """Taylor coefficients 0 to ``order`` at a number or an array of numbers."""
        if isinstance(x, (float, int)):
            i = bisect_left(self.cuts, x)
            return _taylor(x - self.origins[i], self.rows[i], order)
        cuts, origins, rows = self._arrays
        index = cuts.searchsorted(x)
        return _taylor(x - origins[index], list(rows[:, index]), order)


def _taylor(t: N, c: Sequence[N], order: int) -> list[N]:
    """Those of a polynomial at t."""
    out = []
    for k in range(order + 1):
        sum_ = 0.0 * t
        for j in reversed(range(k, len(c))):
            sum_ = sum_ * t + math.comb(j, k) * c[j]
        out.append(sum_)
    return out


def shifted(c: Row, t: Decimal) -> Row:
    """The coefficients of a polynomial about a place t away, in the current context."""
    out = list(c)
    if t:
        for k in range(len(out) - 1):
            for j in reversed(range(k, len(out) - 1)):
                out[j] += t * out[j + 1]
    return out


def at_rest(x: Sequence[Decimal], y: Sequence[Decimal]) -> Exact:
    """The spline through points whose first and second derivative are zero at both ends."""
    with localcontext(FIFTY):
        equations = [_equations(x[i - 1 : i + 2], _rises(y[i - 1 : i + 2])) for i in _inner(x)]
        found = _solved(equations, [(row[:1], other[:1]) for *_, (row, other) in equations])
        inner = [(v[0], a[0]) for v, a in found]
        return _hermite(x, y, [(ZERO, ZERO), *inner, (ZERO, ZERO)])


def periodic(x: Sequence[Decimal], y: Sequence[Decimal]) -> Exact:
    """The periodic spline through points, the last of which is the first a period later."""
    with localcontext(FIFTY):
        equations = [_equations(x[i - 1 : i + 2], _rises(y[i - 1 : i + 2])) for i in _inner(x)]
        # The first knot, which is the last too, is put aside: two more right sides, its v and a.
        right: list[Block] = []
        for i, (before, _, after, known) in enumerate(equations):
            rows = []
            for k in (0, 1):
                by = [ZERO, ZERO]
                if i == 0:
                    by = [p - q for p, q in zip(by, before[k], strict=True)]
                if i == len(equations) - 1:
                    by = [p - q for p, q in zip(by, after[k], strict=True)]
                rows.append([known[k][0], *by])
            right.append((rows[0], rows[1]))
        found = _solved(equations, right)
        ends = [x[-2] - x[-1] + x[0], x[0], x[1]]
        before, here, after, known = _equations(ends, _rises([y[-2], y[0], y[1]]))
        at = []
        for k in (0, 1):
            row = [known[k][0], *[-v for v in here[k]]]
            for part, (v, a) in ((before[k], found[-1]), (after[k], found[0])):
                row = [r - part[0] * p - part[1] * q for r, p, q in zip(row, v, a, strict=True)]
            at.append(row)
        (p, a11, a12), (q, a21, a22) = at
        v0, a0 = _solve2([-a11, -a12], [-a21, -a22], [p], [q])
        first = (v0[0], a0[0])
        inner = [tuple(s[0] + s[1] * first[0] + s[2] * first[1] for s in block) for block in found]
        return _hermite(x, y, [first, *[(v, a) for v, a in inner], first])


class Doubt(NamedTuple):
    """What the rounding of points leaves unknown of their spline."""

    decimals: int  # with which the points are given
    move: float  # by how much a derivative may be off, at its worst place


def doubt(x: Sequence[Decimal], y: Sequence[float], period: bool, order: int) -> Doubt:
    """How far half a unit of the points' last decimal moves a derivative.

    The inverse of B-splines' values at points is a matrix of signs like a chessboard's (C. de Boor
    and A. Pinkus, 1977): points that are off to and fro in turn move a spline most. The first and
    last are taken as exact.
    """
    exponents = [Decimal(repr(v)).normalize().as_tuple().exponent for v in y]
    decimals = max(0, *[-e for e in exponents if isinstance(e, int)])
    unit = Decimal(1).scaleb(-decimals)
    off = [max(unit, Decimal(math.ulp(v))) / (2 if k % 2 else -2) for k, v in enumerate(y)]
    off[0] = off[-1] = ZERO
    pieces = (periodic if period else at_rest)(x, off).rounded()
    move = max(abs(pieces(at, order)[order]) for at in (*pieces.origins, *pieces.cuts))
    return Doubt(decimals, math.factorial(order) * move)


def _inner(x: Sequence[Decimal]) -> range:
    return range(1, len(x) - 1)


def _rises(y: Sequence[Decimal]) -> tuple[Decimal, Decimal]:
    return y[1] - y[0], y[2] - y[1]


def _equations(
    x: Sequence[Decimal], rises: tuple[Decimal, Decimal]
) -> tuple[Block, Block, Block, Block]:
    """Third and fourth derivative alike at the middle of three knots.

    The coefficients of (v, a) before, there and after, and the right side.
    """
    p, q = 1 / (x[1] - x[0]), 1 / (x[2] - x[1])
    p2, q2 = p * p, q * q
    p3, q3 = p2 * p, q2 * q
    d, e = rises
    return (
        ([-8 * p2, -p], [-14 * p3, -2 * p2]),
        ([12 * (q2 - p2), 3 * (p + q)], [-16 * (p3 + q3), 3 * (p2 - q2)]),
        ([8 * q2, -q], [-14 * q3, 2 * q2]),
        ([20 * (e * q3 - d * p3)], [-30 * (d * p3 * p + e * q3 * q)]),
    )


def _solve2(row: Row, other: Row, right: Row, beside: Row) -> Block:
    """Two equations for several right sides, by Cramer's rule."""
    (a, b), (c, d) = row, other
    whole = 1 / (a * d - b * c)
    return (
        [(d * p - b * q) * whole for p, q in zip(right, beside, strict=True)],
        [(a * q - c * p) * whole for p, q in zip(right, beside, strict=True)],
    )


def _solved(equations: list[tuple[Block, Block, Block, Block]], right: list[Block]) -> list[Block]:
    """Block elimination. No pivots: the first k equations are those of the spline through the
    first k + 2 points at rest at its ends, which there always is."""
    rise: list[tuple[Block, Block]] = []
    for (before, here, after, _), given in zip(equations, right, strict=True):
        if rise:
            to, known = rise[-1]
            here, given = _less(here, before, to), _less(given, before, known)
        both = [_solve2(*here, *part) for part in (after, given)]
        rise.append((both[0], both[1]))
    out: list[Block] = []
    for to, known in reversed(rise):
        out.append(_less(known, to, out[-1]) if out else known)
    return out[::-1]


def _less(block: Block, factor: Block, by: Block) -> Block:
    """block - factor by, where factor is 2 x 2."""
    rows = [
        [v - f[0] * p - f[1] * q for v, p, q in zip(row, *by, strict=True)]
        for row, f in zip(block, factor, strict=True)
    ]
    return rows[0], rows[1]


def _hermite(
    x: Sequence[Decimal], y: Sequence[Decimal], ends: Sequence[tuple[Decimal, Decimal]]
) -> Exact:
    """The quintics with these values, first and second derivatives at the knots."""
    out = []
    for i, (a, b) in enumerate(pairwise(x)):
        h, d = b - a, y[i + 1] - y[i]
        (v0, a0), (v1, a1) = ends[i], ends[i + 1]
        third = (10 * d - (6 * v0 + 4 * v1) * h - (3 * a0 - a1) * h * h / 2) / h**3
        fourth = (-15 * d + (8 * v0 + 7 * v1) * h + (3 * a0 - 2 * a1) * h * h / 2) / h**4
        fifth = (6 * d - 3 * (v0 + v1) * h - (a0 - a1) * h * h / 2) / h**5
        out.append([y[i], v0, a0 / 2, third, fourth, fifth])
    return Exact(list(x), out)
