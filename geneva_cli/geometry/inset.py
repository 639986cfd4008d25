"""Contours at a distance inside the material, of edges and of what a cutter leaves in corners.

Lines and arcs have parallel lines and arcs. At a corner both parallels are carried on until they
meet. A cubic has no parallel cubic.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import STRAIGHT, directions, fraction_at
from geneva_cli.geometry.shapes import (
    Arc,
    Circle,
    Contour,
    Layer,
    Line,
    Point,
    Segment,
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


class TooWide(GenevaError):
    """A dog bone that does not fit, but one of a narrower cutter may."""


class Corner(NamedTuple):
    """A right turn of a contour: the end of a piece, by a positive angle in radians."""

    piece: int
    at: Point
    turn: float


class Bone(NamedTuple):
    """A dog bone: its centre, and the arc that replaces its corner."""

    corner: Corner
    centre: Point
    arc: Arc


def pieces(contour: Contour) -> list[Line | Arc]:
    """The contour's pieces; raises GenevaError for cubics."""
    kept = [piece for piece in contour.segments if isinstance(piece, Line | Arc)]
    if len(kept) < len(contour.segments):
        raise GenevaError("--cutter works on lines and arcs only: use --curves arcs")
    return kept


def inner_corners(contour: Contour, radius: float) -> Iterator[Corner]:
    """The corners in which a cutter leaves material, at most r (1/cos(turn/2) - 1) of it.

    >>> square = closed("", [Line((0, 0), (0, 9)), Line((0, 9), (9, 9)), Line((9, 9), (0, 0))])
    >>> [round(math.degrees(corner.turn)) for corner in inner_corners(square, 1.0)]
    [90, 135, 135]
    """
    around = pieces(contour)
    for i, piece in enumerate(around):
        before, after = directions(piece)[1], directions(around[(i + 1) % len(around)])[0]
        turn = -math.remainder(after - before, math.tau)
        # less than 1e-4 mm of material is no corner
        if 0.0 < turn < math.pi and radius * (1.0 / math.cos(0.5 * turn) - 1.0) > 1e-4:
            yield Corner(i, piece.end, turn)


def bone(contour: Contour, corner: Corner, radius: float) -> Bone:
    """The dog bone of a corner, which runs clockwise from one wall through it to the other."""
    (x, y), around = corner.at, pieces(contour)
    walls = around[corner.piece], around[(corner.piece + 1) % len(around)]
    bisector = directions(walls[1])[0] + 0.5 * corner.turn - 0.5 * math.pi
    centre = x + radius * math.cos(bisector), y + radius * math.sin(bisector)
    start, end = (_again(wall, centre, corner.at) for wall in walls)
    halves = [math.asin(min(1.0, 0.5 * math.dist(corner.at, p) / radius)) for p in (start, end)]
    return Bone(corner, centre, Arc(start, end, -math.tan(0.5 * sum(halves))))


def with_bones(contour: Contour, bones: Iterable[Bone]) -> Contour:
    """The contour with dog bones in place of its corners.

    Raises TooWide if a wall is too short for the bones at its ends.
    """
    at = {one.corner.piece: one for one in bones}
    around = pieces(contour)
    segments: list[Segment] = []
    for i, piece in enumerate(around):
        ahead, behind = at.get(i), at.get((i - 1) % len(around))
        low = fraction_at(piece, behind.arc.end) if behind else 0.0
        high = fraction_at(piece, ahead.arc.start) if ahead else 1.0
        if not 0.0 <= low < high <= 1.0:
            x, y = (ahead or behind or at[0]).corner.at
            raise TooWide(
                f"the wall of {contour.layer} at its corner x = {x:.5g}, y = {y:.5g} is "
                "shorter than a dog bone"
            )
        start = behind.arc.end if behind else piece.start
        end = ahead.arc.start if ahead else piece.end
        if isinstance(piece, Line):
            segments.append(Line(start, end))
        else:
            segments.append(Arc(start, end, math.tan(0.25 * (high - low) * piece.sweep)))
        segments += [ahead.arc] if ahead else []
    return closed(contour.layer, segments)


def _again(wall: Line | Arc, centre: Point, corner: Point) -> Point:
    """Second point at which a circle through the corner meets a wall.

    For a straight wall it is the corner's mirror image in the perpendicular from the circle's
    centre. For a round wall it is the mirror image in the line of both centres.
    """
    (cx, cy), (px, py) = centre, corner
    if isinstance(wall, Line):
        ux, uy = wall.start[1] - wall.end[1], wall.end[0] - wall.start[0]
    else:
        ux, uy = wall.centre[0] - cx, wall.centre[1] - cy
    along = ((px - cx) * ux + (py - cy) * uy) / (ux * ux + uy * uy)
    return 2.0 * (cx + along * ux) - px, 2.0 * (cy + along * uy) - py
