"""Curves of edges: lines, circles and splines at a height."""

from __future__ import annotations

import math

from geneva_cli.curves.shapes import Arc, Line, Point
from geneva_cli.output.step.entities import DIRECTION, Entities, listed, real
from geneva_cli.output.step.splines import Piece, Spline


def level(file: Entities, z: float) -> str:
    """The plane across the axis at a height."""
    return file.add(f"PLANE('',{file.placement((0.0, 0.0), z)})")


def curve(file: Entities, piece: Piece, z: float) -> str:
    """The text of a piece's curve."""
    if isinstance(piece, Line):
        vector = file.shared(f"VECTOR('',{file.direction(*unit_of(piece))},1.)")
        return f"LINE('',{file.point(piece.start, z)},{vector})"
    if isinstance(piece, Arc):
        return circle_at(file, piece.centre, piece.radius, z)
    return _spline(file, piece, z)


def _spline(file: Entities, spline: Spline, z: float) -> str:
    poles = listed([file.point(p, z) for p in spline.poles])
    count, knots = knots_of(spline)
    return (
        f"B_SPLINE_CURVE_WITH_KNOTS('',3,{poles},.UNSPECIFIED.,.F.,.F.,{count},{knots},"
        ".UNSPECIFIED.)"
    )


def knots_of(spline: Spline) -> tuple[str, str]:
    """The multiplicity of each knot, two where a cubic is once differentiable, and the knots."""
    count = listed(["4", *["2"] * (len(spline.knots) - 2), "4"])
    return count, listed([real(knot / spline.knots[-1], DIRECTION) for knot in spline.knots])


def unit_of(line: Line) -> Point:
    """The direction of a line."""
    (x0, y0), (x1, y1) = line
    length = math.dist(line.start, line.end)
    return (x1 - x0) / length, (y1 - y0) / length


def circle_at(file: Entities, centre: Point, radius: float, z: float) -> str:
    """The text of a circle at a height."""
    return f"CIRCLE('',{file.placement(centre, z)},{real(radius)})"
