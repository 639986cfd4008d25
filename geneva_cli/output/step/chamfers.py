"""Chamfers at 45 degrees: planes over lines, cones over arcs, up to the edges of the faces.

Where two chamfers meet in a corner, their edge runs through the corners of all insets. It is a line
between planes or tangent pieces. Otherwise it is a spline with the exact ends and tangents.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.curves.inset import corner, corner_slope, inset, lines_and_arcs
from geneva_cli.curves.plates import Plate
from geneva_cli.curves.shapes import Arc, Contour, Line
from geneva_cli.output.step.curves import curve, smooth_curve
from geneva_cli.output.step.entities import (
    DIRECTION,
    Entities,
    SolidCorner,
    WallFace,
    edge,
    face,
    loop,
    real,
)

CUBICS = 8  # of an edge that is no line: their error is a millionth of the chamfer and less


class Side(NamedTuple):
    """One of the two faces of a plate: its height, that of the wall's edge, and +1 if it is up."""

    z: float
    wall: float
    up: float


class Chamfers(NamedTuple):
    """The faces of chamfers, and the edges around the lower and the upper face of the plate."""

    faces: list[str]
    low: list[str]
    high: list[str]


def chamfers(
    file: Entities,
    plate: Plate,
    contour: Contour,
    corners: list[SolidCorner],
    walls: list[WallFace],
) -> Chamfers:
    """Write the chamfers around one contour."""
    own = lines_and_arcs(contour)
    inner = lines_and_arcs(inset(own, contour.layer, plate.chamfer))
    sides = (
        Side(plate.low, plate.low + plate.chamfer, -1.0),
        Side(plate.high, plate.high - plate.chamfer, 1.0),
    )
    faces, edges = [], []
    for side in sides:
        ends = [file.add(f"VERTEX_POINT('',{file.point(one.start, side.z)})") for one in inner]
        rises = [
            _rise(file, (own[k - 1], own[k]), side, (at.high if side.up > 0.0 else at.low, ends[k]))
            for k, at in enumerate(corners)
        ]
        own_edges = []
        for k, (piece, within, wall) in enumerate(zip(own, inner, walls, strict=True)):
            after = (k + 1) % len(own)
            along = not isinstance(within, Arc) or within.bulge > 0.0
            on = edge(file, ends[k], ends[after], curve(file, within, side.z), along)
            below = wall.high if side.up > 0.0 else wall.low
            around = [(below, True), (rises[after], True), (on, False), (rises[k], False)]
            if side.up < 0.0:
                around = [(one, not forward) for one, forward in reversed(around)]
            outwards = not isinstance(piece, Arc) or piece.bulge > 0.0
            surface = _surface(file, piece, side)
            faces.append(face(file, [loop(file, around)], surface, outwards))
            own_edges.append(on)
        edges.append(own_edges)
    return Chamfers(faces, *edges)


def _surface(file: Entities, piece: Line | Arc, side: Side) -> str:
    """Write the plane or the cone of a chamfer."""
    if isinstance(piece, Line):
        (x0, y0), (x1, y1) = piece
        long = math.dist(piece.start, piece.end)
        x, y, tilt = (x1 - x0) / long, (y1 - y0) / long, math.sqrt(0.5)
        axis = file.direction(tilt * y, -tilt * x, tilt * side.up)
        place = file.placement(piece.start, side.wall, axis, file.direction(x, y))
        return file.add(f"PLANE('',{place})")
    # a cone is wider along its axis: towards the wall where the material is inside
    up = -side.up if piece.bulge > 0.0 else side.up
    place = file.placement(piece.centre, side.wall, file.direction(0.0, 0.0, up))
    angle = real(0.25 * math.pi, DIRECTION)
    return file.add(f"CONICAL_SURFACE('',{place},{real(piece.radius)},{angle})")


def _rise(
    file: Entities, pieces: tuple[Line | Arc, Line | Arc], side: Side, ends: tuple[str, str]
) -> str:
    """Write the edge from a wall's corner to that of the face."""
    before, after = pieces
    depth = abs(side.z - side.wall)
    start, end = after.start, corner(before, after, depth)
    (x0, y0), (x1, y1) = start, end
    along = (x1 - x0) / depth, (y1 - y0) / depth
    long = math.hypot(*along, 1.0)
    straight = isinstance(before, Line) and isinstance(after, Line)
    if straight or abs(math.hypot(*along) - 1.0) < 1e-9:  # of tangent pieces, along the normal
        heading = file.direction(along[0] / long, along[1] / long, side.up / long)
        vector = file.shared(f"VECTOR('',{heading},1.)")
        return edge(file, *ends, f"LINE('',{file.point(start, side.wall)},{vector})", True)
    step, places, slopes = depth / CUBICS, [], []
    for k in range(CUBICS + 1):
        x, y = corner(before, after, k * step) if k else start
        u, v = corner_slope(before, after, (x, y))
        places.append((x, y, side.wall + side.up * k * step))
        slopes.append((step * u, step * v, step * side.up))
    return edge(file, *ends, smooth_curve(file, places, slopes), True)
