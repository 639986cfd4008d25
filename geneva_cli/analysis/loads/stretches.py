"""The motion cut into stretches in which its loads are smooth.

They have a kink or a jump where the torque changes sign (the roller then bears on the other wall),
where the sliding does (friction turns round), where the input's torque does, and where the motion
itself has a break.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.analysis.loads.contact import NEAR, Contact, contact, is_straight
from geneva_cli.analysis.loads.forces import Setting, gain, sliding, value
from geneva_cli.analysis.loads.zeros import columns, inside, zeros
from geneva_cli.errors import GenevaError
from geneva_cli.machine.engagement import Engagement
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.jet import Jet
from geneva_cli.numerics.roots import root
from geneva_cli.numerics.scan import Functions, NeverSeen, Scan, scan

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array

ZERO = 1e-12  # share of a torque, a motion, or a lever over L that is rounding
COARSE = 1e-10  # share of a step that may lie between two neighbouring angles
CLOSE = 1e-14  # share of an angle that is rounding


class Stretch(NamedTuple):
    """Input angles between which the loads are smooth, and the signs that they have there."""

    start: float
    end: float
    drives: float  # of the wheel's torque
    slides: float  # of the sliding
    feeds: float  # of the input's torque: 1 where it drives the machine, -1 where it is driven


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
    _refuse_rounding(engagement, signs.fastest)
    if given.inertia_Nm:
        cut = signs.cut(cut, lambda piece: -1, "drives")
    cut = signs.cut(cut, lambda piece: ways.index(piece.drives), "slides")
    first = len(ways)
    return tuple(signs.cut(cut, lambda piece: first + pairs.index(piece[2:4]), "feeds"))


def scanned(functions: Functions, spans: Sequence[tuple[float, float]], signed: slice) -> Scan:
    """Samples of loads, as ``numerics.scan`` takes them. Raises GenevaError for loads that are
    rounding, which no number of samples tells.
    """
    try:
        return scan(functions, spans, signed)
    except NeverSeen:
        raise _rounding(
            "loads change within less than the input's angle can tell apart: they"
        ) from None


def _refuse_rounding(engagement: Engagement, fastest: float) -> None:
    """Raise GenevaError where angles are too coarse for the motion: no load has digits then."""
    furthest = max(abs(engagement.entry_deg), abs(engagement.exit_deg))
    share = fastest * math.ulp(furthest) * DEGREE / (2.0 * engagement.half_step)
    if share > COARSE:
        raise _rounding(
            f"the wheel moves {fastest:.2g} times as fast as the input, {share:.1g} of its step "
            "while the input's angle changes by its last digit: such loads"
        )


def _rounding(why: str) -> GenevaError:
    """The refusal of loads that have no digits."""
    return GenevaError(
        f"{why} would be rounding; a drive that hurries less has some (elliptical gears, an "
        "eccentricity up to 0.999999)",
        ("drive", "kind"),
    )


class Signs:
    """Where functions of the contact change sign over some spans, looked for all at once."""

    def __init__(
        self,
        engagement: Engagement,
        spans: Sequence[tuple[float, float]],
        functions: Sequence[Signed],
    ) -> None:
        self.engagement, self.functions = engagement, functions
        self.fastest = 0.0  # of the samples, the wheel's greatest speed over the input's

        def sampled(x: Array, _: Whole) -> tuple[Array, Array]:
            at = contact(engagement, x, 1, reactions=False)
            self.fastest = float(np.max(abs(at.velocity.arrays()[0]), initial=self.fastest))
            return columns([of(at) for of in functions], x)

        self.found = found = scanned(sampled, spans, slice(None))
        inner = inside(found)
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
        middle = contact(self.engagement, 0.5 * (a + b), reactions=False)
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
    return min(max(a, 0.0), b) if a * b <= 0.0 else at_break(a, engagement)


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


def at_break(x: float, engagement: Engagement) -> float:
    """The place, or the break from which only rounding parts it."""
    near = min(engagement.motion.breaks_deg, key=lambda place: abs(place - x))
    return near if abs(near - x) <= ZERO * engagement.motion_deg else x
