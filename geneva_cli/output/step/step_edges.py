"""Chamfers and roundings around a plate's faces, up to the edges of the faces.

A chamfer is a plane over a line and a cone over an arc, a rounding a cylinder and a torus. Where
two meet in a corner, their edge runs through the corners of all insets. Between lines or tangent
pieces it lies in a plane: it is a line, or the quarter of an ellipse for roundings. Otherwise it is
a spline with the exact ends and tangents.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.geometry.inset import corner, corner_slope, inset, lines_and_arcs
from geneva_cli.geometry.plates import Edge, Plate
from geneva_cli.geometry.shapes import Arc, Contour, Line
from geneva_cli.output.step.entities import (
    DIRECTION,
    Entities,
    SolidCorner,
    WallFace,
    curve,
    edge,
    face,
    is_along,
    loop,
    real,
    smooth_curve,
    unit_of,
)

CUBICS = 16  # of an edge that is a spline: their error is a millionth of its size and less


class Side(NamedTuple):
    """One of the two faces of a plate: its height, that of the wall's edge, and +1 if it is up."""

    z: float
    wall: float
    up: float


def edge_faces(
    file: Entities,
    plate: Plate,
    contour: Contour,
    corners: list[SolidCorner],
    walls: list[WallFace],
) -> list[list[str]]:
    """Write the chamfers or roundings around one contour.

    Return their faces, and the curves around the lower and the upper face of the plate.
    """
    own = lines_and_arcs(contour)
    inner = lines_and_arcs(inset(own, contour.layer, plate.edge.size))
    sides = (
        Side(plate.low, plate.low + plate.edge.size, -1.0),
        Side(plate.high, plate.high - plate.edge.size, 1.0),
    )
    faces, edges = [], []
    for side in sides:
        ends = [file.add(f"VERTEX_POINT('',{file.point(one.start, side.z)})") for one in inner]
        rises = [
            edge(
                file,
                at.high if side.up > 0.0 else at.low,
                ends[k],
                _rise(file, (own[k - 1], own[k]), side, plate.edge),
                True,
            )
            for k, at in enumerate(corners)
        ]
        own_edges = []
        for k, (piece, within, wall) in enumerate(zip(own, inner, walls, strict=True)):
            after = (k + 1) % len(own)
            on = edge(file, ends[k], ends[after], curve(file, within, side.z), is_along(within))
            below = wall.high if side.up > 0.0 else wall.low
            around = [(below, True), (rises[after], True), (on, False), (rises[k], False)]
            if side.up < 0.0:
                around = [(one, not forward) for one, forward in reversed(around)]
            if plate.edge.rounded:
                surface, outwards = _rounding(file, piece, side), True
            else:
                surface = _slope(file, piece, side)
                outwards = is_along(piece)
            faces.append(face(file, [loop(file, around)], surface, outwards))
            own_edges.append(on)
        edges.append(own_edges)
    return [faces, *edges]


def _slope(file: Entities, piece: Line | Arc, side: Side) -> str:
    if isinstance(piece, Line):
        (x, y), tilt = unit_of(piece), math.sqrt(0.5)
        axis = file.direction(tilt * y, -tilt * x, tilt * side.up)
        place = file.placement(piece.start, side.wall, axis, file.direction(x, y))
        return file.add(f"PLANE('',{place})")
    # a cone is wider along its axis: towards the wall where the material is inside
    up = -side.up if piece.bulge > 0.0 else side.up
    place = file.placement(piece.centre, side.wall, file.direction(0.0, 0.0, up))
    angle = real(0.25 * math.pi, DIRECTION)
    return file.add(f"CONICAL_SURFACE('',{place},{real(piece.radius)},{angle})")


def _rounding(file: Entities, piece: Line | Arc, side: Side) -> str:
    """Write the cylinder or the torus of a rounding; both have the material inside the tube."""
    r = abs(side.z - side.wall)
    if isinstance(piece, Line):
        (x, y), (x0, y0) = unit_of(piece), piece.start
        middle = x0 - r * y, y0 + r * x
        place = file.placement(middle, side.wall, file.direction(x, y), file.up)
        return file.add(f"CYLINDRICAL_SURFACE('',{place},{real(r)})")
    major = piece.radius - math.copysign(r, piece.bulge)
    own = f"{file.placement(piece.centre, side.wall)},{real(major)},{real(r)}"
    if major < r:  # the tube meets itself on its axis; the face is outside
        return file.add(f"DEGENERATE_TOROIDAL_SURFACE('',{own},.T.)")
    return file.add(f"TOROIDAL_SURFACE('',{own})")


def _rise(file: Entities, pieces: tuple[Line | Arc, Line | Arc], side: Side, own: Edge) -> str:
    before, after = pieces
    start, end = after.start, corner(before, after, own.size)
    across = (end[0] - start[0]) / own.size, (end[1] - start[1]) / own.size  # per depth
    wide = math.hypot(*across)
    straight = isinstance(before, Line) and isinstance(after, Line)
    if straight or abs(wide - 1.0) < 1e-9:  # of tangent pieces, along the normal
        if own.rounded:
            outwards = file.direction(-across[0] / wide, -across[1] / wide)
            # x points from the middle to the wall's corner, and y up to the face's
            side_on = file.direction(-across[1] / wide * side.up, across[0] / wide * side.up)
            place = file.placement(end, side.wall, side_on, outwards)
            return f"ELLIPSE('',{place},{real(wide * own.size)},{real(own.size)})"
        long = math.hypot(wide, 1.0)
        heading = file.direction(across[0] / long, across[1] / long, side.up / long)
        vector = file.shared(f"VECTOR('',{heading},1.)")
        return f"LINE('',{file.point(start, side.wall)},{vector})"
    places, slopes = [], []
    for k in range(CUBICS + 1):
        (depth, height), (deeper, rise) = own.at(k / CUBICS), own.slope(k / CUBICS)
        x, y = corner(before, after, depth) if k else start
        u, v = corner_slope(before, after, (x, y))
        places.append((x, y, side.wall + side.up * height))
        slopes.append((deeper * u / CUBICS, deeper * v / CUBICS, side.up * rise / CUBICS))
    return smooth_curve(file, places, slopes)
