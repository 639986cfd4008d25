"""Division of many designs' spans into pieces on which all functions are smooth.

A row is a part of a design's span. It is sampled at Chebyshev points with all signs held as in its
middle, so that every function is smooth on the whole row. The row is cut where a function whose
sign matters is zero. Beyond the cut the same samples are evaluated with the other sign. A row is
halved if a series does not show where its zeros are.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np

from geneva_cli.numerics import chebyshev
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import (
    Array,
    Mask,
    Which,
    Whole,
    columns_taken,
    joined,
    numbers_of,
    rows_taken,
)
from geneva_cli.numerics.chebyshev import GRID, MIDDLE, POINTS

AT_END = 1e-9  # fraction of a row: a zero this near to an end, such as a motion's, is the end's own
LATER_TERMS = 4.0  # times the last terms of a series: a bound on all later terms
NEWTON_STEPS = 6  # of Newton's method, from the zero of a series


class Functions(Protocol):
    """The functions of designs: first those whose signs matter, then the wanted ones.

    Each of the first is smooth while those before it keep their signs. The wanted ones are smooth
    while all do.
    """

    signs: int  # number of the functions whose signs matter
    wanted: int  # number of the wanted functions
    margins: Sequence[int]  # of the first: above 0, and 0 where wanted functions have a pole
    poled: Sequence[int]  # of the first: they behave as 1/x at the place 0

    def at(self, x: Array, which: Whole, order: int) -> Any:
        """All that the functions of some designs are computed from, at places (m, k) in degrees."""

    def column(self, at: Any, number: int) -> Any:
        """The part of ``at`` for one place of each design: (m, 1)."""

    def rows(self, at: Any, which: Whole) -> Any:
        """The part of ``at`` for some designs, by their numbers among the m, which may repeat."""

    def evaluate(
        self, at: Any, forced: Array | None = None, requested: Sequence[int] | None = None
    ) -> tuple[Mask, list[Array]]:
        """Masks of positive signs, (signs, m, k), and Taylor coefficients (functions, m, k).

        ``forced`` are known signs, 1.0 or -1.0; where it is NaN they are computed. ``requested``
        are the numbers of the wanted functions to evaluate, all by default. A function without a
        bound is infinite, and its slope 0.
        """


class Rows(NamedTuple):
    """Parts of designs' spans, m of them, for sampling."""

    design: Whole  # (m,)
    span: Whole
    u: Array  # both ends as ``spread`` places, in which the samples are spaced: (2, m)
    x: Array  # both ends as places, degrees
    edge: Mask  # whether each is an end of the span, or a cut: (2, m)

    def take(self, which: Which) -> Rows:
        """Some of the rows, by a mask or their numbers."""
        if not isinstance(which, slice):
            which = numbers_of(which)
        design, span, u, x, edge = self
        ends = (columns_taken(u, which), columns_taken(x, which), columns_taken(edge, which))
        return Rows(columns_taken(design, which), columns_taken(span, which), *ends)

    def at(self, t: Array) -> Array:
        """The spread places at positions from -1 to 1 in the rows."""
        a, b = self.u
        return np.asarray(0.5 * (a + b) + 0.5 * (b - a) * t)


class SmoothPieces(NamedTuple):
    """Parts of rows on which no sign changes, and the wanted functions there."""

    rows: Rows
    sign: Array  # (signs, m)
    part: Array  # both ends as positions in the sampled row, from -1 to 1: (2, m)
    value: Array  # at the points of that row, with these signs: (wanted, m, points)

    @property
    def whole(self) -> Mask:
        """Masks of the pieces that are whole rows."""
        return np.asarray((self.part[0] == -1.0) & (self.part[1] == 1.0))

    def take(self, which: Which) -> SmoothPieces:
        """Some of the pieces, by a mask or their numbers."""
        sign, part = columns_taken(self.sign, which), columns_taken(self.part, which)
        return SmoothPieces(self.rows.take(which), sign, part, rows_taken(self.value, which))


class SampledRows(NamedTuple):
    """The pieces of sampled rows, and the parts that must be sampled again."""

    pieces: SmoothPieces
    x: Array  # the places of their samples, (m, points)
    margin: Array  # the product of the functions that are zero at poles: (m, points)
    again: list[Rows]  # parts whose zeros are not known


class SpreadPlaces:
    """Spread places u and places x of n designs, each with a width w of its own (n, 1)."""

    def __init__(self, w: Array | None) -> None:
        self.w = w

    def spread(self, x: Array, design: Whole) -> Array:
        """u at places (m,)."""
        return x if self.w is None else spread(x, self.w[design, 0])

    def gathered(self, u: Array, design: Whole) -> Array:
        """Places at u, (m,) or (m, k)."""
        if self.w is None:
            return u
        w = self.w[design, 0]
        return gathered(u, w if u.ndim == 1 else w[:, None])[0]

    def halves(self, rows: Rows) -> list[Rows]:
        """Both halves of rows."""
        u = rows.at(np.zeros(1))
        x = np.clip(self.gathered(u, rows.design), *rows.x)
        first, last = np.array([[True], [False]]), np.array([[False], [True]])
        return [
            rows._replace(
                u=np.where(first, rows.u, u), x=np.where(first, rows.x, x), edge=rows.edge & first
            ),
            rows._replace(
                u=np.where(last, rows.u, u), x=np.where(last, rows.x, x), edge=rows.edge & last
            ),
        ]


class Cutter:
    """Divides rows of designs into pieces."""

    def __init__(self, f: Functions, places: SpreadPlaces, n: int) -> None:
        self.f, self.places = f, places
        # the greatest size so far of each function whose sign matters
        self.size = np.zeros((f.signs, n))
        self.width = np.zeros(n)  # of all spans, in spread places

    def is_narrow(self, rows: Rows) -> Mask:
        """Masks of the rows that are too narrow for halving."""
        # no row is narrower than 1e-11 of its design's spans
        return np.asarray(rows.u[1] - rows.u[0] <= 1e-11 * self.width[rows.design])

    def sampled(self, rows: Rows) -> SampledRows:
        """Pieces of rows, cut where a sign changes."""
        f = self.f
        # designs lie side by side in memory: each operation runs along all of them
        u = np.asfortranarray(rows.at(POINTS[:, None]).T)
        x = self.places.gathered(u, rows.design)
        x = np.clip(x, rows.x[0][:, None], rows.x[1][:, None])
        x[:, 0], x[:, -1] = rows.x
        at = f.at(x, rows.design, 0)
        sign = np.ones((f.signs, len(u)))
        if f.signs:
            middle = f.evaluate(f.column(at, MIDDLE), None, ())[0][..., 0]
            sign = np.where(middle, 1.0, -1.0)
        value = f.evaluate(at, sign[..., None])[1][0]
        part = np.array([[-1.0], [1.0]]).repeat(len(u), axis=1)
        own, again = np.arange(len(u)), []
        for kind in range(f.signs):
            here = rows.take(own)
            # a pole is multiplied by the distance from it
            q = value[kind]
            if kind in f.poled:
                q = q * np.abs(rows_taken(x, own))
            unsure, cut, t = self._zeros(kind, here, sign, part, q)
            unsure &= ~self.is_narrow(here)
            if unsure.any():
                again.append(self._parts(here, part, unsure))
            if len(cut):
                number, part = _between(cut, t, part)
                own, unsure, q = own[number], unsure[number], rows_taken(q, number)
                sign, value = columns_taken(sign, number), rows_taken(value, number)
            kept = ~unsure & (part[1] > part[0])
            if not kept.all():
                own, q, value = own[kept], rows_taken(q, kept), rows_taken(value, kept)
                sign, part = columns_taken(sign, kept), columns_taken(part, kept)
            self._turn(kind, at, own, SmoothPieces(rows.take(own), sign, part, value), q)
        pieces = SmoothPieces(self._cut(rows.take(own), part), sign, part, value[f.signs :])
        margin = np.abs(value[list(f.margins)].prod(axis=0))
        return SampledRows(pieces, rows_taken(x, own), margin, again)

    def _turn(self, kind: int, at: Any, own: Whole, pieces: SmoothPieces, q: Array) -> None:
        """Set each sign to its function's in the middle of each piece, and update the values."""
        sign, part, value = pieces[1:]
        some = np.flatnonzero(~pieces.whole)
        middle = chebyshev.at(
            chebyshev.series(rows_taken(q, some)), 0.5 * (part[0] + part[1])[some]
        )
        flip = some[np.where(middle > 0.0, 1.0, -1.0) != sign[kind, some]]
        if len(flip):
            sign[kind, flip] *= -1.0
            values = self.f.evaluate(self.f.rows(at, own[flip]), sign[:, flip, None])
            value[:, flip] = values[1][0]

    def _cut(self, rows: Rows, part: Array) -> Rows:
        """Parts of rows, whose inner ends are cuts."""
        inner = np.abs(part) < 1.0
        if not inner.any():
            return rows
        u = np.where(inner, rows.at(part), rows.u)
        x = rows.x.copy()
        end, which = np.nonzero(inner)
        x[end, which] = self.places.gathered(u[end, which], rows.design[which])
        return rows._replace(u=u, x=np.clip(x, *rows.x), edge=rows.edge | inner)

    def _parts(self, rows: Rows, part: Array, which: Mask) -> Rows:
        """The parts to sample next: both halves of a whole row, or a part as a row of its own."""
        whole = (part[0] == -1.0) & (part[1] == 1.0)
        cut = which & ~whole
        own = self._cut(rows.take(cut), part[:, cut])
        return joined([own, *self.places.halves(rows.take(which & whole))])

    def _zeros(
        self, kind: int, rows: Rows, sign: Array, part: Array, value: Array
    ) -> tuple[Mask, Whole, Array]:
        """A mask of parts with unknown zeros, and the zeros of the other parts.

        Zeros are the numbers of their parts, and positions from -1 to 1 in the rows.
        """
        unsure = np.zeros(len(value), dtype=bool)
        some, q, size, left = _may_cross(value, sign[kind])
        rounding = self._rounding(kind, rows.design, np.abs(value).max(axis=1))[some]
        none = np.zeros(0, dtype=int), np.zeros(0)
        if not len(some):
            return unsure, *none
        g, d = chebyshev.on_grid(q)
        # below 1e-12 of its size on a row, a function has no sign
        level = np.maximum(1e-12 * size, rounding)
        noise = np.repeat(level[None], len(GRID), axis=0).T
        for end in (0, -1):
            noise[:, end] = np.maximum(noise[:, end], AT_END * np.abs(d[:, end]))
        below = g < -noise
        change = below[:, 1:] != below[:, :-1]
        twice = _crosses_twice(g, d, below, noise, LATER_TERMS * left[:, None])
        near = np.abs(g[:, 1:-1]) < LATER_TERMS * left[:, None]
        grid = GRID[1:-1, None]
        near &= ((grid >= part[0, some]) & (grid <= part[1, some])).T
        # The series may err by 3e-3 of a size for a single zero, and by 1e-9 if several points
        # are within the error of 0.
        open_ = (left > 3e-3 * size) & change.any(axis=1)
        open_ |= (left > np.maximum(1e-9 * size, rounding)) & (near.sum(axis=1) > 1)
        open_ |= twice
        unsure[some] = open_
        own, cell = np.nonzero(change & ~open_[:, None])
        if not len(own):
            return unsure, *none
        low, high, a, b = GRID[cell], GRID[cell + 1], g[own, cell], g[own, cell + 1]
        t = chebyshev.root(
            chebyshev.series(rows_taken(q, own)), low, high, low + (high - low) * a / (a - b)
        )
        which = some[own]
        kept = (t > part[0, which] + AT_END) & (t < part[1, which] - AT_END)
        which, t = which[kept], t[kept]
        t = self._refined(kind, rows.take(which), sign[:, which], t)
        kept = (t > part[0, which]) & (t < part[1, which])
        return unsure, which[kept], t[kept]

    def _rounding(self, kind: int, design: Whole, size: Array) -> Array:
        """The rounding error of a function, from its greatest size in its design."""
        np.fmax.at(self.size[kind], design, np.where(np.isfinite(size), size, 0.0))
        # some roundings of its greatest size in the design's whole motion
        return np.asarray(4e-15 * self.size[kind, design])

    def _refined(self, kind: int, rows: Rows, sign: Array, t: Array) -> Array:
        """Zeros of the functions themselves, from the zeros of their series."""
        if not len(t):
            return t
        middle, half = rows.at(np.zeros(1)), 0.5 * (rows.u[1] - rows.u[0])
        x = self.places.gathered(rows.at(t), rows.design)
        number = np.arange(self.f.signs)[:, None]
        known, live = np.where(number < kind, sign, np.nan), np.arange(len(t))
        for _ in range(NEWTON_STEPS):
            at = self.f.at(x[live, None], rows.design[live], 1)
            value, slope = (c[kind, :, 0] for c in self.f.evaluate(at, known[:, live, None], ())[1])
            step = -value / (slope * DEGREE)
            # No step is longer than a tenth of a half row: the series knows its zeros better.
            far = 0.1 * half[live]
            step = np.clip(np.where(np.isfinite(step), step, 0.0), -far, far)
            x[live] += step
            # After a step of 1e-8 of a half row the rest is rounding.
            live = live[np.abs(step) > 1e-8 * half[live]]
            if not len(live):
                break
        t = (self.places.spread(x, rows.design) - middle) / half
        return np.asarray(t)


def _may_cross(value: Array, sign: Array) -> tuple[Whole, Array, Array, Array]:
    """Rows on which a function may change sign.

    Returns their numbers, the values times the sign in the middle, the sizes, and the series'
    errors.
    """
    size, left = np.abs(value).max(axis=1), chebyshev.remainder(value)
    q = value * sign[:, None]
    # Where a point is below a twentieth of the size, the function may be 0 next to it.
    some = np.flatnonzero(~(q.min(axis=1) >= 0.05 * size + LATER_TERMS * left))
    return some, rows_taken(q, some), size[some], left[some]


def _crosses_twice(g: Array, d: Array, below: Mask, noise: Array, left: Array) -> Mask:
    """Masks of rows that may have a pair of zeros between two places of the grid.

    ``left`` is the error of their series.
    """
    before, after = d[:, :-1], d[:, 1:]
    turn = before / (before - after)
    bottom = g[:, :-1] + 0.5 * before * turn * np.diff(GRID)
    dips = (before * after < 0.0) & (below[:, 1:] == below[:, :-1])
    bottom += np.where(below[:, 1:], left, -left)
    dips &= (bottom < -noise[:, 1:]) != below[:, 1:]
    return np.asarray(dips.any(axis=1))


def _between(cut: Whole, t: Array, part: Array) -> tuple[Whole, Array]:
    """Parts between cuts: the numbers of the original parts, and both ends."""
    number = np.concatenate((np.arange(part.shape[1]), cut))
    start, end = np.concatenate((part[0], t)), np.concatenate((part[1], t))
    one, two = np.lexsort((start, number)), np.lexsort((end, number))
    return number[one], np.stack((start[one], end[two]))


def spread(x: Array, w: Array) -> Array:
    """u at places x, where x = w sinh(u / w): samples even in u are spread about 0.

    Near 0, where functions change fastest, the range within w of 0 gets as much length as the rest.
    Poles at x = i w and -i w move to u = i w pi/2 and -i w pi/2. So the same number of samples
    gives more digits. Near 0, u is x; with a large w it is x everywhere.

    Source: D. Elliott, P. R. Johnston, "A sinh transformation for evaluating nearly singular
    boundary element integrals", Int. J. Numer. Meth. Engng 62 (2005).
    """
    u: Array = w * np.arcsinh(x / w)
    return u


def gathered(u: Array, w: Array) -> tuple[Array, Array]:
    """The places x at u, and their derivative by u.

    >>> import numpy as np
    >>> w = np.array([2.0, 1e3])
    >>> gathered(spread(np.array([6.0, 6.0]), w), w)[0].round(12)
    array([6., 6.])
    """
    sine = np.sinh(u / w)
    return w * sine, np.sqrt(1.0 + sine * sine)
