"""The greatest size of a function, proved: branch and bound with Taylor enclosures in balls.

A function is given by its Taylor coefficients at a ball. On an interval of half width h about m the
enclosure is the sum of c_k(m) t^k for k < ORDER and c_ORDER(interval) t^ORDER, with |t| <= h: the
theorem of Taylor, with Lagrange's remainder. The same holds for its first two derivatives.

An interval is settled if its values lie below the greatest known one. They must do so by more than
the fraction ``TIE``, so that all equal peaks remain. It is settled too if the function is monotonic
on it, or if its size is convex there: then its ends decide. The third case is a concave size, where
interval Newton closes on the one zero of the derivative. Else the interval is halved.
"""

import heapq
import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple, TypeAlias, cast

from flint import arb, arb_poly

from geneva_cli.extras.certify.balls import Ball, arb_of, below
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
NEAR_DEG = 1e-7  # places that are nearer are one


class BoundedSpan(NamedTuple):
    """An interval of a motion in degrees, and a bound above the function's size on it, or inf."""

    motion: int  # its number
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


class _Piece(NamedTuple):
    """Part of a motion with one formula, and what an end may be off where another takes over."""

    motion: int
    start: float
    end: float
    before: float
    after: float

    def reach(self, a: float, b: float) -> tuple[float, float]:
        """The interval, longer at an end of the piece by what that end may be off."""
        return a - self.before * (a == self.start), b + self.after * (b == self.end)


def greatest(motions: Sequence[tuple[Formula, Iterable[float]]], limit: int) -> Greatest:
    """The greatest size of several motions' formulas, each from its first seam to its last.

    It examines at most so many intervals.
    """
    pieces = []
    for i, (_, seams) in enumerate(motions):
        ends = sorted(seams)
        for a, b in pairwise(distinct(ends, 4.0 * EDGE_DEG)):  # as near as their errors: one
            off = EDGE_DEG * (a != ends[0]), EDGE_DEG * (b != ends[-1])
            pieces.append(_Piece(i, a, b, *off))
    return _Search([formula for formula, _ in motions], limit).run(pieces)


class _Search:
    """Branch and bound, the interval with the highest bound first."""

    def __init__(self, formulas: Sequence[Formula], limit: int) -> None:
        self.formulas, self.limit = formulas, limit
        self.low, self.examined = 0.0, 0
        self.candidates: list[BoundedSpan] = []
        self.ends: list[BoundedSpan] = []  # ends of halved intervals, which are no peaks
        self.waiting: list[tuple[float, float, float, _Piece]] = []
        self.unsettled: list[BoundedSpan] = []

    def run(self, pieces: Sequence[_Piece]) -> Greatest:
        for piece in pieces:
            for x in (piece.start, piece.end):
                a, b = piece.reach(x, x)
                # mostly inside the piece
                self._take(piece, a - 3.0 * (b - x), b + 3.0 * (x - a))
            heapq.heappush(self.waiting, (-math.inf, piece.start, piece.end, piece))
        while self.waiting and -self.waiting[0][0] >= self._least and self.examined < self.limit:
            high, a, b, piece = heapq.heappop(self.waiting)
            self.examined += 1
            self._examine(piece, a, b, -high)
        left = [BoundedSpan(piece.motion, a, b, -high) for high, a, b, piece in self.waiting]
        left = [one for one in left + self.unsettled if one.high >= self._least]
        kept = [one for one in self.candidates if one.high >= self._least]
        kept += [one for one in self.ends if one.high >= self.low]
        high = max(one.high for one in kept + left)
        places: list[BoundedSpan] = []
        for one in sorted(kept):
            last = places[-1] if places else None
            # nearer places are one
            if last and last.motion == one.motion and one.start - last.end <= NEAR_DEG:
                most = max(last.high, one.high)
                places[-1] = last._replace(end=max(last.end, one.end), high=most)
            else:
                places.append(one)
        open_ = max(left, key=lambda one: one.high, default=None)
        return Greatest(self.low, high, tuple(places), self.examined, open_)

    @property
    def _least(self) -> float:
        """The size that an interval must reach to be one of the greatest."""
        return self.low * (1.0 - TIE)

    def _examine(self, piece: _Piece, a: float, b: float, high: float) -> None:
        inside, value, slope, bend = self._on(piece, *piece.reach(a, b))
        if value.is_finite():
            self.low = max(self.low, _sizes(inside)[0])
            high = min(high, _sizes(value)[1])
            if high < self._least:
                return
            sign = _sign(value)
            bends = sign * _sign(bend)  # above 0: the size is convex
            if _sign(slope) or bends > 0:
                self._take_ends(piece, a, b)
                return
            if bends < 0 and self._take_top(piece, a, b, sign, bend):
                return
            # an interval that rises by less than 1e-15 of the greatest size is a plateau
            if high <= self.low * (1.0 + 1e-15):
                self.candidates.append(BoundedSpan(piece.motion, a, b, high))
                return
        # A shorter fraction of a piece is not halved, but left open. It is long enough for a seam
        # inside, that should have been known, to be seen (``arrays.Enclosed.REACH``).
        if b - a < max(2.0**-30 * (piece.end - piece.start), 4.0 * EDGE_DEG):
            # A jump has no derivatives. Its bound lies above the values beside it by their slope
            # times the shortest interval: for loads by 1e-8 of them.
            spans = self.candidates if high <= self.low * (1.0 + 1e-6) else self.unsettled
            spans.append(BoundedSpan(piece.motion, a, b, high))
            return
        middle = 0.5 * (a + b)
        heapq.heappush(self.waiting, (-high, a, middle, piece))
        heapq.heappush(self.waiting, (-high, middle, b, piece))

    def _take_ends(self, piece: _Piece, a: float, b: float) -> None:
        """Take the sizes at both ends of an interval; those of the piece are known."""
        for x in (a, b):
            if x not in (piece.start, piece.end):
                self.ends.append(self._sized(piece, x, x))

    def _take(self, piece: _Piece, a: float, b: float) -> None:
        """Take an interval of a few units in the last place as one that may hold the greatest."""
        span = self._sized(piece, a, b)
        (self.candidates if math.isfinite(span.high) else self.unsettled).append(span)

    def _sized(self, piece: _Piece, a: float, b: float) -> BoundedSpan:
        """A short interval, or one angle, with its bound; raises ``low`` to what is reached."""
        one = self._values(piece, Ball.exact(a), 0)[0] if a == b else self._on(piece, a, b)[1]
        low, high = _sizes(one)
        self.low = max(self.low, low)
        return BoundedSpan(piece.motion, a, b, high)

    def _take_top(self, piece: _Piece, a: float, b: float, sign: int, bend: arb) -> bool:
        """Take the one place where the slope is 0; False if Newton does not close on it."""
        x, y = piece.reach(a, b)
        # 60 Newton steps, each of which squares the width
        for _ in range(60):
            middle = 0.5 * (x + y)
            step = self._values(piece, Ball.exact(middle), 1)[1] / bend
            low, high = Ball(middle - step * 180 / arb.pi()).bounds()
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
        if any(
            _sign(self._values(piece, Ball.exact(at), 1)[1]) != side
            for at, side in ((x, sign), (y, -sign))
        ):
            return False
        self._take(piece, x, y)
        return True

    def _values(self, piece: _Piece, at: Ball, order: int) -> list[arb]:
        """Taylor coefficients at a ball; of a place where none are known, balls without bounds."""
        try:
            jet = self.formulas[piece.motion](cast("Number", at), order)
        except Undecided:
            return [arb.nan()] * (order + 1)
        return [arb_of(c) for c in jet.c]

    def _on(self, piece: _Piece, a: float, b: float) -> tuple[arb, arb, arb, arb]:
        """The value in the middle of an interval, and value, slope and bend on all of it.

        By Taylor's theorem; a value without bounds is not finite.
        """
        # Both at the exact middle: a double beside it may belong to the formula beyond a seam.
        on = Ball.between(a, b)
        centre = on.arb.mid()
        thin = self._values(piece, Ball(centre), ORDER - 1)
        thick = self._values(piece, on, ORDER)
        # the sum and its first two derivatives, and how far they lie from the middle
        total, t = arb_poly([*thin, thick[ORDER]]), (on.arb - centre) * arb.pi() / 180
        rate = total.derivative()
        value, slope = _meet(total(t), thick[0]), _meet(rate(t), thick[1])
        return thin[0], value, slope, _meet(rate.derivative()(t), 2 * thick[2])


def _sign(x: arb) -> int:
    """1 or -1 if all numbers of a ball have that sign, else 0."""
    return (x > 0) - (x < 0)


def _sizes(x: arb) -> tuple[float, float]:
    """Doubles below and above the size of every number of a ball."""
    return max(below(x.abs_lower()), 0.0), -below(-x.abs_upper())


def _meet(x: arb, y: arb) -> arb:
    """The intersection of two balls that hold one number; an unbounded ball adds nothing."""
    if not (x.is_finite() and y.is_finite()):
        return x if x.is_finite() else y
    return x.intersection(y) if x.overlaps(y) else x.union(y)
