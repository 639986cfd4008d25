"""Area, first moments and polar moment of the inside of outlines, by Green's theorem.

Gauss's eight points are exact for cubics, and to rounding for arcs of a radian or less.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from geneva_cli.geometry.measure import (
    STRAIGHT,
    at,
    directions,
    halved,
    mapped,
    segment_length,
)
from geneva_cli.geometry.shapes import (
    Arc,
    Circle,
    Contour,
    Line,
    Point,
    Segment,
    Shape,
    as_contour,
    backwards,
)

# Gauss-Legendre's abscissae and weights of eight points on 0..1
GAUSS = tuple(
    (0.5 + 0.5 * sign * node, 0.5 * weight)
    for node, weight in (
        (0.18343464249564980, 0.36268378337836198),
        (0.52553240991632899, 0.31370664587788729),
        (0.79666647741362674, 0.22238103445337447),
        (0.96028985649753623, 0.10122853629037626),
    )
    for sign in (-1.0, 1.0)
)


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

    def times(self, factor: float) -> Moments:
        """Moments multiplied by a factor."""
        return Moments(*[factor * part for part in self])


def moments(shape: Shape) -> Moments:
    """Moments of a closed contour, or of a circle."""
    if isinstance(shape, Circle):
        (x, y), square = shape.centre, shape.radius * shape.radius
        area = math.pi * square
        return Moments(area, area * x, area * y, area * (x * x + y * y + 0.5 * square))
    radian = math.tan(0.25)  # the bulge of an arc of one
    pieces = (p for s in shape.segments for p in halved(s, lambda bulge: bulge > radian))
    return total(map(_swept, pieces))


def area(shape: Shape) -> float:
    """Area inside, positive if the contour runs counterclockwise; a chord closes an open one."""
    if isinstance(shape, Circle):
        return math.pi * shape.radius * shape.radius
    if not shape.segments:
        return 0.0
    x, y = shape.segments[0].start
    return moments(mapped(shape, lambda p: (p[0] - x, p[1] - y))).area


def with_material_left(shape: Contour, outside: bool) -> Contour:
    """Contour that runs counterclockwise as an outline, and clockwise as a hole."""
    return shape if (area(shape) > 0.0) is outside else backwards(shape)


def oriented(outline: Shape, holes: Iterable[Shape]) -> list[Contour]:
    """A face's outline and holes as contours with the material on their left."""
    inner = [with_material_left(as_contour(hole), False) for hole in holes]
    return [with_material_left(as_contour(outline), True), *inner]


def total(parts: Iterable[Moments]) -> Moments:
    """Sum of the moments of several shapes."""
    rows = list(parts) or [Moments(0.0, 0.0, 0.0, 0.0)]
    return Moments(*map(math.fsum, zip(*rows, strict=True)))


def _swept(segment: Segment) -> Moments:
    """Moments of the area that the ray from the origin to the segment's point sweeps."""
    (a, b), (c, d) = segment.start, segment.end
    if isinstance(segment, Line) or (isinstance(segment, Arc) and abs(segment.bulge) < STRAIGHT):
        cross = a * d - b * c
        squares = (a * a + b * b) + (a * c + b * d) + (c * c + d * d)
        thirds = (a + c) / 6.0, (b + d) / 6.0
        return Moments(cross / 2.0, cross * thirds[0], cross * thirds[1], cross * squares / 12.0)
    rows = []
    for t, weight in GAUSS:
        x, y = at(segment, t)
        if isinstance(segment, Arc):
            length = segment_length(segment)
            direction = directions(segment)[0] + t * segment.sweep
            dx, dy = length * math.cos(direction), length * math.sin(direction)
        else:
            by = 3.0 * (1.0 - t) ** 2, 6.0 * t * (1.0 - t), 3.0 * t * t
            steps = [(q[0] - p[0], q[1] - p[1]) for p, q in zip(segment, segment[1:], strict=False)]
            dx, dy = (sum(b * step[k] for b, step in zip(by, steps, strict=True)) for k in (0, 1))
        swept = weight * (x * dy - y * dx)
        rows.append(Moments(0.5, x / 3.0, y / 3.0, 0.25 * (x * x + y * y)).times(swept))
    return total(rows)
