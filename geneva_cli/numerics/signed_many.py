"""Extremes of functions of many designs that are smooth only while some others keep their signs.

A load jumps where the roller's sliding turns round, and has a kink where its torque does. Each
design's span is sampled; where a sign changes between two samples its zero is found and the span
is cut there, and where a cubic does not predict a sample midway, or a pair of zeros may hide, it is
halved. What is left are cells: between their ends every function is smooth, and as good as a cubic.
Those in which a function may pass what is known of it are left to ``turns_many``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import choose_record
from geneva_cli.numerics.between_samples import limits
from geneva_cli.numerics.cells import (
    LEVEL,
    Across,
    Beside,
    Cells,
    Cuts,
    Look,
    Range,
    Tops,
    Turns,
    joined,
    taken,
    turns_in,
)
from geneva_cli.numerics.crossings import about, matters
from geneva_cli.numerics.cubics import touches, zero_of_cubic
from geneva_cli.numerics.extrema_many import unpredicted
from geneva_cli.numerics.flat_ends import flat_ends, second_turns
from geneva_cli.numerics.poles import goes_one_way
from geneva_cli.numerics.quintics import turns_as_told
from geneva_cli.numerics.roots import DEEPEST
from geneva_cli.numerics.roots_many import newton_many
from geneva_cli.numerics.samples_many import SHARE, Samples, some_of, unpredicted_beside
from geneva_cli.numerics.spread import gathered, spread
from geneva_cli.numerics.turns_many import NOISE, Doubted, Signed, turn

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Which, Whole
    from geneva_cli.numerics.extrema_many import Sample
    from geneva_cli.numerics.jet import Array
    from geneva_cli.numerics.poles import Three

BLOCK = 2048  # designs sampled at a time: so many lie in the processor's cache
CELLS = 8  # of a span, to begin with
FEW = 4  # of one that is short
SHORT = 0.4  # share of the widest span on the same side of 0
ENDED = 1e-6  # share of a cell: after so short a step, what is left of a zero is rounding
NARROWEST = 0.25  # share of a span: samples are spread no more than by this
NARROW = 1e-9  # share of a place: a cell no wider is not halved


class Found(NamedTuple):
    """Greatest values of n designs and where, a row a quantity, as of ``Tops``; and the cuts."""

    most: Array
    x: Array
    cuts: Cuts


def search(
    f: Signed,
    spans: Sequence[tuple[Array, Array]],
    n: int,
    sized: bool,
    known: Sequence[tuple[int, Array, Array]] = (),
    w: Array | None = None,
    cuts: bool = True,
) -> Found:
    """Of n designs over their spans, one after the other: (n, 1) the ends of each.

    A span that ends before it begins is none. ``known`` are values that no span reaches: a wanted
    function's number, and of each design the place and the value, NaN where there is none.
    ``sized`` is as of ``Tops``. Samples are spread about 0 by ``w`` (n, 1), or even. Without
    ``cuts`` a change of sign is looked for only where an extreme may be beside it.
    """
    with np.errstate(all="ignore"):
        return _Search(f, n, sized, known, w, cuts).found(spans)


def places(a: Array, b: Array, cells: int = CELLS) -> Array:
    """Places of samples, of mirrored spans mirrored: each half is counted from its own end."""
    way = (b - a) * (np.arange(cells // 2) / cells)
    return np.asfortranarray(np.hstack((a + way, 0.5 * (a + b), b - way[:, ::-1])))


class _Search:
    def __init__(
        self,
        f: Signed,
        n: int,
        sized: bool,
        known: Sequence[tuple[int, Array, Array]],
        w: Array | None,
        cuts: bool,
    ) -> None:
        self.f, self.n, self.w, self.all_cuts = f, n, w, cuts
        self.tops = Tops(f.wanted, n, sized)
        self.range = Range(*np.full((2, f.signs + f.wanted, n), np.inf) * [[[1.0]], [[-1.0]]])
        self.cells: list[Cells] = []  # to be looked at again
        self.crossed: list[tuple[Cells, Beside]] = []  # in which a sign changes
        self.across: list[Across] = []
        self.crossings = 0  # how many cells those are
        self.turns: list[Turns] = []
        self.flat: list[Turns] = []  # that may turn twice
        self.cuts: list[Cuts] = []
        for k, place, value in known:
            there = np.flatnonzero(~np.isnan(value))
            for sign, side in self.tops.sides(value[there]):
                self.tops.add(self.tops.number(k, sign), there, place[there], side)

    def found(self, spans: Sequence[tuple[Array, Array]]) -> Found:
        groups = list(by_cells(spans))
        for i in range(0, self.n, BLOCK):
            part, every = slice(i, i + BLOCK), []
            for number, count, there in groups:
                if there[part].any():
                    a, b = (end[part] for end in spans[number])
                    every.append(self._sampled(a, b, part, number, count, there[part]))
            # a cell is judged by what is known of all spans
            for samples, there in every:
                self._judge(samples, there)
        cells = joined(self.cells)
        self.cuts.append(_cuts(cells, cells, np.zeros(0, dtype=int)))
        self._settle(joined([cells, *self._crossed()]))
        for _ in range(DEEPEST):
            if self.flat:
                flat, self.flat = joined(self.flat), []
                self.turns.append(self.tops.hopeful(second_turns(self.f, self.tops, flat)))
            turns, self.turns = self.turns, []
            doubted = turn(self.f, self.range, self.tops, joined(turns)) if turns else []
            if not doubted:
                break
            self._settle(joined([half for one in doubted for half in self._parted(one)]))
        return Found(self.tops.most, self.tops.places(), joined(self.cuts))

    def _sampled(
        self, a: Array, b: Array, part: slice, number: int, count: int, there: Mask
    ) -> tuple[Samples, Mask]:
        """One span of a part of the designs, in so many cells; those that are ``there`` count."""
        f, b = self.f, np.maximum(a, b)
        # Designs lie side by side in memory: each operation runs along all of them.
        x = places(a, b, count) if self.w is None else spread_places(a, b, self.w[part], count)
        at = f.at(x, part, 1)
        positive, (value, slope) = f.look(at)
        slope *= DEGREE
        design = np.arange(part.start, part.start + len(x))
        size = np.abs(value[: f.signs]).max(axis=2)
        for end, beside in ((0, 1), (-1, -2)):
            self._sign_end(at, x, positive, value, slope, size, end, beside)
        full: Which = slice(None) if there.all() else there
        self.range.widen(design[full], value[:, full])
        self.tops.add_samples(design[full], x[full], value[f.signs :, full])
        samples = Samples(design, number, x, positive, value, slope)
        crosses = samples.differ & there[:, None]
        if not self.all_cuts:
            self.across += about(f, samples, at, crosses, self.crossings)
            self.crossings += int(np.count_nonzero(crosses))
        return samples, there

    def _judge(self, samples: Samples, there: Mask) -> None:
        """What is to be looked at again, and where functions turn."""
        f, differ = self.f, samples.differ
        open_ = samples.open(self.range, self._bounded(samples.design), differ, self._matters)
        closed, differ = ~(open_ | differ) & there[:, None], differ & there[:, None]
        self.cells.append(samples.cells(open_ & there[:, None]))
        self.crossed.append((samples.cells(differ), samples.beside(differ)))
        for k in range(f.wanted):
            some = samples.turns(f.signs + k, k, self.range, closed)
            self.turns.append(self.tops.hopeful(some))

    def _sign_end(
        self,
        at: Any,
        x: Array,
        positive: Mask,
        value: Array,
        slope: Array,
        size: Array,
        end: int,
        beside: int,
    ) -> None:
        """Signs at one end of a span where a function is rounding: those that it has within.

        A motion's middle and ends are where it passes 0, and there a span begins or ends.
        """
        signs, known = self.f.signs, np.full((self.f.signs, len(x)), np.nan)
        within = np.where(positive[:, :, beside], 1.0, -1.0)
        for kind in range(signs):  # those after it may hang on its sign
            noise = np.abs(value[kind, :, end]) <= NOISE * size[kind]
            rise = slope[kind, :, end] * (x[:, beside] - x[:, end])
            clear = np.abs(rise) > LEVEL * size[kind]
            own = np.where(clear, np.sign(rise), within[kind])
            known[kind] = np.where(noise, own, np.nan)
            wrong = noise & (positive[kind, :, end] != (own > 0.0))
            if wrong.any():
                here = self._look(self.f.column(at, end), known)
                for samples, other in zip((positive, value, slope), here, strict=True):
                    samples[..., end] = np.where(wrong, other, samples[..., end])

    def _bounded(self, design: Whole, *ends: Array) -> Mask:
        """Whether functions are bounded as far as is known: near a pole none is looked at nearer.

        ``ends`` are values (functions, m): in whose range they are, those are far from one.
        """
        wanted = self.tops.bounded()[:, design]
        known = np.concatenate((np.full((self.f.signs, len(design)), True), wanted))
        if ends and not known.all():
            known |= np.logical_and.reduce([self.range.holds(design, value) for value in ends])
        return known

    def _matters(
        self, missed: Mask, design: Whole, left: Sample, middle: Sample, right: Sample
    ) -> Mask:
        """Of functions that are not predicted those that may pass a top.

        Or may be 0, if their sign counts: twice then.
        """
        where = np.nonzero(missed)
        if not len(where[0]):
            return missed

        three = some_of(left, where), some_of(middle, where), some_of(right, where)
        low, high = limits(*three)
        row, of = where[0] - self.f.signs, design[where[1]]
        may = ~((low > 0.0) | (high < 0.0))
        some = np.flatnonzero(row >= 0)
        may[some] = self.tops.may_pass(row[some], of[some], low[some], high[some])
        some = some[may[some]]
        room = SHARE * self.range.width(where[0][some], of[some])
        one, two, last = ((x[some], v[some], d[some]) for x, v, d in three)
        may[some] = ~turns_as_told(one, two, last, room)
        self._without_poles(may, where, (left, middle, right))
        missed[where] = may
        return missed

    def _without_poles(self, may: Mask, where: tuple[Whole, ...], three: Three) -> None:
        """Those that go one way to a pole, or from it, may not pass a top between samples."""
        if not self.f.rooms:
            return
        some = np.flatnonzero(may & (where[0] >= self.f.signs))
        index = tuple(one[some] for one in where)

        def at(sample: Sample) -> tuple[Sample, Sample]:
            x, v, d = sample
            x = np.broadcast_to(x, v.shape[1:])[index[1:]]
            room, slope = np.ones(len(some)), np.zeros(len(some))
            for row in self.f.rooms:
                r, s = v[row][index[1:]], d[row][index[1:]]
                room, slope = room * r, slope * r + room * s
            return (x, v[index], d[index]), (x, room, slope)

        of, rooms = zip(*map(at, three), strict=True)
        may[some] = ~goes_one_way(of, rooms, SHARE)

    def _look(
        self, at: Any, forced: Array | None = None, asked: Sequence[int] | None = None
    ) -> Look:
        """At places (m, 1): without their last axis, and slopes by degrees."""
        positive, c = self.f.look(at, None if forced is None else forced[..., None], asked)
        return Look(positive[..., 0], c[0][..., 0], c[1][..., 0] * DEGREE)

    def _parted(self, doubted: Doubted) -> tuple[Cells, Cells]:
        """The cells of turns that have another sign than they, in two at those."""
        f, (turns, x) = self.f, doubted
        a, b = turns.left[0], turns.right[0]
        inside = (a < x) & (x < b)
        turns, x, a, b = taken(turns, inside), x[inside], a[inside], b[inside]
        own = np.where(turns.positive, 1.0, -1.0)
        looks = [self._look(f.at(end[:, None], turns.design, 1), own) for end in (a, b)]
        ends = [np.stack(pair) for pair in zip(*looks, strict=True)]
        here = self._look(f.at(x[:, None], turns.design, 1))
        self.tops.add_all(turns.design, x, here.value[f.signs :])
        cells = Cells(turns.design, turns.span, np.stack((a, b)), *ends)
        return cells.parted(x, (here, here))

    def _crossed(self) -> list[Cells]:
        """Of cells cut where a sign changes, the parts that must be looked at again.

        A part and the sample beside it in which no sign changes are judged together.
        """
        cells, beside = (joined(parts) for parts in zip(*self.crossed, strict=True))
        if self.across:
            which = matters(self.f, cells, joined(self.across), self.range, self.tops)
            cells, beside = taken(cells, which), taken(beside, which)
        out = []
        for end, part in enumerate(self._cut(cells)):
            low, high = (side[:, part.design] for side in self.range)
            three = beside.at(end), part.at(end), part.at(1 - end)
            missed = unpredicted_beside(*three, low, high)
            missed &= self._bounded(part.design, *(value for _, value, _ in three))
            missed = self._matters(missed, part.design, *three)
            open_ = missed.any(axis=0) | ~beside.known[end] | self._may_cross(part)
            open_ |= (part.positive[0] != part.positive[1]).any(axis=0)
            self._close(part, ~open_)
            out.append(taken(part, open_))
        return out

    def _may_cross(self, cells: Cells) -> Mask:
        """Whether a function whose sign counts may change it twice within cells."""
        signs, (a, b) = self.f.signs, cells.x
        (v, w), (d, e) = cells.value[:, :signs], cells.slope[:, :signs]
        return np.asarray(touches(b - a, v, d, w, e).any(axis=0))

    def _close(self, cells: Cells, where: Mask) -> None:
        """Keep where wanted functions may turn within cells that are not looked at again."""
        for k in range(self.f.wanted):
            some = turns_in(self.f.signs + k, k, cells, self.range, where)
            self.turns.append(self.tops.hopeful(some))
            self.flat.append(flat_ends(self.f.signs + k, k, cells, self.tops, where))

    def _settle(self, cells: Cells) -> None:
        """Cut at zeros, and halve until a cubic predicts."""
        for _ in range(2 * DEEPEST):
            differ = (cells.positive[0] != cells.positive[1]).any(axis=0)
            rest = [*self._cut(taken(cells, differ)), *self._halved(taken(cells, ~differ))]
            cells = joined(rest)
            if not len(cells.design):
                break

    def _cut(self, cells: Cells) -> tuple[Cells, Cells]:
        """In two at the zero of the first function whose sign differs."""
        f, design, (a, b), (left, right) = self.f, cells.design, cells.x, cells.positive
        if not len(design):
            return cells, cells
        kind, number = np.argmax(left != right, axis=0), np.arange(f.signs)[:, None]
        sides = [np.where(side, 1.0, -1.0) for side in (left, right)]
        before = np.where(number < kind, sides[0], np.nan)

        def zero(x: Array, live: Whole) -> tuple[Array, Array]:
            _, value, slope = self._look(f.at(x[:, None], design[live], 1), before[:, live], ())
            own = kind[live], np.arange(len(live))
            return value[own], slope[own]

        every = np.arange(len(a))
        (v, w), (d, e) = cells.value[:, kind, every], cells.slope[:, kind, every]
        start = a + (b - a) * zero_of_cubic(v, w, d * (b - a), e * (b - a))
        x = newton_many(zero, a, b, start, ~left[kind, every], ENDED, (v, w))[0]
        at = f.at(x[:, None], design, 1)
        looks = [self._look(at, np.where(number <= kind, side, np.nan)) for side in sides]
        stays = ~self._passed(design, looks[0], left & (number < kind), ~left & (number < kind))
        if not stays.all():
            # a sign that the others hang on is another one here: it changes twice in the cell
            here = self._look_within(at, design, left)
            looks = [choose_record(stays, look, here) for look in looks]
        for look in looks:
            self.tops.add_all(design, x, look.value[f.signs :])
        one, two = cells.parted(x, looks)
        self.cuts.append(_cuts(one, two, np.flatnonzero(stays)))
        return one, two

    def _passed(self, design: Whole, look: Look, positive: Mask, negative: Mask) -> Mask:
        """Whether one of the functions held to be positive or negative is not: (k,)."""
        value = look.value[: self.f.signs]
        noise = NOISE * self.range.size(design)[: self.f.signs]
        passed = (positive & (value < -noise)) | (negative & (value > noise))
        return np.asarray(passed.any(axis=0))

    def _look_within(self, at: Any, design: Whole, positive: Mask) -> Look:
        """At a place within each cell, where what is as small as rounding has its cell's sign."""
        look, signs = self._look(at), self.f.signs
        noise = np.abs(look.value[:signs]) <= NOISE * self.range.size(design)[:signs]
        if noise.any():
            own = np.where(positive, 1.0, -1.0)
            look = self._look(at, np.where(noise, own, np.nan))
        return look

    def _halved(self, cells: Cells) -> tuple[Cells, Cells]:
        """The halves of cells of one sign that must be looked at again."""
        f, (a, b) = self.f, cells.x
        x = 0.5 * (a + b)
        inside = (x > a) & (x < b)
        cells, x = taken(cells, inside), x[inside]
        if not len(x):
            return cells, cells
        design = cells.design
        at = f.at(x[:, None], design, 1)
        look = self._look_within(at, design, cells.positive[0])
        self.tops.add_all(design, x, look.value[f.signs :])
        low, high = (side[:, design] for side in self.range)
        three = cells.at(0), (x, look.value, look.slope), cells.at(1)
        missed = unpredicted(*three, low, high, SHARE)
        wide = cells.x[1] - cells.x[0] > NARROW * (np.abs(cells.x[0]) + np.abs(cells.x[1]))
        known = self._bounded(design, cells.value[0], look.value, cells.value[1])
        open_ = self._matters(missed & known, design, *three).any(axis=0) & wide
        open_ |= (look.positive != cells.positive[0]).any(axis=0)
        halves = cells.parted(x, (look, look))
        for half in halves:
            open_ |= self._may_cross(half) & wide
        for half in halves:
            self._close(half, ~open_)
        return taken(halves[0], open_), taken(halves[1], open_)


def by_cells(spans: Sequence[tuple[Array, Array]]) -> Iterator[tuple[int, int, Mask]]:
    """The number of each span, into how many cells it is cut, and in which of the designs: (n,).

    A piece of a motion that is short beside another one on its side of 0 has less to tell.
    """
    width = np.stack([(b - a)[:, 0] for a, b in spans])
    before = np.stack([(a + b)[:, 0] < 0.0 for a, b in spans])
    first, last = (np.where(side, width, 0.0).max(axis=0) for side in (before, ~before))
    short = width <= SHORT * np.where(before, first, last)
    for number, there in enumerate(width > 0.0):
        yield number, FEW, there & short[number]
        yield number, CELLS, there & ~short[number]


def spread_places(a: Array, b: Array, w: Array, cells: int = CELLS) -> Array:
    """The same, spread about 0, but so that no cell is wider than a quarter of the span."""
    w = np.maximum(w, NARROWEST * (b - a))
    x = np.clip(gathered(places(spread(a, w), spread(b, w), cells), w)[0], a, b)
    x[:, :1], x[:, -1:] = a, b
    return x


def _cuts(before: Cells, after: Cells, where: Whole) -> Cuts:
    positive = np.stack((before.positive[1], after.positive[0]))
    return taken(Cuts(before.design, before.span, before.x[1], positive), where)


def no_cuts() -> Cuts:
    """What no sign cuts."""
    none = np.zeros(0, dtype=int)
    return Cuts(none, none, np.zeros(0), np.zeros((2, 0, 0), dtype=bool))
