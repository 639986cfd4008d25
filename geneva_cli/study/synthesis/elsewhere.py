"""Machines of a family whose parts can be built, where those of its best cannot.

A family is looked at all over its span. The best place whose machine can be built is taken; between
it and the nearest better one, which cannot, it is looked at nearer and nearer.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

from geneva_cli.study.synthesis.best import FORGIVEN, Candidate, Places
from geneva_cli.study.synthesis.families.family import Family
from geneva_cli.study.synthesis.limited import breaks_limit
from geneva_cli.study.synthesis.rows import Row, rows
from geneva_cli.study.synthesis.wish import Wish

EVENLY = 16  # parts of a span, between which it is looked at first
# The row of a machine whose parts were turned, None where they fail: with the sizes of another one
# that passes, or where there is none yet with the first that do.
Turn: TypeAlias = Callable[[Row, Row | None], Row | None]


class Nearer(NamedTuple):
    """Into how many parts what is left is cut at each nearer look, and how many looks there are."""

    parts: int
    looks: int


LOOKED = Nearer(parts=4, looks=4)  # a look takes a fraction of a millisecond
TURNED = Nearer(parts=2, looks=3)  # a turn some hundred times as long


class Place(NamedTuple):
    """A place of a family, and its machine's row, None where it cannot be built."""

    candidate: Candidate
    row: Row | None

    def __lt__(self, other: Place) -> bool:  # type: ignore[override]
        return self.candidate < other.candidate


def with_others(wish: Wish, found: Sequence[Row]) -> list[Row]:
    """The rows, and of each family none of whose rows can be built the best machine that may be;
    where they break a limit of the frame, there is another search for such.
    """
    able = {row.family for row in found if not row.cannot_be or breaks_limit(row)}
    stuck = [*dict.fromkeys(row.family for row in found if row.family and row.family not in able)]
    known = {row.spec for row in found}
    others = elsewhere(wish, stuck) if stuck else []
    standing = [row for row in others if row and row.spec not in known]
    return [*found, *(row._replace(stands_in=True) for row in standing)]


def elsewhere(wish: Wish, families: Sequence[Family], turn: Turn | None = None) -> list[Row | None]:
    """Of each family the row of its best machine that may be built, to some thousandths of its
    span; None where none was found.

    With ``turn`` of the best that is found to pass a whole turn, of a few that are turned.
    """
    search = _Elsewhere(wish, families, turn)
    search.first()
    nearer = TURNED if turn else LOOKED
    for _ in range(nearer.looks):
        search.nearer(nearer.parts)
    return [search.good[i].row if i in search.good else None for i in range(len(families))]


class _Elsewhere:
    """Of each family, by its number, the best place so far that can be built, and the nearest
    better one that cannot.
    """

    def __init__(self, wish: Wish, families: Sequence[Family], turn: Turn | None) -> None:
        self.wish, self.families, self.turn = wish, families, turn
        self.places = Places(families, wish)
        self.good: dict[int, Place] = {}
        self.bad: dict[int, Candidate] = {}

    def first(self) -> None:
        """Look all over the spans."""
        seen = self._looked([(i, x) for i, f in enumerate(self.families) for x in f.places(EVENLY)])
        for i, places in seen.items():
            may_be = sorted(place for place in places if place.row)
            good = self._first_of(may_be)
            if not good:
                continue
            self.good[i], x = good, good.candidate.x
            better = [place.candidate for place in places if place < good]
            if better and not self.families[i].several:
                self.bad[i] = min(better, key=lambda one: abs(one.x - x))

    def _first_of(self, may_be: Sequence[Place]) -> Place | None:
        """The first of some places that can be built: of every second, or the one before."""
        for k in range(0, len(may_be), 2):
            if found := self._turned(may_be[k]):
                return (self._turned(may_be[k - 1]) if k else None) or found
        return None

    def nearer(self, parts: int) -> None:
        """Look between what can be built and what is better."""
        ends = {i: (self.good[i].candidate.x, bad.x) for i, bad in self.bad.items()}
        asked = [
            (i, a + (b - a) * k / parts) for i, (a, b) in ends.items() for k in range(1, parts)
        ]
        for i, places in self._looked(asked).items():
            passed = 0
            for k, place in enumerate(places, 1):
                good = self.good[i]
                if place.candidate < good.candidate and (done := self._turned(place, good)):
                    self.good[i], passed = done, k
            left = [p.candidate for p in places[passed:] if p.candidate < self.good[i].candidate]
            self.bad[i] = [*left, self.bad[i]][0]

    def _looked(self, asked: Sequence[tuple[int, float]]) -> dict[int, list[Place]]:
        """The places of each family, in their order, that keep the bounds."""
        seen = self.places.look(asked)
        kept = [(i, c) for (i, _), c in zip(asked, seen, strict=True) if c.broken < FORGIVEN]
        specs = [self.families[i].at(c.x) for i, c in kept]
        found = iter(rows(self.wish, [spec for spec in specs if spec], []))
        out: dict[int, list[Place]] = {}
        for (i, candidate), spec in zip(kept, specs, strict=True):
            row = next(found) if spec else None
            can_be = row and not row.cannot_be
            own = row._replace(family=self.families[i]) if row and can_be else None
            out.setdefault(i, []).append(Place(candidate, own))
        return out

    def _turned(self, place: Place, passing: Place | None = None) -> Place | None:
        """The place, where its machine can be built: one that is nearer than the best so far."""
        row = place.row
        if row and self.turn:
            row = self.turn(row, passing.row if passing else None)
        return Place(place.candidate, row) if row else None
