"""Bounds and lengths of shapes, and shapes moved and rotated.

Nothing is measured from an arc's centre, which may be far away.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple, TypeVar

from geneva_cli.geometry.shapes import Arc, Circle, Contour, Cubic, Line, Point, Segment, Shape

STRAIGHT = 1e-16  # a bulge below it moves no point of the arc by a rounding of the chord
S = TypeVar("S", Contour, Circle, Shape)


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
    (x, y), (x0, y0), (x1, y1) = point, piece.start, piece.end
    u, v = x1 - x0, y1 - y0
    along = ((x - x0) * u + (y - y0) * v) / (u * u + v * v)
    if isinstance(piece, Line) or abs(piece.bulge) < STRAIGHT:
        return along
    # With h half the sweep and a, b the places along and across the chord, over it, the point is
    # (2 a - 1) sin h along and cos h - 2 b sin h across from the centre, over the radius. So
    # nothing is measured from a centre that is far away.
    across, half = ((y - y0) * u - (x - x0) * v) / (u * u + v * v), 0.5 * piece.sweep
    sine, cosine = math.sin(half), math.cos(half)
    turn = math.atan2((2.0 * along - 1.0) * sine, cosine - 2.0 * across * sine)
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
    (x0, y0), (x1, y1) = arc.start, arc.end
    long = (1.0 + arc.bulge * arc.bulge) / 3.0
    half = 0.5 * arc.sweep
    c, s = long * math.cos(half), long * math.sin(half)
    x, y = x1 - x0, y1 - y0
    first = x0 + c * x + s * y, y0 + c * y - s * x
    second = x1 - c * x + s * y, y1 - c * y - s * x
    return Cubic(arc.start, first, second, arc.end)


def mapped(
    shape: S, point: Callable[[Point], Point], radius: Callable[[float], float] = lambda r: r
) -> S:
    """Move a shape by a similarity of points that keeps the sense, and of a circle's radius."""
    if isinstance(shape, Circle):
        return shape._replace(centre=point(shape.centre), radius=radius(shape.radius))
    pieces: list[Segment] = []
    for one in shape.segments:
        if isinstance(one, Arc):
            pieces.append(Arc(point(one.start), point(one.end), one.bulge))
        else:
            pieces.append(type(one)(*map(point, one)))
    return shape._replace(segments=tuple(pieces))


def turned(shape: S, radians: float, centre: Point = (0.0, 0.0)) -> S:
    """Rotate a shape about a point, counterclockwise."""
    (x, y), c, s = centre, math.cos(radians), math.sin(radians)
    if isinstance(shape, Circle):
        u, v = shape.centre[0] - x, shape.centre[1] - y
        return shape._replace(centre=(x + c * u - s * v, y + s * u + c * v))
    pieces: list[Segment] = []
    for one in shape.segments:
        moved: list[Point] = []
        for px, py in one[:2] if isinstance(one, Arc) else one:
            u, v = px - x, py - y
            moved.append((x + c * u - s * v, y + s * u + c * v))
        if isinstance(one, Arc):
            pieces.append(Arc(moved[0], moved[1], one.bulge))
        else:
            pieces.append(type(one)(*moved))
    return shape._replace(segments=tuple(pieces))


def turned_pieces(pieces: Iterable[Segment], radians: float) -> tuple[Segment, ...]:
    """Rotate pieces of an outline about the origin, counterclockwise."""
    return turned(Contour("", tuple(pieces), closed=False), radians).segments


def mirrored(pieces: Sequence[Segment]) -> list[Segment]:
    """Mirror pieces of an outline in the x axis, and run them backwards."""
    over = mapped(Contour("", tuple(pieces), closed=False), lambda p: (p[0], -p[1]))
    # backwards, but an arc's bulge changes its sign twice
    return [
        Arc(piece.end, piece.start, piece.bulge)
        if isinstance(piece, Arc)
        else type(piece)(*piece[::-1])
        for piece in reversed(over.segments)
    ]


def _extremes(segment: Segment) -> Iterator[Point]:
    """The ends, and the points at which the segment runs along an axis."""
    yield segment.start
    yield segment.end
    if isinstance(segment, Cubic):
        for a, b, c, d in zip(*segment, strict=True):
            # the derivative's Bernstein coefficients, by 3: square t² + 2 half t + e = 0
            e, f, g = b - a, c - b, d - c
            square, half = e - 2.0 * f + g, f - e
            under = half * half - square * e
            if under >= 0.0:
                root = -(half + math.copysign(math.sqrt(under), half))  # no cancellation
                roots = [root / square] if square else []
                roots += [e / root] if root else []
                yield from (at(segment, t) for t in roots if 0.0 < t < 1.0)
    elif isinstance(segment, Arc) and abs(segment.bulge) >= STRAIGHT:
        (x0, y0), (x1, y1) = segment.start, segment.end
        sweep, quarter = segment.sweep, 0.5 * math.pi
        first = math.atan2(y1 - y0, x1 - x0) - 0.5 * sweep  # direction at the start
        low, high = sorted((first, first + sweep))
        for k in range(math.ceil(low / quarter), math.floor(high / quarter) + 1):
            yield at(segment, min(max((k * quarter - first) / sweep, 0.0), 1.0))
