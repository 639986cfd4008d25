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

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.study.batches import numbers
from geneva_cli.study.sweep.constraints import Objective
from geneva_cli.study.synth.families.family import Family
from geneva_cli.study.target import Target

INTERVALS = 24  # intervals of a family's span that are sampled first


class FamilyMachine(NamedTuple):
    """A machine and its family."""

    spec: Spec
    family: Family


def best(
    families: Sequence[Family], target: Target, how_near: bool = False
) -> tuple[list[FamilyMachine], list[FamilyMachine]]:
    """The best machine of each family, divided into those that keep the bounds and the others.

    The others break the bounds least, with ``how_near`` to the last digit.
    """
    free = [f for f in families if f.is_free and math.isnan(f.best)]
    chosen = {id(f): at for f, at in zip(free, _places(free, target, how_near), strict=True)}
    kept: list[FamilyMachine] = []
    broken: list[FamilyMachine] = []
    for f in families:
        sure = f.low if math.isnan(f.best) else f.best
        place = chosen.get(id(f), Trial(0.0, 0.0, sure))
        is_known = abs(place.x - f.known) <= 1e-4 * (f.high - f.low)  # by another family
        if not is_known and (spec := f.at(place.x)):
            (kept if place.keeps else broken).append(FamilyMachine(spec, f))
    return kept, broken


def _places(free: Sequence[Family], target: Target, how_near: bool) -> list[Trial]:
    """The best place of each family; ``NONE`` where there is no machine."""
    search = FamilySearch(free, target, how_near)
    if search.nearest:
        search.sample([(i, f.plain) for i, f in enumerate(free) if f.low <= f.plain <= f.high])
    search.sample([(i, x) for i, f in enumerate(free) if not search.done(i) for x in _first(f)])
    search.start_tracks()
    for number in range(8):  # enough for a minimum, which is flat
        search.refine(number)
    return [search.best_trials.get(i, NONE) for i in range(len(free))]


def _first(f: Family) -> list[float]:
    """The places of a family that are sampled first, including the plain crank."""
    plain = [f.plain] if f.low < f.plain < f.high else []
    return [*(f.low + _step(f) * j for j in range(INTERVALS)), f.high, *plain]


class Trial(NamedTuple):
    """A machine of a family: its violation of the bounds, its cost, and its place.

    ``cost`` is the quantity to minimise, or the distance from the plain crank.
    """

    violation: float
    cost: float
    x: float

    @property
    def keeps(self) -> bool:
        """Return True if the machine keeps the bounds apart from rounding."""
        return self.violation < 1e-200  # each violation by rounding adds 1e-300


NONE = Trial(math.inf, math.inf, math.nan)


class Sample(NamedTuple):
    """A sampled place of a family, and its margin to the bounds."""

    x: float
    margin: float
    trial: Trial


class FamilySearch:
    """The best place so far of each family, by its number.

    The bounds and the goal are those quantities of the requirement that a batch can compute.
    """

    def __init__(self, families: Sequence[Family], target: Target, patient: bool = False) -> None:
        self.families, self.bounds = families, target.known_bounds
        self.patient = patient  # also samples near places where no small step can keep the bounds
        sort = target.known_sort
        self.nearest = target.any_motion and not sort
        self.peak = target.peak
        self.sign, self.least = sort or Objective(1.0, self.peak)
        self.best_trials: dict[int, Trial] = {}
        # of each family, in order of their places
        self.samples: list[list[Sample]] = [[] for _ in families]
        self.tracks: list[tuple[int, Trial]] = []

    def done(self, i: int) -> bool:
        """Return True if a family's best place cannot be improved."""
        place = self.best_trials.get(i, NONE)
        return self.nearest and not place.violation and place.cost == 0.0

    def start_tracks(self) -> None:
        """Start tracks at the three best places of each family that beat their neighbours."""
        for i, samples in enumerate(self.samples):
            trials = [one.trial for one in samples]
            neighbours = zip(trials, [NONE, *trials], [*trials[1:], NONE], strict=False)
            tops = [at for at, one, two in neighbours if at <= min(one, two)]
            self.tracks += [(i, at) for at in sorted(tops)[:3]]

    def refine(self, number: int) -> None:
        """Sample near the best place of every track, closer for a greater ``number``."""
        places = [self._nearby(i, at, number) for i, at in self.tracks]
        trials = iter(
            self.sample(
                [(i, x) for (i, _), xs in zip(self.tracks, places, strict=True) for x in xs]
            )
        )
        self.tracks = [
            (i, min([at, *(next(trials) for _ in xs)]))
            for (i, at), xs in zip(self.tracks, places, strict=True)
        ]

    def _nearby(self, i: int, best: Trial, number: int) -> list[float]:
        """Places near the best of a track; empty where it cannot improve."""
        f, (violation, _, x) = self.families[i], best
        if self.done(i):
            return []
        if self.nearest and f.plain == f.plain and not violation:
            return self._crossing(i, x)
        end = x in (f.low, f.high)
        if number or not end:
            places = self.samples[i]
            at = bisect_left(places, (x, -math.inf))
            violations = [one.trial.violation for one in places[max(at - 1, 0) : at + 2]]
            # no bound can be kept nearby if its violation is twice the decrease between neighbours
            is_hopeless = violation > 2.0 * (max(violations) - violation)
            if violation and not self.patient and is_hopeless:
                return []
            # a place at an end of its span that stays the best in close samples is the best
            if end and not any(violations):
                return []
        step = _step(f) / 3**number
        near = [x + step * j / 3 for j in (-2, -1, 1, 2)]
        return [at for at in near if f.low <= at <= f.high]

    def _crossing(self, i: int, x: float) -> list[float]:
        """Places near the one where the bounds are just kept, on the way to the plain crank."""
        f, places = self.families[i], self.samples[i]
        at = bisect_left(places, (x, -math.inf))
        neighbour = at + (1 if f.plain > x else -1)
        if not 0 <= neighbour < len(places):
            return []
        (a, kept, _), (b, broken, _) = places[at], places[neighbour]
        wide = (b - a) / (f.high - f.low)
        if abs(wide) <= 1e-12 or not broken < 0.0 <= kept < math.inf:
            return []
        secant = a + (b - a) * kept / (kept - broken) if broken > -math.inf else math.nan
        about = (b - a) * min(0.05, 2.0 * abs(wide))  # on either side of the secant's root
        low, high = min(a, b), max(a, b)
        nearby = {secant - about, secant, secant + about, 0.5 * (a + b)}
        return [at for at in nearby if low < at < high]

    def sample(self, places: Sequence[tuple[int, float]]) -> list[Trial]:
        """Sample these places of the families: their machines, or ``NONE`` where there is none."""
        specs = [self.families[i].at(x) for i, x in places]
        rows = iter(self._numbers([spec for spec in specs if spec]))
        trials = []
        for (i, x), spec in zip(places, specs, strict=True):
            row = next(rows) if spec else None
            trials.append(self._add(i, x, row) if row and row[0] == row[0] else NONE)
        return trials

    def _numbers(self, specs: Sequence[Spec]) -> Sequence[Sequence[float] | None]:
        rows = numbers(specs, [self.least, *(b.name for b in self.bounds)])
        if self.bounds or self.least != self.peak:
            # other machines get their peak: what no batch computes is computed later
            others = [spec for spec, row in zip(specs, rows, strict=True) if not row]
            peaks = iter(numbers(others, [self.peak]))
            rows = [row or next(peaks) for row in rows]
        return rows

    def _add(self, i: int, x: float, row: Sequence[float]) -> Trial:
        plain = self.families[i].plain
        cost = abs(x - plain) if self.nearest and plain == plain else self.sign * row[0]
        violation, margin = self._violation(row[1:])
        trial = Trial(violation, cost, x)
        self.best_trials[i] = min(self.best_trials.get(i, NONE), trial)
        insort(self.samples[i], Sample(x, margin, trial))
        return trial

    def _violation(self, values: Sequence[float]) -> tuple[float, float]:
        """The sum of the relative violations of the bounds, and the least margin."""
        total, least = 0.0, math.inf
        for b, value in zip(self.bounds, values, strict=False):
            margin = b.margin(value)
            least = min(least, margin if margin == margin else -math.inf)
            if not margin >= 0.0:
                is_rounding = b.kept(value)
                total += 1e-300 if is_rounding else -margin
        return total, least


def _step(family: Family) -> float:
    return (family.high - family.low) / INTERVALS
