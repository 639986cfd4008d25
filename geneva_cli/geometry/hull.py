"""The convex hull of circles."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geneva_cli.geometry.shapes import (
    Circle,
    Contour,
    Layer,
    Line,
    Segment,
    about,
    closed,
    two_arcs,
)

HULL_ROUNDING = 1e-12  # radians, and mm: directions and points nearer to each other are one


def convex_hull(layer: Layer, circles: Sequence[Circle]) -> Contour:
    """Convex hull of circles, counterclockwise: arcs on circles, and lines between them.

    It touches a circle in the directions in which this circle reaches farthest. Going round, the
    next circle takes over where both reach equally far, on their common tangent.

    >>> two = convex_hull("ARM", [Circle("ARM", (0.0, 0.0), 1.0), Circle("ARM", (4.0, 0.0), 1.0)])
    >>> [type(piece).__name__ for piece in two.segments]
    ['Arc', 'Line', 'Arc', 'Line']
    """
    order = sorted(circles, key=lambda c: (c.centre[0] + c.radius, c.centre[1]))
    here, turned = order[-1], 0.0  # the farthest along x
    arcs: list[tuple[Circle, float, float]] = []
    while turned < math.tau:
        step, after = _next(here, turned, circles)
        step = min(step, math.tau - turned)
        if arcs and turned + step == math.tau and arcs[0][0] == here:
            first, _, sweep = arcs[0]
            arcs[0] = first, turned - math.tau, step + sweep  # the hull starts within this arc
        else:
            arcs.append((here, turned, step))
        turned += step
        here = after
    pieces: list[Segment] = []
    for circle, start, sweep in arcs:
        arc = about(circle.centre, circle.radius, start, sweep)
        if pieces and math.dist(pieces[-1].end, arc.start) > HULL_ROUNDING:
            pieces.append(Line(pieces[-1].end, arc.start))
        if len(arcs) == 1:
            pieces += two_arcs(circle, start)
        elif sweep > HULL_ROUNDING:
            pieces.append(arc)
    if len(arcs) > 1 and math.dist(pieces[-1].end, pieces[0].start) > HULL_ROUNDING:
        pieces.append(Line(pieces[-1].end, pieces[0].start))
    return closed(layer, pieces)


def _next(here: Circle, turned: float, circles: Sequence[Circle]) -> tuple[float, Circle]:
    """Angle in radians to the next circle, and that circle; a whole turn if there is none."""
    best = (math.tau, 0.0, here)
    for other in circles:
        x, y = other.centre[0] - here.centre[0], other.centre[1] - here.centre[1]
        apart, less = math.hypot(x, y), here.radius - other.radius
        if apart <= abs(less) * (1.0 + HULL_ROUNDING) or other == here:
            continue  # one circle holds the other
        at = math.atan2(y, x) - math.acos(less / apart)
        step = max((at - turned + HULL_ROUNDING) % math.tau - HULL_ROUNDING, 0.0)
        if step < best[0] - HULL_ROUNDING or (step < best[0] + HULL_ROUNDING and apart > best[1]):
            best = step, apart, other
    return best[0], best[2]
