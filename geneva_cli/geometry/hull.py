"""The convex hull of circles, and how far outlines reach."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.shapes import (
    Arc,
    Circle,
    Contour,
    Layer,
    Line,
    Segment,
    about,
    closed,
    two_arcs,
)
from geneva_cli.numerics.arrays import Array, Number

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


def farthest(outline: Polyarc, x: Number, y: Number) -> Array:
    """Return the distance from points to the farthest point of each piece.

    x and y broadcast with the pieces. The farthest point is at an end of the piece, or where an arc
    lies opposite the point as seen from its centre.
    """
    vx, vy = outline.cx - x, outline.cy - y
    away = np.hypot(vx, vy)
    opposite = outline.arc & (vx * outline.mx + vy * outline.my >= away * outline.cos_half)
    start, end = np.hypot(outline.x0 - x, outline.y0 - y), np.hypot(outline.x1 - x, outline.y1 - y)
    return np.where(opposite, away + outline.radius, np.maximum(start, end))


def from_segments(outline: Polyarc, start: Array, end: Array, reach: float) -> Array:
    """Return the least distance of segments that cross no piece from the outline, (n,).

    ``start`` and ``end`` are (n, 2). Distances above ``reach`` are returned as ``reach``. The
    distance is at an end of the segment, at a corner of the outline, or where the line from an
    arc's centre meets the segment at a right angle.
    """
    # only pieces that may lie within reach of a segment are compared with it
    (x, y), half = 0.5 * (start + end).T, 0.5 * np.hypot(*(end - start).T)
    middle = np.hypot(outline.ox - x[:, None], outline.oy - y[:, None])
    row, piece = np.nonzero(middle <= reach + half[:, None] + outline.size)
    near = outline.subset(piece)
    (x, y), (dx, dy), (ex, ey) = start[row].T, (end - start)[row].T, end[row].T
    square = np.maximum(dx * dx + dy * dy, 1e-300)

    def nearest(px: Array, py: Array) -> tuple[Array, Array]:
        """The points of the segments that are nearest to points."""
        along = np.clip(((px - x) * dx + (py - y) * dy) / square, 0.0, 1.0)
        return x + along * dx, y + along * dy

    def away(px: Array, py: Array) -> Array:
        fx, fy = nearest(px, py)
        return np.hypot(fx - px, fy - py)

    places = (x, y), (ex, ey), nearest(near.cx, near.cy)
    from_places = [near.distances(*place).distance for place in places]
    corners = away(near.x0, near.y0), away(near.x1, near.y1)
    out = np.full(len(start), reach)
    np.minimum.at(out, row, np.minimum.reduce((*from_places, *corners)))
    return out


def short_pieces(contours: Iterable[Contour], step: float) -> Polyarc:
    """Return an outline cut into equal pieces; arcs turn by at most ``step`` radians in each.

    A line is cut like an arc of a quarter of a circle.
    """
    pieces = tuple(p for c in contours for s in c.segments for p in _cut(s, step))
    return Polyarc([Contour("", pieces)])


def _cut(segment: Segment, step: float) -> Iterator[Segment]:
    if isinstance(segment, Arc):
        (cx, cy), radius, sweep = segment.centre, segment.radius, segment.sweep
        start = math.atan2(segment.start[1] - cy, segment.start[0] - cx)
        count = max(1, math.ceil(abs(sweep) / step))
        for i in range(count):
            yield about((cx, cy), radius, start + sweep * i / count, sweep / count)
        return
    (x0, y0), (x1, y1) = segment.start, segment.end
    count = math.ceil(0.5 * math.pi / step)
    corners = [(x0 + (x1 - x0) * i / count, y0 + (y1 - y0) * i / count) for i in range(count + 1)]
    yield from map(Line, corners[:-1], corners[1:])
