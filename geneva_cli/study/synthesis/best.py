"""The best machine of each family that keeps the bounds, or the one nearest to them.

The best has the least peak acceleration (in rad/s² if times are required), or the least of the
goal's quantity. If any motion is allowed, it is the nearest to the plain crank. All families are
sampled as batches: first evenly between their ends, then ever closer to the places of each that are
better than their neighbours, or to the place where a bound is just kept.
"""

from __future__ import annotations

import math
from bisect import bisect_left, insort
from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.machine.spec import Spec
from geneva_cli.study.goals import Objective
from geneva_cli.study.quantities import in_batch
from geneva_cli.study.synthesis.bounds import known_bounds, of_motion
from geneva_cli.study.synthesis.families.family import Family
from geneva_cli.study.synthesis.target import Target
from geneva_cli.study.synthesis.together import numbers

PLACES = 24  # intervals of a family's span that are sampled first
LOOKS, CLOSER = 8, 3  # number of closer samplings, and their ratio of widths: a minimum is flat
TRACKS = 3  # of a family: places better than their neighbours that are sampled more closely
# ratio of the violation at a place to its decrease nearby: above this, no bound can be kept nearby
HOPELESS = 2.0
TINY = 1e-300  # violation of a bound that is broken by rounding only
FORGIVEN = 1e-200  # sum of such violations, at most
SAME = 1e-4  # fraction of a span, within which the best is another family's machine
CLOSE = 1e-12  # fraction of a span, between a place that keeps the bounds and one that does not
ABOUT = 0.05  # fraction of the interval between such places, on either side of the secant's root


class Chosen(NamedTuple):
    """A machine and its family."""

    spec: Spec
    family: Family


def best(
    families: Sequence[Family], target: Target, how_near: bool = False
) -> tuple[list[Chosen], list[Chosen]]:
    """The best machine of each family, divided into those that keep the bounds and the others.

    The others break the bounds least, with ``how_near`` to the last digit.
    """
    free = [f for f in families if f.is_free and math.isnan(f.best)]
    chosen = {id(f): NONE for f in free}
    first = of_motion(target) if not how_near else None
    if first:
        free = [f for f, at in zip(free, _places(free, first, how_near), strict=True) if at.keeps]
    chosen |= {id(f): at for f, at in zip(free, _places(free, target, how_near), strict=True)}
    kept: list[Chosen] = []
    broken: list[Chosen] = []
    for f in families:
        sure = f.low if math.isnan(f.best) else f.best
        place = chosen.get(id(f), Candidate(0.0, 0.0, sure))
        known = abs(place.x - f.known) <= SAME * (f.high - f.low)
        if not known and (spec := f.at(place.x)):
            (kept if place.keeps else broken).append(Chosen(spec, f))
    return kept, broken


def _places(free: Sequence[Family], target: Target, how_near: bool) -> list[Candidate]:
    """The best place of each family; ``NONE`` where there is no machine."""
    search = Places(free, target, how_near)
    if search.nearest:
        search.look([(i, f.plain) for i, f in enumerate(free) if f.low <= f.plain <= f.high])
    search.look([(i, x) for i, f in enumerate(free) if not search.done(i) for x in _first(f)])
    search.begin()
    for look in range(LOOKS):
        search.nearer(look)
    return [search.found.get(i, NONE) for i in range(len(free))]


def _first(f: Family) -> list[float]:
    """The places of a family that are sampled first, including the plain crank."""
    plain = [f.plain] if f.low < f.plain < f.high else []
    return [*(f.low + _step(f) * j for j in range(PLACES)), f.high, *plain]


class Candidate(NamedTuple):
    """A machine of a family: its violation of the bounds, its cost, and its place.

    ``far`` is the quantity to minimise, or the distance from the plain crank.
    """

    broken: float
    far: float
    x: float

    @property
    def keeps(self) -> bool:
        """Return True if the machine keeps the bounds apart from rounding."""
        return self.broken < FORGIVEN


NONE = Candidate(math.inf, math.inf, math.nan)


class Tried(NamedTuple):
    """A sampled place of a family, and its margin to the bounds."""

    x: float
    room: float
    candidate: Candidate


class Places:
    """The best place so far of each family, by its number.

    The bounds and the goal are those quantities of the requirement that ``together`` computes.
    """

    def __init__(self, families: Sequence[Family], target: Target, patient: bool = False) -> None:
        self.families, self.bounds = families, known_bounds(target)
        self.patient = patient  # also samples near places where no small step can keep the bounds
        least = target.sort if target.sort and in_batch([target.sort.name]) else None
        self.nearest = target.any_motion and not least
        self.peak = target.peak
        self.sign, self.least = least or Objective(1.0, self.peak)
        self.found: dict[int, Candidate] = {}
        # for each family all sampled places, in order
        self.tried: list[list[Tried]] = [[] for _ in families]
        self.tracks: list[tuple[int, Candidate]] = []

    def done(self, i: int) -> bool:
        """Return True if a family's best place cannot be improved."""
        place = self.found.get(i, NONE)
        return self.nearest and not place.broken and place.far == 0.0

    def begin(self) -> None:
        """Start tracks at the best places of each family that are better than their neighbours."""
        for i, tried in enumerate(self.tried):
            places = [one.candidate for one in tried]
            beside = zip(places, [NONE, *places], [*places[1:], NONE], strict=False)
            tops = [at for at, one, two in beside if at <= min(one, two)]
            self.tracks += [(i, at) for at in sorted(tops)[:TRACKS]]

    def nearer(self, look: int) -> None:
        """Sample near the best place of every track, closer at each call."""
        places = [self._beside(i, at, look) for i, at in self.tracks]
        seen = iter(
            self.look([(i, x) for (i, _), xs in zip(self.tracks, places, strict=True) for x in xs])
        )
        self.tracks = [
            (i, min([at, *(next(seen) for _ in xs)]))
            for (i, at), xs in zip(self.tracks, places, strict=True)
        ]

    def _beside(self, i: int, best: Candidate, look: int) -> list[float]:
        """Places near the best of a track; empty where it cannot improve."""
        f, (broken, _, x) = self.families[i], best
        if self.done(i):
            return []
        if self.nearest and f.plain == f.plain and not broken:
            return self._crossing(i, x)
        end = x in (f.low, f.high)
        if look or not end:
            places = self.tried[i]
            at = bisect_left(places, (x, -math.inf))
            beside = [one.candidate.broken for one in places[max(at - 1, 0) : at + 2]]
            if broken and not self.patient and broken > HOPELESS * (max(beside) - broken):
                return []
            # a place at an end of its span that stays the best in close samples is the best
            if end and not any(beside):
                return []
        step = _step(f) / CLOSER**look
        near = [x + step * j / CLOSER for j in range(1 - CLOSER, CLOSER) if j]
        return [at for at in near if f.low <= at <= f.high]

    def _crossing(self, i: int, x: float) -> list[float]:
        """Places near the one where the bounds are just kept, on the way to the plain crank."""
        f, places = self.families[i], self.tried[i]
        at = bisect_left(places, (x, -math.inf))
        beside = at + (1 if f.plain > x else -1)
        if not 0 <= beside < len(places):
            return []
        (a, kept, _), (b, broken, _) = places[at], places[beside]
        wide = (b - a) / (f.high - f.low)
        if abs(wide) <= CLOSE or not broken < 0.0 <= kept < math.inf:
            return []
        line = a + (b - a) * kept / (kept - broken) if broken > -math.inf else math.nan
        about = (b - a) * min(ABOUT, 2.0 * abs(wide))
        low, high = min(a, b), max(a, b)
        tried = {line - about, line, line + about, 0.5 * (a + b)}
        return [at for at in tried if low < at < high]

    def look(self, places: Sequence[tuple[int, float]]) -> list[Candidate]:
        """Sample these places of the families: their machines, or ``NONE`` where there is none."""
        specs = [self.families[i].at(x) for i, x in places]
        rows = iter(self._numbers([spec for spec in specs if spec]))
        found = []
        for (i, x), spec in zip(places, specs, strict=True):
            row = next(rows) if spec else None
            found.append(self._add(i, x, row) if row and row[0] == row[0] else NONE)
        return found

    def _numbers(self, specs: Sequence[Spec]) -> Sequence[Sequence[float] | None]:
        rows = numbers(specs, [self.least, *(b.name for b in self.bounds)])
        if (
            self.bounds or self.least != self.peak
        ):  # quantities that no batch computes are requested later
            without = iter(
                numbers([s for s, row in zip(specs, rows, strict=True) if not row], [self.peak])
            )
            rows = [row or next(without) for row in rows]
        return rows

    def _add(self, i: int, x: float, row: Sequence[float]) -> Candidate:
        plain = self.families[i].plain
        far = abs(x - plain) if self.nearest and plain == plain else self.sign * row[0]
        broken, room = self._broken(row[1:])
        candidate = Candidate(broken, far, x)
        self.found[i] = min(self.found.get(i, NONE), candidate)
        insort(self.tried[i], Tried(x, room, candidate))
        return candidate

    def _broken(self, values: Sequence[float]) -> tuple[float, float]:
        """The sum of the relative violations of the bounds, and the least margin."""
        total, least = 0.0, math.inf
        for b, value in zip(self.bounds, values, strict=False):
            room = b.room(value)
            least = min(least, room if room == room else -math.inf)
            if not room >= 0.0:
                total += TINY if b.kept(value) else -room
        return total, least


def _step(family: Family) -> float:
    return (family.high - family.low) / PLACES
