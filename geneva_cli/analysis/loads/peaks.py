"""The greatest loads over a motion, refined to the last digits.

The loads are smooth but where the torque changes sign (the roller then bears on the other wall),
where the sliding does (friction turns round), and where the motion itself has a break. Between
these places each is scanned until nothing is stepped over, and its maxima are roots of its slope.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.analysis.loads.contact import NEAR, Contact, contact, is_straight
from geneva_cli.analysis.loads.forces import Greatest, Row, Setting, gain, sliding, value
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.pitch_curve import retraces
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import rows_of, scalar
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.numerics.roots import root
from geneva_cli.numerics.roots_many import Roots, roots_between, roots_many
from geneva_cli.numerics.scan import Scan, hopeful, scan

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Whole
    from geneva_cli.numerics.jet import Array

ZERO = 1e-12  # share of a torque, a motion, or a lever over L that is rounding
STEP = 1e-9  # share of a bracket: after so short a Newton step, what is left is rounding
CLOSE = 1e-14  # share of an angle that is rounding
TIE = 1e-12  # two peaks nearer than this are one that occurs twice: the earlier is meant


class Stretch(NamedTuple):
    """Input angles between which the loads are smooth, and the signs that they have there."""

    start: float
    end: float
    drives: float  # of the wheel's torque
    slides: float  # of the sliding
    pays: float  # of the input's torque


# contact, signs of torque, of sliding and of the input's torque -> the quantities
Rows: TypeAlias = Callable[[Contact[Jet], Number, Number, Number], list[Row[Jet]]]


Signed: TypeAlias = Callable[[Contact[Jet]], Jet]  # something whose sign is asked for


@lru_cache(maxsize=256)
def stretches(engagement: Engagement, given: Setting) -> tuple[Stretch, ...]:
    """The motion cut where its loads have kinks or jumps.

    Cuts are places of breaks; a stretch ends one double beside them. At the cusp of a curved slot
    it keeps away from the slopes that are rounding.
    """

    def torque(at: Contact[Jet]) -> Jet:
        return at.acceleration * given.inertia_Nm + given.resists_Nm

    def rubs(drives: float) -> Signed:
        return lambda at: sliding(at, drives, given.radius)

    def shaft(drives: float, slides: float) -> Signed:
        return lambda at: gain(given, at, drives, slides) * drives

    ways = (1.0, -1.0) if given.inertia_Nm else (1.0,)
    pairs = [(drives, slides) for drives in ways for slides in (1.0, -1.0)]
    functions = [*map(rubs, ways), *[shaft(*pair) for pair in pairs]]
    cut = [Stretch(a, b, 1.0, 1.0, 1.0) for a, b in _smooth(engagement)]
    if given.inertia_Nm:
        functions.append(torque)
    signs = Signs(engagement, [piece[:2] for piece in cut], functions)
    if given.inertia_Nm:
        cut = signs.cut(cut, lambda piece: -1, "drives")
    cut = signs.cut(cut, lambda piece: ways.index(piece.drives), "slides")
    first = len(ways)
    return tuple(signs.cut(cut, lambda piece: first + pairs.index(piece[2:4]), "pays"))


class Signs:
    """Where functions of the contact change sign over some spans, looked for all at once."""

    def __init__(
        self,
        engagement: Engagement,
        spans: Sequence[tuple[float, float]],
        functions: Sequence[Signed],
    ) -> None:
        self.engagement, self.functions = engagement, functions

        def sampled(x: Array, _: Whole) -> tuple[Array, Array]:
            at = contact(engagement, x, 1, joints=False)
            return _columns([of(at) for of in functions], x)

        self.found = found = scan(sampled, spans)
        inner = _inner(found)
        ends = [found.changes(row) for row in range(len(functions))]
        kept = [(before[inner[before]], after[inner[before]]) for before, after in ends]
        self.row = np.repeat(np.arange(len(kept)), [len(before) for before, _ in kept])
        before, after = (np.concatenate(side) for side in zip(*kept, strict=True))

        def line(x: Array, which: Whole) -> tuple[Array, Array]:
            value, slope = sampled(x, which)
            pick = self.row[which], np.arange(len(x))
            return value[pick], slope[pick]

        self.zeros = zeros(line, found, self.row, before, after)

    def cut(
        self, pieces: Sequence[Stretch], row: Callable[[Stretch], int], sign: str
    ) -> list[Stretch]:
        """The pieces cut at the zeros of the function that ``row`` tells, with its sign between."""
        out = []
        for piece in pieces:
            number = row(piece) % len(self.functions)
            low, high = (piece.start + CLOSE * abs(piece.start), piece.end - CLOSE * abs(piece.end))
            places = np.sort(self.zeros[self.row == number])
            places = places[(places > low) & (places < high)]
            for a, b in pairwise([piece.start, *places.tolist(), piece.end]):
                cut = piece._replace(start=a, end=b)
                out.append(cut._replace(**{sign: self._sign(number, a, b)}))
        return out

    def _sign(self, row: int, a: float, b: float) -> float:
        """Of a function between two of its zeros: that of its greatest sample."""
        inside = (self.found.x > a) & (self.found.x < b)
        if inside.any():
            values = self.found.value[row, inside]
            return math.copysign(1.0, float(values[np.argmax(abs(values))]))
        middle = contact(self.engagement, 0.5 * (a + b), joints=False)
        return math.copysign(1.0, float(np.ravel(value(self.functions[row](middle)))[0]))


def cusps(engagement: Engagement, pieces: Sequence[Stretch]) -> list[tuple[int, float]]:
    """The stretches that keep away from a cusp at mid-motion, and where they end beside it."""
    before, after = NEAR * engagement.entry_deg, NEAR * engagement.exit_deg
    ends = [(i, end) for i, piece in enumerate(pieces) for end in piece[:2]]
    return [(i, end) for i, end in ends if end in (before, after)]


def whole(engagement: Engagement, given: Setting) -> list[Stretch]:
    """The stretches of a motion without gaps, for values alone: what is left out is given back."""
    pieces = stretches(engagement, given)
    cuts = [engagement.entry_deg]
    for before, after in pairwise(pieces):
        cuts.append(_between(engagement, given, before, after))
    cuts.append(engagement.exit_deg)
    placed = zip(pieces, pairwise(cuts), strict=True)
    return [p._replace(start=a, end=b) for p, (a, b) in placed if a < b]


def _between(engagement: Engagement, given: Setting, before: Stretch, after: Stretch) -> float:
    """Where one stretch ends and the next begins: a break, or a change of sign beside it."""
    a, b = before.end, after.start
    if b - a > NEAR * engagement.motion_deg * 1e-3 and before.drives != after.drives:

        def torque(way: float) -> tuple[float, float]:
            _, _, epsilon, rise = engagement.motion(a + way, 3).scalars()
            return epsilon * given.inertia_Nm + given.resists_Nm, rise * given.inertia_Nm * DEGREE

        if torque(0.0)[0] * torque(b - a)[0] < 0.0:
            return a + root(torque, 0.0, b - a)
    return min(max(a, 0.0), b) if a * b <= 0.0 else _at_break(a, engagement)


def _smooth(engagement: Engagement) -> list[tuple[float, float]]:
    breaks = engagement.motion.breaks_deg
    out = []
    for a, b in zip(breaks, breaks[1:], strict=False):
        start = a if a == breaks[0] else math.nextafter(a, math.inf)
        end = b if b == breaks[-1] else math.nextafter(b, -math.inf)
        if not is_straight(engagement):
            start = NEAR * engagement.exit_deg if a == 0.0 else start
            end = NEAR * engagement.entry_deg if b == 0.0 else end
        if start < end:
            out.append((start, end))
    return out


def _inner(found: Scan) -> Mask:
    """Of each sample whether what is found after it is not the stretch's end itself.

    Samples crowd towards both ends: between the last two a zero or a top is the end's own.
    """
    same = found.joined
    inner: Mask = np.concatenate((same, [False]))
    inner[1:] &= same
    inner[:-2] &= same[1:]
    inner[0] = inner[-2] = False
    return inner


def zeros(
    of: Callable[[Array, Whole], tuple[Array, Array]],
    found: Scan,
    row: Whole,
    before: Whole,
    after: Whole,
) -> Array:
    """Where functions of a scan are zero between samples, to a last place of the bracket.

    ``row`` are their numbers in the scan. ``of`` gives value and slope; what is rounding beside a
    function's greatest value counts as zero.
    """
    bar = np.array([found.noise(number) for number in range(len(found.value))])[row]

    def line(way: Array, which: Whole) -> tuple[Array, Array]:
        value, slope = of(found.x[before[which]] + way, which)
        return np.where(abs(value) > bar[which], value, 0.0), slope

    ends = found.value[row, before], found.value[row, after]
    out: Array = found.x[before] + _between_samples(line, found, before, after, *ends).x
    return out


def _between_samples(
    of: Callable[[Array, Whole], tuple[Array, ...]],
    found: Scan,
    before: Whole,
    after: Whole,
    *ends: Array,
) -> Roots:
    """Roots between samples of functions known at both.

    Near 0 doubles are finer than angles, so ``of`` takes the way from the first sample on.
    """
    width = found.x[after] - found.x[before]
    first, last = ends
    return roots_between(of, 0.0 * width, width, (first, last), STEP)


def _columns(jets: list[Jet], x: Array) -> tuple[Array, Array]:
    """Values and slopes by degrees, a row a jet."""
    value, slope = (rows_of([jet.c[k] for jet in jets], len(x)) for k in (0, 1))
    return value, slope * DEGREE


def maxima(
    engagement: Engagement, given: Setting, rows: Rows, least: float = 0.0
) -> list[Greatest]:
    """The greatest of each of ``rows`` over a motion; if not above ``least`` that, at entry."""
    pieces = stretches(engagement, given)
    signs = np.array([piece[2:] for piece in pieces]).T

    def sampled(x: Array, span: Whole) -> tuple[Array, Array]:
        asked = rows(contact(engagement, x, 1), *signs[:, span])
        value, slope = _columns([row.value for row in asked], x)
        for i, row in enumerate(asked):
            if row.room is None:
                continue
            lost = row.room.c[0] <= 0.0
            if np.any(lost):
                value[i] = np.where(lost, np.where(row.way > 0.0, np.nan, -np.inf), value[i])
        return value, slope

    found = scan(sampled, [(p.start, p.end) for p in pieces])
    ends = _at_mid_motion(engagement, given, pieces, rows, least)
    tops = _tops(engagement, found, rows, signs)
    brinks: dict[int, float] = {}
    out = []
    for i in range(len(found.value)):

        def at(x: Number, piece: Stretch, order: int, i: int = i) -> Row[Jet]:
            return rows(contact(engagement, x, order), *piece[2:])[i]

        lost = np.isnan(found.value[i])
        if lost.any():
            first = _first_with_room(engagement, pieces[0], rows, i)
            if first not in brinks:
                brinks[first] = _brink(found, lost, pieces, at)
            brink = brinks[first]
            out.append(Greatest(math.inf, min(brink, 0.0) if ends[i] == math.inf else brink))
        else:
            places = [(0.0, ends[i]), *tops[i], *_ends(found, i)]
            out.append(_greatest(places, engagement, least))
    return out


def _first_with_room(engagement: Engagement, piece: Stretch, rows: Rows, row: int) -> int:
    """The first row that ceases to have a bound where this one does: they need the same."""
    asked = rows(contact(engagement, np.array([piece.end]), 1), *piece[2:])
    same = [one.room is asked[row].room and bool(np.all(one.way > 0.0)) for one in asked]
    return same.index(True)


def _ends(found: Scan, row: int) -> list[tuple[float, float]]:
    """The first and last sample of each stretch."""
    cuts = np.flatnonzero(~found.joined)
    return [(float(found.x[i]), float(found.value[row][i])) for i in (0, *cuts, *(cuts + 1), -1)]


def _tops(
    engagement: Engagement, found: Scan, rows: Rows, signs: Array
) -> list[list[tuple[float, float]]]:
    """Places and values of the maxima of each row, all of them at once."""
    inner = _inner(found)
    hopes = [(row, i) for row in range(len(found.value)) for i in hopeful(found, row) if inner[i]]
    out: list[list[tuple[float, float]]] = [[] for _ in found.value]
    for number, i in hopes:  # a sample may be the top itself
        if found.slope[number, i + 1] == 0.0:
            out[number].append((float(found.x[i + 1]), float(found.value[number, i + 1])))
    hopes = [(number, i) for number, i in hopes if found.slope[number, i + 1]]
    if not hopes:
        return out
    row, before = (np.array(side) for side in zip(*hopes, strict=True))

    def jets(way: Array, which: Whole) -> tuple[Array, Array, Array]:
        """Slope, bend and value, each of the row that is asked for."""
        at = contact(engagement, found.x[before[which]] + way, 2)
        asked = [one.value.c for one in rows(at, *signs[:, found.span[before[which]]])]
        pick = row[which], np.arange(len(way))
        value, slope, bend = (rows_of([c[k] for c in asked], len(way))[pick] for k in range(3))
        return slope, 2.0 * DEGREE * bend, value

    slopes = found.slope[row, before], found.slope[row, before + 1]
    way, step, (slope, _, value) = _between_samples(jets, found, before, before + 1, *slopes)
    value = value + 0.5 * DEGREE * slope * step  # on the parabola through the last place but one
    for i, place, most in zip(row, (found.x[before] + way).tolist(), value.tolist(), strict=True):
        out[i].append((place, most))
    return out


def _greatest(places: list[tuple[float, float]], engagement: Engagement, least: float) -> Greatest:
    most = max(value for _, value in places)
    if not most > least:
        return Greatest(least, engagement.entry_deg)
    if math.isinf(most):
        return Greatest(most, 0.0)
    first = min(x for x, value in places if value >= most - TIE * abs(most))
    return Greatest(most, _at_break(first, engagement))


def _at_mid_motion(
    engagement: Engagement, given: Setting, pieces: tuple[Stretch, ...], rows: Rows, least: float
) -> list[float]:
    """The quantities at mid-motion of a curved slot, which no stretch reaches; infinite or a limit.

    Straight slots are scanned through mid-motion: nothing is added there.
    """
    x = np.zeros(1)
    at = contact(engagement, x)
    torque = at.acceleration * given.inertia_Nm + given.resists_Nm
    needed = float(torque.arrays()[0][0])
    beside = [p for p in pieces if NEAR * engagement.entry_deg in (p.end, -p.start)]
    if is_straight(engagement):
        with np.errstate(all="ignore"):
            return [least for _ in rows(at, 1.0, 1.0, 1.0)]
    # The tangent points away from the axis on the way in and out; at a cusp they are one.
    ways = (1.0,) if retraces(engagement) else (1.0, -1.0)
    common = given.inertia_Nm * abs(scalar(engagement.motion(0.5 * engagement.entry_deg, 2).c[2]))
    loaded = abs(needed) > ZERO * (common + given.resists_Nm)
    limits = [_towards_mid_motion(engagement, piece, rows) for piece in beside]
    out: list[float] = []
    for way in ways:
        here = at._replace(along=at.along * way, aside=at.aside * way, curvature=at.curvature * way)
        drives = math.copysign(1.0, needed)
        slides = math.copysign(1.0, float(sliding(here, drives, given.radius).arrays()[0][0]))
        with np.errstate(all="ignore"):
            pays = float(np.ravel(gain(given, here, drives, slides).c[0])[0]) * drives
            asked = rows(here, drives, slides, math.copysign(1.0, pays))
        values = []
        for row, limit in zip(asked, zip(*limits, strict=True), strict=True):
            room = math.inf if row.room is None else float(np.ravel(row.room.c[0])[0])
            value = float(np.ravel(row.value.c[0])[0])
            if room > ZERO and math.isfinite(value):
                values.append(value)
            elif loaded:
                values.append(math.copysign(math.inf, row.way))
            else:
                values.append(max(limit))
        out = [max(pair) for pair in zip(out, values, strict=True)] if out else values
    return out


def _towards_mid_motion(engagement: Engagement, piece: Stretch, rows: Rows) -> list[float]:
    """The limits of 0/0 there, from the stretch beside it."""
    x = piece.end if piece.end < 0.0 else piece.start
    h = math.radians(x)
    every = [row.value.c for row in rows(contact(engagement, x, 2), *piece[2:])]
    return [float(c[0] - h * (c[1] - h * c[2])) for c in every]


def _at_break(x: float, engagement: Engagement) -> float:
    """The place, or the break from which only rounding parts it."""
    near = min(engagement.motion.breaks_deg, key=lambda place: abs(place - x))
    return near if abs(near - x) <= ZERO * engagement.motion_deg else x


def _brink(
    found: Scan,
    lost: Mask,
    pieces: tuple[Stretch, ...],
    at: Callable[[Number, Stretch, int], Row[Jet]],
) -> float:
    """Where a quantity first has no value: where what it needs is 0, or its stretch begins."""
    first = int(np.argmax(lost))
    if not first or not found.joined[first - 1]:
        return float(found.x[first])
    i = first - 1
    start, width = float(found.x[i]), np.array([found.x[i + 1] - found.x[i]])
    piece = pieces[found.span[i]]

    def room(way: Array, _: Whole) -> tuple[Array, Array]:
        needed = at(start + way, piece, 1).room
        assert needed is not None
        value, slope = needed.c
        return value + 0.0 * way, slope * DEGREE + 0.0 * way

    return start + float(roots_many(room, 0.0 * width, width, STEP)[0])
