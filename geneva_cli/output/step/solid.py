"""A plate as a closed solid: planes, cylinders and extruded splines between its two faces.

All contours have the material on their left. Seen from outside, each wall is then bounded
counterclockwise: the lower edge, up at its end, the upper edge back, and down at its start.
"""

from __future__ import annotations

from itertools import pairwise

from geneva_cli.geometry.moments import with_material_left
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import Arc, Circle, Line, Point
from geneva_cli.output.solid_part import plate_contours
from geneva_cli.output.splines import Piece, pieces
from geneva_cli.output.step.entities import (
    Entities,
    SolidCorner,
    WallFace,
    circle_at,
    closed_solid,
    curve,
    edge,
    face,
    is_along,
    knots_of,
    level,
    listed,
    loop,
    real,
    unit_of,
)


def solid(file: Entities, plate: Plate) -> str:
    """The number of the plate's MANIFOLD_SOLID_BREP.

    Raises GenevaError for a coordinate that is not finite, or a plate without thickness.
    """
    faces, lower, upper = [], [], []
    outside = True
    shapes = plate_contours(plate)
    for shape in shapes:
        if isinstance(shape, Circle):
            walls = [_round(file, plate, shape, outside)]
        else:
            contour = with_material_left(shape, outside)
            own = pieces(contour.segments)
            ends = [_place(file, plate, piece.start) for piece in own]
            walls = [
                _wall(file, plate, piece, pair)
                for piece, pair in zip(own, pairwise([*ends, ends[0]]), strict=True)
            ]
        faces += [wall.face for wall in walls]
        lower.append(loop(file, [(wall.low, not wall.along) for wall in reversed(walls)]))
        upper.append(loop(file, [(wall.high, wall.along) for wall in walls]))
        outside = False
    faces.append(face(file, lower, level(file, plate.low), False))
    faces.append(face(file, upper, level(file, plate.high), True))
    return closed_solid(file, faces)


def _place(file: Entities, plate: Plate, at: Point) -> SolidCorner:
    points = [file.point(at, z) for z in (plate.low, plate.high)]
    low, high = (file.add(f"VERTEX_POINT('',{point})") for point in points)
    return SolidCorner(low, high, edge(file, low, high, f"LINE('',{points[0]},{file.rise})", True))


def _wall(
    file: Entities,
    plate: Plate,
    piece: Piece,
    ends: tuple[SolidCorner, SolidCorner],
) -> WallFace:
    start, end = ends
    curves = [curve(file, piece, z) for z in (plate.low, plate.high)]
    along = is_along(piece)
    low = edge(file, start.low, end.low, curves[0], along)
    high = edge(file, start.high, end.high, curves[1], along)
    sides = loop(file, [(low, True), (end.edge, True), (high, False), (start.edge, False)])
    # a cylinder's own normal points away from its axis, that of the others to the right
    wall = face(file, [sides], surface(file, piece, plate), along)
    return WallFace(wall, low, high, True)


def _round(file: Entities, plate: Plate, circle: Circle, outside: bool) -> WallFace:
    (x, y), r = circle.centre, circle.radius
    seam = _place(file, plate, (x + r, y))
    low, high = (
        edge(file, vertex, vertex, circle_at(file, circle.centre, r, z), True)
        for vertex, z in ((seam.low, plate.low), (seam.high, plate.high))
    )
    sides = [(low, outside), (seam.edge, True), (high, not outside), (seam.edge, False)]
    surface = _cylinder(file, circle.centre, r, plate.low)
    return WallFace(face(file, [loop(file, sides)], surface, outside), low, high, outside)


def surface(file: Entities, piece: Piece, plate: Plate) -> str:
    """The surface over a piece."""
    if isinstance(piece, Line):
        x, y = unit_of(piece)
        axis, ahead = file.direction(y, -x), file.direction(x, y)
        return file.add(f"PLANE('',{file.placement(piece.start, plate.low, axis, ahead)})")
    if isinstance(piece, Arc):
        return _cylinder(file, piece.centre, piece.radius, plate.low)
    # The surface is a spline too: kernels integrate between knots, which they do not find in an
    # extruded curve.
    levels = plate.low, plate.high
    poles = listed([listed([file.point(p, z) for z in levels]) for p in piece.poles])
    count, knots = knots_of(piece.knots)
    return file.add(
        f"B_SPLINE_SURFACE_WITH_KNOTS('',3,1,{poles},.UNSPECIFIED.,.F.,.F.,.F.,{count},(2,2),"
        f"{knots},(0.,1.),.UNSPECIFIED.)"
    )


def _cylinder(file: Entities, centre: Point, radius: float, z: float) -> str:
    return file.shared(f"CYLINDRICAL_SURFACE('',{file.placement(centre, z)},{real(radius)})")
