"""Of each family one machine that keeps the wish's bounds: the gentlest, or the nearest.

The gentlest has the least peak acceleration; the nearest to the plain crank is taken where any
motion will do. All families are looked at together: at places evenly between their ends, then
nearer and nearer about the best of each.
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
# Times that the look is narrowed, and by how much: a peak is flat, and the nearest has a bound.
GENTLEST = (8, 3)
NEAREST = (12, 9)
BROKEN = 4  # of these, after which a family that has broken its bounds so far is given up
TINY = 1e-300  # what a bound that is broken by no more than rounding counts
FORGIVEN = 1e-200  # what rounding adds up to at most
SAME = 1e-4  # share of a span, nearer than which the best is another family's machine
PEAK = "acceleration.max"


def best(
    families: Sequence[Family], bounds: Sequence[Constraint] = (), nearest: bool = False
) -> list[Spec]:
    """One spec of each family; none of one that has no machine, or none within the bounds.

    ``bounds`` are on quantities that ``together`` knows. Where no place of a family keeps them, the
    look goes on about the one that breaks them least.
    """
    free = [f for f in families if f.low < f.high]
    search = _Search(free, bounds, nearest)
    search.look([(i, x) for i, f in enumerate(free) for x in _first(f)])
    for look in range(search.looks):
        search.look([at for i in search.found for at in search.beside(i, look)])
    chosen = {id(f): search.found.get(i, NONE) for i, f in enumerate(free)}
    out = []
    for f in families:
        place = chosen.get(id(f), Place(0.0, 0.0, f.low))
        known = abs(place.x - f.known) <= SAME * (f.high - f.low)
        spec = None if known or place.broken >= FORGIVEN else _made(f, place.x)
        if spec is not None:
            out.append(spec)
    return out


def _first(f: Family) -> list[float]:
    """The places of a family that are looked at first; the plain crank is among them."""
    plain = [f.plain] if f.low < f.plain < f.high else []
    return [*(f.low + _step(f) * j for j in range(PLACES)), f.high, *plain]


class Place(NamedTuple):
    """A machine of a family: by how much it breaks the bounds, how far it is from the best that
    could be (its peak, or its distance from the plain crank), and where it is.
    """

    broken: float
    far: float
    x: float


NONE = Place(math.inf, math.inf, math.nan)


class _Search:
    """The best place so far of each family, by its number."""

    def __init__(
        self, families: Sequence[Family], bounds: Sequence[Constraint], nearest: bool
    ) -> None:
        self.families, self.bounds, self.nearest = families, bounds, nearest
        self.looks, self.closer = NEAREST if nearest else GENTLEST
        self.found: dict[int, Place] = {}

    def beside(self, i: int, look: int) -> list[tuple[int, float]]:
        """Places beside a family's best, nearer at each look; none where it can get no better."""
        f, (broken, far, x) = self.families[i], self.found[i]
        toward = 0.0
        if self.nearest:
            if f.plain == f.plain and not broken:
                toward = f.plain - x  # nothing on the other side is nearer
            elif look >= BROKEN:
                return []
        # one that is still best at an end of its span, looked at nearer there, is best there
        if far == 0.0 or (look and x in (f.low, f.high)):
            return []
        step, k = _step(f) / self.closer**look, self.closer
        near = [x + step * i / k for i in range(1 - k, k) if i and i * toward >= 0.0]
        return [(i, at) for at in near if f.low <= at <= f.high]

    def look(self, places: Sequence[tuple[int, float]]) -> None:
        """Look at these places of the families too."""
        tried = [(i, x, spec) for i, x in places if (spec := _made(self.families[i], x))]
        specs = [spec for _, _, spec in tried]
        rows = numbers(specs, [PEAK, *(b.name for b in self.bounds)])
        if self.bounds:  # where no array of machines has a quantity, its bound is asked for later
            without = iter(
                numbers([s for s, row in zip(specs, rows, strict=True) if not row], [PEAK])
            )
            rows = [row or next(without) for row in rows]
        for (i, x, _), row in zip(tried, rows, strict=True):
            if row is not None:
                plain = self.families[i].plain
                far = abs(x - plain) if self.nearest and plain == plain else row[0]
                place = Place(self._broken(row[1:]), far, x)
                self.found[i] = min(self.found.get(i, NONE), place)

    def _broken(self, values: Sequence[float]) -> float:
        """By how much the bounds are broken together, over their sizes."""
        total = 0.0
        for b, value in zip(self.bounds, values, strict=False):
            room = b.room(value)
            if not room >= 0.0:
                total += TINY if b.kept(value) else -room
        return total


def _step(family: Family) -> float:
    return (family.high - family.low) / PLACES


def _made(family: Family, x: float) -> Spec | None:
    try:
        return family.make(x)
    except GenevaError:
        return None
