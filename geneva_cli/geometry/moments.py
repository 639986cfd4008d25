"""Area, first moments and polar moment of the inside of outlines, by Green's theorem.

Gauss's eight points are exact for cubics, and to rounding for arcs of a radian or less.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from geneva_cli.geometry.measure import STRAIGHT, at, directions, segment_length
from geneva_cli.geometry.shapes import (
    Arc,
    Circle,
    Contour,
    Cubic,
    Line,
    Point,
    Shape,
    as_contour,
    backwards,
)

# Gauss-Legendre's abscissae and weights of eight points on -1..1, of which four are below 0
GAUSS = (
    (0.18343464249564980, 0.36268378337836198),
    (0.52553240991632899, 0.31370664587788729),
    (0.79666647741362674, 0.22238103445337447),
    (0.96028985649753623, 0.10122853629037626),
)
RADIAN = math.tan(0.25)  # the bulge of an arc of one


class Moments(NamedTuple):
    """Integrals of 1, x, y and x² + y² over the inside, about the origin; below 0 if clockwise."""

    area: float
    x: float
    y: float
    polar: float

    @property
    def centroid(self) -> Point:
        """Centre of mass of a uniform plate."""
        return self.x / self.area, self.y / self.area


def moments(shape: Shape) -> Moments:
    """Moments of a closed contour, or of a circle.

    They are those of the areas that the ray from the origin to a point of the outline sweeps.
    """
    if isinstance(shape, Circle):
        (x, y), square = shape.centre, shape.radius * shape.radius
        area = math.pi * square
        return Moments(area, area * x, area * y, area * (x * x + y * y + 0.5 * square))
    rows: list[tuple[float, float, float, float]] = []
    pieces = [*shape.segments]
    while pieces:
        piece = pieces.pop()
        if isinstance(piece, Arc) and abs(piece.bulge) > RADIAN:
            middle, bulge = at(piece, 0.5), math.tan(0.125 * piece.sweep)
            pieces += Arc(piece.start, middle, bulge), Arc(middle, piece.end, bulge)
            continue
        if isinstance(piece, Line) or (isinstance(piece, Arc) and abs(piece.bulge) < STRAIGHT):
            (a, b), (c, d) = piece.start, piece.end
            cross = a * d - b * c
            squares = (a * a + b * b) + (a * c + b * d) + (c * c + d * d)
            x, y = (a + c) / 6.0, (b + d) / 6.0
            rows.append((cross / 2.0, cross * x, cross * y, cross * squares / 12.0))
            continue
        if isinstance(piece, Arc):
            length, (first, _), sweep = segment_length(piece), directions(piece), piece.sweep
        own = []
        for node, weight in GAUSS:
            for t in (0.5 - 0.5 * node, 0.5 + 0.5 * node):
                x, y = at(piece, t)
                if isinstance(piece, Cubic):
                    dx, dy = _velocity(piece, t)
                else:
                    turn = first + t * sweep
                    dx, dy = length * math.cos(turn), length * math.sin(turn)
                swept = 0.5 * weight * (x * dy - y * dx)
                polar = 0.25 * (x * x + y * y)
                own.append((swept * 0.5, swept * (x / 3.0), swept * (y / 3.0), swept * polar))
        rows.append(total(own))
    return total(rows)


def _velocity(piece: Cubic, t: float) -> Point:
    """The derivative of a cubic's point by its parameter."""
    a, b, c = 3.0 * (1.0 - t) ** 2, 6.0 * t * (1.0 - t), 3.0 * t * t
    (x0, y0), (x1, y1), (x2, y2), (x3, y3) = piece
    return (
        a * (x1 - x0) + b * (x2 - x1) + c * (x3 - x2),
        a * (y1 - y0) + b * (y2 - y1) + c * (y3 - y2),
    )


def total(rows: Iterable[tuple[float, float, float, float]]) -> Moments:
    """Sum of the moments of several shapes."""
    return Moments(*map(math.fsum, zip((0.0, 0.0, 0.0, 0.0), *rows, strict=True)))


def with_material_left(shape: Shape, outside: bool) -> Contour:
    """Contour that runs counterclockwise as an outline, and clockwise as a hole."""
    contour = as_contour(shape)
    return contour if (moments(contour).area > 0.0) is outside else backwards(contour)


def oriented(outline: Shape, holes: Iterable[Shape]) -> list[Contour]:
    """A face's outline and holes as contours with the material on their left."""
    return [with_material_left(outline, True), *(with_material_left(h, False) for h in holes)]
