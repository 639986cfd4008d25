"""Contours at a distance inside the material: the sections of chamfered and rounded edges.

Lines and arcs have parallel lines and arcs. At a corner both parallels are carried on until they
meet. A cubic has no parallel cubic.
"""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import STRAIGHT, directions
from geneva_cli.geometry.shapes import (
    Arc,
    Circle,
    Contour,
    Layer,
    Line,
    Point,
    Shape,
    closed,
    two_arcs,
)


def lines_and_arcs(shape: Shape) -> list[Line | Arc]:
    """Return the pieces of a closed shape; raises GenevaError for a cubic."""
    pieces = two_arcs(shape) if isinstance(shape, Circle) else shape.segments
    plain = [piece for piece in pieces if isinstance(piece, Line | Arc)]
    if len(plain) < len(pieces):
        raise GenevaError(
            "a spline has no parallel spline, so its edges are sharp; use --curves arcs, or remove "
            "the key"
        )
    return plain


def corner(before: Line | Arc, after: Line | Arc, depth: float) -> Point:
    """Return the point at a distance to the left of two pieces, near their common end.

    Raises GenevaError for a corner so sharp that it is far away.
    """
    at = after.start
    (ax, ay), (bx, by) = _left(directions(before)[1]), _left(directions(after)[0])
    both = 1.0 + ax * bx + ay * by
    if both < 0.1:  # an angle of 26 degrees or less: the point is four depths away
        raise _too_wide()
    x, y = at[0] + depth * (ax + bx) / both, at[1] + depth * (ay + by) / both
    if abs(ax * by - ay * bx) < 1e-6:  # radians: tangent pieces meet in the common normal
        return x, y
    for _ in range(8):  # Newton's digits double each time, and the first guess errs by depth²/R
        (d, (ux, uy)), (e, (vx, vy)) = away(before, (x, y)), away(after, (x, y))
        det = ux * vy - uy * vx
        if not det:  # so deep that both pieces are in one direction, to rounding
            raise _too_wide()
        d, e = depth - d, depth - e
        x, y = x + (d * vy - e * uy) / det, y + (e * ux - d * vx) / det
    return x, y


def corner_slope(before: Line | Arc, after: Line | Arc, at: Point) -> Point:
    """Return the corner's movement per depth at a point of its path."""
    (_, (ux, uy)), (_, (vx, vy)) = away(before, at), away(after, at)
    det = ux * vy - uy * vx
    return (vy - uy) / det, (ux - vx) / det


def inset(pieces: list[Line | Arc], layer: Layer, depth: float) -> Contour:
    """Return the contour at a depth to the left of some pieces, piece by piece.

    Raises GenevaError where it has a piece no longer.
    """
    before = [pieces[-1], *pieces[:-1]]
    starts = [corner(one, piece, depth) for one, piece in zip(before, pieces, strict=True)]
    ends = [*starts[1:], starts[0]]
    return closed(
        layer,
        [_parallel(*one, depth) for one in zip(pieces, starts, ends, strict=True)],
    )


def _parallel(piece: Line | Arc, start: Point, end: Point, depth: float) -> Line | Arc:
    if isinstance(piece, Line) or abs(piece.bulge) < STRAIGHT:
        (x0, y0), (x1, y1) = piece.start, piece.end
        ahead = (end[0] - start[0]) * (x1 - x0) + (end[1] - start[1]) * (y1 - y0)
        if ahead <= 0.0:
            raise _too_wide()
        return Line(start, end)
    (cx, cy), sweep = piece.centre, piece.sweep
    if sweep > 0.0 and piece.radius <= depth:
        raise _too_wide()
    turn = math.atan2(end[1] - cy, end[0] - cx) - math.atan2(start[1] - cy, start[0] - cx)
    turn = sweep + math.remainder(turn - sweep, math.tau)
    if turn * sweep <= 0.0:
        raise _too_wide()
    return Arc(start, end, math.tan(0.25 * turn))


def away(piece: Line | Arc, at: Point) -> tuple[float, Point]:
    """Return how far a point is to the left of a piece's line or circle, and that direction."""
    if isinstance(piece, Line) or abs(piece.bulge) < STRAIGHT:
        nx, ny = _left(directions(piece)[0])
        return (at[0] - piece.start[0]) * nx + (at[1] - piece.start[1]) * ny, (nx, ny)
    (cx, cy), sense = piece.centre, math.copysign(1.0, piece.bulge)
    x, y = cx - at[0], cy - at[1]
    far = math.hypot(x, y)
    return sense * (piece.radius - far), (sense * x / far, sense * y / far)


def _left(direction: float) -> Point:
    return -math.sin(direction), math.cos(direction)


def _too_wide() -> GenevaError:
    return GenevaError(
        "it is wider than a rounding, or cuts off a face of a part; use a smaller value"
    )
