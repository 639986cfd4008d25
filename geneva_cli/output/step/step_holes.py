"""Holes across a plate's axis: cylinders between two walls, and loops in those walls.

Where a cylinder meets a cylinder the edge is no circle. It is written as a spline of cubics in the
hole's angle, which have the exact ends and tangents.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.geometry.cross_holes import CrossHole, Opening
from geneva_cli.geometry.moments import with_material_left
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import Circle, Shape
from geneva_cli.output.splines import Piece
from geneva_cli.output.step.curves import smooth_curve
from geneva_cli.output.step.entities import Entities, edge, face, loop, real

CUBICS = 128  # of an edge: their error is 5e-9 of the hole's radius, a hundredth of the file's


class BoredWalls(NamedTuple):
    """The faces of cross holes, and the loops that they cut into walls, by the wall's piece."""

    faces: list[str]
    loops: dict[Piece, list[str]]


class Rim(NamedTuple):
    """The edge of a hole in a wall, and the vertex at its top."""

    at: str
    point: str
    edge: str


def bored_walls(file: Entities, plate: Plate, shapes: Sequence[Shape]) -> BoredWalls:
    """Write the cross holes of a plate with these contours."""
    oriented = [
        shape if isinstance(shape, Circle) else with_material_left(shape, i == 0)
        for i, shape in enumerate(shapes)
    ]
    bored = BoredWalls([], {})
    for hole in plate.cross:
        ends = hole.openings(oriented)
        low, high = (_rim(file, hole, opening) for opening in ends)
        vector = file.shared(f"VECTOR('',{_ahead(file, hole)},1.)")
        rise = edge(file, low.at, high.at, f"LINE('',{low.point},{vector})", True)
        sides = [(low.edge, False), (rise, True), (high.edge, True), (rise, False)]
        place = file.placement(hole.at, hole.height, _ahead(file, hole), file.up)
        cylinder = file.add(f"CYLINDRICAL_SURFACE('',{place},{real(hole.radius)})")
        bored.faces.append(face(file, [loop(file, sides)], cylinder, False))
        for opening, rim, along in zip(ends, (low, high), (True, False), strict=True):
            bored.loops.setdefault(opening.piece, []).append(loop(file, [(rim.edge, along)]))
    return bored


def _ahead(file: Entities, hole: CrossHole) -> str:
    return file.direction(math.cos(hole.turn), math.sin(hole.turn))


def _rim(file: Entities, hole: CrossHole, opening: Opening) -> Rim:
    """Write the edge of a hole in a wall, counterclockwise about the hole's direction."""
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
    return Rim(vertex, point, edge(file, vertex, vertex, curve, True))
