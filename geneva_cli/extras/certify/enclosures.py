"""The greatest size of a function, proved: branch and bound with Taylor enclosures in balls.

A function is given by its Taylor coefficients at a ball. On an interval of half width h about m the
enclosure is the sum of c_k(m) t^k for k < ORDER and c_ORDER(interval) t^ORDER, with |t| <= h: the
theorem of Taylor, with Lagrange's remainder. The same holds for its first two derivatives.

An interval is settled if its values lie below the greatest known one. They must do so by more than
the fraction ``TIE``, so that all equal peaks remain. It is settled too if the function is monotonic
on it, or if its size is convex there: then its ends decide. The third case is a concave size, where
interval Newton closes on the one zero of the derivative. Else the interval is halved.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple, TypeAlias, cast

from geneva_cli.extras.certify.balls import NOWHERE, Ball, ball_of
from geneva_cli.numerics.angles import distinct
from geneva_cli.numerics.intervals import Undecided
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.numerics.tolerances import TIE

# the jet of an order at a ball of degrees from mid-motion, by the angle in radians
Formula: TypeAlias = Callable[[Number, int], Jet]

ORDER = 5
# An end of a piece is a double that rounding may have moved: by 8 units in the last place of 180
# degrees at most. Pieces overlap by as much, so that no angle is left out.
EDGE_DEG = 2.0**-42


class BoundedSpan(NamedTuple):
    """An interval in degrees, and a bound above the function's size on it (infinite: none)."""

    start: float
    end: float
    high: float


class Greatest(NamedTuple):
    """Bounds of the greatest size, and all places where it may be.

    ``open`` is the interval with the highest bound that is not settled, or None if all are: then
    the greatest size is proved to lie from ``low`` to ``high``, and at one of ``places``.
    """

    low: float
    high: float
    places: tuple[BoundedSpan, ...]
    intervals: int
    open: BoundedSpan | None


class _Enclosure(NamedTuple):
    """Balls that hold the function in the middle of an interval, and on all of it."""

    middle: Ball
    value: Ball
    slope: Ball
    bend: Ball


class _Piece(NamedTuple):
    """Part of the motion with one formula, and what an end may be off where another takes over."""

    start: float
    end: float
    before: float
    after: float

    def reach(self, a: float, b: float) -> tuple[float, float]:
        """The interval, longer at an end of the piece by what that end may be off."""
        return a - self.before * (a == self.start), b + self.after * (b == self.end)


def greatest(formula: Formula, seams: Iterable[float], limit: int) -> Greatest:
    """The greatest size of a formula from first to last seam, with at most so many intervals."""
    ends = sorted(seams)
    pieces = [
        _Piece(a, b, EDGE_DEG * (a != ends[0]), EDGE_DEG * (b != ends[-1]))
        for a, b in pairwise(distinct(ends, 4.0 * EDGE_DEG))  # as near as their errors: one
    ]
    return _Search(formula, limit).run(pieces)


class _Search:
    """Branch and bound, the interval with the highest bound first."""

    def __init__(self, formula: Formula, limit: int) -> None:
        self.formula, self.limit = formula, limit
        self.low, self.examined = 0.0, 0
        self.candidates: list[BoundedSpan] = []
        self.ends: list[BoundedSpan] = []  # ends of halved intervals, which are no peaks
        self.waiting: list[tuple[float, float, float, _Piece]] = []
        self.unsettled: list[BoundedSpan] = []

    def run(self, pieces: Sequence[_Piece]) -> Greatest:
        for piece in pieces:
            for x in (piece.start, piece.end):
                a, b = piece.reach(x, x)
                self._take(a - 3.0 * (b - x), b + 3.0 * (x - a))  # mostly inside the piece
            heapq.heappush(self.waiting, (-math.inf, piece.start, piece.end, piece))
        while self.waiting and -self.waiting[0][0] >= self._least and self.examined < self.limit:
            high, a, b, piece = heapq.heappop(self.waiting)
            self.examined += 1
            self._examine(piece, BoundedSpan(a, b, -high))
        left = [BoundedSpan(a, b, -high) for high, a, b, _ in self.waiting] + self.unsettled
        left = [interval for interval in left if interval.high >= self._least]
        kept = [interval for interval in self.candidates if interval.high >= self._least]
        kept += [interval for interval in self.ends if interval.high >= self.low]
        high = max(interval.high for interval in kept + left)
        places: list[BoundedSpan] = []
        near = 1e-9 * (pieces[-1].end - pieces[0].start)  # nearer places are one
        for one in sorted(kept):
            if places and one.start - places[-1].end <= near:
                start, end, most = places.pop()
                one = BoundedSpan(start, max(end, one.end), max(most, one.high))
            places.append(one)
        open_ = max(left, key=lambda interval: interval.high, default=None)
        return Greatest(self.low, high, tuple(places), self.examined, open_)

    @property
    def _least(self) -> float:
        """The size that an interval must reach to be one of the greatest."""
        return self.low * (1.0 - TIE)

    def _examine(self, piece: _Piece, interval: BoundedSpan) -> None:
        a, b, high = interval
        enclosure = self._on(*piece.reach(a, b))
        if enclosure:
            self.low = max(self.low, enclosure.middle.sizes()[0])
            high = min(high, enclosure.value.sizes()[1])
            if high < self._least:
                return
            bends = enclosure.value.sign * enclosure.bend.sign  # above 0: the size is convex
            if enclosure.slope.sign or bends > 0:
                self._take_ends(piece, a, b)
                return
            if bends < 0 and self._take_top(piece, a, b, enclosure):
                return
            # an interval that rises by less than 1e-15 of the greatest size is a plateau
            if high <= self.low * (1.0 + 1e-15):
                self.candidates.append(BoundedSpan(a, b, high))
                return
        # A shorter fraction of a piece is not halved, but left open. It is long enough for a seam
        # inside, that should have been known, to be seen (``arrays.Enclosed.REACH``).
        if b - a < max(2.0**-30 * (piece.end - piece.start), 4.0 * EDGE_DEG):
            # A jump has no derivatives. Its bound lies above the values beside it by their slope
            # times the shortest interval: for loads by 1e-8 of them.
            spans = self.candidates if high <= self.low * (1.0 + 1e-6) else self.unsettled
            spans.append(BoundedSpan(a, b, high))
            return
        middle = 0.5 * (a + b)
        heapq.heappush(self.waiting, (-high, a, middle, piece))
        heapq.heappush(self.waiting, (-high, middle, b, piece))

    def _take_ends(self, piece: _Piece, a: float, b: float) -> None:
        """Take the sizes at both ends of an interval; those of the piece are known."""
        for x in (a, b):
            if x not in (piece.start, piece.end):
                self.ends.append(self._sized(x, x))

    def _take(self, a: float, b: float) -> None:
        """Take an interval of a few units in the last place as one that may hold the greatest."""
        interval = self._sized(a, b)
        (self.candidates if math.isfinite(interval.high) else self.unsettled).append(interval)

    def _sized(self, a: float, b: float) -> BoundedSpan:
        """A short interval, or one angle, with its bound; raises ``low`` to what is reached."""
        if a == b:
            value = self._values(Ball.exact(a), 0)[0]
        else:
            on = self._on(a, b)
            value = on.value if on else NOWHERE
        low, high = value.sizes()
        self.low = max(self.low, low)
        return BoundedSpan(a, b, high)

    def _take_top(self, piece: _Piece, a: float, b: float, on: _Enclosure) -> bool:
        """Take the one place where the slope is 0; False if Newton does not close on it."""
        x, y = piece.reach(a, b)
        # 60 Newton steps, each of which squares the width
        for _ in range(60):
            middle = 0.5 * (x + y)
            step = self._values(Ball.exact(middle), 1)[1] / on.bend
            low, high = (middle - step * (180.0 / Ball.library.pi)).bounds()
            narrow = max(low, x), min(high, y)
            if narrow[0] > narrow[1]:  # the slope is nowhere 0
                self._take_ends(piece, a, b)
                return True
            x, y = narrow
            if y - x < EDGE_DEG:
                break
        x, y = x - 2.0 * EDGE_DEG, y + 2.0 * EDGE_DEG
        if y - x > 5.0 * EDGE_DEG:
            return False
        before, after = (self._values(Ball.exact(at), 1)[1].sign for at in (x, y))
        if (before, after) != (on.value.sign, -on.value.sign):
            return False
        self._take(x, y)
        return True

    def _values(self, at: Ball, order: int) -> Sequence[Ball]:
        """Taylor coefficients at a ball; of a place where none are known, balls without bounds."""
        try:
            return [ball_of(c) for c in self.formula(cast("Number", at), order).c]
        except Undecided:
            return [NOWHERE] * (order + 1)

    def _on(self, a: float, b: float) -> _Enclosure | None:
        """Enclosures on an interval by Taylor's theorem; None if the function has no bound."""
        # Both at the exact middle: a double beside it may belong to the formula beyond a seam.
        on = Ball.between(a, b)
        t = Ball.between(-on.radius, on.radius) * (Ball.library.pi / 180.0)
        thin = self._values(on.centre, ORDER - 1)
        thick = self._values(on, ORDER)
        c = [*thin, thick[ORDER]]
        sums = (
            _sum(c, t).meet(thick[0]),
            _sum([k * v for k, v in enumerate(c)][1:], t).meet(thick[1]),
            _sum([k * (k - 1) * v for k, v in enumerate(c)][2:], t).meet(2 * thick[2]),
        )
        return _Enclosure(thin[0], *sums) if sums[0].is_finite else None


def _sum(coefficients: Sequence[Ball], t: Ball) -> Ball:
    total = coefficients[-1]
    for c in reversed(coefficients[:-1]):
        total = total * t + c
    return total
