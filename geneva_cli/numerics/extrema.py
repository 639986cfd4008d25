"""Stationary points and greatest sizes of a batch of functions of one variable.

Designs are processed in blocks that fit in the processor's cache. All are scanned over their own
spans. Where a cubic through two neighbours' values and slopes misses the value midway, only those
designs are sampled again between them. Newton's method, within brackets, then refines the rest. A
design that is NaN anywhere has NaN for a result, and disturbs no other. ``search`` has its own
engine: on motions of a batch it takes 9 to 16 times as long, places peaks to 3e-11 degrees only,
and does not list stationary points.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Which, Whole, blocks, joined
from geneva_cli.numerics.newton import Brackets, nearer, newton_roots
from geneva_cli.numerics.tolerances import TIE

if TYPE_CHECKING:
    Sample: TypeAlias = Array | tuple[Array, Array, Array]  # place, value, slope

SCAN_INTERVALS = 12  # intervals of the first scan, an even number
# designs scanned at a time: 13 places of each take 110 kB for each number of a formula
BLOCK = 1024
GROUP = 16 * BLOCK  # designs refined together
PREDICTED = 1e-2  # fraction of the range by which a cubic may miss the middle of its interval


class BatchFunction(Protocol):
    """A function for each design; ``A[which]`` selects numbers of designs, if A has those of all.

    ``which`` is a slice or the indices of m designs. ``x`` then has the shape (m, k), and numbers
    (n, 1) give ``A[which]`` of the shape (m, 1).
    """

    def __call__(self, x: Array, which: Which, order: int) -> Sequence[Array]:
        """Value and derivatives up to ``order``, 0 to 2, each of the shape of x."""


class Stationary(NamedTuple):
    """Stationary points, in order of design and place."""

    which: Whole  # the design's number
    x: Array
    value: Array


def stationary_points(f: BatchFunction, a: Array, b: Array) -> Stationary:
    """All stationary points between a and b, of the shape (n, 1), in order of design and place."""
    groups = []
    with np.errstate(all="ignore"):
        for part in blocks(len(a), GROUP):
            groups.append(_tops(f, _scanned(f, a[part], b[part], part.start).turns)[:3])
    which, x, value = joined(groups)
    order = np.lexsort((x, which))
    return Stationary(which[order], x[order], value[order])


class Rough(NamedTuple):
    """Approximate functions for a scan, and their error as a fraction of a greatest size."""

    f: BatchFunction
    wrong: float


def greatest_sizes(
    f: BatchFunction, *places: Array, rough: Rough | None = None, unsure: float = 0.0
) -> tuple[Array, Array]:
    """Greatest sizes between the first and the last of some places (n, 1), and where: (n,) both.

    Functions are smooth between two places, which are known to a fraction ``unsure`` of the whole
    span. Both ends are included. If sizes differ by less than a fraction of 1e-13, the first is
    returned. ``rough`` are approximations that take less time, used to find where to search.

    >>> A = np.array([[1.0], [2.0]])
    >>> def waves(x, which, order):
    ...     sine, cosine = np.sin(A[which] * x), np.cos(A[which] * x)
    ...     return [sine, A[which] * cosine, -(A[which] ** 2) * sine][: order + 1]
    >>> greatest_sizes(waves, 0.0 * A, 0.0 * A + 1.0)
    (array([0.84147098, 1.        ]), array([1.        , 0.78539816]))
    """
    with np.errstate(all="ignore"):
        groups = [
            _greatest(f, rough, [place[part] for place in places], unsure, part.start)
            for part in blocks(len(places[0]), GROUP)
        ]
    return joined(groups)


def _greatest(
    f: BatchFunction, rough: Rough | None, places: Sequence[Array], unsure: float, start: int
) -> tuple[Array, Array]:
    """Greatest sizes of a group of designs, the first of which has the number ``start``."""
    pieces = smooth_pieces(places, unsure)
    scans = [_scanned(rough.f if rough else f, a, b, start) for a, b in pieces]
    size = np.abs(np.hstack([scan.ends for scan in scans]))
    at = np.hstack([end for piece in pieces for end in piece])
    sampled = np.maximum.reduce([np.abs(x) for scan in scans for x in (scan.low, scan.high)])
    tops = _tops(f, joined([_high_turns(scan, sampled, start) for scan in scans]), rough)
    which, value = tops.which - start, np.abs(tops.value)
    x = _at_ends(tops.x, at[which])
    if rough and rough.wrong:
        # evaluate samples again that may be the greatest
        bar = (1.0 - rough.wrong) * _most(size, which, value)
        low = tops.sampled & (value < bar[which])
        again = np.flatnonzero(tops.sampled & ~low)
        value[low] = -np.inf
        value[again] = np.abs(f(x[again, None], tops.which[again], 0)[0][:, 0])
        size[size < bar[:, None]] = -np.inf
        column, row = np.nonzero(bar <= size.T)
        size[row, column] = np.abs(f(at[row, column, None], row + start, 0)[0][:, 0])
    most = _most(size, which, value)
    bar = most / (1.0 + TIE)
    ends = np.fmin.reduce(np.where(size >= bar[:, None], at, np.nan), axis=1)
    high, tops_first = value >= bar[which], np.full(len(most), np.nan)
    np.fmin.at(tops_first, which[high], x[high])
    # An end just before an equally high maximum is part of its flat top.
    apart = (tops_first - ends) / (at[:, -1] - at[:, 0])
    # Nearer to the end the maximum may be rounding; farther than a root of TIE it is not level.
    flat = (apart > 1e-12) & (apart < 1e-6)
    return most, np.where(flat, tops_first, np.fmin(ends, tops_first))


def _at_ends(x: Array, ends: Array) -> Array:
    """Places (k,), replaced by the ends (k, j) that they equal apart from rounding."""
    nearest = ends[np.arange(len(x)), np.abs(ends - x[:, None]).argmin(axis=1)]
    # Places nearer than this fraction of the span are equal, such as 0 and 1e-47.
    close = np.abs(nearest - x) < 1e-15 * (ends[:, -1] - ends[:, 0])
    return np.where(close, nearest, x)


def _most(size: Array, which: Whole, value: Array) -> Array:
    """The greatest of sizes (n, k) and of other values of the designs."""
    most: Array = size.max(axis=1)
    np.maximum.at(most, which, value)
    return most


def smooth_pieces(places: Sequence[Array], unsure: float = 0.0) -> list[tuple[Array, Array]]:
    """Both ends of the parts between ascending places (n, 1), clear of the places within.

    A function may jump at the places within. They are known to a fraction ``unsure`` of the whole
    span, but 0 is exact. The value at a place itself belongs to the part before it, so that the
    part after it begins at least one double later.
    """
    blur = unsure * (places[-1] - places[0])
    inner = [(x, np.where(x == 0.0, 0.0, blur)) for x in places[1:-1]]
    # beyond 0 the next double would become 0 again where it is scaled
    beyond = [np.where(x == 0.0, 1e-300, np.nextafter(x, np.inf)) for x, _ in inner]
    begins = [np.maximum(after, x + clear) for after, (x, clear) in zip(beyond, inner, strict=True)]
    ends = [x - clear for x, clear in inner]
    pairs = zip([places[0], *begins], [*ends, places[-1]], strict=True)
    return [(np.minimum(a, places[-1]), np.maximum(a, b)) for a, b in pairs]


def _high_turns(scan: _Scan, sampled: Array, start: int) -> _SamplePairs:
    """Pairs around a maximum or minimum whose size may exceed ``sampled`` in their design."""
    here, left, right = scan.turns.which - start, scan.turns.left, scan.turns.right
    # A cubic rises above its ends by at most 4/27 of this; and a cubic may miss.
    rise = (right[0] - left[0]) * np.abs(left[2] - right[2]) * (4.0 / 27.0)
    reach = np.maximum(np.abs(left[1]), np.abs(right[1])) + rise
    missed = PREDICTED * (scan.high - scan.low)
    return scan.turns.taken(reach + missed[here] >= sampled[here])


class _SamplePairs(NamedTuple):
    """Adjacent samples of designs: place, value and slope in three rows, left and right."""

    which: Whole
    left: Array
    right: Array

    def taken(self, where: Mask) -> _SamplePairs:
        return _SamplePairs(self.which[where], self.left[:, where], self.right[:, where])


class _Scan(NamedTuple):
    ends: Array  # values at a and b, two columns
    low: Array  # the least and the greatest sample of each design
    high: Array
    turns: _SamplePairs  # pairs whose slope changes sign, or is zero at one end
    missed: _SamplePairs  # pairs where a cubic does not predict the middle: to be halved


def _scanned(f: BatchFunction, a: Array, b: Array, start: int) -> _Scan:
    """The scan of a group of designs, the first of which has the number ``start``."""
    scans = [_scan(f, a[part], b[part], start + part.start) for part in blocks(len(a), BLOCK)]
    ends, low, high = (np.concatenate([s[i] for s in scans]) for i in range(3))
    turns, missed = (
        joined(pairs) for pairs in ([s.turns for s in scans], [s.missed for s in scans])
    )
    if len(missed.which):
        turns = joined([turns, _refined(f, start, missed, low, high)])
    return _Scan(ends, low, high, turns, missed)


def _scan(f: BatchFunction, a: Array, b: Array, start: int) -> _Scan:
    # Designs lie side by side in memory: each operation runs along all of them.
    samples = np.empty((3, SCAN_INTERVALS + 1, len(a))).transpose(0, 2, 1)
    x, value, slope = samples
    x[:] = a + (b - a) * (np.arange(SCAN_INTERVALS + 1) / SCAN_INTERVALS)
    x[:, -1:] = b
    value[:], slope[:] = f(x, slice(start, start + len(a)), 1)
    low, high = value.min(axis=1), value.max(axis=1)
    left, middle, right = samples[:, :, :-1:2], samples[:, :, 1::2], samples[:, :, 2::2]
    missed = unpredicted(left, middle, right, low[:, None], high[:, None])
    turn = _turns(slope[:, :-1], slope[:, 1:])
    turn[:, ::2] &= ~missed
    turn[:, 1::2] &= ~missed
    column, row = np.nonzero(turn.T)
    turns = _SamplePairs(row + start, samples[:, row, column], samples[:, row, column + 1])
    column, row = np.nonzero(missed.T)
    left, middle, right = (s[:, row, column] for s in (left, middle, right))
    row += start
    halves = joined([_SamplePairs(row, left, middle), _SamplePairs(row, middle, right)])
    return _Scan(value[:, [0, -1]], low, high, turns, halves)


def _refined(
    f: BatchFunction, start: int, open_: _SamplePairs, low: Array, high: Array
) -> _SamplePairs:
    """Pairs with a turn, halved until a cubic predicts the middle; updates ``low`` and ``high``.

    Halving ends for a design with more than 32,768 open pairs.
    """
    settled = []
    most = 1 << 15  # open pairs of a design: more are rounding, as of table laws
    for _ in range(50):  # a feature 2**-50 of the interval wide is still seen
        which, left, right = open_
        x = 0.5 * (left[0] + right[0])
        value, slope = (v[:, 0] for v in f(x[:, None], which, 1))
        middle, here = np.stack((x, value, slope)), which - start
        np.minimum.at(low, here, value)
        np.maximum.at(high, here, value)
        missed = unpredicted(left, middle, right, low[here], high[here])
        halves = [_SamplePairs(which, left, middle), _SamplePairs(which, middle, right)]
        settled += [half.taken(~missed) for half in halves]
        open_ = joined([half.taken(missed) for half in halves])
        if len(open_.which) > most:
            noisy = np.bincount(open_.which - start)[open_.which - start] > most
            settled.append(open_.taken(noisy))
            open_ = open_.taken(~noisy)
        if not len(open_.which):
            break
    pairs = joined([*settled, open_])
    return pairs.taken(_turns(pairs.left[2], pairs.right[2]))


def unpredicted(left: Sample, middle: Sample, right: Sample, low: Array, high: Array) -> Mask:
    """Masks of the pairs whose cubic misses the sample midway by ``PREDICTED`` of the range.

    Pairs are included whose cubic turns twice between slopes of the same sign.
    """
    width = right[0] - left[0]
    predicted = 0.5 * (left[1] + right[1]) + width * (left[2] - right[2]) / 8.0
    # the rounding of a value, which no sampling improves
    rounding = 1e-13 * np.maximum(np.abs(low), np.abs(high))
    missed: Mask = np.abs(middle[1] - predicted) > PREDICTED * (high - low) + rounding
    missed |= goes_back(left, middle, rounding)
    return missed | goes_back(middle, right, rounding)


def goes_back(one: Sample, two: Sample, rounding: Array) -> Mask:
    """Masks of the pairs whose cubic turns twice between slopes of the same sign."""
    width, rise = two[0] - one[0], two[1] - one[1]
    product, both = one[2] * two[2], (one[2] + two[2]) * width
    # The slope is a parabola. It is below zero somewhere if its mean is less than a third of:
    # the sum of the two slopes less the root of their product. The sum alone is a first test.
    turns: Mask = (3.0 * rise * both < both * both) & (product > 0.0)
    if turns.any():
        where = np.nonzero(turns)  # few
        mean = np.sqrt(product[where]) * np.abs(np.broadcast_to(width, turns.shape)[where])
        size, rise = np.abs(both[where]), rise[where] * np.sign(both[where])
        large = size > np.broadcast_to(rounding, turns.shape)[where]
        turns[where] = (3.0 * rise < size - mean) & large
    return turns


def _turns(left: Array, right: Array) -> Mask:
    # both are zero for a constant, or at turns that a halving would have revealed
    turns: Mask = (np.sign(left) * np.sign(right) < 0.0) | ((left == 0.0) != (right == 0.0))
    return turns


class _Tops(NamedTuple):
    """Stationary points, their values, and a mask of those that are samples."""

    which: Whole
    x: Array
    value: Array
    sampled: Mask


def _tops(f: BatchFunction, pairs: _SamplePairs, rough: Rough | None = None) -> _Tops:
    """Stationary points of pairs: right samples with slope 0, and the points within.

    A stationary sample may hide another point within. The slope next to it has the sign of the
    second derivative, and its zero is divided out of the slope for Newton's method. The first step
    uses ``rough``, which usually leaves one step for the functions themselves.
    """
    which, left, right = pairs
    before, after = left[2], right[2]
    flat = right[:2, after == 0.0], which[after == 0.0]
    known = np.flatnonzero((before == 0.0) | (after == 0.0))
    if len(known):
        before, after = before.copy(), after.copy()
        for side, slope, sign in ((left, before, 1.0), (right, after, -1.0)):
            there = known[slope[known] == 0.0]
            slope[there] = sign * f(side[0, there, None], which[there], 2)[2][:, 0]
        turns = np.sign(before) * np.sign(after) < 0.0
        (which, left, right), before = pairs.taken(turns), before[turns]
    a, b = left[0], right[0]
    at_a, at_b = left[2] == 0.0, right[2] == 0.0

    def slope_of(x: Array, live: Whole, f: BatchFunction = f) -> tuple[Array, Array, Array]:
        value, slope, bend = (v[:, 0] for v in f(x[:, None], which[live], 2))
        others = at_a[live] / (x - a[live]) - at_b[live] / (b[live] - x)
        return slope, bend - slope * others, value

    start = turn_of_cubic(left, right)
    brackets = Brackets(a, b, np.where(at_a, np.nan, left[2]), np.where(at_b, np.nan, right[2]))
    if rough:
        slope, bend, _ = slope_of(start, np.arange(len(start)), rough.f)
        start = nearer(slope, bend, brackets, start)
    # In a bracket where a cubic holds, a step of 1e-8 of the bracket reaches the last bit.
    x, rise, (_, _, value) = newton_roots(slope_of, brackets, start, before < 0.0, 1e-8)
    within = np.stack((x, value + rise))
    (x, value), which = (
        np.concatenate(p, axis=-1) for p in zip((within, which), flat, strict=True)
    )
    return _Tops(which, x, value, np.arange(len(which)) >= len(rise))


def turn_of_cubic(left: Array, right: Array) -> Array:
    """The stationary place of the cubic through two neighbours' values and slopes."""
    width = right[0] - left[0]
    chord = (right[1] - left[1]) / width
    s, e = left[2], right[2]
    # slope = s + q t + p t², which rises through its root if s < 0
    p, q = 3.0 * (s + e - 2.0 * chord), 2.0 * (3.0 * chord - 2.0 * s - e)
    rising = np.where(s < 0.0, 1.0, -1.0)
    root = rising * np.sqrt(np.maximum(q * q - 4.0 * p * s, 0.0))
    t = np.where(q * rising > 0.0, -2.0 * s / (q + root), (root - q) / (2.0 * p))
    turn: Array = left[0] + width * np.where((t > 0.0) & (t < 1.0), t, 0.5)
    return turn
