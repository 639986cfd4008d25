"""Cranks about one wheel: the gap between neighbours, which holds at any angles of both."""

from __future__ import annotations

import math
from itertools import combinations

from geneva_cli.curves.distance import Polyarc
from geneva_cli.curves.extents import farthest
from geneva_cli.layout.roller_paths import roller_reaches
from geneva_cli.outlines.bounds import AXIS
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.verdict.checks.check import Check, compared


def cranks_apart(name: str, parts: FlatParts) -> Check | None:
    """The gap between the circles that the nearest two cranks sweep about their axes."""
    places = parts.mechanism.crank_places
    if len(places) < 2:
        return None
    between = min(math.dist(one.at, other.at) for one, other in combinations(places, 2))
    return compared(name, between - 2.0 * reach_mm(parts), "at least", 0.0)


def reach_mm(parts: FlatParts) -> float:
    """Radius of the circle about a crank's axis that contains disc, hub, roller and arm."""
    outlines = parts.outlines
    sizes = outlines.sizes
    rollers = max(roller_reaches(outlines.assembly)) + sizes.roller
    arm = farthest(Polyarc([parts.arm.outline]), AXIS).max() if parts.arm else 0.0
    return max(sizes.lock, sizes.crank_hub, rollers, float(arm))
