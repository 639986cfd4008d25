"""Shapes: contours of lines, arcs and cubics on named layers, in millimetres.

Also their hull, bounds and lengths, places on them, and shapes that are moved, turned or mirrored.
Points are (x, y). Nothing is measured from an arc's centre, which may be far away.
"""

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import permutations
from operator import attrgetter, itemgetter
from typing import Literal, NamedTuple, TypeAlias, TypeVar

import numpy as np

Point: TypeAlias = tuple[float, float]
ORIGIN: Point = (0.0, 0.0)
STRAIGHT = 1e-16  # a bulge below it moves no point of the arc by a rounding of the chord
HULL_ROUNDING = 1e-12  # radians: directions nearer to each other are one
TOUCHING = 1e-10  # mm: a circle that reaches so much less far touches a line
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
S = TypeVar("S", Contour, Circle, Shape)


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
        if isinstance(piece, Arc):
            pieces.append(Arc(piece.end, piece.start, -piece.bulge))
        else:
            pieces.append(type(piece)(*piece[::-1]))
    return contour._replace(segments=tuple(pieces))


def convex_hull(layer: Layer, circles: Sequence[Circle]) -> Contour:
    """Convex hull of circles, counterclockwise: arcs on circles, and lines between them.

    A line leaves one circle for another, in a direction in which both reach farthest.
    """
    found = list[tuple[float, float, Circle, Circle]]()
    for one, other in permutations(circles, 2):
        x, y = other.centre[0] - one.centre[0], other.centre[1] - one.centre[1]
        apart, less = math.hypot(x, y), one.radius - other.radius
        if apart <= abs(less) * (1.0 + HULL_ROUNDING):
            continue  # one circle holds the other
        # above 0: the first arc reaches farthest along x
        turn = math.atan2(y, x) - math.acos(less / apart) - HULL_ROUNDING
        turn = turn % math.tau + HULL_ROUNDING
        u, v = math.cos(turn), math.sin(turn)
        reaches = [centre[0] * u + centre[1] * v + radius for _, centre, radius in circles]
        if one.centre[0] * u + one.centre[1] * v + one.radius >= max(reaches) - TOUCHING:
            found.append((turn, apart, one, other))
    lines: list[tuple[float, float, Circle, Circle]] = []
    for line in sorted(found, key=itemgetter(0)):
        if not lines or line[0] - lines[-1][0] > HULL_ROUNDING:
            lines.append(line)
        elif line[1] > lines[-1][1]:  # the longer one of two in the same direction
            lines[-1] = line
    if not lines:
        return as_contour(max(circles, key=attrgetter("radius"))._replace(layer=layer))
    pieces, before = list[Segment](), lines[-1][0] - math.tau
    for turn, _, one, other in lines:
        arc = about(one.centre, one.radius, before, turn - before)
        pieces += [arc, Line(arc.end, polar(other.centre, other.radius, turn))]
        before = turn
    return closed(layer, pieces)


class Box(NamedTuple):
    """Least and greatest coordinates."""

    x0: float
    y0: float
    x1: float
    y1: float


def bounds(shape: Shape) -> Box:
    """Smallest box around a shape, with the exact extremes of its arcs and cubics."""
    if isinstance(shape, Circle):
        (x, y), r = shape.centre, shape.radius
        return Box(x - r, y - r, x + r, y + r)
    xs, ys = zip(*(p for segment in shape.segments for p in _extremes(segment)), strict=True)
    return Box(min(xs), min(ys), max(xs), max(ys))


def bounds_of(shapes: Iterable[Shape]) -> Box:
    """Smallest box around some shapes."""
    x0, y0, x1, y1 = zip(*map(bounds, shapes), strict=True)
    return Box(min(x0), min(y0), max(x1), max(y1))


def segment_length(segment: Segment) -> float:
    """Length of a line or arc; of a cubic that of its control polygon, which is no shorter."""
    if isinstance(segment, Cubic):
        return math.fsum(map(math.dist, segment[:-1], segment[1:]))
    chord = math.dist(segment.start, segment.end)
    if isinstance(segment, Line) or abs(segment.bulge) < STRAIGHT:
        return chord
    half = 0.5 * segment.sweep
    return chord * half / math.sin(half)


def directions(piece: Line | Arc) -> tuple[float, float]:
    """Directions of travel at both ends, radians."""
    (x0, y0), (x1, y1) = piece.start, piece.end
    chord = math.atan2(y1 - y0, x1 - x0)
    half = 0.5 * piece.sweep if isinstance(piece, Arc) else 0.0
    return chord - half, chord + half


def legs(arc: Arc) -> tuple[float, float]:
    """Directions of an arc's ends from its centre, counterclockwise."""
    x, y = arc.centre
    first = math.atan2(arc.start[1] - y, arc.start[0] - x)
    return (first, first + arc.sweep) if arc.sweep > 0.0 else (first + arc.sweep, first)


def fraction_at(piece: Line | Arc, point: Point) -> float:
    """Fraction of the length at a point of the piece, or of its whole line or circle."""
    start = complex(*piece.start)
    seen = (complex(*point) - start) / (complex(*piece.end) - start)
    if isinstance(piece, Line) or abs(piece.bulge) < STRAIGHT:
        return seen.real
    # With h half the sweep and a, b the places along and across the chord, over it, the point is
    # (2 a - 1) sin h along and cos h - 2 b sin h across from the centre, over the radius. So
    # nothing is measured from a centre that is far away.
    half = 0.5 * piece.sweep
    sine, cosine = math.sin(half), math.cos(half)
    turn = math.atan2((2.0 * seen.real - 1.0) * sine, cosine - 2.0 * seen.imag * sine)
    return 0.5 + 0.5 * turn / half


def at(segment: Segment, t: float) -> Point:
    """Point at the parameter 0..1, which is a fraction of the length for lines and arcs."""
    if t in (0.0, 1.0):
        return segment.end if t else segment.start
    if isinstance(segment, Cubic):  # by de Casteljau's construction
        corners: list[Point] = list(segment)
        while len(corners) > 1:
            pairs = zip(corners[:-1], corners[1:], strict=True)
            corners = [(x + t * (u - x), y + t * (v - y)) for (x, y), (u, v) in pairs]
        return corners[0]
    if isinstance(segment, Line) or abs(segment.bulge) < STRAIGHT:
        (x0, y0), (x1, y1) = segment.start, segment.end
        return x0 + t * (x1 - x0), y0 + t * (y1 - y0)
    # the chord to a point is the whole chord, rotated and shortened
    (x0, y0), (x1, y1), half = segment.start, segment.end, 0.5 * segment.sweep
    turn, scale = (t - 1.0) * half, math.sin(t * half) / math.sin(half)
    u, v, c, s = x1 - x0, y1 - y0, scale * math.cos(turn), scale * math.sin(turn)
    return x0 + c * u - s * v, y0 + s * u + c * v


def points(segment: Segment, count: int) -> list[Point]:
    """``count`` + 1 points at even parameters, both ends included."""
    return [at(segment, i / count) for i in range(count + 1)]


def halved(segment: Segment, is_long: Callable[[float], bool]) -> list[Segment]:
    """A segment alone; an arc halved until no part ``is_long`` by the size of its bulge."""
    if isinstance(segment, Arc) and is_long(abs(segment.bulge)):
        middle, bulge = at(segment, 0.5), math.tan(0.125 * segment.sweep)
        first, last = Arc(segment.start, middle, bulge), Arc(middle, segment.end, bulge)
        return [*halved(first, is_long), *halved(last, is_long)]
    return [segment]


def as_cubic(arc: Arc) -> Cubic:
    """The cubic with the arc's ends, tangents and middle: within 3e-4 radii at 90 degrees."""
    start, end = complex(*arc.start), complex(*arc.end)
    turn = cmath.rect((1.0 + arc.bulge * arc.bulge) / 3.0, 0.5 * arc.sweep)
    first, second = start + turn.conjugate() * (end - start), end - turn * (end - start)
    return Cubic(arc.start, (first.real, first.imag), (second.real, second.imag), arc.end)


def placed(
    shape: S, at: Point = ORIGIN, turn: float = 0.0, scale: float = 1.0, mirror: bool = False
) -> S:
    """Scale a shape, rotate it about the origin, counterclockwise, and move it.

    With ``mirror`` it is first mirrored in the x axis.
    """
    if (at, turn, scale, mirror) == (ORIGIN, 0.0, 1.0, False):
        return shape
    by, factor, over = complex(*at), cmath.rect(scale, turn), -1.0 if mirror else 1.0
    if isinstance(shape, Circle):
        z = factor * complex(shape.centre[0], over * shape.centre[1]) + by
        return shape._replace(centre=(z.real, z.imag), radius=scale * shape.radius)
    pieces: list[Segment] = []
    for one in shape.segments:
        corners: list[Point] = []
        for x, y in one[:2] if isinstance(one, Arc) else one:
            z = factor * complex(x, over * y) + by
            corners.append((z.real, z.imag))
        if isinstance(one, Arc):
            pieces.append(Arc(corners[0], corners[1], over * one.bulge))
        else:
            pieces.append(type(one)(*corners))
    return shape._replace(segments=tuple(pieces))


def mirrored(pieces: Iterable[Segment]) -> tuple[Segment, ...]:
    """Mirror pieces of an outline in the x axis, and run them backwards."""
    own = Contour("", tuple(pieces), closed=False)
    return backwards(placed(own, mirror=True)).segments


def _extremes(segment: Segment) -> Iterator[Point]:
    """The ends, and the points at which the segment runs along an axis."""
    yield segment.start
    yield segment.end
    if isinstance(segment, Cubic):
        for a, b, c, d in zip(*segment, strict=True):
            # the derivative's Bernstein coefficients, by 3
            e, f, g = b - a, c - b, d - c
            roots = np.roots((e - 2.0 * f + g, 2.0 * (f - e), e))
            places = roots.real[np.isreal(roots)].tolist()
            yield from (at(segment, t) for t in places if 0.0 < t < 1.0)
    elif isinstance(segment, Arc) and abs(segment.bulge) >= STRAIGHT:
        sweep, quarter, first = segment.sweep, 0.5 * math.pi, directions(segment)[0]
        low, high = sorted((first, first + sweep))
        for k in range(math.ceil(low / quarter), math.floor(high / quarter) + 1):
            yield at(segment, min(max((k * quarter - first) / sweep, 0.0), 1.0))
