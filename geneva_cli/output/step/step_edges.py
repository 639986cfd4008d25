"""Chamfers and roundings around a plate's faces, up to the edges of the faces.

A chamfer is a plane over a line and a cone over an arc, a rounding a cylinder and a torus. Where
two meet in a corner, their edge runs through the corners of all insets. Between lines or tangent
pieces it lies in a plane: it is a line, or the quarter of an ellipse for roundings. Otherwise it is
a spline with the exact ends and tangents.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.geometry.inset import corner, corner_slope, inset, lines_and_arcs
from geneva_cli.geometry.moments import with_material_left
from geneva_cli.geometry.plates import Edge, Plate
from geneva_cli.geometry.round_holes import CrossHole, Opening
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Shape
from geneva_cli.output.splines import Piece
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


CUBICS = 128  # of an edge: their error is 5e-9 of the hole's radius, a hundredth of the file's


def bored_walls(
    file: Entities, plate: Plate, shapes: Sequence[Shape]
) -> tuple[list[str], dict[Piece, list[str]]]:
    """Write the cross holes of a plate with these contours.

    Return their faces, and the loops that they cut into walls, by the wall's piece.
    """
    oriented = [
        shape if isinstance(shape, Circle) else with_material_left(shape, i == 0)
        for i, shape in enumerate(shapes)
    ]
    faces: list[str] = []
    loops: dict[Piece, list[str]] = {}
    for hole in plate.cross:
        ends = hole.openings(oriented)
        low, high = (_rim(file, hole, opening) for opening in ends)
        vector = file.shared(f"VECTOR('',{_ahead(file, hole)},1.)")
        rise = edge(file, low[0], high[0], f"LINE('',{low[1]},{vector})", True)
        sides = [(low[2], False), (rise, True), (high[2], True), (rise, False)]
        place = file.placement(hole.at, hole.height, _ahead(file, hole), file.up)
        cylinder = file.add(f"CYLINDRICAL_SURFACE('',{place},{real(hole.radius)})")
        faces.append(face(file, [loop(file, sides)], cylinder, False))
        for opening, rim, along in zip(ends, (low[2], high[2]), (True, False), strict=True):
            loops.setdefault(opening.piece, []).append(loop(file, [(rim, along)]))
    return faces, loops


def _ahead(file: Entities, hole: CrossHole) -> str:
    return file.direction(math.cos(hole.turn), math.sin(hole.turn))


def _rim(file: Entities, hole: CrossHole, opening: Opening) -> tuple[str, str, str]:
    """Write the edge of a hole in a wall; return the vertex at its top, its point, and it."""
    r, step = hole.radius, math.tau / CUBICS
    c, s = math.cos(hole.turn), math.sin(hole.turn)
    places, slopes = [], []
    for k in range(CUBICS):
        # quarter turns at once, so that the last pole is the first one
        y, up = -r * math.sin(step * k), r * math.cos(step * k)
        x, y1, up1 = opening.x(y), -up, y
        places.append((*hole.placed(x, y), hole.height + up))
        x1 = opening.slope(y) * y1
        slopes.append((step * (c * x1 - s * y1), step * (s * x1 + c * y1), step * up1))
    curve = smooth_curve(file, [*places, places[0]], [*slopes, slopes[0]])
    x, y, z = places[0]
    point = file.point((x, y), z)
    vertex = file.add(f"VERTEX_POINT('',{point})")
    return vertex, point, edge(file, vertex, vertex, curve, True)
