"""Shapes: contours of lines, arcs and cubics on named layers, in millimetres.

Points are (x, y).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Literal, NamedTuple, TypeAlias

Point: TypeAlias = tuple[float, float]
ORIGIN: Point = (0.0, 0.0)
HULL_ROUNDING = 1e-12  # radians, and mm: directions and points nearer to each other are one
# The names of all layers: of drawings, sheets and animations. Shapes that are not drawn
# have none.
Layer: TypeAlias = Literal[
    "WHEEL", "CRANK", "ARM", "LINK", "FRAME", "GROOVE", "PITCH", "ROLLER", "BORE", "HUB", "SHAFT",
    "OUTLINE", "HIDDEN", "CENTER", "HATCH", "DIMENSION", "TEXT",
    "GEAR", "SLOT", "HOLLOW", "",
]  # fmt: skip


class Line(NamedTuple):
    """A straight piece."""

    start: Point
    end: Point


class Arc(NamedTuple):
    """An arc of a circle; ``bulge`` is tan(sweep / 4), positive counterclockwise, as in DXF."""

    start: Point
    end: Point
    bulge: float

    @property
    def sweep(self) -> float:
        """Angle of the arc, radians; positive counterclockwise."""
        return 4.0 * math.atan(self.bulge)

    @property
    def radius(self) -> float:
        """Radius: half the chord over the sine of half the sweep."""
        return 0.5 * math.dist(self.start, self.end) / abs(math.sin(0.5 * self.sweep))

    @property
    def centre(self) -> Point:
        """Centre, on the chord's perpendicular at half the chord over tan(sweep / 2)."""
        (x0, y0), (x1, y1) = self.start, self.end
        away = 0.25 * (1.0 - self.bulge * self.bulge) / self.bulge
        return 0.5 * (x0 + x1) - away * (y1 - y0), 0.5 * (y0 + y1) + away * (x1 - x0)


class Cubic(NamedTuple):
    """A cubic Bézier curve."""

    start: Point
    first: Point  # control points
    second: Point
    end: Point


Segment: TypeAlias = Line | Arc | Cubic


class Contour(NamedTuple):
    """Segments end to end; if ``closed``, the last ends exactly where the first starts."""

    layer: Layer
    segments: tuple[Segment, ...]
    closed: bool = True


class Circle(NamedTuple):
    """A full circle: a bore, a roller."""

    layer: Layer
    centre: Point
    radius: float


Shape: TypeAlias = Contour | Circle


def polar(centre: Point, radius: float, turn: float) -> Point:
    """Point in a direction, radians, at a distance from another point."""
    return centre[0] + radius * math.cos(turn), centre[1] + radius * math.sin(turn)


def about(centre: Point, radius: float, start: float, sweep: float) -> Arc:
    """Arc about a centre from the direction ``start`` on, both angles in radians."""
    begin, end = polar(centre, radius, start), polar(centre, radius, start + sweep)
    return Arc(begin, end, math.tan(0.25 * sweep))


def two_arcs(circle: Circle, start: float = 0.0) -> tuple[Arc, Arc]:
    """Both halves of a circle, counterclockwise from a direction in radians."""
    centre, radius = circle.centre, circle.radius
    return about(centre, radius, start, math.pi), about(centre, radius, start + math.pi, math.pi)


def as_contour(shape: Shape) -> Contour:
    """A closed shape as a contour: a circle as two arcs."""
    return closed(shape.layer, two_arcs(shape)) if isinstance(shape, Circle) else shape


def joined(segments: Iterable[Segment]) -> tuple[Segment, ...]:
    """Segments end to end, each changed to start exactly at the end of the one before."""
    out: list[Segment] = []
    for segment in segments:
        out.append(segment._replace(start=out[-1].end) if out else segment)
    return tuple(out)


def closed(layer: Layer, segments: Iterable[Segment]) -> Contour:
    """A closed contour: ends that differ by rounding become one point."""
    pieces = joined(segments)
    return Contour(layer, (*pieces[:-1], pieces[-1]._replace(end=pieces[0].start)))


def polygon(layer: Layer, corners: Sequence[Point]) -> Contour:
    """A closed contour of lines between corners."""
    after = [*corners[1:], corners[0]]
    return closed(layer, [Line(p, q) for p, q in zip(corners, after, strict=True)])


def backwards(contour: Contour) -> Contour:
    """The contour with the opposite sense of travel."""
    pieces: list[Segment] = []
    for piece in reversed(contour.segments):
        if isinstance(piece, Cubic):
            pieces.append(Cubic(piece.end, piece.second, piece.first, piece.start))
        elif isinstance(piece, Arc):
            pieces.append(Arc(piece.end, piece.start, -piece.bulge))
        else:
            pieces.append(Line(piece.end, piece.start))
    return contour._replace(segments=tuple(pieces))


def convex_hull(layer: Layer, circles: Sequence[Circle]) -> Contour:
    """Convex hull of circles, counterclockwise: arcs on circles, and lines between them.

    It touches a circle in the directions in which this circle reaches farthest. Going round, the
    next circle takes over where both reach equally far, on their common tangent.
    """
    here, turned = circles[0], 0.0
    for one in circles:  # the farthest along x
        ahead = one.centre[0] + one.radius - (here.centre[0] + here.radius)
        if ahead > 0.0 or (ahead == 0.0 and one.centre[1] >= here.centre[1]):
            here = one
    arcs: list[tuple[Circle, float, float]] = []
    while turned < math.tau:
        # the angle to the next circle, and that circle: a whole turn if there is none
        step, far, after = math.tau, 0.0, here
        for other in circles:
            x, y = other.centre[0] - here.centre[0], other.centre[1] - here.centre[1]
            apart, less = math.hypot(x, y), here.radius - other.radius
            if apart <= abs(less) * (1.0 + HULL_ROUNDING) or other == here:
                continue  # one circle holds the other
            at = math.atan2(y, x) - math.acos(less / apart)
            to = max((at - turned + HULL_ROUNDING) % math.tau - HULL_ROUNDING, 0.0)
            if to < step - HULL_ROUNDING or (to < step + HULL_ROUNDING and apart > far):
                step, far, after = to, apart, other
        step = min(step, math.tau - turned)
        if arcs and turned + step == math.tau and arcs[0][0] == here:
            first, _, sweep = arcs[0]
            arcs[0] = first, turned - math.tau, step + sweep  # the hull starts within this arc
        else:
            arcs.append((here, turned, step))
        turned += step
        here = after
    pieces: list[Segment] = []
    for circle, start, sweep in arcs:
        arc = about(circle.centre, circle.radius, start, sweep)
        if pieces and math.dist(pieces[-1].end, arc.start) > HULL_ROUNDING:
            pieces.append(Line(pieces[-1].end, arc.start))
        if len(arcs) == 1:
            pieces += two_arcs(circle, start)
        elif sweep > HULL_ROUNDING:
            pieces.append(arc)
    if len(arcs) > 1 and math.dist(pieces[-1].end, pieces[0].start) > HULL_ROUNDING:
        pieces.append(Line(pieces[-1].end, pieces[0].start))
    return closed(layer, pieces)
