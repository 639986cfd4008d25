"""Wheels on a carrier: the gap between neighbours, which pass each other in one plane."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geneva_cli.analysis.carried import farthest_mm
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.verdict.checks.check import Check, compared

if TYPE_CHECKING:
    from geneva_cli.outlines.outlines import Outlines


def wheels_apart(name: str, parts: FlatParts) -> Check | None:
    """The gap between the circles of adjacent wheels, each with all that it carries."""
    wheels = parts.mechanism.spec.drive.wheels_on_carrier
    if wheels < 2:
        return None
    between = 2.0 * parts.mechanism.center_distance_mm * math.sin(math.pi / wheels)
    return compared(name, between - 2.0 * reach_mm(parts.outlines), "at least", 0.0)


def reach_mm(outlines: Outlines) -> float:
    """Radius of the circle about a wheel's axis that contains it and its masses."""
    sizes = outlines.sizes
    return max(sizes.rim, sizes.outer, farthest_mm(outlines.assembly.mechanism.spec))
