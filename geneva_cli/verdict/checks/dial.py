"""The wheel's walls around its keyway and the dial's bolts, if the spec sets their keys."""

from __future__ import annotations

from itertools import combinations

from geneva_cli.curves.distance import Polyarc
from geneva_cli.curves.hole_walls import apart, beyond
from geneva_cli.curves.shapes import Circle, backwards
from geneva_cli.layout.bores import has_shape
from geneva_cli.outlines.wheel import wheel_circles
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.verdict.checks.check import Check, compared


def wall(name: str, parts: FlatParts) -> Check | None:
    """The least wall around the bore with its keyway and around the dial's bolts."""
    size = parts.mechanism.spec.size
    if not (has_shape(size, "wheel") or size.dial_bolts):
        return None
    outlines = parts.outlines
    inside = outlines.assembly.sign < 0.0  # the contour is that of the opening
    edge = Polyarc([backwards(outlines.wheel) if inside else outlines.wheel])
    holes = [s for s in wheel_circles(outlines.assembly, outlines.sizes) if s.layer == "BORE"]
    walls = [-beyond(edge, hole) for hole in holes]
    walls += [apart(one, two) for one, two in combinations(holes, 2)]
    for hole in holes if inside else ():
        assert isinstance(hole, Circle)  # an internal wheel has no bore
        x, y = hole.centre
        walls.append(outlines.sizes.outer - (x * x + y * y) ** 0.5 - hole.radius)
    return compared(name, min(walls), "at least", outlines.sizes.wall_min)
