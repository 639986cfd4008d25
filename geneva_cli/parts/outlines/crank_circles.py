"""The circles of a crank beside its locking disc: rollers, pins and bore."""

from __future__ import annotations

import math
from itertools import combinations

from geneva_cli.geometry.shapes import Circle, Shape
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.reliefs import keyway_direction
from geneva_cli.parts.shafts.bores import bore_of
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots.roller_paths import roller_centres


def crank_circles(assembly: Assembly, sizes: Sizes) -> list[Shape]:
    """Return rollers, pins and bore in its shape."""
    shapes: list[Shape] = []
    for centre in roller_centres(assembly):
        shapes += [Circle("ROLLER", centre, sizes.roller)]
        shapes += [Circle("ROLLER", centre, sizes.pin)] if sizes.pin else []
    if sizes.crank_bore:
        own = bore_of(assembly.mechanism.spec.size, "crank", sizes.crank_bore)
        shapes.append(own.shape("BORE", keyway_direction(assembly)))
    return shapes


def rollers_gap(assembly: Assembly, sizes: Sizes) -> float | None:
    """Return the gap between the roller that starts the wheel and that which stops it, mm.

    It is negative where they overlap, and None if each roller does both.
    """
    if len(assembly.rollers) == len(assembly.motions):
        return None
    pairs = combinations(roller_centres(assembly), 2)
    return min(math.dist(one, other) for one, other in pairs) - 2.0 * sizes.roller
