"""Curves of edges: lines, circles and splines at a height."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TypeAlias

from geneva_cli.geometry.shapes import Arc, Line, Point
from geneva_cli.output.splines import Piece
from geneva_cli.output.step.entities import DIRECTION, Entities, listed, real

Place: TypeAlias = tuple[float, float, float]


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
    return _cubics(file, [(*p, z) for p in piece.poles], piece.knots)


def is_along(piece: Piece) -> bool:
    """Return True if a piece runs as its curve does: all but arcs that turn clockwise."""
    return not isinstance(piece, Arc) or piece.bulge > 0.0


def smooth_curve(file: Entities, places: Sequence[Place], slopes: Sequence[Place]) -> str:
    """The text of a curve of cubics with these ends, and slopes per cubic; closed at one place."""
    poles: list[Place] = []
    for (x, y, z), (u, v, w) in zip(places, slopes, strict=True):
        before = x - u / 3.0, y - v / 3.0, z - w / 3.0
        after = x + u / 3.0, y + v / 3.0, z + w / 3.0
        poles += [before, after]
    poles = [places[0], *poles[1:-1], places[-1]]
    return _cubics(file, poles, range(len(places)), closed=places[0] == places[-1])


def _cubics(
    file: Entities, poles: Iterable[Place], ends: Sequence[float], closed: bool = False
) -> str:
    points = listed([file.point((x, y), z) for x, y, z in poles])
    count, knots = knots_of(ends)
    flag = ".T." if closed else ".F."
    return (
        f"B_SPLINE_CURVE_WITH_KNOTS('',3,{points},.UNSPECIFIED.,{flag},.F.,{count},{knots},"
        ".UNSPECIFIED.)"
    )


def knots_of(ends: Sequence[float]) -> tuple[str, str]:
    """The multiplicity of each knot, two where a cubic is once differentiable, and the knots."""
    count = listed(["4", *["2"] * (len(ends) - 2), "4"])
    return count, listed([real(end / ends[-1], DIRECTION) for end in ends])


def unit_of(line: Line) -> Point:
    """The direction of a line."""
    (x0, y0), (x1, y1) = line
    length = math.dist(line.start, line.end)
    return (x1 - x0) / length, (y1 - y0) / length


def circle_at(file: Entities, centre: Point, radius: float, z: float) -> str:
    """The text of a circle at a height."""
    return f"CIRCLE('',{file.placement(centre, z)},{real(radius)})"
