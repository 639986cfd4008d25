"""Of each family the machine with the least peak acceleration that keeps the wish's bounds.

All families are looked at together: at places evenly between their ends, then nearer and nearer
about the best of each.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.spec import Spec
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synthesis.families.family import Family
from geneva_cli.study.synthesis.together import numbers

PLACES = 24  # intervals of a family's span that are looked at first
NEARER = 8  # times that the look is narrowed
CLOSER = 3  # times nearer together that the places of each narrower look are
TINY = 5e-324  # what a bound that is broken by no more than rounding counts
SAME = 1e-4  # share of a span, nearer than which the best is another family's machine
PEAK = "acceleration.max"


def best(families: Sequence[Family], bounds: Sequence[Constraint] = ()) -> list[Spec]:
    """One spec of each family; none of one that has no machine, or none within the bounds.

    ``bounds`` are on quantities that ``together`` knows. Where no place of a family keeps them, the
    look goes on about the one that breaks them least.
    """
    free = [f for f in families if f.low < f.high]
    search = _Search(free, bounds)
    search.look([(i, f.low + _step(f) * j) for i, f in enumerate(free) for j in range(PLACES)])
    search.look([(i, f.high) for i, f in enumerate(free)])
    width, open_ = 1.0, set(search.found)
    for look in range(NEARER):
        # one that is still best at an end of its span, looked at nearer there, is best there
        open_ -= {i for i in open_ if look and search.found[i].x in free[i][1:3]}
        search.look([at for i in sorted(open_) for at in search.beside(i, width)])
        width /= CLOSER
    chosen = {id(f): search.found.get(i, NONE) for i, f in enumerate(free)}
    out = []
    for f in families:
        place = chosen.get(id(f), Place(0.0, 0.0, f.low))
        known = abs(place.x - f.known) <= SAME * (f.high - f.low)
        spec = None if known or place.broken else _made(f, place.x)
        if spec is not None:
            out.append(spec)
    return out


class Place(NamedTuple):
    """A machine of a family: by how much it breaks the bounds, its peak, and where it is."""

    broken: float
    peak: float
    x: float


NONE = Place(math.inf, math.inf, math.nan)


class _Search:
    """The best place so far of each family, by its number."""

    def __init__(self, families: Sequence[Family], bounds: Sequence[Constraint]) -> None:
        self.families, self.bounds = families, bounds
        self.found: dict[int, Place] = {}

    def beside(self, i: int, width: float) -> list[tuple[int, float]]:
        """Places on either side of a family's best, within so many steps of its span."""
        f, x = self.families[i], self.found[i].x
        step = _step(f) * width / CLOSER
        near = (x + k * step for k in range(1 - CLOSER, CLOSER) if k)
        return [(i, at) for at in near if f.low <= at <= f.high]

    def look(self, places: Sequence[tuple[int, float]]) -> None:
        """Look at these places of the families too."""
        tried = [(i, x, spec) for i, x in places if (spec := _made(self.families[i], x))]
        names = [PEAK, *(b.name for b in self.bounds)]
        rows = numbers([spec for _, _, spec in tried], names)
        for (i, x, _), row in zip(tried, rows, strict=True):
            if row is not None:
                place = Place(self._broken(row[1:]), row[0], x)
                self.found[i] = min(self.found.get(i, NONE), place)

    def _broken(self, values: Sequence[float]) -> float:
        """By how much the bounds are broken together, over their sizes."""
        pairs = zip(self.bounds, values, strict=True)
        return sum(max(-b.room(v), TINY) for b, v in pairs if not b.kept(v))


def _step(family: Family) -> float:
    return (family.high - family.low) / PLACES


def _made(family: Family, x: float) -> Spec | None:
    try:
        return family.make(x)
    except GenevaError:
        return None
