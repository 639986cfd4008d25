"""Of each family one machine that keeps the wish's bounds: the best, or the nearest.

The best has the least peak acceleration, or the least of what the wish sorts by; the nearest to
the plain crank is taken where any motion will do. All families are looked at together: at places
evenly between their ends, then nearer and nearer about the best of each, or about the place where
a bound is just kept.
"""

from __future__ import annotations

import math
from bisect import bisect_left, insort
from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.spec import Spec
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synthesis.families.family import Family
from geneva_cli.study.synthesis.together import numbers
from geneva_cli.study.synthesis.wish import PEAK

PLACES = 24  # intervals of a family's span that are looked at first
LOOKS, CLOSER = 8, 3  # times that the look is narrowed, and by how much: a least value is flat
BROKEN = 4  # of these, after which a family that has broken its bounds so far is given up
TINY = 1e-300  # what a bound that is broken by no more than rounding counts
FORGIVEN = 1e-200  # what rounding adds up to at most
SAME = 1e-4  # share of a span, nearer than which the best is another family's machine
CLOSE = 1e-12  # share of a span, between a place that keeps the bounds and one that does not
ABOUT = 0.05  # share of what is between two such, on either side of where a straight line passes


def best(
    families: Sequence[Family],
    bounds: Sequence[Constraint] = (),
    nearest: bool = False,
    least: str = "",
) -> list[Spec]:
    """One spec of each family; none of one that has no machine, or none within the bounds.

    ``bounds``, and what is to be the ``least`` (with a minus sign the greatest), are quantities
    that ``together`` knows. Where no place of a family keeps them, the look goes on about the one
    that breaks them least.
    """
    free = [f for f in families if f.low < f.high]
    search = _Search(free, bounds, nearest and not least, least)
    if search.nearest:
        search.look([(i, f.plain) for i, f in enumerate(free) if f.low <= f.plain <= f.high])
    search.look([(i, x) for i, f in enumerate(free) if not search.done(i) for x in _first(f)])
    for look in range(LOOKS):
        search.look([at for i in search.found for at in search.beside(i, look)])
    chosen = {id(f): search.found.get(i, NONE) for i, f in enumerate(free)}
    out = []
    for f in families:
        place = chosen.get(id(f), Candidate(0.0, 0.0, f.low))
        known = abs(place.x - f.known) <= SAME * (f.high - f.low)
        spec = None if known or place.broken >= FORGIVEN else _made(f, place.x)
        if spec is not None:
            out.append(spec)
    return out


def _first(f: Family) -> list[float]:
    """The places of a family that are looked at first; the plain crank is among them."""
    plain = [f.plain] if f.low < f.plain < f.high else []
    return [*(f.low + _step(f) * j for j in range(PLACES)), f.high, *plain]


class Candidate(NamedTuple):
    """A machine of a family: by how much it breaks the bounds, how far it is from the best that
    could be (what is to be the least, or its distance from the plain crank), and where it is.
    """

    broken: float
    far: float
    x: float


NONE = Candidate(math.inf, math.inf, math.nan)


class _Search:
    """The best place so far of each family, by its number."""

    def __init__(
        self,
        families: Sequence[Family],
        bounds: Sequence[Constraint],
        nearest: bool,
        least: str = "",
    ) -> None:
        self.families, self.bounds, self.nearest = families, bounds, nearest
        self.least, self.sign = least.lstrip("-") or PEAK, -1.0 if least[:1] == "-" else 1.0
        self.found: dict[int, Candidate] = {}
        # of each family all places looked at, in order, with the room that the bounds leave there
        self.rooms: list[list[tuple[float, float]]] = [[] for _ in families]

    def done(self, i: int) -> bool:
        """Whether a family's best place cannot be bettered."""
        place = self.found.get(i, NONE)
        return self.nearest and not place.broken and place.far == 0.0

    def beside(self, i: int, look: int) -> list[tuple[int, float]]:
        """Places beside a family's best, nearer at each look; none where it can get no better."""
        f, (broken, _, x) = self.families[i], self.found[i]
        if self.done(i):
            return []
        if self.nearest and f.plain == f.plain:
            if not broken:
                return [(i, at) for at in self._crossing(i)]
            if look >= BROKEN:
                return []
        # one that is still best at an end of its span, looked at nearer there, is best there
        if look and x in (f.low, f.high):
            return []
        step = _step(f) / CLOSER**look
        near = [x + step * j / CLOSER for j in range(1 - CLOSER, CLOSER) if j]
        return [(i, at) for at in near if f.low <= at <= f.high]

    def _crossing(self, i: int) -> list[float]:
        """Places about the one where the bounds are just kept, on the way to the plain crank."""
        f, places, x = self.families[i], self.rooms[i], self.found[i].x
        at = bisect_left(places, (x, -math.inf))
        beside = at + (1 if f.plain > x else -1)
        if not 0 <= beside < len(places):
            return []
        (a, kept), (b, broken) = places[at], places[beside]
        wide = (b - a) / (f.high - f.low)
        if abs(wide) <= CLOSE or not broken < 0.0 <= kept < math.inf:
            return []
        line = a + (b - a) * kept / (kept - broken) if broken > -math.inf else math.nan
        about = (b - a) * min(ABOUT, 2.0 * abs(wide))
        low, high = min(a, b), max(a, b)
        tried = {line - about, line, line + about, 0.5 * (a + b)}
        return [at for at in tried if low < at < high]

    def look(self, places: Sequence[tuple[int, float]]) -> None:
        """Look at these places of the families too."""
        tried = [(i, x, spec) for i, x in places if (spec := _made(self.families[i], x))]
        specs = [spec for _, _, spec in tried]
        rows = numbers(specs, [self.least, *(b.name for b in self.bounds)])
        if self.bounds or self.least != PEAK:  # what no array of machines has, is asked for later
            without = iter(
                numbers([s for s, row in zip(specs, rows, strict=True) if not row], [PEAK])
            )
            rows = [row or next(without) for row in rows]
        for (i, x, _), row in zip(tried, rows, strict=True):
            if row is None or row[0] != row[0]:
                continue
            plain = self.families[i].plain
            far = abs(x - plain) if self.nearest and plain == plain else self.sign * row[0]
            broken, room = self._broken(row[1:])
            self.found[i] = min(self.found.get(i, NONE), Candidate(broken, far, x))
            insort(self.rooms[i], (x, room))

    def _broken(self, values: Sequence[float]) -> tuple[float, float]:
        """By how much the bounds are broken together, over their sizes; the least room."""
        total, least = 0.0, math.inf
        for b, value in zip(self.bounds, values, strict=False):
            room = b.room(value)
            least = min(least, room if room == room else -math.inf)
            if not room >= 0.0:
                total += TINY if b.kept(value) else -room
        return total, least


def _step(family: Family) -> float:
    return (family.high - family.low) / PLACES


def _made(family: Family, x: float) -> Spec | None:
    try:
        return family.make(x)
    except GenevaError:
        return None
