"""Greatest and least values of functions of many designs, and the places where signs change.

Series between the ``cuts``, at which a load may jump, show where a function may exceed the known
values; there the function itself is evaluated, by Newton steps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Which, Whole, blocks, joined, record_taken
from geneva_cli.numerics.cuts import (
    BLOCK,
    GRID,
    LATER_TERMS,
    POINTS,
    SLOPES,
    VALUES,
    Cutter,
    at,
    product,
    remainder,
    series,
)
from geneva_cli.numerics.tolerances import TIE

if TYPE_CHECKING:
    from geneva_cli.numerics.cuts import Asked, Functions, Held, Pieces, Rows
    from geneva_cli.numerics.jet import Jet

Spans: TypeAlias = Sequence[tuple[Array, Array]]  # both ends (n, 1) of each
Known: TypeAlias = tuple[int, Array, Array]  # a function's number, places and values
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
        """The parts on which no sign changes: adjacent pieces with equal signs joined into one."""
        if not self.pieces:
            return Stretches(np.arange(0), np.arange(0), np.zeros((2, 0)), np.full((0, 0), True))
        rows, sign = joined(self.pieces)
        order = np.lexsort((rows.x[1], rows.x[0], rows.span, rows.design))  # empty pieces first
        design, span, _, (a, b) = record_taken(rows, order)
        positive = sign[:, order] > 0.0
        first = np.ones(len(design), dtype=bool)
        first[1:] = (design[1:] != design[:-1]) | (span[1:] != span[:-1])
        first[1:] |= (positive[:, 1:] != positive[:, :-1]).any(axis=0)
        last = np.append(first[1:], True)
        x = np.stack((a[first], b[last]))
        return Stretches(design[first], span[first], x, positive[:, first])


@dataclass
class Smooth:
    """Functions of designs without kinks and jumps.

    ``jets(x, which, order, requested)`` returns the jet of each requested function, of ``order`` or
    a higher one. The signs of the first ``signs`` functions matter. ``unit`` is that of the places
    over the jets'.
    """

    jets: Callable[[Array, Which, int, Sequence[int]], Sequence[Jet]]
    wanted: int = 1
    signs: int = 0
    unit: float = 1.0
    poled: Sequence[int] = ()

    def __call__(
        self, x: Array, which: Which, order: int, held: Held = None, requested: Asked = None
    ) -> tuple[Mask, Array]:
        """Masks of positive signs, and Taylor coefficients."""
        numbers = range(self.wanted) if requested is None else requested
        every = [*range(self.signs), *(self.signs + i for i in numbers)]
        out = np.empty((order + 1, len(every), *x.shape[::-1])).swapaxes(2, 3)
        for i, jet in enumerate(self.jets(np.asfortranarray(x), which, order, every)):
            for k in range(order + 1):
                out[k, i] = jet.c[k] * self.unit**k if k else jet.c[k]
        return out[0][: self.signs] > 0.0, out


def search(
    f: Functions,
    spans: Spans,
    sized: bool,
    known: Sequence[Known] = (),
    w: Array | None = None,
    requested: Asked = None,
) -> SearchResult:
    """The greatest values of n designs over their spans, whose ends are (n, 1).

    With ``sized`` they are the greatest sizes, else those of the functions and of their negatives.
    ``known`` are values that no span reaches: the number of a wanted function, and for each design
    the place and the value, or NaN. Samples are spread about 0 by ``w`` (n, 1), or evenly spaced.
    ``requested`` are the numbers of the functions, all by default.
    """
    with np.errstate(all="ignore"):
        cutter = Cutter(f, np.array(spans), w, requested)
        extremes = _Extremes(cutter, sized)
        for number, x, value in known:
            design = np.flatnonzero(~np.isnan(value))
            extremes.add(np.full(len(design), number), design, x[design], value[design])
        for part in blocks(len(cutter.w), GROUP // max(f.wanted, 2)):
            cutter.begin(part)
            while level := cutter.level():
                every = [*map(cutter.pieces, level)]
                for pieces in every:
                    extremes.add_samples(pieces)
                for pieces in every:
                    extremes.judge(pieces)
            extremes.refine()
        # the first places of the greatest values
        first = np.full(extremes.most.shape, np.inf)
        for side, of, design, x, value in extremes.known:
            near = value >= bar(extremes.most[side, of, design], extremes.size[of, design])
            np.fmin.at(first, (side[near], of[near], design[near]), x[near])
        first = np.where(np.isinf(first), extremes.at_sample, first)
        shape = -1, len(cutter.w)
        return SearchResult(extremes.most.reshape(shape), first.reshape(shape), extremes.pieces)


def cuts(f: Functions, spans: Spans) -> Stretches:
    """The parts of the spans of ``search`` on which no sign changes."""
    return search(f, spans, sized=True, requested=()).stretches


class _Candidates(NamedTuple):
    """Places near which a function may have one of its greatest values on a piece."""

    side: Whole  # of the result: (m,)
    number: Whole  # of the function
    design: Whole
    sign: Array  # held there: (signs, m)
    ends: Array  # of the piece: (2, m)
    x: Array  # from which to search
    near: Array  # the longest step from there
    uphill: Array  # 1 for a maximum, -1 for a minimum
    reach: Array  # a bound of the value, with its sign by the side


class _Extremes:
    """The greatest values of n designs, and the first places that have them."""

    def __init__(self, cutter: Cutter, sized: bool) -> None:
        self.f, self.sized, self.cutter = cutter.f, sized, cutter
        n, asked = len(cutter.w), cutter.requested
        wanted = cutter.f.wanted if asked is None else len(asked)
        self.most = np.full((1 if sized else 2, wanted, n), -np.inf)
        self.size = np.zeros((wanted, n))  # typical ones, of samples far from poles
        self.at_sample = np.full(self.most.shape, np.nan)  # the place of a greatest sample
        # side of the result, number of the function, design, place and value there
        self.known: list[tuple[Whole, Whole, Whole, Array, Array]] = []
        self.candidates: list[_Candidates] = []
        self.pieces: list[tuple[Rows, Array]] = []

    def add(self, number: Whole, design: Whole, x: Array, value: Array) -> None:
        """Add values (m,) of functions, by their numbers, at ends and extremes."""
        for side, own in enumerate((np.abs(value),) if self.sized else (value, -value)):
            sides = np.full(len(number), side)
            _raise(self.most, (sides, number, design), own)
            self.known.append((sides, number, design, x, own))

    def add_samples(self, pieces: Pieces) -> None:
        """Add samples of pieces; only those within each piece count."""
        (a, b), x, design, value = pieces.rows.x, pieces.x, pieces.rows.design, pieces.value
        sided = np.abs(value)[None] if self.sized else np.stack((value, -value))
        outside = (x < a) | (x > b)
        # from its begin on, where a margin changes its sign, and rounding decides at the end itself
        known = (sided == np.inf) | outside
        endless = known[:, :, 1:-1].all(axis=2) & (sided == np.inf).any(axis=2)
        sided = np.where(outside, -np.inf, sided)
        best = sided.argmax(axis=2)
        top = np.take_along_axis(sided, best[:, :, None], axis=2)[:, :, 0]
        top = np.where(endless, np.inf, top)
        place = np.where(endless, a, x[best, np.arange(len(design))])
        sides, numbers, _ = np.ogrid[: len(top), : top.shape[1], :1]
        _raise(self.most, (sides, numbers, design), top)
        side, number, of = np.nonzero(top == self.most[..., design])
        self.at_sample[side, number, design[of]] = place[side, number, of]
        side, number, of = np.nonzero(top == np.inf)
        rows = place[side, number, of], top[side, number, of]
        self.known.append((side, number, design[of], *rows))
        if self.cutter.depth < 4:  # rows that were halved more often lie near a pole
            step = len(POINTS) // 4
            inner = np.abs(value[:, step:-step:step]).max(axis=1)
            _raise(self.size, (numbers[0], design), np.where(np.isfinite(inner), inner, 0.0))

    def judge(self, pieces: Pieces) -> None:
        """Keep candidates of pieces with precise series, and sample the others again."""
        value, (a, b), design = pieces.value, pieces.rows.x, pieces.rows.design
        left = remainder(value)
        low, high = value.min(axis=1), value.max(axis=1)
        size = np.maximum(np.abs(low), np.abs(high))
        open_ = ~(left <= PRECISE * size) | (left == np.inf)
        # by how much an extreme between samples exceeds them, over their range
        more = np.where(open_, 1.0, 0.15) * (high - low) + UNFINISHED * left
        bars = bar(self.most[..., design], self.size[:, design])
        low_reach, high_reach = low - more, high + more
        # towards a pole, whose series has no end, the reciprocal's bounds serve
        number, row = np.nonzero(open_)
        inverse = np.ascontiguousarray(1.0 / value[number, :, row].T)
        rest, least, most = remainder(inverse), inverse.min(axis=0), inverse.max(axis=0)
        ended = rest <= PRECISE * np.maximum(np.abs(least), np.abs(most))
        beyond = 0.15 * (most - least) + UNFINISHED * rest
        for bound, own, end in (
            (low_reach, least >= 0.0, most + beyond),
            (high_reach, most <= 0.0, least - beyond),
        ):
            here = ended & own
            bound[number[here], row[here]] = 1.0 / end[here]
        may = (~(np.stack((high_reach, -low_reach)) < bars) & (bars < np.inf)).any(axis=0)
        # a row of lower samples may have the peak whose flank another row's sample was on
        best, bounded = self.at_sample[..., design], self.most[..., design] < np.inf
        may |= open_ & ((best >= a) & (best <= b) & bounded).any(axis=0)
        may &= (low != np.inf) & (high != -np.inf)  # it has a bound somewhere
        open_ &= ~(left <= TIE * TIE * self.size[:, design])
        miss = self.cutter.again(pieces.rows, pieces.part, (may & open_).any(axis=0))
        self.pieces.append((record_taken(pieces.rows, ~miss), pieces.sign[:, ~miss]))
        number, piece = np.nonzero(may & ~miss)
        if len(number):
            self._add_candidates(number, piece, left[number, piece], pieces)

    def _add_candidates(self, number: Whole, piece: Whole, left: Array, pieces: Pieces) -> None:
        """Keep the tops of functions on pieces, some at their ends, if they may be greatest.

        ``left`` is the error of their series.
        """
        rows, part = record_taken(pieces.rows, piece), pieces.part.take(piece, axis=1)
        samples = np.ascontiguousarray(pieces.value[number, :, piece].T)
        cut = np.flatnonzero(part[1] - part[0] < 2.0)
        if len(cut):  # at the points of the piece itself
            a, b = part[:, cut]
            t = 0.5 * (a + b) + 0.5 * (b - a) * POINTS[:, None]
            samples[:, cut] = at(series(samples.take(cut, axis=1)), t)
        value, slope = product(VALUES, samples), product(SLOPES, samples)
        terms = series(samples)
        # of a constant the start alone: a range of rounding says nothing about places
        varied = np.ptp(samples, axis=0) > 1e-13 * np.abs(samples).max(axis=0)
        value, slope = np.pad(value, ((1, 1), (0, 0)), "edge"), np.where(varied, slope, 0.0)
        grid, one = np.pad(GRID, 1, "edge"), np.ones((1, len(number)))
        # of each top: side of the result, curve, position from -1 to 1, 1 for a maximum or -1 for a
        # minimum, and a bound of it but for the series' error
        tops: list[tuple[Any, ...]] = []
        for sense in (1.0, -1.0):
            # as if the function rose before the piece, and fell after it
            g, d = sense * value, np.concatenate((one, sense * slope, -one))
            cell, of = np.nonzero((d[:-1] > 0.0) & (d[1:] <= 0.0))
            before, after = d[cell, of], d[cell + 1, of]
            t = grid[cell] + (grid[cell + 1] - grid[cell]) * before / (before - after)
            top = 2.0 * sense * at(terms[:, of], t) - np.minimum(g[cell, of], g[cell + 1, of])
            to = 0 if self.sized or sense > 0.0 else 1
            tops.append(tuple(np.broadcast_arrays(to, of, t, sense, top)))
        side, of, t, uphill, top = joined(tops)
        reach, design = top + UNFINISHED * left[of], rows.design[of]
        least = bar(self.most[side, number[of], design], self.size[number[of], design])
        kept = np.flatnonzero(~(reach < least) & (least < np.inf))
        side, of, t, uphill, reach = record_taken((side, of, t, uphill, reach), kept)
        own, shifts = record_taken(rows, of), np.array([[-0.1], [0.0], [0.1]])
        before, x, after = own.places(t + shifts, self.cutter.w)[1]
        # a search begins at an end that is this near: its value counts, and Newton leaves it
        x = np.where(t < -0.999, own.x[0], np.where(t > 0.999, own.x[1], x))
        row, sign = (side, number[of], own.design), pieces.sign.take(piece[of], axis=1)
        self.candidates.append(_Candidates(*row, sign, own.x, x, after - before, uphill, reach))

    def refine(self) -> None:
        """Evaluate the functions themselves near the candidates."""
        if not self.candidates:
            return
        every = joined(self.candidates)
        self.candidates = []
        most = self.most[every.side, every.number, every.design]
        least = bar(most, self.size[every.number, every.design])
        some = record_taken(every, ~(every.reach < least) & (least < np.inf))
        x, near = some.x.copy(), some.near.copy()
        value, live = np.empty(len(x)), np.arange(len(x))
        for number in range(20):  # most take two
            if not len(live):
                break
            jets = np.empty((3, len(live)))  # value and two derivatives
            # several functions at once: their common parts cost most
            in_order = np.argsort(some.number[live], kind="stable")
            for block in blocks(len(live), 8 * BLOCK):
                here = in_order[block]
                of = live[here]
                requested, own = np.unique(some.number[of], return_inverse=True)
                held, asked = some.sign[:, of, None], requested.tolist()
                rows = self.f(x[of, None], some.design[of], 2, held, asked)[1]
                for k in range(3):
                    jets[k, here] = rows[k][self.f.signs + own, np.arange(len(of)), 0]
            v, slope, bend = jets[0], jets[1], 2.0 * jets[2]
            if not number:  # the ends' own values, as a flat top's place is rounding
                at_end = np.flatnonzero((x == some.ends).any(axis=0))
                self.add(*record_taken((some.number, some.design, x, v), at_end))
            step = np.nan_to_num(some.uphill[live] * slope / np.abs(bend))
            # at rest where the function has the other extreme: inwards, by less each time
            rests = np.abs(slope) <= 1e-6 * np.abs(bend) * near[live]
            away = rests & (some.uphill[live] * bend > 0.0)
            middle = 0.5 * some.ends[:, live].sum(axis=0)
            step = np.where(away, np.sign(middle - x[live]) * 0.1 * near[live], step)
            near[live] *= np.where(away, 0.3, 1.0)
            step = np.clip(step, -near[live], near[live])
            step = np.clip(x[live] + step, *some.ends[:, live]) - x[live]
            short = np.abs(step) <= 1e-3 * near[live]
            value[live] = v + np.where(short, 0.5 * slope * step, 0.0)
            x[live] += step
            # after a step of 1e-8 of the search range, a maximum's place is exact
            live = live[np.abs(step) > 1e-8 * near[live]]
        # on the way to a flat end a step only halves the distance; and 1e-14 is rounding
        reached = 1e-14 * some.near
        reached[live] = 0.02 * some.near[live]
        for end in some.ends:
            x = np.where(np.abs(x - end) <= reached, end, x)
        self.add(some.number, some.design, x, value)


def _raise(most: Array, index: tuple[Whole, ...], value: Array) -> None:
    """Set greatest values to values that are greater."""
    flat = np.ravel_multi_index(index, most.shape)  # NumPy is ten times as fast with flat indices
    np.fmax.at(most.reshape(-1), flat.reshape(-1), value.reshape(-1))


def bar(most: Array, size: Array) -> Array:
    """The least value that counts as equal to a greatest one of functions of a typical ``size``."""
    # within 1e-12 of their own size, or of 1e-13 of the function's: at a root it is not exactly 0
    tie = np.maximum(1e-12 * np.abs(most), 1e-13 * size)
    return most - np.where(np.isfinite(most), tie, 0.0)
