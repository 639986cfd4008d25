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
from geneva_cli.geometry.inset import away, between, corner
from geneva_cli.geometry.measure import fraction_at, segment_length, turned
from geneva_cli.geometry.shapes import Arc, Contour, Line, Point, Segment
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import scalar
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots.roller_paths import mouth_corners, rest


class Tip(NamedTuple):
    """A flat at a horn's tip: its ends on the slot's wall and on the recess."""

    wall: Point
    recess: Point


def tip(wall: Line, centre: Point, sizes: Sizes) -> Tip | None:
    """Return the flat of a horn beside a wall that runs outwards; None for a horn thick enough.

    ``centre`` is the recess's. Raises GenevaError where nothing of the wall would be left.
    """
    (x, y), long = wall.start, math.dist(wall.start, wall.end)
    u, v = (wall.end[0] - x) / long, (wall.end[1] - y) / long
    foot = (centre[0] - x) * u + (centre[1] - y) * v
    side = (centre[1] - y) * u - (centre[0] - x) * v
    depth = abs(side) - sizes.horn_tip
    if not sizes.horn_tip or depth >= sizes.recess:
        return None
    at = foot - math.sqrt(sizes.recess**2 - depth * depth)
    if at >= long:
        return None
    if at <= 0.5 * long:
        raise GenevaError(
            f"horn_tip_mm = {sizes.horn_tip:g}: the horns would lose more than half of the slots; "
            "use a smaller tip, or a smaller lock_radius_mm",
            ("size", "horn_tip_mm"),
        )
    across = math.copysign(sizes.horn_tip, side)
    on_wall = x + at * u, y + at * v
    return Tip(on_wall, (on_wall[0] - across * v, on_wall[1] + across * u))


def horn_corners(assembly: Assembly, sizes: Sizes) -> dict[Engagement, tuple[float, float]]:
    """Return the distances from the wheel's axis of each slot's horns at their recesses, mm.

    They are those of the horns before and after a motion, which are mouths' corners unless the
    horns are cut back.
    """
    mouths = mouth_corners(assembly, sizes.roller, sizes.recess, sizes.rim)
    if not (sizes.horn_tip and sizes.lock):
        return mouths
    return {
        kind: (_cut(assembly, sizes, kind, -1.0, entry), _cut(assembly, sizes, kind, 1.0, exit_))
        for kind, (entry, exit_) in mouths.items()
    }


def _cut(assembly: Assembly, sizes: Sizes, kind: Engagement, end: float, mouth: float) -> float:
    """Return the distance of one horn's corner at its recess, with ``mouth`` that of its mouth."""
    x, y = kind.slot(kind.end_deg(end), 0)
    u, v = kind.slot(0.0, 0)
    L, centre = assembly.L, rest(assembly, kind, end)
    start = L * scalar(u.c[0]), L * scalar(v.c[0])
    out = L * scalar(x.c[0]) - start[0], L * scalar(y.c[0]) - start[1]
    long = math.hypot(*out)
    ux, uy = out[0] / long, out[1] / long
    side = math.copysign(
        sizes.half_width, (centre[1] - start[1]) * ux - (centre[0] - start[0]) * uy
    )
    x0, y0 = start[0] - side * uy, start[1] + side * ux
    level = math.sqrt(max(mouth * mouth - (y0 * ux - x0 * uy) ** 2, 0.0))
    along = assembly.sign * level - (x0 * ux + y0 * uy)
    cut = tip(Line((x0, y0), (x0 + along * ux, y0 + along * uy)), centre, sizes)
    return math.hypot(*cut.recess) if cut else mouth


def rounded(before: Line | Arc, after: Line | Arc, radius: float, sign: float) -> list[Segment]:
    """Return two adjacent pieces with an arc of a radius between them.

    ``sign`` is 1 where the material is to the left of them, -1 to the right. Raises GenevaError
    where one of them is too short.
    """
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


def cut_walls(outlines: Outlines, kind: Engagement, direction: float) -> Contour:
    """Return the walls of a straight slot as the wheel has them, at a direction of a slot."""
    walls, sizes = turned(outlines.slots[kind], direction), outlines.sizes
    if not (sizes.mouth_radius or sizes.horn_tip):
        return walls
    first, *inner, last = walls.segments
    lines = [piece for piece in outlines.wheel.segments if isinstance(piece, Line)]
    inwards = next((line for line in lines if line.end == first.end), first)
    outwards = next((line for line in lines if line.start == last.start), last)
    return walls._replace(segments=(inwards, *inner, outwards))


def wall_lost(outlines: Outlines) -> float:
    """Return by how much the walls of straight slots end deeper than at sharp mouths, mm."""
    lost = 0.0
    if outlines.sizes.mouth_radius or outlines.sizes.horn_tip:
        for kind, direction in outlines.assembly.slots:
            sharp = turned(outlines.slots[kind], direction).segments
            cut = cut_walls(outlines, kind, direction).segments
            for i in (0, -1):
                lost = max(lost, segment_length(sharp[i]) - segment_length(cut[i]))
    return lost
