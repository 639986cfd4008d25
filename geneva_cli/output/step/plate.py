"""A plate as a closed solid: planes, cylinders and extruded splines between its two faces.

All contours have the material on their left. Seen from outside, each wall is then bounded
counterclockwise: the lower edge, up at its end, the upper edge back, and down at its start.
"""

from __future__ import annotations

import math
from itertools import pairwise

from geneva_cli.geometry.plates import Plate, with_material_left
from geneva_cli.geometry.shapes import Arc, Circle, Line, Point
from geneva_cli.output.solid_part import plate_contours
from geneva_cli.output.splines import Piece, Spline, pieces
from geneva_cli.output.step.entities import DIRECTION, Entities, listed, real


def plate_solid(file: Entities, plate: Plate) -> str:
    """Write a plate, and return its MANIFOLD_SOLID_BREP."""
    faces: list[str] = []
    loops: tuple[list[str], list[str]] = [], []  # of the lower and the upper face
    levels = plate.low, plate.high
    outside = True
    for shape in plate_contours(plate):
        lower, upper = list[tuple[str, bool]](), list[tuple[str, bool]]()
        if isinstance(shape, Circle):
            (x, y), r = shape.centre, shape.radius
            *vertices, seam = _corner(file, plate, (x + r, y))
            low, high = (
                file.edge(vertex, vertex, _circle(file, shape, z))
                for vertex, z in zip(vertices, levels, strict=True)
            )
            sides = [(low, outside), (seam, True), (high, not outside), (seam, False)]
            cylinder = _cylinder(file, shape, plate.low)
            faces.append(file.face([file.loop(sides)], cylinder, outside))
            lower.append((low, not outside))
            upper.append((high, outside))
        else:
            own = pieces(with_material_left(shape, outside).segments)
            corners = [_corner(file, plate, piece.start) for piece in own]
            ends = pairwise([*corners, corners[0]])
            for piece, (start, end) in zip(own, ends, strict=True):
                curves = [_curve(file, piece, z) for z in levels]
                # arcs that turn clockwise run against their curve
                along = not isinstance(piece, Arc) or piece.bulge > 0.0
                low, high = (file.edge(start[k], end[k], curves[k], along) for k in (0, 1))
                sides = [(low, True), (end[2], True), (high, False), (start[2], False)]
                around = file.loop(sides)
                # a cylinder's own normal points away from its axis, that of the others to the right
                faces.append(file.face([around], _surface(file, piece, plate), along))
                lower.insert(0, (low, False))
                upper.append((high, True))
        loops[0].append(file.loop(lower))
        loops[1].append(file.loop(upper))
        outside = False
    for k, z in enumerate(levels):
        level = file.add(f"PLANE('',{file.placement((0.0, 0.0), z)})")
        faces.append(file.face(loops[k], level, k == 1))
    return file.closed_solid(faces)


def _corner(file: Entities, plate: Plate, at: Point) -> tuple[str, str, str]:
    """Write the lower and upper vertex of a corner, and the edge between them."""
    points = [file.point(at, z) for z in (plate.low, plate.high)]
    low, high = map(file.vertex, points)
    return low, high, file.edge(low, high, f"LINE('',{points[0]},{file.rise})")


def _curve(file: Entities, piece: Piece, z: float) -> str:
    """Return the text of a piece's curve at a height."""
    if isinstance(piece, Line):
        vector = file.shared(f"VECTOR('',{file.direction(*_unit(piece))},1.)")
        return f"LINE('',{file.point(piece.start, z)},{vector})"
    if isinstance(piece, Arc):
        return _circle(file, piece, z)
    points = listed([file.point(pole, z) for pole in piece.poles])
    count, knots = _knots(piece)
    return (
        f"B_SPLINE_CURVE_WITH_KNOTS('',3,{points},.UNSPECIFIED.,.F.,.F.,{count},{knots},"
        ".UNSPECIFIED.)"
    )


def _surface(file: Entities, piece: Piece, plate: Plate) -> str:
    """Write the surface over a piece."""
    if isinstance(piece, Line):
        x, y = _unit(piece)
        axis, ahead = file.direction(y, -x), file.direction(x, y)
        return file.add(f"PLANE('',{file.placement(piece.start, plate.low, axis, ahead)})")
    if isinstance(piece, Arc):
        return _cylinder(file, piece, plate.low)
    # The surface is a spline too: kernels integrate between knots, which they do not find in an
    # extruded curve.
    levels = plate.low, plate.high
    poles = listed([listed([file.point(p, z) for z in levels]) for p in piece.poles])
    count, knots = _knots(piece)
    return file.add(
        f"B_SPLINE_SURFACE_WITH_KNOTS('',3,1,{poles},.UNSPECIFIED.,.F.,.F.,.F.,{count},(2,2),"
        f"{knots},(0.,1.),.UNSPECIFIED.)"
    )


def _knots(spline: Spline) -> tuple[str, str]:
    """Return the multiplicity of each knot, two where it is once differentiable, and the knots."""
    ends = spline.knots
    count = listed(["4", *["2"] * (len(ends) - 2), "4"])
    return count, listed([real(end / ends[-1], DIRECTION) for end in ends])


def _unit(line: Line) -> Point:
    (x0, y0), (x1, y1) = line
    length = math.dist(line.start, line.end)
    return (x1 - x0) / length, (y1 - y0) / length


def _circle(file: Entities, piece: Arc | Circle, z: float) -> str:
    return f"CIRCLE('',{file.placement(piece.centre, z)},{real(piece.radius)})"


def _cylinder(file: Entities, piece: Arc | Circle, z: float) -> str:
    place = file.placement(piece.centre, z)
    return file.shared(f"CYLINDRICAL_SURFACE('',{place},{real(piece.radius)})")
