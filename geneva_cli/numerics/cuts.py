"""Division of many designs' spans into pieces on which no sign changes.

A row, a part of a span, is sampled with all signs held as in its middle, so that every function is
smooth on it; it is cut at the zeros of the signs' functions, or halved where no series shows them.
Series are from samples (..., points, m) at the Chebyshev points of [-1, 1] (L. N. Trefethen,
"Approximation Theory and Approximation Practice", SIAM 2013).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Which, Whole, blocks, joined, record_taken

DEGREE = 16  # of the series: for most loads, its terms have ended between two cuts


def product(matrix: Array, values: Array) -> Array:
    """A matrix (n, k) times values (..., k, m), summed in order."""
    return np.asarray(np.einsum("nk,...km->...nm", matrix, values))


def at(terms: Array, t: Array) -> Array:
    """Values of series (terms, ...) at places, one for each series or broadcast against them."""
    twice, after, later = 2.0 * t, terms[-1], 0.0
    for c in terms[-2:0:-1]:  # Clenshaw's recurrence
        after, later = c + twice * after - later, after
    return np.asarray(terms[0] + t * after - later)


# Where functions are sampled, and where signs are compared, with two cells for each point: places
# -cos(pi k / cells), symmetric to the last bit.
POINTS: Array = np.sin(0.5 * np.pi * np.arange(-DEGREE, DEGREE + 1, 2) / DEGREE)
GRID: Array = np.sin(0.25 * np.pi * np.arange(-2 * DEGREE, 2 * DEGREE + 1, 2) / DEGREE)

_k = np.arange(DEGREE + 1)
_ends = np.where(_k % DEGREE == 0, 0.5, 1.0)  # the first and the last count half
# from samples to terms: the discrete cosine transform of the second kind of points
SERIES = 2.0 / DEGREE * _ends[:, None] * np.cos(np.pi * np.outer(_k, DEGREE - _k) / DEGREE) * _ends
series = partial(product, SERIES)  # terms of the series from samples
_rise = _k - _k[:, None]
# from the terms of a series to those of its derivative
_DERIVED = np.where((_rise > 0) & (_rise % 2 == 1), 2.0 * _k, 0.0)
_DERIVED[0] *= 0.5
_TERMS = at(np.eye(DEGREE + 1)[..., None], GRID).T
# from samples to values and to slopes at ``GRID``
VALUES, SLOPES = product(_TERMS, SERIES), product(_TERMS, product(_DERIVED, SERIES))


def remainder(values: Array) -> Array:
    """The greatest of the last three terms, an estimate of the series' error: (..., m)."""
    return np.asarray(np.abs(product(SERIES[-3:], values)).max(axis=-2))


def root(terms: Array, low: Array, high: Array, start: Array, slope: Array) -> Array:
    """The zero of each series (terms, m) between ``low`` and ``high``, where its signs differ.

    ``start`` is a place near it, and ``slope`` an estimate of the slope there. The search goes by
    secants; the function itself is evaluated afterwards.
    """
    rises, t, value = at(terms, high) > 0.0, start, at(terms, start)
    for _ in range(3):
        below = (value < 0.0) == rises
        low, high = np.where(below, t, low), np.where(below, high, t)
        new = t - value / slope
        new = np.where((low <= new) & (new <= high), new, 0.5 * (low + high))
        there = at(terms, new)
        slope, t, value = (there - value) / (new - t), new, there
    new = t - value / slope
    return np.where((low <= new) & (new <= high), new, t)


BLOCK = 1024  # rows sampled at a time: that many fit in the processor's cache
AT_END = 1e-9  # fraction of a row: a zero this near to an end, such as a motion's, is the end's own
LATER_TERMS = 4.0  # times the last terms of a series: a bound on all later terms


Held: TypeAlias = "Array | None"  # known signs
Asked: TypeAlias = "Sequence[int] | None"  # numbers of functions

if TYPE_CHECKING:

    class Functions(Protocol):
        """The functions of designs: first those whose signs matter, then the wanted ones.

        Each of the first is smooth while those before it keep their signs, the wanted ones while
        all do. At places (m, k) of some designs it returns masks of positive signs (signs, m, k)
        and Taylor coefficients (order + 1, functions, m, k). ``held`` are known signs, 1.0 or -1.0,
        NaN where they are computed; ``requested`` the numbers of the wanted functions to evaluate,
        all by default. A function without a bound is infinite, and its slope 0.
        """

        signs: int  # number of the functions whose signs matter
        wanted: int  # number of the wanted ones
        poled: Sequence[int]  # numbers of those that behave as 1/x at the place 0

        def __call__(
            self, x: Array, which: Which, order: int, held: Held = None, requested: Asked = None
        ) -> tuple[Mask, Array]: ...


class Rows(NamedTuple):
    """Parts of designs' spans, m of them, for sampling."""

    design: Whole  # (m,)
    span: Whole
    u: Array  # both ends as ``spread`` places, in which the samples are evenly spaced: (2, m)
    x: Array  # both ends as places

    def places(self, t: Array, w: Array) -> tuple[Array, Array]:
        """The spread places and the places at positions in the rows, from ``w`` of all designs."""
        (a, b), own = self.u, w[self.design]
        u = 0.5 * (a + b) + 0.5 * (b - a) * t
        return u, np.clip(own * np.sinh(u / own), *self.x)

    def part(self, t: Array, w: Array) -> Rows:
        """The parts between two positions (2, m)."""
        inner, (u, x) = np.abs(t) < 1.0, self.places(t, w)
        return self._replace(u=np.where(inner, u, self.u), x=np.where(inner, x, self.x))


class Pieces(NamedTuple):
    """Parts of sampled rows on which no sign changes, and the wanted functions there."""

    rows: Rows
    sign: Array  # (signs, m)
    part: Array  # both ends as positions in the sampled row, from -1 to 1: (2, m); 2 apart if whole
    x: Array  # the places of the row's samples: (points, m)
    value: Array  # at these places, with these signs: (wanted, points, m)


class Cutter:
    """Divides spans of designs into pieces, with samples spread about 0 by ``w`` (n, 1).

    Without ``w`` they are evenly spaced. ``ends`` are those of the spans: (spans, 2, n, 1).
    """

    def __init__(self, f: Functions, ends: Array, w: Array | None, requested: Asked) -> None:
        self.f, self.ends, self.requested = f, ends[..., 0], requested
        # with a wide spread, samples are evenly spaced
        n, reach = ends.shape[2], np.abs(self.ends).max(axis=(0, 1))
        self.w: Array = 1e3 * reach + 1e-300 if w is None else w[:, 0]
        # the greatest size so far of each function whose sign matters
        self.size = np.zeros((f.signs, n))
        self.width = np.zeros(n)  # of all spans, in spread places
        self.noisy = np.full(n, False)  # designs whose rows no halving resolves
        self.depth, self.first = 0, np.zeros(n, dtype=int)
        self.todo: list[Rows] = []

    def begin(self, part: slice) -> None:
        """Begin with the spans of some designs; one that ends before it begins is empty."""
        self.todo, self.depth = [], -1
        for number, (a, b) in enumerate(self.ends):
            design = part.start + np.flatnonzero(b[part] > a[part])
            x = self.ends[number].take(design, axis=1)
            u = spread(x, self.w[design])
            self.width[design] += u[1] - u[0]
            self.todo.append(Rows(design, np.full(len(design), number), u, x))
        self.first = np.bincount(joined(self.todo).design, minlength=len(self.noisy))

    def level(self) -> list[Rows]:
        """The rows to be sampled at the next level, in blocks; none after the last.

        A kink or a pole leaves some rows at each level, noise twice as many as before.
        """
        self.depth += 1
        rows, self.todo = joined(self.todo) if self.todo else None, []
        if rows is None or not len(rows.design) or self.depth == 60:  # all rows are too narrow then
            return []
        count = np.bincount(rows.design, minlength=len(self.noisy))
        # more rows of a design than these are rounding
        self.noisy |= (count > 100 + 2 * self.first) | (self.depth == 59)
        return [*map(partial(record_taken, rows), blocks(len(rows.design), BLOCK))]

    def again(self, rows: Rows, part: Array, which: Mask) -> Mask:
        """Sample some rows again: both halves of a whole row, or a part as a row of its own.

        Those that are too narrow for it, or noise, are left; the others are returned.
        """
        # no row is narrower than 1e-11 of its design's spans
        narrow = rows.u[1] - rows.u[0] <= 1e-11 * self.width[rows.design]
        which = which & ~(narrow | self.noisy[rows.design])
        if which.any():
            whole = part[1] - part[0] == 2.0
            halved = record_taken(rows, which & whole)
            ends = np.array([[-1.0], [0.0], [1.0]]).repeat(len(halved.design), axis=1)
            halves = halved.part(ends[:2], self.w), halved.part(ends[1:], self.w)
            self.todo += [*halves, record_taken(rows, which & ~whole)]
        return which

    def pieces(self, rows: Rows) -> Pieces:
        """The part about the middle of each row on which no sign changes.

        The other parts are sampled again, and so are parts with unknown zeros.
        """
        f = self.f
        _, x = rows.places(POINTS[:, None], self.w)
        x[0], x[-1] = rows.x
        part = np.array([[-1.0], [1.0]]).repeat(len(rows.design), axis=1)
        sign = np.ones((f.signs, len(rows.design)))
        if f.signs:
            middle = f(x[len(x) // 2, :, None], rows.design, 0, None, ())[0][..., 0]
            sign = np.where(middle, 1.0, -1.0)
        value = f(x.T, rows.design, 0, sign[..., None], self.requested)[1][0].swapaxes(1, 2)
        for kind in range(f.signs):
            # a pole is multiplied by the distance from it
            q = value[kind] * np.abs(x) if kind in f.poled else value[kind]
            unsure, cut, t = self._zeros(kind, rows, part, q * sign[kind])
            if len(cut):
                t = self._refined(kind, record_taken(rows, cut), sign[:, cut], t)
                (low, high), first, last = part.copy(), t < AT_END, t > -AT_END
                np.maximum.at(low, cut[first], t[first])
                np.minimum.at(high, cut[last], t[last])
                for ends in (np.stack((part[0], low)), np.stack((high, part[1]))):
                    wide = np.flatnonzero(ends[1] > ends[0])
                    self.todo.append(record_taken(rows, wide).part(ends[:, wide], self.w))
                part = np.stack((low, high))
            again = self.again(rows.part(part, self.w), part, unsure) | (part[1] <= part[0])
            if again.any():
                kept = np.flatnonzero(~again)
                rows, part, sign, x, value = record_taken((rows, part, sign, x, value), kept)
        return Pieces(rows.part(part, self.w), sign, part, x, value[f.signs :])

    def _zeros(self, kind: int, rows: Rows, part: Array, q: Array) -> tuple[Mask, Whole, Array]:
        """A mask of parts with unknown zeros, and the zeros of the others' series.

        The samples ``q`` are positive in the middle.
        """
        unsure, none = np.full(len(rows.design), False), (np.arange(0), np.zeros(0))
        size, left = np.abs(q).max(axis=0), remainder(q)
        np.fmax.at(self.size[kind], rows.design, np.where(np.isfinite(size), size, 0.0))
        # where a point is below a twentieth of the size, the function may be 0 next to it
        some = np.flatnonzero(~(q.min(axis=0) >= 0.05 * size + LATER_TERMS * left))
        if not len(some):
            return unsure, *none
        q, size, left = q.take(some, axis=1), size[some], left[some]
        g, d = product(VALUES, q), product(SLOPES, q)
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
        terms = series(q.take(own, axis=1))
        t, which = root(terms, low, high, low - a / chord, chord), some[own]
        kept = (t > part[0, which] + AT_END) & (t < part[1, which] - AT_END)
        return unsure, which[kept], t[kept]

    def _refined(self, kind: int, rows: Rows, sign: Array, t: Array) -> Array:
        """Zeros of the functions themselves, from the zeros of their series."""
        (_, x), half = rows.places(t, self.w), 0.5 * (rows.u[1] - rows.u[0])
        earlier, live = np.arange(self.f.signs)[:, None] < kind, np.arange(len(t))
        known = np.where(earlier, sign, np.nan)
        for _ in range(6):  # Newton steps, from the zero of a series
            if not len(live):
                break
            held = known[:, live, None]
            value, slope = self.f(x[live, None], rows.design[live], 1, held, ())[1]
            step = -value[kind, :, 0] / slope[kind, :, 0]
            # No step is longer than a tenth of a half row: the series knows its zeros better.
            far = 0.1 * half[live]
            step = np.clip(np.where(np.isfinite(step), step, 0.0), -far, far)
            x[live] += step
            # After a step of 1e-8 of a half row the rest is rounding.
            live = live[np.abs(step) > 1e-8 * half[live]]
        middle = 0.5 * (rows.u[0] + rows.u[1])
        return np.asarray((spread(x, self.w[rows.design]) - middle) / half)


def spread(x: Array, w: Array) -> Array:
    """u at places x, where x = w sinh(u / w): samples even in u are spread about 0.

    Poles at x = i w and -i w move to u = i w pi/2 and -i w pi/2; with a large w, u is x. Source: D.
    Elliott, P. R. Johnston, Int. J. Numer. Meth. Engng 62 (2005).
    """
    return np.asarray(w * np.arcsinh(x / w))
