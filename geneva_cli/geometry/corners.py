"""Inner corners, and dog bones that free them.

A round cutter leaves its own radius in such a corner. A dog bone is a bite as wide as the cutter: a
circle through the corner, with its centre on the bisector. So a sharp edge fits into the corner.
Contours run with the material on their left, and turn right in an inner corner.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import directions, fraction_at
from geneva_cli.geometry.shapes import Arc, Contour, Line, Point, Segment, closed


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
