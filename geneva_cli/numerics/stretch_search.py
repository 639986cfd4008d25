"""Greatest and least values of functions of many designs, and the places where signs change.

Functions are smooth only while certain signs do not change. For example, a load jumps where the
roller's sliding reverses, and has a kink where the torque does. Each design's spans are sampled at
Chebyshev points and cut where signs change (``pieces``). The series between cuts show where a
function may exceed the known values; there the function itself is evaluated, by Newton steps.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.numerics import chebyshev
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import (
    Array,
    Mask,
    Which,
    Whole,
    blocks,
    columns_taken,
    joined,
    rows_joined,
    rows_taken,
)
from geneva_cli.numerics.chebyshev import GRID, MIDDLE, POINTS
from geneva_cli.numerics.greatest import GreatestValues
from geneva_cli.numerics.smooth_pieces import (
    LATER_TERMS,
    NEWTON_STEPS,
    Cutter,
    Functions,
    Rows,
    SampledRows,
    SpreadPlaces,
)
from geneva_cli.numerics.tolerances import TIE

BLOCK = 2048  # rows sampled at a time: that many fit in the processor's cache
OVERSHOOT = 0.15  # fraction of the range of samples, by which an extreme between them may exceed it
UNFINISHED = 16.0  # times the last terms: the error of a series that has not ended


class Stretches(NamedTuple):
    """The parts of designs' spans on which no sign changes, in order of design and place."""

    design: Whole
    span: Whole
    x: Array  # both ends: (2, m)
    positive: Mask  # (signs, m)


class SearchResult(NamedTuple):
    """Greatest values of n designs and their places: a row for each side and each function."""

    most: Array
    x: Array
    stretches: Stretches


class CandidateCurves(NamedTuple):
    """Functions, on one piece each, that may have one of the greatest values there."""

    number: Whole  # of the function: (m,)
    rows: Rows  # the pieces
    sign: Array  # (signs, m)
    part: Array  # both ends of the piece as positions in the sampled row: (2, m)
    value: Array  # at the Chebyshev points of that row: (m, points)
    left: Array  # the error of the series

    def take(self, which: Which) -> CandidateCurves:
        """Some of the curves, by a mask or their numbers."""
        number, rows, sign, part, value, left = self
        ends = columns_taken(sign, which), columns_taken(part, which)
        some = rows_taken(value, which), columns_taken(left, which)
        return CandidateCurves(columns_taken(number, which), rows.take(which), *ends, *some)

    @property
    def within(self) -> Mask:
        """Masks of the points that lie in the piece: (m, points)."""
        points = POINTS[:, None]
        return np.asarray(((self.part[0] <= points) & (self.part[1] >= points)).T)


def search(
    f: Functions,
    spans: Sequence[tuple[Array, Array]],
    n: int,
    sized: bool,
    known: Sequence[tuple[int, Array, Array]] = (),
    w: Array | None = None,
) -> SearchResult:
    """The greatest values of n designs over their spans, whose ends are (n, 1) in degrees.

    A span that ends before it begins is empty. With ``sized`` the result has the greatest sizes,
    else the greatest values of the functions and of their negatives. ``known`` are values that no
    span reaches: the number of a wanted function, and for each design the place and the value, or
    NaN. Samples are spread about 0 by ``w`` (n, 1), or evenly spaced.
    """
    with np.errstate(all="ignore"):
        extremes = _ExtremeSearch(f, n, sized, w)
        for number, x, value in known:
            design = np.flatnonzero(~np.isnan(value))
            of = np.full(len(design), number)
            extremes.greatest.add(of, design, x[design], value[design])
        extremes.sample(spans)
        extremes.refine()
        most, x = extremes.greatest.most, extremes.greatest.places()
        stretches = _stretches(joined(extremes.rows), np.concatenate(extremes.signs, axis=1))
        return SearchResult(most.reshape(-1, n), x.reshape(-1, n), stretches)


class _ExtremeSearch:
    def __init__(self, f: Functions, n: int, sized: bool, w: Array | None) -> None:
        self.f, self.n, self.places = f, n, SpreadPlaces(w)
        self.greatest = GreatestValues(f.wanted, n, sized)
        self.cutter = Cutter(f, self.places, n)
        self.rows: list[Rows] = []  # the pieces on which no sign changes
        self.signs: list[Array] = []
        self.curves: list[CandidateCurves] = []

    def sample(self, spans: Sequence[tuple[Array, Array]]) -> None:
        """Sample the spans until every function's series has ended where that matters."""
        first = [self._rows(number, *ends) for number, ends in enumerate(spans)]
        for rows in first:
            np.add.at(self.cutter.width, rows.design, rows.u[1] - rows.u[0])
        parts = _blocks(joined(first))
        for depth in range(60):  # halvings: all rows are too narrow for more by then
            every = [self.cutter.sampled(part) for part in parts]
            for sampled in every:
                self.greatest.add_samples(sampled.pieces, sampled.x)
            # Rows that were halved four times lie near a pole: their sizes are not typical.
            for sampled in every if depth < 4 else ():
                self.greatest.add_sizes(sampled.pieces)
            again = [rows for sampled in every for rows in (*sampled.again, *self._judged(sampled))]
            if not again:
                break
            parts = _blocks(joined(again))

    def _rows(self, number: int, a: Array, b: Array) -> Rows:
        """The rows of a span, one for each design that has it."""
        design = np.flatnonzero((b > a)[:, 0])
        x = np.stack((a[design, 0], b[design, 0]))
        u = np.stack([self.places.spread(end, design) for end in x])
        return Rows(design, np.full(len(design), number), u, x, np.full(x.shape, True))

    def _judged(self, sampled: SampledRows) -> list[Rows]:
        """Keep pieces with precise series, and return the rows to sample for the others."""
        pieces = sampled.pieces
        low, high = pieces.value.min(axis=2), pieces.value.max(axis=2)
        left = chebyshev.remainder(pieces.value)
        more = OVERSHOOT * (high - low) + UNFINISHED * left
        functions = np.arange(len(low))[:, None]
        may = self.greatest.may_be(functions, pieces.rows.design, low - more, high + more)
        may &= (low != np.inf) & (high != -np.inf)  # it has a bound somewhere
        number, own = np.nonzero(may)
        each = [rows_taken(one, some) for one, some in zip(pieces.value, may, strict=True)]
        value = rows_joined([np.empty((0, len(POINTS))), *each])
        rows, sign, part = pieces.rows.take(own), pieces.sign[:, own], pieces.part[:, own]
        curves = CandidateCurves(number, rows, sign, part, value, left[number, own])
        miss = np.full(len(pieces.rows.design), False)
        margin, x = (rows_taken(every, own) for every in (sampled.margin, sampled.x))
        miss[own[self._unsettled(curves, margin, x)]] = True
        miss &= ~self.cutter.is_narrow(pieces.rows)
        self.curves.append(curves.take(~miss[own]))
        self.rows.append(pieces.rows.take(~miss))
        self.signs.append(pieces.sign[:, ~miss])
        whole = pieces.whole
        out = [pieces.rows.take(miss & ~whole), *self.places.halves(pieces.rows.take(miss & whole))]
        return [rows for rows in out if len(rows.design)]

    def _unsettled(self, curves: CandidateCurves, margin: Array, x: Array) -> Whole:
        """The numbers of curves with unfinished series that may exceed the known values."""
        size = np.where(curves.within, np.abs(curves.value), 0.0).max(axis=1, initial=0.0)
        # The allowed error of a series near an extreme: 1e-5 of a size. Where a force is nearly 0,
        # its square is only the rounding of the greatest force, and no halving ends its series.
        noise = TIE * TIE * self.greatest.size[curves.number, curves.rows.design]
        ended = (curves.left < np.inf) & (curves.left <= np.maximum(1e-5 * size, noise))
        some = np.flatnonzero(~ended)
        curves, more = curves.take(some), UNFINISHED * curves.left[some]
        low, high = curves.value.min(axis=1) - more, curves.value.max(axis=1) + more
        whole = (curves.part[0] == -1.0) & (curves.part[1] == 1.0)
        margin, x = rows_taken(margin, some), rows_taken(x, some)
        for weight in (margin, margin**2, np.abs(x), x**2):
            least = _least_size(curves.value, weight)
            known = whole & (least > 0.0)
            rises, falls = curves.value[:, MIDDLE] > 0.0, curves.value[:, MIDDLE] < 0.0
            low = np.where(known & rises & ~(least <= low), least, low)
            high = np.where(known & falls & ~(-least >= high), -least, high)
        may = self.greatest.may_be(curves.number, curves.rows.design, low, high)
        return some[may]

    def refine(self) -> None:
        """Evaluate the functions at ends and extremes that may be the greatest."""
        curves = _curves_joined(self.curves)
        curves = _curves_joined([curves, *[self._ends(curves, end) for end in (0, 1)]])
        turns = [
            _turns(curves.take(own[block]), sign, bar[block], own[block])
            for sign in (1.0, -1.0)
            for own, bar in [self._may_turn(curves, sign)]
            for block in blocks(len(own), BLOCK)
        ]
        self._refine(curves, *(np.concatenate(one) for one in zip(*turns, strict=True)))

    def _ends(self, curves: CandidateCurves, end: int) -> CandidateCurves:
        """Add the limits at one end of pieces where they may be the greatest.

        Returns the parts next to flat ends, sampled anew: there the series of a whole piece does
        not tell the sign of the slope.
        """
        terms = chebyshev.series(curves.value)
        value, more = chebyshev.at(terms, curves.part[end]), LATER_TERMS * curves.left
        low, high = value - more, value + more
        may = self.greatest.may_be(curves.number, curves.rows.design, low, high)
        curves = curves.take(may & curves.rows.edge[end])
        x, size = curves.rows.x[end], np.abs(curves.value).max(axis=1, initial=0.0)
        value, slope = self._jets(x[:, None], curves, 1)[..., 0]
        self._add(curves, x, value)
        width = curves.rows.x[1] - curves.rows.x[0]
        # a series does not tell the sign of a slope that changes the piece by less than 1e-3
        return self._next_to_end(curves.take(np.abs(slope) * width <= 1e-3 * size), end)

    def _next_to_end(self, curves: CandidateCurves, end: int) -> CandidateCurves:
        """The part of pieces next to one end, as pieces of their own."""
        rows, other = curves.rows, 1 - end
        u = rows.u.copy()
        # on a tenth of a piece a series of degree 16 is exact to the last digits
        u[other] = u[end] + 0.1 * (u[other] - u[end])
        rows = rows._replace(u=u, edge=np.full(u.shape, False))
        x = self.places.gathered(rows.at(POINTS[:, None]).T, rows.design)
        x = np.clip(x, rows.x[0][:, None], rows.x[1][:, None])
        rows = rows._replace(x=np.stack((x[:, 0], x[:, -1])))
        value = self._jets(x, curves, 0)[0]
        part = np.array([[-1.0], [1.0]]).repeat(len(value), axis=1)
        return CandidateCurves(
            curves.number, rows, curves.sign, part, value, chebyshev.remainder(value)
        )

    def _add(self, curves: CandidateCurves, x: Array, value: Array) -> None:
        self.greatest.add(curves.number, curves.rows.design, x, value)

    def _may_turn(self, curves: CandidateCurves, sign: float) -> tuple[Whole, Array]:
        """Curves on which a maximum of ``sign`` times the function may be one of the greatest.

        Returns their numbers, and the least value that counts as greatest.
        """
        low, high = curves.value.min(axis=1), curves.value.max(axis=1)
        more = OVERSHOOT * (high - low)
        # a function whose range is rounding has no extreme within
        may = high - low > 1e-13 * np.maximum(np.abs(low), np.abs(high))
        side = 0 if sign > 0.0 or self.greatest.sized else 1
        bar = self.greatest.least(side)[curves.number, curves.rows.design]
        may &= ~((high if sign > 0.0 else -low) + more < bar) & (bar < np.inf)
        own = np.flatnonzero(may)
        return own, bar[own]

    def _refine(self, curves: CandidateCurves, which: Whole, t: Array, cell: Array) -> None:
        """Add extremes of the functions themselves, next to the maxima of their series."""
        curves = curves.take(which)
        rows = curves.rows
        x = self.places.gathered(rows.at(t), rows.design)
        # Cells crowd at the ends of a piece, where a series is no more precise: the range is at
        # least a tenth of half a piece.
        near = 0.5 * (rows.x[1] - rows.x[0]) * np.maximum(cell, 0.1)
        live, value = np.arange(len(x)), np.empty(len(x))
        for _ in range(NEWTON_STEPS):
            if not len(live):
                break
            v, slope, bend = self._jets(x[live, None], curves.take(live), 2)[..., 0]
            step = -slope / bend
            step = np.where(np.abs(step) <= near[live], step, 0.0)
            step = np.clip(x[live] + step, *rows.x[:, live]) - x[live]
            value[live] = v + 0.5 * slope * step
            x[live] += step
            # after a step of 1e-5 of the search range, a maximum's value is exact
            live = live[np.abs(step) > 1e-5 * near[live]]
        self._add(curves, x, value)

    def _jets(self, x: Array, curves: CandidateCurves, order: int) -> Array:
        """Value and derivatives by degrees of each curve's function at places (m, k)."""
        out = np.empty((order + 1, *x.shape[::-1])).swapaxes(1, 2)
        # several functions at once: their common parts cost most
        in_order = np.argsort(curves.number, kind="stable")
        for i in range(0, len(x), BLOCK):
            of = in_order[i : i + BLOCK]
            requested, own = np.unique(curves.number[of], return_inverse=True)
            at = self.f.at(x[of], curves.rows.design[of], order)
            c = self.f.evaluate(at, curves.sign[:, of, None], requested.tolist())[1]
            out[:, of] = [one[self.f.signs + own, np.arange(len(of))] for one in c]
        scale = np.array([1.0, DEGREE, 2.0 * DEGREE * DEGREE])[: order + 1]
        out *= scale[:, None, None]
        return out


def _turns(
    curves: CandidateCurves, sign: float, bar: Array, own: Whole
) -> tuple[Whole, Array, Array]:
    """Maxima of ``sign`` times the functions that may reach ``bar``.

    Returns the numbers of the curves among their own numbers, positions from -1 to 1, and the
    ranges of the search there.
    """
    left, cell = LATER_TERMS * curves.left, np.diff(GRID)
    g, d = chebyshev.on_grid(sign * curves.value)
    before, after = d[:, :-1], d[:, 1:]
    reach = np.maximum(g[:, :-1], g[:, 1:]) + 0.25 * cell * np.abs(before - after)
    may = (before > 0.0) & (after < 0.0) & ~(reach + left[:, None] < bar[:, None])
    grid = GRID[:, None]
    may &= ((grid[1:] > curves.part[0]) & (grid[:-1] < curves.part[1])).T
    which, k = np.nonzero(may)
    before, after = before[which, k], after[which, k]
    terms = chebyshev.series(sign * rows_taken(curves.value, which))
    start = GRID[k] + cell[k] * before / (before - after)
    t = chebyshev.root(chebyshev.slopes(terms), GRID[k], GRID[k + 1], start)
    kept = ~(chebyshev.at(terms, t) + left[which] < bar[which])
    a, b = curves.part[:, which]
    kept &= (a - cell[k] < t) & (t < b + cell[k])
    # positions in the piece itself
    t = np.clip((2.0 * t - a - b) / (b - a), -1.0, 1.0)
    return own[which[kept]], t[kept], (2.0 * cell[k] / (b - a))[kept]


def _least_size(value: Array, weight: Array) -> Array:
    """Lower bounds of functions' sizes (m, points), from their products with weights; 0 if unknown.

    Near a pole the product is nearly constant, and the size is at least the product over the
    weight.
    """
    inner = (value * weight)[:, 1:-1]
    low, high = inner.min(axis=1), inner.max(axis=1)
    least = np.where(low > 0.0, low, -high)
    most = np.where(low > 0.0, high, -low)
    # a product that varies by less than a factor of 4 is near its limit at a pole
    tame = (least > 0.0) & (most < 4.0 * least)
    return np.where(tame, 0.5 * least / weight.max(axis=1), 0.0)


def _blocks(rows: Rows) -> list[Rows]:
    return [rows.take(slice(i, i + BLOCK)) for i in range(0, len(rows.design), BLOCK)]


def _curves_joined(parts: Sequence[CandidateCurves]) -> CandidateCurves:
    """Several groups of curves as one; their values have the points as last axis."""
    number, rows, *others = zip(*parts, strict=True)
    sign, part = (np.concatenate(one, axis=1) for one in others[:2])
    value, left = rows_joined(others[2]), np.concatenate(others[3])
    return CandidateCurves(np.concatenate(number), joined(rows), sign, part, value, left)


def _stretches(rows: Rows, sign: Array) -> Stretches:
    """Adjacent pieces with equal signs joined into one."""
    order = np.lexsort((rows.x[0], rows.span, rows.design))
    design, span, _, (a, b), _ = rows.take(order)
    positive = sign[:, order] > 0.0
    first = np.ones(len(design), dtype=bool)
    first[1:] = (design[1:] != design[:-1]) | (span[1:] != span[:-1])
    first[1:] |= (positive[:, 1:] != positive[:, :-1]).any(axis=0)
    last = np.append(first[1:], True)
    x = np.stack((a[first], b[last]))
    return Stretches(design[first], span[first], x, positive[:, first])
