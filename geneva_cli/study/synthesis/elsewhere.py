"""Machines of a family whose parts can be built, where those of its best machine cannot.

The whole span of a family is sampled. The best place whose machine can be built is chosen. The
range between it and the nearest better place, which cannot be built, is then sampled ever closer.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

from geneva_cli.machine.spec import Spec
from geneva_cli.machine.wheels_for_paths import searches_kept
from geneva_cli.study.synthesis.best import Candidate, Places
from geneva_cli.study.synthesis.families.family import Family
from geneva_cli.study.synthesis.limited import breaks_limit
from geneva_cli.study.synthesis.looks import look_at
from geneva_cli.study.synthesis.parts import nothing_in_the_way
from geneva_cli.study.synthesis.rows import Row, limited, rows
from geneva_cli.study.synthesis.target import Target

EVENLY = 16  # parts of a span, between which it is sampled first
AHEAD = 4  # places of a family, the best first, that are tested as a batch
Seen: TypeAlias = dict[int, list[Candidate]]  # places of families, by their numbers
# A function that turns a machine's parts and returns its row, None if they fail. It uses the sizes
# of another row that passes or, without one, the first sizes that do.
Turn: TypeAlias = Callable[[Row, Row | None], Row | None]


class Nearer(NamedTuple):
    """The number of parts of a range at each closer sampling, and the number of samplings."""

    parts: int
    looks: int


LOOKED = Nearer(parts=4, looks=4)  # a test takes a fraction of a millisecond
TURNED = Nearer(parts=2, looks=3)  # a turn takes some hundred times as long


class Place(NamedTuple):
    """A place of a family whose machine can be built, and its row."""

    candidate: Candidate
    row: Row


def standing_in(target: Target, first: Sequence[Row], found: Sequence[Row]) -> list[Row]:
    """Replacements for the ``first`` rows that cannot be built: the best of their families.

    Rows that break a limit of the frame are left out; another search replaces them.
    """
    able = {row.family for row in found if not row.cannot_be}
    stuck = [row.family for row in first if row.cannot_be and not breaks_limit(row)]
    families = [*dict.fromkeys(family for family in stuck if family and family not in able)]
    known = {row.spec for row in found}
    others = elsewhere(target, families) if families else []
    return [row._replace(stands_in=True) for row in others if row and row.spec not in known]


def elsewhere(
    target: Target, families: Sequence[Family], turn: Turn | None = None
) -> list[Row | None]:
    """For each family the row of its best machine that may be built; None if none was found.

    The place is precise to some thousandths of the span. With ``turn`` the machine passes a full
    turn; only a few are turned.
    """
    search = _Elsewhere(target, families, turn)
    search.first()
    nearer = TURNED if turn else LOOKED
    for _ in range(nearer.looks):
        search.nearer(nearer.parts)
    return [search.good[i].row if i in search.good else None for i in range(len(families))]


class _Elsewhere:
    """For each family, by its number, the best buildable place and the nearest better place."""

    def __init__(self, target: Target, families: Sequence[Family], turn: Turn | None) -> None:
        self.target, self.families, self.turn = target, families, turn
        self.places = Places(families, target)
        self.good: dict[int, Place] = {}
        self.bad: dict[int, Candidate] = {}
        # for each family with straight slots, the rows of its places
        self.straight: dict[int, dict[Candidate, Row | None]] = {}

    def first(self) -> None:
        """Sample the whole spans."""
        seen = self._looked([(i, x) for i, f in enumerate(self.families) for x in f.places(EVENLY)])
        ranked = {i: sorted(places) for i, places in seen.items()}
        self.good = self._first_turned(ranked) if self.turn else self._first_built(ranked)
        for i, good in sorted(self.good.items()):
            better = [one for one in seen[i] if one < good.candidate]
            if better and not self.families[i].several:
                x = good.candidate.x
                self.bad[i] = min(better, key=lambda one: abs(one.x - x))

    def nearer(self, parts: int) -> None:
        """Sample between the buildable place and the better one."""
        ends = {i: (self.good[i].candidate.x, bad.x) for i, bad in self.bad.items()}
        asked = [
            (i, a + (b - a) * k / parts) for i, (a, b) in ends.items() for k in range(1, parts)
        ]
        seen = self._looked(asked)
        found = self._next_turned(seen) if self.turn else self._better_built(seen)
        self.good |= found
        for i, places in seen.items():
            passed = places.index(found[i].candidate) + 1 if i in found else 0
            left = [one for one in places[passed:] if one < self.good[i].candidate]
            self.bad[i] = [*left, self.bad[i]][0]

    def _looked(self, asked: Sequence[tuple[int, float]]) -> Seen:
        """The places of each family, in order, that keep the bounds."""
        out: Seen = {}
        for (i, _), candidate in zip(asked, self.places.look(asked), strict=True):
            if candidate.keeps:
                out.setdefault(i, []).append(candidate)
        self._look_at_straight(out)
        return out

    def _look_at_straight(self, seen: Seen) -> None:
        """Make the rows of places with straight slots, whose peaks are searched.

        A batch takes about the time of one.
        """
        of = [
            (i, one, spec)
            for i, own in seen.items()
            if i in self.straight or not ((first := self._spec(i, own[0])) and first.motion)
            for one in own
            if (spec := self._spec(i, one))
        ]
        made = rows(self.target, [spec for _, _, spec in of], [])
        for (i, one, _), row in zip(of, made, strict=True):
            self.straight.setdefault(i, {})[one] = row

    def _better_built(self, seen: Seen) -> dict[int, Place]:
        """For each family the best of some places, if it is better than the present one."""
        best = {i: self.good[i].candidate for i in seen}
        return self._first_built(
            {i: sorted(one for one in places if one < best[i]) for i, places in seen.items()}
        )

    def _first_built(self, places: Seen) -> dict[int, Place]:
        """For each family the first of its places that can be built.

        It is removed from the places with all before it. Most places that cannot be built are
        recognised by their parts, in a fraction of the time of a row.
        """
        found: dict[int, Place] = {}
        for i in self.straight.keys() & places.keys():
            while places[i] and i not in found:
                one = places[i].pop(0)
                self._note(found, i, one, self.straight[i].get(one))
        left = [i for i in places if i not in self.straight]
        with searches_kept():  # every machine is tested in a batch first
            while left:
                asked = self._next_with_parts({i: places[i] for i in left})
                made = rows(self.target, [spec for _, spec in asked.values()], [])
                for (i, (candidate, _)), row in zip(asked.items(), made, strict=True):
                    self._note(found, i, candidate, row)
                left = [i for i in left if places[i] and i not in found]
        return found

    def _note(self, found: dict[int, Place], i: int, place: Candidate, row: Row | None) -> None:
        if row and not row.cannot_be:
            found[i] = Place(place, row._replace(family=self.families[i]))

    def _next_with_parts(self, places: Seen) -> dict[int, tuple[Candidate, Spec]]:
        """For each family the first of its next places without an obstacle to its parts."""
        ahead = {i: [(one, self._spec(i, one)) for one in own[:AHEAD]] for i, own in places.items()}
        look_at(spec for own in ahead.values() for _, spec in own if spec)
        found = {}
        for i, own in ahead.items():
            for candidate, spec in own:
                del places[i][0]
                if spec and nothing_in_the_way(spec):
                    found[i] = candidate, spec
                    break
        return found

    def _spec(self, i: int, place: Candidate) -> Spec | None:
        spec = self.families[i].at(place.x)
        return limited(self.target, spec) if spec else None

    def _first_turned(self, places: Seen) -> dict[int, Place]:
        """For each family the first place that passes; every second one is turned first."""
        found = {}
        for i, own in places.items():
            before = None
            while place := self._next(i, own):
                if done := self._turned(place):
                    found[i] = (self._turned(before) if before else None) or done
                    break
                before = self._next(i, own)
        return found

    def _next_turned(self, places: Seen) -> dict[int, Place]:
        """For each family the last of its places that is better than those before it and passes."""
        found: dict[int, Place] = {}
        for i, own in places.items():
            for candidate in own:
                good = found.get(i, self.good[i])
                if not candidate < good.candidate:
                    continue
                place = self._next(i, [candidate])
                if place and (done := self._turned(place, good)):
                    found[i] = done
        return found

    def _next(self, i: int, places: list[Candidate]) -> Place | None:
        return self._first_built({i: places}).get(i)

    def _turned(self, place: Place, passing: Place | None = None) -> Place | None:
        """The place with its turned row if its parts pass, with sizes of ``passing`` if given."""
        assert self.turn
        row = self.turn(place.row, passing.row if passing else None)
        return Place(place.candidate, row) if row else None
