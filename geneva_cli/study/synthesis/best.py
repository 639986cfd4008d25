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
from geneva_cli.study.synthesis.families import Family
from geneva_cli.study.synthesis.together import numbers

PLACES = 24  # intervals of a family's span that are looked at first
NEARER = 8  # times that the look is narrowed
CLOSER = 6  # intervals of each narrower look, over the two beside the best
SAME = 1e-4  # share of a span, nearer than which the best is another family's machine
PEAK = "acceleration.max"


def best(families: Sequence[Family], bounds: Sequence[Constraint] = ()) -> list[Spec]:
    """One spec of each family; none of one that has no machine, or none within the bounds.

    ``bounds`` are on quantities that ``together`` knows.
    """
    free = [f for f in families if f.low < f.high]
    if not free:
        return [spec for f in families if (spec := _made(f, f.low))]
    spans = [(f.low, f.high) for f in free]
    found: list[tuple[float, float]] = [(math.inf, math.nan)] * len(free)
    count = PLACES
    for _ in range(1 + NEARER):
        places = [[a + (b - a) * j / count for j in range(count)] + [b] for a, b in spans]
        found = _looked(free, places, bounds, found)
        step = [(b - a) / count for a, b in spans]
        spans = [
            (max(f.low, x - h), min(f.high, x + h)) if x == x else (f.low, f.high)
            for f, (_, x), h in zip(free, found, step, strict=True)
        ]
        count = CLOSER
    chosen = {id(f): x for f, (_, x) in zip(free, found, strict=True)}
    out = []
    for f in families:
        x = chosen.get(id(f), f.low)
        known = abs(x - f.known) <= SAME * (f.high - f.low)
        spec = None if known or x != x else _made(f, x)
        if spec is not None:
            out.append(spec)
    return out


def _looked(
    free: Sequence[Family],
    places: Sequence[Sequence[float]],
    bounds: Sequence[Constraint],
    found: Sequence[tuple[float, float]],
) -> list[tuple[float, float]]:
    """The least peak and its place of each family, of these places and the best so far."""
    out = list(found)
    tried = [
        (i, x, spec)
        for i, (f, at) in enumerate(zip(free, places, strict=True))
        for x in at
        if (spec := _made(f, x))
    ]
    names = [PEAK, *(b.name for b in bounds)]
    rows = numbers([spec for _, _, spec in tried], names)
    for (i, x, _), row in zip(tried, rows, strict=True):
        if row is None:
            continue
        peak, *others = row
        kept = all(b.kept(v) for b, v in zip(bounds, others, strict=True))
        if kept and peak < out[i][0]:
            out[i] = (peak, x)
    return out


def _made(family: Family, x: float) -> Spec | None:
    try:
        return family.make(x)
    except GenevaError:
        return None
