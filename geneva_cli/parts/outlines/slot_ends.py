"""The ends of straight slots: rounded mouths, and horns cut back to flats.

A horn between slot and recess is thinnest at its tip. With ``horn_tip_mm`` a thinner tip is cut
off, square to its slot: the flat from the slot's wall to the recess is then that long. In a frame
along the wall the recess's centre is at the depth d below it, and the flat is

    s = sqrt(k² - (d - t)²)

inwards of the centre, with k the recess's radius and t the flat. With ``mouth_radius_mm`` the
corner of wall and rim, or of wall and flat, is rounded by an arc that touches both.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import fraction_at, segment_length
from geneva_cli.geometry.offsets import away, between, corner
from geneva_cli.geometry.shapes import Arc, Contour, Line, Point, Segment


class Tip(NamedTuple):
    """A flat at a horn's tip: its ends on the slot's wall and on the recess."""

    wall: Point
    recess: Point


def tip(wall: Line, centre: Point, recess: float, width: float) -> Tip | None:
    """Return the flat of a horn beside a wall that runs outwards; None for a horn thick enough.

    ``centre`` and ``recess`` are centre and radius of the recess, and ``width`` is the flat's.
    """
    (x, y), long = wall.start, math.dist(wall.start, wall.end)
    u, v = (wall.end[0] - x) / long, (wall.end[1] - y) / long
    foot = (centre[0] - x) * u + (centre[1] - y) * v
    side = (centre[1] - y) * u - (centre[0] - x) * v
    depth = abs(side) - width
    if not width or depth >= recess:
        return None
    at = foot - math.sqrt(max(recess**2 - depth * depth, 0.0))
    if at >= long:
        return None
    if depth <= 0.0 or at <= 0.5 * long:
        raise GenevaError(
            f"horn_tip_mm = {width:g}: the horns would lose more than half of the slots; "
            "use a smaller tip, or a smaller lock_radius_mm",
            ("size", "horn_tip_mm"),
        )
    across = math.copysign(width, side)
    on_wall = x + at * u, y + at * v
    return Tip(on_wall, (on_wall[0] - across * v, on_wall[1] + across * u))


def rounded(before: Line | Arc, after: Line | Arc, radius: float, sign: float) -> list[Segment]:
    """Return two pieces with an arc between them; ``sign`` is 1 with the material on the left."""
    centre = corner(before, after, sign * radius)
    ends = []
    for piece in (before, after):
        distance, (x, y) = away(piece, centre)
        ends.append((centre[0] - distance * x, centre[1] - distance * y))
    parts = [fraction_at(piece, end) for piece, end in zip((before, after), ends, strict=True)]
    if not (0.0 < parts[0] <= 1.0 and 0.0 <= parts[1] < 1.0):
        raise GenevaError(
            f"mouth_radius_mm = {radius:g}: a mouth's corner has no space for this rounding, as "
            "wall, rim or tip of the horn is too short beside it; use a smaller radius",
            ("size", "mouth_radius_mm"),
        )
    first, last = ends
    sweep = math.remainder(
        math.atan2(last[1] - centre[1], last[0] - centre[0])
        - math.atan2(first[1] - centre[1], first[0] - centre[0]),
        math.tau,
    )
    return [
        between(before, before.start, first),
        Arc(first, last, math.tan(0.25 * sweep)),
        between(after, last, after.end),
    ]


def cut_walls(walls: Contour, wheel: Contour) -> Contour:
    """Return the walls of a straight slot at its place as the contour of the wheel has them."""
    first, *inner, last = walls.segments
    lines = [piece for piece in wheel.segments if isinstance(piece, Line)]
    inwards = next((line for line in lines if line.end == first.end), first)
    outwards = next((line for line in lines if line.start == last.start), last)
    return walls._replace(segments=(inwards, *inner, outwards))


def wall_lost(walls: Contour, wheel: Contour) -> float:
    """Return by how much the walls of a straight slot end deeper than at sharp mouths, mm."""
    cut = cut_walls(walls, wheel).segments
    return max(segment_length(walls.segments[i]) - segment_length(cut[i]) for i in (0, -1))
