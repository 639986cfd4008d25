"""Machines of a family whose parts can be built, where those of its best machine cannot.

The whole span of a family is sampled. The best place whose machine can be built is chosen. The
range between it and the nearest better place, which cannot be built, is then sampled ever closer.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.study.synth.families.family import Family
from geneva_cli.study.synth.family_search import FamilySearch, Trial
from geneva_cli.study.synth.fast_parts import has_no_obstacle
from geneva_cli.study.synth.machine_rows import MachineRow, rows, with_peak_limit
from geneva_cli.study.synth.parts_data import compute_parts_data
from geneva_cli.study.target import Target

TrialsByFamily: TypeAlias = dict[int, list[Trial]]  # places of families, by their numbers
# A function that turns a machine's parts and returns its row, None if they fail. It uses the sizes
# of another row that passes or, without one, the first sizes that do.
Turn: TypeAlias = Callable[[MachineRow, MachineRow | None], MachineRow | None]


class BuildablePlace(NamedTuple):
    """A place of a family whose machine can be built, and its row."""

    trial: Trial
    row: MachineRow


def replacement_rows(
    target: Target, first: Sequence[MachineRow], ranked: Sequence[MachineRow]
) -> list[MachineRow]:
    """Replacements for the ``first`` rows that cannot be built: the best of their families.

    Rows that break a limit of the frame are left out; another search replaces them.
    """
    able = {row.family for row in ranked if not row.is_impossible}
    stuck = [row.family for row in first if row.is_impossible and not row.breaks_limit]
    families = [*dict.fromkeys(family for family in stuck if family and family not in able)]
    known = {row.spec for row in ranked}
    others = buildable_rows(target, families) if families else []
    return [row._replace(is_replacement=True) for row in others if row and row.spec not in known]


def buildable_rows(
    target: Target, families: Sequence[Family], turn: Turn | None = None
) -> list[MachineRow | None]:
    """For each family the row of its best machine that may be built; None for a family without.

    The place is precise to some thousandths of the span. With ``turn`` the machine passes a full
    turn; only a few are turned.
    """
    search = _BuildableSearch(target, families, turn)
    search.first()
    # parts of the range at each closer sampling: a turn takes a hundred times as long as a test
    parts, samplings = (2, 3) if turn else (4, 4)
    for _ in range(samplings):
        search.refine(parts)
    return [search.good[i].row if i in search.good else None for i in range(len(families))]


class _BuildableSearch:
    """For each family, by its number, the best buildable place and the nearest better place."""

    def __init__(self, target: Target, families: Sequence[Family], turn: Turn | None) -> None:
        self.target, self.families, self.turn = target, families, turn
        self.search = FamilySearch(families, target)
        self.good: dict[int, BuildablePlace] = {}
        self.bad: dict[int, Trial] = {}
        # for each family with straight slots, the rows of its places
        self.straight: dict[int, dict[Trial, MachineRow | None]] = {}

    def first(self) -> None:
        """Sample the whole spans."""
        samples = self._sampled([(i, x) for i, f in enumerate(self.families) for x in f.places(16)])
        ranked = {i: sorted(places) for i, places in samples.items()}
        self.good = self._first_turned(ranked) if self.turn else self._first_built(ranked)
        for i, good in sorted(self.good.items()):
            better = [one for one in samples[i] if one < good.trial]
            if better and not self.families[i].several:
                x = good.trial.x
                self.bad[i] = min(better, key=lambda one: abs(one.x - x))

    def refine(self, parts: int) -> None:
        """Sample between the buildable place and the better one."""
        ends = {i: (self.good[i].trial.x, bad.x) for i, bad in self.bad.items()}
        between = [
            (i, a + (b - a) * k / parts) for i, (a, b) in ends.items() for k in range(1, parts)
        ]
        samples = self._sampled(between)
        better = self._next_turned(samples) if self.turn else self._better_built(samples)
        self.good |= better
        for i, places in samples.items():
            passed = places.index(better[i].trial) + 1 if i in better else 0
            left = [one for one in places[passed:] if one < self.good[i].trial]
            self.bad[i] = [*left, self.bad[i]][0]

    def _sampled(self, places: Sequence[tuple[int, float]]) -> TrialsByFamily:
        """The places of each family, in order, that keep the bounds."""
        out: TrialsByFamily = {}
        for (i, _), trial in zip(places, self.search.sample(places), strict=True):
            if trial.keeps:
                out.setdefault(i, []).append(trial)
        self._add_straight_rows(out)
        return out

    def _add_straight_rows(self, samples: TrialsByFamily) -> None:
        """Make the rows of places with straight slots, whose peaks are searched.

        A batch takes about the time of one.
        """
        of = [
            (i, one, spec)
            for i, own in samples.items()
            if i in self.straight or not ((first := self._spec(i, own[0])) and first.motion)
            for one in own
            if (spec := self._spec(i, one))
        ]
        new_rows = rows(self.target, [spec for _, _, spec in of], [])
        for (i, one, _), row in zip(of, new_rows, strict=True):
            self.straight.setdefault(i, {})[one] = row

    def _better_built(self, samples: TrialsByFamily) -> dict[int, BuildablePlace]:
        """For each family the best of some places, if it is better than the present one."""
        best = {i: self.good[i].trial for i in samples}
        return self._first_built(
            {i: sorted(one for one in places if one < best[i]) for i, places in samples.items()}
        )

    def _first_built(self, places: TrialsByFamily) -> dict[int, BuildablePlace]:
        """For each family the first of its places that can be built.

        It is removed from the places with all before it. Most places that cannot be built are
        recognised by their parts, in a fraction of the time of a row.
        """
        built: dict[int, BuildablePlace] = {}
        for i in self.straight.keys() & places.keys():
            while places[i] and i not in built:
                one = places[i].pop(0)
                self._add(built, i, one, self.straight[i].get(one))
        left = [i for i in places if i not in self.straight]
        while left:
            candidates = self._next_drawable({i: places[i] for i in left})
            new_rows = rows(self.target, [spec for _, spec in candidates.values()], [])
            for (i, (trial, _)), row in zip(candidates.items(), new_rows, strict=True):
                self._add(built, i, trial, row)
            left = [i for i in left if places[i] and i not in built]
        return built

    def _add(
        self, built: dict[int, BuildablePlace], i: int, place: Trial, row: MachineRow | None
    ) -> None:
        if row and not row.is_impossible:
            built[i] = BuildablePlace(place, row._replace(family=self.families[i]))

    def _next_drawable(self, places: TrialsByFamily) -> dict[int, tuple[Trial, Spec]]:
        """For each family the first of its next places without an obstacle to its parts."""
        # the best four places of each family are tested as a batch
        ahead = {i: [(one, self._spec(i, one)) for one in own[:4]] for i, own in places.items()}
        compute_parts_data(spec for own in ahead.values() for _, spec in own if spec)
        drawable = {}
        for i, own in ahead.items():
            for trial, spec in own:
                del places[i][0]
                if spec and has_no_obstacle(spec):
                    drawable[i] = trial, spec
                    break
        return drawable

    def _spec(self, i: int, place: Trial) -> Spec | None:
        spec = self.families[i].at(place.x)
        return with_peak_limit(self.target, spec) if spec else None

    def _first_turned(self, places: TrialsByFamily) -> dict[int, BuildablePlace]:
        """For each family the first place that passes; every second one is turned first."""
        passing = {}
        for i, own in places.items():
            before = None
            while place := self._next(i, own):
                if done := self._turned(place):
                    passing[i] = (self._turned(before) if before else None) or done
                    break
                before = self._next(i, own)
        return passing

    def _next_turned(self, places: TrialsByFamily) -> dict[int, BuildablePlace]:
        """For each family the last of its places that is better than those before it and passes."""
        passing: dict[int, BuildablePlace] = {}
        for i, own in places.items():
            for trial in own:
                good = passing.get(i, self.good[i])
                if not trial < good.trial:
                    continue
                place = self._next(i, [trial])
                if place and (done := self._turned(place, good)):
                    passing[i] = done
        return passing

    def _next(self, i: int, places: list[Trial]) -> BuildablePlace | None:
        return self._first_built({i: places}).get(i)

    def _turned(
        self, place: BuildablePlace, passing: BuildablePlace | None = None
    ) -> BuildablePlace | None:
        """The place with its turned row if its parts pass; ``passing`` lends its sizes."""
        assert self.turn
        row = self.turn(place.row, passing.row if passing else None)
        return BuildablePlace(place.trial, row) if row else None
