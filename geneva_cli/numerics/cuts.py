"""Division of many designs' spans into pieces on which no sign changes.

A row, a part of a span, is sampled with all signs held as in its middle, so that every function is
smooth on it; it is cut at the zeros of the signs' functions, or halved where no series shows them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from geneva_cli.numerics import chebyshev
from geneva_cli.numerics.arrays import Array, Mask, Which, Whole, blocks, joined, record_taken
from geneva_cli.numerics.chebyshev import GRID, MIDDLE, POINTS

BLOCK = 1024  # rows sampled at a time: that many fit in the processor's cache
MOST_ROWS = 100  # of a design at a time, beyond twice those of its spans: more are rounding
AT_END = 1e-9  # fraction of a row: a zero this near to an end, such as a motion's, is the end's own
LATER_TERMS = 4.0  # times the last terms of a series: a bound on all later terms
NEWTON_STEPS = 6  # of Newton's method, from the zero of a series


class Functions(Protocol):
    """The functions of designs: first those whose signs matter, then the wanted ones.

    Each of the first is smooth while those before it keep their signs, the wanted ones while all
    do. Called with places (m, k) of some designs, it returns masks of positive signs (signs, m, k)
    and Taylor coefficients (functions, m, k) by the place. ``held`` are known signs, 1.0 or -1.0,
    NaN where they are computed. ``requested`` are the numbers of the wanted functions to evaluate,
    all by default. A function without a bound is infinite, and its slope 0.
    """

    signs: int  # number of the functions whose signs matter
    wanted: int  # number of the wanted ones
    poled: Sequence[int]  # numbers of those that behave as 1/x at the place 0

    def __call__(
        self,
        x: Array,
        which: Which,
        order: int,
        held: Array | None = None,
        requested: Sequence[int] | None = None,
    ) -> tuple[Mask, Array]: ...


class Rows(NamedTuple):
    """Parts of designs' spans, m of them, for sampling."""

    design: Whole  # (m,)
    span: Whole
    u: Array  # both ends as ``spread`` places, in which the samples are evenly spaced: (2, m)
    x: Array  # both ends as places

    def take(self, which: Which) -> Rows:
        """Some of the rows, by a mask or their numbers."""
        return record_taken(self, which)

    def at(self, t: Array) -> Array:
        """The spread places at positions from -1 to 1 in the rows."""
        a, b = self.u
        return np.asarray(0.5 * (a + b) + 0.5 * (b - a) * t)

    def part(self, t: Array, w: Array) -> Rows:
        """The parts between two positions (2, m); ``w`` are the spread widths of all designs."""
        inner = np.abs(t) < 1.0
        u = np.where(inner, self.at(t), self.u)
        x = np.clip(gathered(u, w[self.design]), *self.x)
        return self._replace(u=u, x=np.where(inner, x, self.x))

    @property
    def which(self) -> Which:
        """The rows' designs, as a slice where they are all designs between two numbers."""
        if not len(self.design):
            return self.design
        first, last = int(self.design[0]), int(self.design[-1])
        whole = last - first == len(self.design) - 1 and bool((np.diff(self.design) == 1).all())
        return slice(first, last + 1) if whole else self.design


class Pieces(NamedTuple):
    """Parts of sampled rows on which no sign changes, and the wanted functions there."""

    rows: Rows
    sign: Array  # (signs, m)
    part: Array  # both ends as positions in the sampled row, from -1 to 1: (2, m)
    x: Array  # the places of the row's samples: (points, m)
    value: Array  # at these places, with these signs: (wanted, points, m)


def is_whole(part: Array) -> Mask:
    """Masks of the parts (2, m) of rows, by both ends from -1 to 1, that are whole rows."""
    return np.asarray((part[0] == -1.0) & (part[1] == 1.0))


class Cutter:
    """Divides rows of designs into pieces, with samples spread about 0 by ``w``, (n,)."""

    def __init__(self, f: Functions, w: Array, requested: Sequence[int] | None) -> None:
        self.f, self.w, self.requested = f, w, requested
        # the greatest size so far of each function whose sign matters
        self.size = np.zeros((f.signs, len(w)))
        self.width = np.zeros(len(w))  # of all spans, in spread places
        self.noisy = np.full(len(w), False)  # designs whose rows no halving resolves
        self.todo: list[Rows] = []

    def pieces(
        self, spans: Sequence[tuple[Array, Array]], start: int
    ) -> Iterator[tuple[int, list[Pieces]]]:
        """Yield the pieces of spans (n, 1) of designs from number ``start`` on, level by level.

        A span that ends before it begins is empty. Rows in ``self.todo`` are sampled at the next
        level, until none is left. A kink or a pole leaves some rows at each level, noise twice as
        many as before.
        """
        each = []
        for number, (a, b) in enumerate(spans):
            own = np.flatnonzero((b > a)[:, 0])
            design, x = own + start, np.stack((a[own, 0], b[own, 0]))
            u = spread(x, self.w[design])
            self.width[design] += u[1] - u[0]
            each.append(Rows(design, np.full(len(own), number), u, x))
        rows = joined(each)
        first = np.bincount(rows.design, minlength=len(self.noisy))
        for depth in range(60):  # halvings: all rows are too narrow for more by then
            if not len(rows.design):
                break
            count = np.bincount(rows.design, minlength=len(self.noisy))
            self.noisy |= (count > MOST_ROWS + 2 * first) | (depth == 59)
            self.todo = [rows.take(slice(0))]
            yield (
                depth,
                [self._sampled(rows.take(some)) for some in blocks(len(rows.design), BLOCK)],
            )
            rows = joined(self.todo)

    def is_settled(self, rows: Rows) -> Mask:
        """Masks of the rows that are too narrow for halving, or noise."""
        # no row is narrower than 1e-11 of its design's spans
        narrow = rows.u[1] - rows.u[0] <= 1e-11 * self.width[rows.design]
        return np.asarray(narrow | self.noisy[rows.design])

    def again(self, rows: Rows, part: Array, which: Mask) -> None:
        """Sample some rows again: both halves of a whole row, or a part as a row of its own."""
        halved = rows.take(which & is_whole(part))
        ends = np.array([[-1.0], [0.0], [1.0]]).repeat(len(halved.design), axis=1)
        halves = [halved.part(ends[:2], self.w), halved.part(ends[1:], self.w)]
        self.todo += [*halves, rows.take(which & ~is_whole(part))]

    def _sampled(self, rows: Rows) -> Pieces:
        """Pieces of rows, cut where a sign changes; parts with unknown zeros are sampled again."""
        x = gathered(rows.at(POINTS[:, None]), self.w[rows.design]).clip(*rows.x)
        x[0], x[-1] = rows.x
        own = np.arange(x.shape[1])
        part = np.array([[-1.0], [1.0]]).repeat(len(own), axis=1)
        sign = np.ones((self.f.signs, len(own)))
        if self.f.signs:
            middle = self.f(x.T[:, MIDDLE, None], rows.which, 0, None, ())[0][..., 0]
            sign = np.where(middle, 1.0, -1.0)
        value = self._values(x, rows.which, sign)
        for kind in range(self.f.signs):
            # a pole is multiplied by the distance from it
            poled = kind in self.f.poled
            q = value[kind] * np.abs(x.take(own, axis=1)) if poled else value[kind]
            here = rows.take(own)
            unsure, cut, t = self._zeros(kind, here, sign, part, q)
            unsure &= ~self.is_settled(here)
            if unsure.any():
                self.again(here.part(part, self.w), part, unsure)
            if len(cut) or unsure.any():
                # the parts between the cuts, by the numbers of the original parts
                number = np.concatenate((np.arange(part.shape[1]), cut))
                begin, end = np.concatenate((part[0], t)), np.concatenate((part[1], t))
                one, two = np.lexsort((begin, number)), np.lexsort((end, number))
                number, part = number[one], np.stack((begin[one], end[two]))
                kept = np.flatnonzero(~unsure[number] & (part[1] > part[0]))
                number, part = number[kept], part.take(kept, axis=1)
                own = own[number]
                q, sign, value = (v.take(number, axis=-1) for v in (q, sign, value))
            # parts in whose middle the function does not have the sign of their row
            some = np.flatnonzero(~is_whole(part))
            terms, t = chebyshev.series(q.take(some, axis=1)), 0.5 * part.sum(axis=0)[some]
            middles = np.where(chebyshev.at(terms, t) > 0.0, 1.0, -1.0)
            flip = some[middles != sign[kind, some]]
            if len(flip):
                sign[kind, flip] *= -1.0
                design = rows.design[own[flip]]
                there = x.take(own[flip], axis=1)
                value[..., flip] = self._values(there, design, sign.take(flip, axis=1))
        cut_rows = rows.take(own).part(part, self.w)
        return Pieces(cut_rows, sign, part, x.take(own, axis=1), value[self.f.signs :])

    def _values(self, x: Array, which: Which, sign: Array) -> Array:
        """Every function at places (points, m) with known signs: (functions, points, m)."""
        return self.f(x.T, which, 0, sign[..., None], self.requested)[1][0].swapaxes(1, 2)

    def _zeros(
        self, kind: int, rows: Rows, sign: Array, part: Array, value: Array
    ) -> tuple[Mask, Whole, Array]:
        """A mask of parts with unknown zeros, and the zeros of the other parts."""
        unsure, none = np.full(len(rows.design), False), (np.zeros(0, dtype=int), np.zeros(0))
        size, left = np.abs(value).max(axis=0), chebyshev.remainder(value)
        np.fmax.at(self.size[kind], rows.design, np.where(np.isfinite(size), size, 0.0))
        q = value * sign[kind]
        # where a point is below a twentieth of the size, the function may be 0 next to it
        some = np.flatnonzero(~(q.min(axis=0) >= 0.05 * size + LATER_TERMS * left))
        if not len(some):
            return unsure, *none
        q, size, left = q.take(some, axis=1), size[some], left[some]
        g, d = chebyshev.on_grid(q)
        # below 1e-12 of its size on a row, or some roundings of that in its design's whole motion,
        # a function has no sign
        rounding = 4e-15 * self.size[kind, rows.design[some]]
        noise = np.broadcast_to(np.maximum(1e-12 * size, rounding), g.shape).copy()
        noise[[0, -1]] = np.maximum(noise[[0, -1]], AT_END * np.abs(d[[0, -1]]))
        below = g < -noise
        change = below[1:] != below[:-1]
        low, high = part.take(some, axis=1)
        near = np.abs(g[1:-1]) < LATER_TERMS * left
        near &= (GRID[1:-1, None] >= low) & (GRID[1:-1, None] <= high)
        # The series may err by 3e-3 of a size for a single zero, and by 1e-9 if several points
        # are within the error of 0.
        open_ = (left > 3e-3 * size) & change.any(axis=0)
        open_ |= (left > np.maximum(1e-9 * size, rounding)) & (near.sum(axis=0) > 1)
        # a pair of zeros between two places of the grid, by a parabola there
        before, after = d[:-1], d[1:]
        turn = before / (before - after)
        bottom = g[:-1] + 0.5 * before * turn * np.diff(GRID)[:, None]
        bottom += np.where(below[1:], LATER_TERMS * left, -LATER_TERMS * left)
        dips = (before * after < 0.0) & ~change & ((bottom < -noise[1:]) != below[1:])
        open_ |= dips.any(axis=0)
        unsure[some] = open_
        own, cell = np.nonzero((change & ~open_).T)
        if not len(own):
            return unsure, *none
        a, b, low, high = g[cell, own], g[cell + 1, own], GRID[cell], GRID[cell + 1]
        chord = (b - a) / (high - low)
        terms = chebyshev.series(q.take(own, axis=1))
        t, which = chebyshev.root(terms, low, high, low - a / chord, chord), some[own]
        kept = (t > part[0, which] + AT_END) & (t < part[1, which] - AT_END)
        which, t = which[kept], t[kept]
        t = self._refined(kind, rows.take(which), sign[:, which], t)
        kept = (t > part[0, which]) & (t < part[1, which])
        return unsure, which[kept], t[kept]

    def _refined(self, kind: int, rows: Rows, sign: Array, t: Array) -> Array:
        """Zeros of the functions themselves, from the zeros of their series."""
        w, half = self.w[rows.design], 0.5 * (rows.u[1] - rows.u[0])
        x, number = gathered(rows.at(t), w), np.arange(self.f.signs)[:, None]
        known, live = np.where(number < kind, sign, np.nan), np.arange(len(t))
        for _ in range(NEWTON_STEPS):
            if not len(live):
                break
            held = known[:, live, None]
            both = self.f(x[live, None], rows.design[live], 1, held, ())[1]
            step = -both[0][kind, :, 0] / both[1][kind, :, 0]
            # No step is longer than a tenth of a half row: the series knows its zeros better.
            far = 0.1 * half[live]
            step = np.clip(np.where(np.isfinite(step), step, 0.0), -far, far)
            x[live] += step
            # After a step of 1e-8 of a half row the rest is rounding.
            live = live[np.abs(step) > 1e-8 * half[live]]
        return np.asarray((spread(x, w) - rows.at(np.zeros(1))) / half)


def spread(x: Array, w: Array) -> Array:
    """u at places x, where x = w sinh(u / w): samples even in u are spread about 0.

    Poles at x = i w and -i w move to u = i w pi/2 and -i w pi/2; with a large w, u is x. Source: D.
    Elliott, P. R. Johnston, Int. J. Numer. Meth. Engng 62 (2005).
    """
    u: Array = w * np.arcsinh(x / w)
    return u


def gathered(u: Array, w: Array) -> Array:
    """The places x at u."""
    x: Array = w * np.sinh(u / w)
    return x
