"""Area, first moments and polar moment of the inside of outlines, by Green's theorem.

Lines are in closed form. Arcs and cubics use Gauss's eight points. These are exact for a cubic's
polynomials of degree eleven, and to rounding for the sines of an arc of a radian or less.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from geneva_cli.geometry.measure import GAUSS, STRAIGHT, halves, mapped
from geneva_cli.geometry.shapes import (
    Arc,
    Circle,
    Contour,
    Cubic,
    Line,
    Point,
    Segment,
    Shape,
    as_contour,
    backwards,
)


class Moments(NamedTuple):
    """Integrals of 1, x, y and x² + y² over the inside, about the origin.

    Units are those of the coordinates to the second, third, third and fourth power. Values are
    negative if the outline runs clockwise.
    """

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

    def less(self, other: Moments) -> Moments:
        """Moments of a plate after another is cut out of it."""
        return Moments(*[a - b for a, b in zip(self, other, strict=True)])


def moments(shape: Shape) -> Moments:
    """Moments of a closed contour, or of a circle.

    >>> moments(Circle("BORE", (3.0, 0.0), 1.0)).polar / math.pi  # 1/2 and, by Steiner, 3²
    9.5
    """
    if isinstance(shape, Circle):
        (x, y), square = shape.centre, shape.radius * shape.radius
        area = math.pi * square
        return Moments(area, area * x, area * y, area * (x * x + y * y + 0.5 * square))
    parts = [_swept(piece) for segment in shape.segments for piece in _small(segment)]
    return total(parts)


def area(shape: Shape) -> float:
    """Area inside, positive if the contour runs counterclockwise.

    An open contour is closed by the chord from its end to its start. Moments are taken about the
    first point, so that a shape far from the origin loses no digits.
    """
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


def _small(segment: Segment) -> Iterator[Segment]:
    """The segment in pieces that are integrated exactly."""
    # eight points integrate the sines of an arc of 1 radian to rounding
    if isinstance(segment, Arc) and abs(segment.sweep) > 1.0:
        for half in halves(segment):
            yield from _small(half)
    else:
        yield segment


def _swept(segment: Segment) -> Moments:
    """Moments of the area that the ray from the origin to the segment's point sweeps."""
    if isinstance(segment, Cubic):
        return _of_cubic(segment)
    whole = _triangle(segment.start, segment.end)
    if isinstance(segment, Line) or abs(segment.bulge) < STRAIGHT:
        return whole
    return total((whole, _cap(segment)))


def _triangle(p: Point, q: Point) -> Moments:
    (a, b), (c, d) = p, q
    cross = a * d - b * c
    squares = (a * a + b * b) + (a * c + b * d) + (c * c + d * d)
    return Moments(
        cross / 2.0, cross * (a + c) / 6.0, cross * (b + d) / 6.0, cross * squares / 12.0
    )


def _cap(arc: Arc) -> Moments:
    """Moments between an arc and its chord, in the chord's frame: x along it, y the arc's height.

    y = 2 r sin((h + t)/2) sin((h - t)/2) at t = -h..h, with half the sweep h, does not cancel.
    """
    (x0, y0), (x1, y1) = arc.start, arc.end
    chord, half = math.dist(arc.start, arc.end), 0.5 * abs(arc.sweep)
    r = 0.5 * chord / math.sin(half)
    area = first = own = 0.0
    for node, weight in GAUSS:  # the cap is symmetric
        t = node * half
        x, y = r * math.sin(t), 2.0 * r * math.sin(0.5 * (half + t)) * math.sin(0.5 * (half - t))
        part = 2.0 * weight * half * r * math.cos(t)  # dx
        area += part * y
        first += part * y * y / 2.0
        own += part * (x * x * y + y * y * y / 3.0)
    sign = math.copysign(1.0, arc.bulge)
    # the middle of the chord, and the direction from it to the arc: right if counterclockwise
    m, n = (0.5 * (x0 + x1), 0.5 * (y0 + y1)), (sign * (y1 - y0) / chord, sign * (x0 - x1) / chord)
    polar = own + area * (m[0] * m[0] + m[1] * m[1]) + 2.0 * first * (m[0] * n[0] + m[1] * n[1])
    moved = area * m[0] + first * n[0], area * m[1] + first * n[1]
    return Moments(sign * area, sign * moved[0], sign * moved[1], sign * polar)


def _of_cubic(cubic: Cubic) -> Moments:
    sums = [0.0, 0.0, 0.0, 0.0]
    for node, weight in GAUSS:
        for t in (0.5 - 0.5 * node, 0.5 + 0.5 * node):
            u = 1.0 - t
            at = (u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t)
            by = (-3.0 * u * u, 3.0 * u * (u - 2.0 * t), 3.0 * t * (2.0 * u - t), 3.0 * t * t)
            x, y = (sum(b * p[k] for b, p in zip(at, cubic, strict=True)) for k in (0, 1))
            dx, dy = (sum(b * p[k] for b, p in zip(by, cubic, strict=True)) for k in (0, 1))
            swept = 0.5 * weight * (x * dy - y * dx)
            for k, (part, of) in enumerate(((0.5, 1.0), (1 / 3, x), (1 / 3, y))):
                sums[k] += swept * part * of
            sums[3] += swept * 0.25 * (x * x + y * y)
    return Moments(*sums)
