"""Spans of many designs cut into pieces on which all functions are smooth.

A row, a part of a design's span, is sampled at the Chebyshev points with all signs held as they are
in its middle: so every function is smooth on the whole row. Where a function whose sign counts is
zero the row is cut, and beyond the cut the same samples are evaluated again with the other sign. A
row on which a series does not tell where the zeros are is halved.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeAlias

import numpy as np

from geneva_cli.numerics import chebyshev
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.chebyshev import GRID, MIDDLE, POINTS
from geneva_cli.numerics.spread import gathered, spread

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask, Whole

    Which: TypeAlias = slice | Whole
    Some: TypeAlias = slice | Whole | Mask

NOISE = 1e-12  # share of a function's size on a row that has no sign
ROUNDING = 4e-15  # and of its greatest size in the design's whole motion: some roundings
END = 1e-9  # share of a row: a zero so near to an end, as of a motion's, is the end's own
SETTLED = 3e-3  # share of a size that a series may leave where a single zero is looked for
DIGITS = 1e-9  # and where several places are as near to 0 as that
NEAR = 0.05  # share of a size: nearer to 0 at a point, a function may be 0 beside it
SAFE = 4.0  # times the last terms of a series: what all that follow them may come to
STEPS = 6  # of Newton's, from the zero of a series
CLOSE = 1e-8  # share of a half row: after so short a step, what is left is rounding
FAR = 0.1  # and no step is longer: a series knows its zeros better
NARROW = 1e-11  # share of a design's spans: no row is narrower


class Functions(Protocol):
    """The functions of designs. The first are those whose signs count, each of them smooth while
    those before it keep theirs; the others are wanted, and are smooth while all do.
    """

    signs: int  # how many of the functions have a sign that counts
    wanted: int  # how many others are looked for
    rooms: Sequence[int]  # of the first: which are above 0, and 0 where wanted ones have a pole
    poled: Sequence[int]  # of the first: which go as 1/x at the place 0

    def at(self, x: Array, which: Which, order: int) -> Any:
        """What the functions of some designs are made of, at places (m, k) in degrees."""

    def column(self, at: Any, number: int) -> Any:
        """The same at one place of each design: (m, 1)."""

    def rows(self, at: Any, which: Whole) -> Any:
        """The same of some of the designs, by their numbers among the m, which may repeat."""

    def look(
        self, at: Any, forced: Array | None = None, asked: Sequence[int] | None = None
    ) -> tuple[Mask, list[Array]]:
        """Which signs are positive, (signs, m, k), and Taylor coefficients (functions, m, k).

        ``forced`` are signs that are known, 1.0 or -1.0; where it is NaN they are looked up. Of
        the wanted functions only those ``asked`` are among the functions, if that is given. A
        function without a bound is infinite, and its slope 0.
        """


class Rows(NamedTuple):
    """Parts of designs' spans, to be sampled."""

    design: Whole  # (m,)
    span: Whole
    u: Array  # both ends as ``spread`` places, at which the samples are even: (2, m)
    x: Array  # and as places, degrees
    edge: Mask  # whether each is an end of the span, or a cut: (2, m)

    def take(self, which: Some) -> Rows:
        """Some of the rows, by a mask or their numbers."""
        design, span, u, x, edge = self
        return Rows(design[which], span[which], u[:, which], x[:, which], edge[:, which])

    def at(self, t: Array) -> Array:
        """The spread places of shares from -1 to 1."""
        a, b = self.u
        return np.asarray(0.5 * (a + b) + 0.5 * (b - a) * t)


class Pieces(NamedTuple):
    """Parts of rows on which no sign changes, and the wanted functions there."""

    rows: Rows
    sign: Array  # (signs, m)
    part: Array  # both ends as shares of the row that was sampled, from -1 to 1: (2, m)
    value: Array  # at the points of that row, with these signs: (wanted, m, points)

    @property
    def whole(self) -> Mask:
        """Whether each is the row that was sampled."""
        return np.asarray((self.part[0] == -1.0) & (self.part[1] == 1.0))

    def take(self, which: Some) -> Pieces:
        """Some of the pieces, by a mask or their numbers."""
        sign, part = self.sign[:, which], self.part[:, which]
        return Pieces(self.rows.take(which), sign, part, self.value[:, which])


class Sampled(NamedTuple):
    """What became of sampled rows."""

    pieces: Pieces
    x: Array  # the places of their samples, (m, points)
    room: Array  # the product of the functions that poles are zeros of: (m, points)
    again: list[Rows]  # parts whose zeros are not known, to be sampled


class Places:
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
        """Rows in two each."""
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


def rows_joined(parts: Sequence[Rows]) -> Rows:
    """Several groups of rows as one."""
    return Rows(*(np.concatenate(one, axis=-1) for one in zip(*parts, strict=True)))


class Cutter:
    """Cuts rows of designs into pieces."""

    def __init__(self, f: Functions, places: Places, n: int) -> None:
        self.f, self.places = f, places
        self.size = np.zeros((f.signs, n))  # the greatest seen of each function whose sign counts
        self.width = np.zeros(n)  # of all spans, in spread places

    def is_narrow(self, rows: Rows) -> Mask:
        """Whether rows are as narrow as any may be: no halves of them tell more."""
        return np.asarray(rows.u[1] - rows.u[0] <= NARROW * self.width[rows.design])

    def sampled(self, rows: Rows, which: Which) -> Sampled:
        """Pieces of rows of the designs ``which``, each cut where a sign changes."""
        f = self.f
        # designs lie side by side in memory: each operation runs along all of them
        u = np.asfortranarray(rows.at(POINTS[:, None]).T)
        x = self.places.gathered(u, rows.design)
        x = np.clip(x, rows.x[0][:, None], rows.x[1][:, None])
        x[:, 0], x[:, -1] = rows.x
        at = f.at(x, which, 0)
        sign = np.ones((f.signs, len(u)))
        if f.signs:
            middle = f.look(f.column(at, MIDDLE), None, ())[0][..., 0]
            sign = np.where(middle, 1.0, -1.0)
        value = f.look(at, sign[..., None])[1][0]
        part = np.array([[-1.0], [1.0]]).repeat(len(u), axis=1)
        own, again = np.arange(len(u)), []
        for kind in range(f.signs):
            here = rows.take(own)
            # a pole is taken times the distance from it
            q = value[kind] * np.abs(x[own]) if kind in f.poled else value[kind]
            unsure, cut, t = self._zeros(kind, here, sign, part, q)
            unsure &= ~self.is_narrow(here)
            if unsure.any():
                again.append(self._parts(here, part, unsure))
            if len(cut):
                number, part = _between(cut, t, part)
                own, unsure, q = own[number], unsure[number], q[number]
                sign, value = sign[:, number], value[:, number]
            kept = ~unsure & (part[1] > part[0])
            if not kept.all():
                own, q = own[kept], q[kept]
                sign, part, value = sign[:, kept], part[:, kept], value[:, kept]
            self._turn(kind, at, own, Pieces(rows.take(own), sign, part, value), q)
        pieces = Pieces(self._cut(rows.take(own), part), sign, part, value[f.signs :])
        return Sampled(pieces, x[own], np.abs(value[list(f.rooms)].prod(axis=0)), again)

    def _turn(self, kind: int, at: Any, own: Whole, pieces: Pieces, q: Array) -> None:
        """Set a sign to what its function has in the middle of each piece, and the values to it."""
        sign, part, value = pieces[1:]
        some = np.flatnonzero(~pieces.whole)
        middle = chebyshev.at(chebyshev.series(q[some]), 0.5 * (part[0] + part[1])[some])
        flip = some[np.where(middle > 0.0, 1.0, -1.0) != sign[kind, some]]
        if len(flip):
            sign[kind, flip] *= -1.0
            found = self.f.look(self.f.rows(at, own[flip]), sign[:, flip, None])
            value[:, flip] = found[1][0]

    def _cut(self, rows: Rows, part: Array) -> Rows:
        """Parts of rows, whose ends within are cuts."""
        inner = np.abs(part) < 1.0
        if not inner.any():
            return rows
        u = np.where(inner, rows.at(part), rows.u)
        x = rows.x.copy()
        end, which = np.nonzero(inner)
        x[end, which] = self.places.gathered(u[end, which], rows.design[which])
        return rows._replace(u=u, x=np.clip(x, *rows.x), edge=rows.edge | inner)

    def _parts(self, rows: Rows, part: Array, which: Mask) -> Rows:
        """What is to be sampled of those: halves of a whole row, or a part of one as its own."""
        whole = (part[0] == -1.0) & (part[1] == 1.0)
        cut = which & ~whole
        own = self._cut(rows.take(cut), part[:, cut])
        return rows_joined([own, *self.places.halves(rows.take(which & whole))])

    def _zeros(
        self, kind: int, rows: Rows, sign: Array, part: Array, value: Array
    ) -> tuple[Mask, Whole, Array]:
        """Of which parts the zeros of a function are not known; and the zeros of the others.

        These are the numbers of the parts, and places from -1 to 1 of their rows.
        """
        unsure = np.zeros(len(value), dtype=bool)
        some, q, size, left = _may_cross(value, sign[kind])
        rounding = self._rounding(kind, rows.design, np.abs(value).max(axis=1))[some]
        none = np.zeros(0, dtype=int), np.zeros(0)
        if not len(some):
            return unsure, *none
        g, d = chebyshev.on_grid(q)
        level = np.maximum(NOISE * size, rounding)
        noise = np.repeat(level[:, None], len(GRID), axis=1)
        for end in (0, -1):
            noise[:, end] = np.maximum(noise[:, end], END * np.abs(d[:, end]))
        below = g < -noise
        change = below[:, 1:] != below[:, :-1]
        twice = _crosses_twice(g, d, below, noise, SAFE * left[:, None])
        near = np.abs(g[:, 1:-1]) < SAFE * left[:, None]
        near &= (GRID[1:-1] >= part[0, some, None]) & (GRID[1:-1] <= part[1, some, None])
        open_ = (left > SETTLED * size) & change.any(axis=1)
        open_ |= (left > np.maximum(DIGITS * size, rounding)) & (near.sum(axis=1) > 1)
        open_ |= twice
        unsure[some] = open_
        own, cell = np.nonzero(change & ~open_[:, None])
        if not len(own):
            return unsure, *none
        low, high, a, b = GRID[cell], GRID[cell + 1], g[own, cell], g[own, cell + 1]
        t = chebyshev.root(chebyshev.series(q[own]), low, high, low + (high - low) * a / (a - b))
        which = some[own]
        kept = (t > part[0, which] + END) & (t < part[1, which] - END)
        which, t = which[kept], t[kept]
        t = self._refined(kind, rows.take(which), sign[:, which], t)
        kept = (t > part[0, which]) & (t < part[1, which])
        return unsure, which[kept], t[kept]

    def _rounding(self, kind: int, design: Whole, size: Array) -> Array:
        """What is rounding beside a function's greatest size in its design."""
        np.fmax.at(self.size[kind], design, np.where(np.isfinite(size), size, 0.0))
        return np.asarray(ROUNDING * self.size[kind, design])

    def _refined(self, kind: int, rows: Rows, sign: Array, t: Array) -> Array:
        """Zeros by the function itself, from those of its series on."""
        if not len(t):
            return t
        middle, half = rows.at(np.zeros(1)), 0.5 * (rows.u[1] - rows.u[0])
        x = self.places.gathered(rows.at(t), rows.design)
        number = np.arange(self.f.signs)[:, None]
        held, live = np.where(number < kind, sign, np.nan), np.arange(len(t))
        for _ in range(STEPS):
            at = self.f.at(x[live, None], rows.design[live], 1)
            value, slope = (c[kind, :, 0] for c in self.f.look(at, held[:, live, None], ())[1])
            step = -value / (slope * DEGREE)
            far = FAR * half[live]
            step = np.clip(np.where(np.isfinite(step), step, 0.0), -far, far)
            x[live] += step
            live = live[np.abs(step) > CLOSE * half[live]]
            if not len(live):
                break
        t = (self.places.spread(x, rows.design) - middle) / half
        return np.asarray(t)


def _may_cross(value: Array, sign: Array) -> tuple[Whole, Array, Array, Array]:
    """The numbers of rows on which a function may change sign; its values times the sign that it
    has in the middle, its size, and what its series leaves.
    """
    size, left = np.abs(value).max(axis=1), chebyshev.remainder(value)
    q = value * sign[:, None]
    some = np.flatnonzero(~(q.min(axis=1) >= NEAR * size + SAFE * left))
    return some, q[some], size[some], left[some]


def _crosses_twice(g: Array, d: Array, below: Mask, noise: Array, left: Array) -> Mask:
    """Whether rows may have a pair of zeros between two places of the grid.

    ``left`` is what their series may leave of the functions.
    """
    before, after = d[:, :-1], d[:, 1:]
    turn = before / (before - after)
    bottom = g[:, :-1] + 0.5 * before * turn * np.diff(GRID)
    dips = (before * after < 0.0) & (below[:, 1:] == below[:, :-1])
    bottom += np.where(below[:, 1:], left, -left)
    dips &= (bottom < -noise[:, 1:]) != below[:, 1:]
    return np.asarray(dips.any(axis=1))


def _between(cut: Whole, t: Array, part: Array) -> tuple[Whole, Array]:
    """Parts between cuts: the numbers of those that were cut, or not, and their ends."""
    number = np.concatenate((np.arange(part.shape[1]), cut))
    start, end = np.concatenate((part[0], t)), np.concatenate((part[1], t))
    one, two = np.lexsort((start, number)), np.lexsort((end, number))
    return number[one], np.stack((start[one], end[two]))
