"""Of each family the machine with the least peak acceleration that keeps the wish's bounds.

All families are looked at together: at places evenly between their ends, then nearer and nearer
about the best of each.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from geneva_cli.errors import GenevaError
from geneva_cli.machine.spec import Spec
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synthesis.families.family import Family
from geneva_cli.study.synthesis.together import numbers

PLACES = 24  # intervals of a family's span that are looked at first
NEARER = 8  # times that the look is narrowed
CLOSER = 6  # intervals of each narrower look, over the two beside the best
SAME = 1e-4  # share of a span, nearer than which the best is another family's machine
NONE = (math.inf, math.nan)
PEAK = "acceleration.max"


def best(families: Sequence[Family], bounds: Sequence[Constraint] = ()) -> list[Spec]:
    """One spec of each family; none of one that has no machine, or none within the bounds.

    ``bounds`` are on quantities that ``together`` knows.
    """
    free = [f for f in families if f.low < f.high]
    if not free:
        return [spec for f in families if (spec := _made(f, f.low))]
    found: dict[int, tuple[float, float]] = {}
    open_ = {i: (f.low, f.high) for i, f in enumerate(free)}
    count = PLACES
    for look in range(1 + NEARER):
        places = {
            i: [a + (b - a) * j / count for j in range(count)] + [b] for i, (a, b) in open_.items()
        }
        _look(free, places, bounds, found)
        nearer = {}
        for i, (a, b) in open_.items():
            f, (_, x) = free[i], found.get(i, NONE)
            # one that is still best at an end of its span, looked at nearer there, is best there
            if x == x and not (look and x in (f.low, f.high)):
                step = (b - a) / count
                nearer[i] = max(f.low, x - step), min(f.high, x + step)
        open_, count = nearer, CLOSER
    chosen = {id(f): found.get(i, NONE)[1] for i, f in enumerate(free)}
    out = []
    for f in families:
        x = chosen.get(id(f), f.low)
        known = abs(x - f.known) <= SAME * (f.high - f.low)
        spec = None if known or x != x else _made(f, x)
        if spec is not None:
            out.append(spec)
    return out


def _look(
    free: Sequence[Family],
    places: dict[int, list[float]],
    bounds: Sequence[Constraint],
    found: dict[int, tuple[float, float]],
) -> None:
    """Put into ``found`` the least peak and its place of each family, of these places too."""
    tried = [(i, x, spec) for i, at in places.items() for x in at if (spec := _made(free[i], x))]
    names = [PEAK, *(b.name for b in bounds)]
    rows = numbers([spec for _, _, spec in tried], names)
    for (i, x, _), row in zip(tried, rows, strict=True):
        if row is None:
            continue
        peak, *others = row
        kept = all(b.kept(v) for b, v in zip(bounds, others, strict=True))
        if kept and peak < found.get(i, NONE)[0]:
            found[i] = (peak, x)


def _made(family: Family, x: float) -> Spec | None:
    try:
        return family.make(x)
    except GenevaError:
        return None
