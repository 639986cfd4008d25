"""A plate as a closed solid: planes, cylinders and extruded splines between its two faces.

All contours have the material on their left. Seen from outside, each wall is then bounded
counterclockwise: the lower edge, up at its end, the upper edge back, and down at its start.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.curves.measure import with_material_left
from geneva_cli.curves.plates import Plate
from geneva_cli.curves.shapes import Arc, Circle, Contour, Line, Point
from geneva_cli.output.solid_part import plate_contours
from geneva_cli.output.step.cross_holes import bored_walls
from geneva_cli.output.step.entities import (
    DIRECTION,
    Entities,
    WallFace,
    closed_solid,
    edge,
    face,
    listed,
    loop,
    real,
)
from geneva_cli.output.step.splines import Piece, Spline, pieces


class SolidCorner(NamedTuple):
    """A corner of a contour: its lower and upper vertex, and the edge between them."""

    low: str
    high: str
    edge: str


def solid(file: Entities, plate: Plate) -> str:
    """The number of the plate's MANIFOLD_SOLID_BREP.

    Raises GenevaError for a coordinate that is not finite, or a plate without thickness.
    """
    faces, lower, upper = [], [], []
    outside = True
    shapes = plate_contours(plate)
    bored = bored_walls(file, plate, shapes)
    for shape in shapes:
        walls = (
            [_round(file, plate, shape, outside)]
            if isinstance(shape, Circle)
            else _walls(file, plate, with_material_left(shape, outside), bored.loops)
        )
        faces += [wall.face for wall in walls]
        lower.append(loop(file, [(wall.low, not wall.along) for wall in reversed(walls)]))
        upper.append(loop(file, [(wall.high, wall.along) for wall in walls]))
        outside = False
    faces += bored.faces
    faces.append(face(file, lower, level(file, plate.low), False))
    faces.append(face(file, upper, level(file, plate.high), True))
    return closed_solid(file, faces)


def level(file: Entities, z: float) -> str:
    """The plane across the axis at a height."""
    return file.add(f"PLANE('',{file.placement((0.0, 0.0), z)})")


def _walls(
    file: Entities, plate: Plate, contour: Contour, bored: dict[Piece, list[str]]
) -> list[WallFace]:
    chain = pieces(contour.segments)
    corners = [_place(file, plate, piece.start) for piece in chain]
    pairs = zip(corners, [*corners[1:], corners[0]], strict=True)
    return [
        _wall(file, plate, piece, ends, bored.get(piece, []))
        for piece, ends in zip(chain, pairs, strict=True)
    ]


def _place(file: Entities, plate: Plate, at: Point) -> SolidCorner:
    points = [file.point(at, z) for z in (plate.low, plate.high)]
    low, high = (file.add(f"VERTEX_POINT('',{point})") for point in points)
    return SolidCorner(low, high, edge(file, low, high, f"LINE('',{points[0]},{file.rise})", True))


def _wall(
    file: Entities,
    plate: Plate,
    piece: Piece,
    ends: tuple[SolidCorner, SolidCorner],
    holes: list[str],
) -> WallFace:
    start, end = ends
    curves = [curve(file, piece, z) for z in (plate.low, plate.high)]
    along = not isinstance(piece, Arc) or piece.bulge > 0.0
    low = edge(file, start.low, end.low, curves[0], along)
    high = edge(file, start.high, end.high, curves[1], along)
    sides = loop(file, [(low, True), (end.edge, True), (high, False), (start.edge, False)])
    # a cylinder's own normal points away from its axis, that of the others to the right
    wall = face(file, [sides, *holes], surface(file, piece, plate), along)
    return WallFace(wall, low, high, True)


def _round(file: Entities, plate: Plate, circle: Circle, outside: bool) -> WallFace:
    """The wall of a whole circle, cut open along a seam."""
    (x, y), r = circle.centre, circle.radius
    seam = _place(file, plate, (x + r, y))
    low, high = (
        edge(file, vertex, vertex, _circle(file, circle.centre, r, z), True)
        for vertex, z in ((seam.low, plate.low), (seam.high, plate.high))
    )
    sides = [(low, outside), (seam.edge, True), (high, not outside), (seam.edge, False)]
    surface = _cylinder(file, circle.centre, r, plate.low)
    return WallFace(face(file, [loop(file, sides)], surface, outside), low, high, outside)


def curve(file: Entities, piece: Piece, z: float) -> str:
    """The text of a piece's curve."""
    if isinstance(piece, Line):
        vector = file.shared(f"VECTOR('',{file.direction(*_direction(piece))},1.)")
        return f"LINE('',{file.point(piece.start, z)},{vector})"
    if isinstance(piece, Arc):
        return _circle(file, piece.centre, piece.radius, z)
    return _spline(file, piece, z)


def _spline(file: Entities, spline: Spline, z: float) -> str:
    poles = listed([file.point(p, z) for p in spline.poles])
    count, knots = _knots(spline)
    return (
        f"B_SPLINE_CURVE_WITH_KNOTS('',3,{poles},.UNSPECIFIED.,.F.,.F.,{count},{knots},"
        ".UNSPECIFIED.)"
    )


def _knots(spline: Spline) -> tuple[str, str]:
    """The multiplicity of each knot, two where a cubic is once differentiable, and the knots."""
    count = listed(["4", *["2"] * (len(spline.knots) - 2), "4"])
    return count, listed([real(knot / spline.knots[-1], DIRECTION) for knot in spline.knots])


def surface(file: Entities, piece: Piece, plate: Plate) -> str:
    """The surface over a piece."""
    if isinstance(piece, Line):
        x, y = _direction(piece)
        axis, ahead = file.direction(y, -x), file.direction(x, y)
        return file.add(f"PLANE('',{file.placement(piece.start, plate.low, axis, ahead)})")
    if isinstance(piece, Arc):
        return _cylinder(file, piece.centre, piece.radius, plate.low)
    # The surface is a spline too: kernels integrate between knots, which they do not find in an
    # extruded curve.
    levels = plate.low, plate.high
    poles = listed([listed([file.point(p, z) for z in levels]) for p in piece.poles])
    count, knots = _knots(piece)
    return file.add(
        f"B_SPLINE_SURFACE_WITH_KNOTS('',3,1,{poles},.UNSPECIFIED.,.F.,.F.,.F.,{count},(2,2),"
        f"{knots},(0.,1.),.UNSPECIFIED.)"
    )


def _direction(line: Line) -> Point:
    (x0, y0), (x1, y1) = line
    length = math.dist(line.start, line.end)
    return (x1 - x0) / length, (y1 - y0) / length


def _circle(file: Entities, centre: Point, radius: float, z: float) -> str:
    return f"CIRCLE('',{file.placement(centre, z)},{real(radius)})"


def _cylinder(file: Entities, centre: Point, radius: float, z: float) -> str:
    return file.shared(f"CYLINDRICAL_SURFACE('',{file.placement(centre, z)},{real(radius)})")
