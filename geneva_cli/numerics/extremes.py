"""Greatest and least values of functions of many designs, and the places where signs change.

Functions are smooth only while certain signs do not change. For example, a load jumps where the
roller's sliding reverses, and has a kink where the torque does. Each design's spans are sampled at
Chebyshev points and cut where signs change (``cuts``). The series between cuts show where a
function may exceed the known values; there the function itself is evaluated, by Newton steps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import factorial
from typing import NamedTuple

import numpy as np

from geneva_cli.numerics import chebyshev
from geneva_cli.numerics.arrays import (
    Array,
    Mask,
    Which,
    Whole,
    blocks,
    joined,
    record_taken,
    rows_joined,
    rows_taken,
)
from geneva_cli.numerics.chebyshev import MIDDLE, POINTS
from geneva_cli.numerics.cuts import (
    BLOCK,
    LATER_TERMS,
    Cutter,
    Functions,
    Pieces,
    Rows,
    gathered,
)
from geneva_cli.numerics.tolerances import TIE

GROUP = 1 << 15  # functions of designs that are searched together
UNFINISHED = 4.0 * LATER_TERMS  # times the last terms: the error of a series that has not ended
PRECISE = 1e-5  # fraction of a size: the allowed error of a series near an extreme


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
    pieces: list[tuple[Rows, Array]]  # parts without a change of sign, and their signs

    @property
    def stretches(self) -> Stretches:
        """The parts on which no sign changes."""
        return _stretches(*joined(self.pieces))


class Smooth:
    """Functions of designs without kinks and jumps, from their derivatives.

    ``derivatives(x, which, order, requested)`` returns value and derivatives of each requested
    function; their number may be higher than the order. The first ``signs`` functions are those
    whose signs matter. ``unit`` is that of the places over the derivatives'.
    """

    poled = ()

    def __init__(
        self,
        derivatives: Callable[[Array, Which, int, Sequence[int]], Sequence[Sequence[Array]]],
        wanted: int = 1,
        signs: int = 0,
        unit: float = 1.0,
    ) -> None:
        self.derivatives, self.wanted, self.signs, self.unit = derivatives, wanted, signs, unit

    def __call__(
        self,
        x: Array,
        which: Which,
        order: int,
        held: Array | None = None,
        requested: Sequence[int] | None = None,
    ) -> tuple[Mask, list[Array]]:
        """Masks of positive signs, and Taylor coefficients."""
        numbers = range(self.wanted) if requested is None else requested
        every = [*range(self.signs), *(self.signs + i for i in numbers)]
        out = [np.empty((len(every), *x.shape[::-1])).swapaxes(1, 2) for _ in range(order + 1)]
        for i, row in enumerate(self.derivatives(np.asfortranarray(x), which, order, every)):
            for k, values in enumerate(out):
                values[i] = row[k] * (self.unit**k / factorial(k)) if k else row[k]
        return out[0][: self.signs] > 0.0, out


def search(
    f: Functions,
    spans: Sequence[tuple[Array, Array]],
    sized: bool,
    known: Sequence[tuple[int, Array, Array]] = (),
    w: Array | None = None,
) -> SearchResult:
    """The greatest values of n designs over their spans, whose ends are (n, 1).

    A span that ends before it begins is empty. With ``sized`` the result has the greatest sizes,
    else the greatest values of the functions and of their negatives. ``known`` are values that no
    span reaches: the number of a wanted function, and for each design the place and the value, or
    NaN. Samples are spread about 0 by ``w`` (n, 1), or evenly spaced.

    Values that differ only by rounding are equal: the earlier place counts.
    """
    with np.errstate(all="ignore"):
        extremes = _Extremes(f, _widths(spans, w), sized)
        for number, x, value in known:
            design = np.flatnonzero(~np.isnan(value))
            extremes.add(np.full(len(design), number), design, x[design], value[design])
        for part in blocks(len(spans[0][0]), GROUP // max(f.wanted, 2)):
            extremes.sample([(a[part], b[part]) for a, b in spans], part.start)
            extremes.refine()
        shape = -1, len(spans[0][0])
        places = extremes.places().reshape(shape)
        return SearchResult(extremes.most.reshape(shape), places, extremes.pieces)


def cuts(f: Functions, spans: Sequence[tuple[Array, Array]], w: Array | None = None) -> Stretches:
    """The parts of the spans of ``search`` on which no sign changes."""
    with np.errstate(all="ignore"):
        cutter, out = Cutter(f, _widths(spans, w), ()), _no_pieces(f)
        for part in blocks(len(spans[0][0]), BLOCK):
            rows = cutter.rows([(a[part], b[part]) for a, b in spans], part.start)
            for level in cutter.levels(rows):
                out += [(p.rows, p.sign) for p in map(cutter.sampled, level)]
        return _stretches(*joined(out))


def _widths(spans: Sequence[tuple[Array, Array]], w: Array | None) -> Array:
    """The widths (n,) by which samples are spread; with a wide one they are evenly spaced."""
    reach = np.max([np.abs(end[:, 0]) for span in spans for end in span], axis=0)
    return np.asarray(1e3 * reach + 1e-300 if w is None else w[:, 0])


class _Candidates(NamedTuple):
    """Places near which a function may have one of its greatest values on a piece."""

    number: Whole  # of the function: (m,)
    design: Whole
    sign: Array  # held there: (signs, m)
    ends: Array  # of the piece: (2, m)
    x: Array  # from which to search
    near: Array  # the longest step from there
    uphill: Array  # 1 for a maximum, -1 for a minimum, 0 for a constant
    reach: Array  # a bound of the sided value

    def take(self, which: Which) -> _Candidates:
        """Some of the candidates, by a mask or their numbers."""
        return record_taken(self, which)


class _Curves(NamedTuple):
    """Functions on one piece each, at the Chebyshev points of the piece."""

    number: Whole  # of the function: (m,)
    piece: Whole  # its number
    value: Array  # (m, points)
    left: Array  # the error of the series

    def take(self, which: Mask) -> _Curves:
        number, piece, value, left = self
        return _Curves(number[which], piece[which], rows_taken(value, which), left[which])


class _Extremes:
    """The greatest values of n designs, and the first places that have them."""

    def __init__(self, f: Functions, w: Array, sized: bool) -> None:
        self.f, self.sized, self.cutter = f, sized, Cutter(f, w, None)
        self.senses = (1.0,) if sized else (1.0, -1.0)
        self.most = np.full((len(self.senses), f.wanted, len(w)), -np.inf)
        self.size = np.zeros((f.wanted, len(w)))  # typical ones, of samples far from poles
        self.at_sample = np.full(self.most.shape, np.nan)  # the place of a greatest sample
        self.known: list[tuple[int, Whole, Whole, Array, Array]] = []
        self.candidates: list[list[_Candidates]] = [[] for _ in self.senses]
        self.pieces = _no_pieces(f)

    def _sided(self, sense: float, value: Array) -> Array:
        """Sizes, or values times the sense: 1 for the greatest values, -1 for the least."""
        return np.abs(value) if self.sized else sense * value

    def add(self, number: Whole, design: Whole, x: Array, value: Array) -> None:
        """Add values (m,) of functions, by their numbers, at ends and extremes."""
        for side, sense in enumerate(self.senses):
            own = self._sided(sense, value)
            _raise(self.most[side], number, design, own)
            self.known.append((side, number, design, x, own))

    def _bar(self, side: int, number: Whole, design: Whole) -> Array:
        """The least values that count as equal to the greatest ones."""
        return bar(self.most[side, number, design], self.size[number, design])

    def _may_be(self, number: Whole, design: Whole, low: Array, high: Array) -> Mask:
        """Masks of functions between ``low`` and ``high`` that may have one of the greatest values.

        Nothing exceeds an unbounded value.
        """
        out = np.full(np.shape(low), False)
        for side, sense in enumerate(self.senses):
            reach = np.maximum(high, -low) if self.sized else high if sense > 0.0 else -low
            least = self._bar(side, number, design)
            out |= ~(reach < least) & (least < np.inf)
        return out

    def places(self) -> Array:
        """The first places of the greatest values."""
        first = np.full(self.most.shape, np.inf)
        for side, number, design, x, value in self.known:
            near = value >= self._bar(side, number, design)
            np.fmin.at(first[side], (number[near], design[near]), x[near])
        return np.where(np.isinf(first), self.at_sample, first)

    def sample(self, spans: Sequence[tuple[Array, Array]], start: int) -> None:
        """Sample spans of designs until every function's series has ended where that matters."""
        rows = self.cutter.rows(spans, start)
        for depth, level in enumerate(self.cutter.levels(rows)):
            every = [self.cutter.sampled(block) for block in level]
            for pieces in every:
                self._add_samples(pieces, depth)
            for pieces in every:
                self._judge(pieces)

    def _add_samples(self, pieces: Pieces, depth: int) -> None:
        """Add samples of pieces; only those within each piece count."""
        (a, b), x, every = pieces.rows.x, pieces.x, np.arange(len(pieces.x))
        design, number = pieces.rows.design, np.arange(self.f.wanted)[:, None]
        outside = (x < a[:, None]) | (x > b[:, None])
        for side, sense in enumerate(self.senses):
            own = self._sided(sense, pieces.value)
            endless = (own == np.inf).all(axis=2)
            own = np.where(outside, -np.inf, own) if outside.any() else own
            best = own.argmax(axis=2)
            top, place = own[number, every, best], x[every, best]
            top, place = np.where(endless, np.inf, top), np.where(endless, a, place)
            _raise(self.most[side], number, design, top)
            of, row = np.nonzero(top == self.most[side][:, design])
            self.at_sample[side, of, design[row]] = place[of, row]
            of, row = np.nonzero(top == np.inf)
            self.known.append((side, of, design[row], place[of, row], top[of, row]))
        if depth < 4:  # rows that were halved more often lie near a pole
            inner = np.abs(pieces.value[..., MIDDLE // 2 : MIDDLE + 5 : MIDDLE // 2]).max(axis=2)
            _raise(self.size, number, design, np.where(np.isfinite(inner), inner, 0.0))

    def _judge(self, pieces: Pieces) -> None:
        """Keep candidates of pieces with precise series, and sample the others again.

        Where a force is nearly 0, its square is only the rounding of the greatest force, and no
        halving ends its series.
        """
        curves, design = self._curves(pieces), pieces.rows.design
        size = np.abs(curves.value).max(axis=1, initial=0.0)
        noise = TIE * TIE * self.size[curves.number, design[curves.piece]]
        ended = (curves.left < np.inf) & (curves.left <= np.maximum(PRECISE * size, noise))
        miss = np.full(len(design), False)
        miss[curves.piece[~ended]] = True
        miss &= ~self.cutter.is_settled(pieces.rows)
        self._add_candidates(curves.take(~miss[curves.piece]), pieces)
        self.pieces.append((pieces.rows.take(~miss), pieces.sign[:, ~miss]))
        if miss.any():
            self.cutter.again(pieces.rows, pieces.whole, miss)

    def _curves(self, pieces: Pieces) -> _Curves:
        """The functions that may have one of the greatest values on each piece."""
        value, design = pieces.value, pieces.rows.design
        left = chebyshev.remainder(value)
        low, high = value.min(axis=2), value.max(axis=2)
        open_ = ~(left <= PRECISE * np.maximum(np.abs(low), np.abs(high))) | (left == np.inf)
        # by how much an extreme between samples exceeds them, over their range
        more = np.where(open_, 1.0, 0.15) * (high - low) + UNFINISHED * left
        may = self._may_be(np.arange(len(value))[:, None], design, low - more, high + more)
        # a row of lower samples may have the peak whose flank another row's sample was on
        (a, b), best = pieces.rows.x, self.at_sample[..., design]
        may |= open_ & ((best >= a) & (best <= b)).any(axis=0)
        may &= (low != np.inf) & (high != -np.inf)  # it has a bound somewhere
        number, piece = np.nonzero(may)
        each = [
            one if some.all() else rows_taken(one, some)
            for one, some in zip(value, may, strict=True)
        ]
        curves = rows_joined([np.empty((0, len(POINTS))), *each])
        cut = np.flatnonzero(~pieces.whole[piece])
        if len(cut):  # at the points of the piece itself
            a, b = pieces.part[:, piece[cut], None]
            t = 0.5 * (a + b) + 0.5 * (b - a) * POINTS
            curves[cut] = chebyshev.at(chebyshev.series(rows_taken(curves, cut))[..., None], t)
        return _Curves(number, piece, curves, left[number, piece])

    def _add_candidates(self, curves: _Curves, pieces: Pieces) -> None:
        """Keep the places near which a function may have one of the greatest values."""
        number, piece, value, left = curves
        for side, sense in enumerate(self.senses):
            sized = self._sided(sense, value)
            least = self._bar(side, number, pieces.rows.design[piece])
            of, point, flat, reach = _tops(sized, least - UNFINISHED * left)
            samples = rows_taken(value, of)
            uphill = np.sign(samples[np.arange(len(of)), point]) if self.sized else sense
            uphill = np.where(flat, 0.0, uphill)
            t = _turn(samples * uphill[:, None], point)
            # a flat end has a value of its own, from which rounding leads a search away
            end = np.where(point == 0, -1.0, np.where(point == len(POINTS) - 1, 1.0, t))
            extra = np.flatnonzero(end != t)
            every = np.append(np.arange(len(of)), extra)
            t, uphill = np.append(t, end[extra]), np.append(uphill, 0.0 * extra)
            of, point, reach = of[every], point[every], reach[every]
            own, top, error = pieces.rows.take(piece[of]), sized[of, point], left[of]
            x = np.clip(gathered(own.at(t), self.cutter.w[own.design]), *own.x)
            near = 0.5 * (own.x[1] - own.x[0]) * _REACH[point]
            columns = own.design, pieces.sign[:, piece[of]], own.x, x, near, uphill
            found = _Candidates(number[of], *columns, reach + UNFINISHED * error)
            # the sample at the end of a row is the value there, and a precise series its slope
            exact = pieces.whole[piece[of]] & (end[every] == t) & (np.abs(t) == 1.0)
            exact &= error <= 1e-11 * top
            self.known.append((side, *(c[exact] for c in (number[of], own.design, x, top))))
            self.candidates[side].append(found.take(~exact))

    def refine(self) -> None:
        """Evaluate the functions themselves near the candidates."""
        each = [joined(own) for own in self.candidates if own]
        self.candidates = [[] for _ in self.senses]
        if not each:
            return
        bars = [self._bar(side, own.number, own.design) for side, own in enumerate(each)]
        may = [
            ~(own.reach < least) & (least < np.inf) for own, least in zip(each, bars, strict=True)
        ]
        some = joined([own.take(which) for own, which in zip(each, may, strict=True)])
        x, value, live = some.x.copy(), np.empty(len(some.x)), np.arange(len(some.x))
        for _ in range(20):  # most take two
            if not len(live):
                break
            v, slope, bend = self._jets(x[live], some.take(live))
            step = np.nan_to_num(some.uphill[live] * slope / np.abs(bend))
            step = np.clip(step, -some.near[live], some.near[live])
            step = np.clip(x[live] + step, *some.ends[:, live]) - x[live]
            short = np.abs(step) <= 1e-3 * some.near[live]
            value[live] = v + np.where(short, 0.5 * slope * step, 0.0)
            x[live] += step
            # after a step of 1e-8 of the search range, a maximum's place is exact
            live = live[np.abs(step) > 1e-8 * some.near[live]]
        # on the way to a flat end a step only halves the distance
        for end in some.ends[:, live]:
            x[live] = np.where(np.abs(x[live] - end) <= 0.02 * some.near[live], end, x[live])
        self.add(some.number, some.design, x, value)

    def _jets(self, x: Array, of: _Candidates) -> Array:
        """Value and two derivatives of each candidate's function at places (m,)."""
        out = np.empty((3, len(x)))
        # several functions at once: their common parts cost most
        in_order = np.argsort(of.number, kind="stable")
        for block in blocks(len(x), 8 * BLOCK):
            some = in_order[block]
            requested, own = np.unique(of.number[some], return_inverse=True)
            held = of.sign[:, some, None]
            jets = self.f(x[some, None], of.design[some], 2, held, requested.tolist())[1]
            out[:, some] = [c[self.f.signs + own, np.arange(len(some)), 0] for c in jets]
        out[2] *= 2.0
        return out


def _tops(value: Array, bars: Array) -> tuple[Whole, Whole, Mask, Array]:
    """Local maxima of samples (m, points) next to which a function may reach its bar.

    Returns the numbers of rows and points, masks of those on constant functions, and bounds of the
    values there. A constant has one at the start, as a range of rounding says nothing about places.
    """
    low, high = value.min(axis=1), value.max(axis=1)
    flat = high - low <= 1e-13 * np.maximum(np.abs(low), np.abs(high))
    may = ~flat[:, None] & ~(value < (bars - (high - low))[:, None])
    may[:, 1:] &= value[:, 1:] > value[:, :-1]
    may[:, :-1] &= value[:, :-1] >= value[:, 1:]
    may[:, 0] |= flat
    row, point = np.nonzero(may)
    here, (before, after) = value[row, point], _neighbours(value, row, point, 1)
    # a parabola through three samples exceeds them by an eighth of this at most
    reach = here + (2.0 * here - before - after)
    kept = flat[row] | ~(reach < bars[row])
    row = row[kept]
    return row, point[kept], flat[row], reach[kept]


def _neighbours(value: Array, row: Whole, point: Whole, apart: int) -> tuple[Array, Array]:
    """Samples in some rows before and after a point; beyond an end those on its other side.

    By the angle whose cosine is -t the points are even, and a function is its own mirror image.
    """
    last = len(POINTS) - 1
    places = np.abs(point - apart), last - np.abs(last - point - apart)
    before, after = (value[row, place] for place in places)
    return before, after


def _turn(value: Array, point: Whole) -> Array:
    """Maxima of samples (m, points) next to the points of given numbers, as positions.

    They are those of a polynomial through five samples. Where a function falls from an end, its
    maximum is that end.
    """
    every = np.arange(len(point))
    here = value[every, point]
    (b, a), (d, c) = (_neighbours(value, every, point, apart) for apart in (1, 2))
    first, second = (
        (8.0 * (a - b) - (c - d)) / 12.0,
        (16.0 * (a + b) - (c + d) - 30.0 * here) / 12.0,
    )
    third, fourth = 0.5 * (c - d) - (a - b), c + d - 4.0 * (a + b) + 6.0 * here
    bend = a + b - 2.0 * here
    shift = np.where(bend < 0.0, 0.5 * (b - a) / bend, 0.0)  # of the parabola through three
    for _ in range(2):  # Newton steps on the polynomial's slope
        slope = first + shift * (second + shift * (0.5 * third + shift * fourth / 6.0))
        bend = second + shift * (third + 0.5 * shift * fourth)
        shift += np.where(bend < 0.0, np.clip(-slope / bend, -0.25, 0.25), 0.0)
    last = len(POINTS) - 1
    ends = np.flatnonzero((point == 0) | (point == last))
    inward = np.where(point[ends] == 0, 1.0, -1.0)
    slopes = chebyshev.end_slopes(value[ends])
    rises = inward * np.where(inward > 0.0, slopes[:, 0], slopes[:, 1]) > 0.0
    turn = np.sqrt(-6.0 * second[ends] / fourth[ends])
    shift[ends] = np.where(rises, inward * np.where(turn < 1.0, turn, 0.5), 0.0)
    return np.where(shift == 0.0, POINTS[point], -np.cos(np.pi / last * (point + shift)))


def _raise(most: Array, number: Whole, design: Whole, value: Array) -> None:
    """Set greatest values (functions, n) to values that are greater."""
    index = number * most.shape[1] + design  # flat indices: NumPy is ten times as fast with them
    np.fmax.at(most.reshape(-1), index.reshape(-1), value.reshape(-1))


def bar(most: Array, size: Array) -> Array:
    """The least value that counts as equal to a greatest one.

    ``size`` is the functions' typical size.

    >>> bar(np.array([2.0, 0.0, np.inf]), np.array([2.0, 1.0, 1.0])).tolist()
    [1.999999999998, -1e-13, inf]
    """
    # Extremes within 1e-12 of their size are equal. So are values within 1e-13 of the function's
    # size: at a computed root it is not exactly 0.
    tie = np.maximum(1e-12 * np.abs(most), 1e-13 * size)
    return most - np.where(np.isfinite(most), tie, 0.0)


def first_greatest(value: Array, place: Array, size: Array) -> tuple[Array, Array]:
    """The greatest of values in rows (k, n), and the first place of its equals: (n,) each.

    >>> first_greatest(np.array([[0.0], [1e-17]]), np.array([[10.0], [20.0]]), np.array([1.0]))
    (array([1.e-17]), array([10.]))
    """
    with np.errstate(invalid="ignore"):
        most = value.max(axis=0)
        first = np.argmax(value >= bar(most, size), axis=0)
    return most, np.take_along_axis(place, first[None], axis=0)[0]


def _stretches(rows: Rows, sign: Array) -> Stretches:
    """Adjacent pieces with equal signs joined into one."""
    order = np.lexsort((rows.x[0], rows.span, rows.design))
    design, span, _, (a, b) = rows.take(order)
    positive = sign[:, order] > 0.0
    first = np.ones(len(design), dtype=bool)
    first[1:] = (design[1:] != design[:-1]) | (span[1:] != span[:-1])
    first[1:] |= (positive[:, 1:] != positive[:, :-1]).any(axis=0)
    last = np.append(first[1:], True)
    x = np.stack((a[first], b[last]))
    return Stretches(design[first], span[first], x, positive[:, first])


def _no_pieces(f: Functions) -> list[tuple[Rows, Array]]:
    """An empty list of pieces, to be joined with others."""
    none, ends = np.zeros(0, dtype=int), np.zeros((2, 0))
    return [(Rows(none, none, ends, ends), np.zeros((f.signs, 0)))]


# the cells on both sides of each point; near the ends of a piece, where they crowd, a series is no
# more precise: the range is at least a tenth of half a piece
_REACH = np.maximum(np.convolve(np.diff(POINTS), np.ones(2)), 0.1)
