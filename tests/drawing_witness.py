"""Read DXF and SVG back into pieces, by independent formulas, and compare them with a drawing.

Also polylines, lengths and scaled drawings, which only tests need.

A piece is ``(start, end, point)``; ``point(t)`` is the point at a fraction t of it, from 0 to 1.
"""

import io
import math
import re
import warnings
from xml.etree import ElementTree

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st
from scipy.integrate import quad
from shapely.geometry import Polygon

from geneva_cli.geometry.shapes import (
    STRAIGHT,
    Arc,
    Circle,
    Cubic,
    Line,
    at,
    closed,
    segment_length,
)

FRACTIONS = (0.0, 0.07, 0.25, 0.5, 0.61, 0.83, 1.0)
CHAIN = 1e-9  # how near ends must be to be one point; the files' last decimals are 1e-9 and 1e-12
NUMBER = st.floats(-100.0, 100.0).map(lambda x: round(x, 3))
POINT = st.tuples(NUMBER, NUMBER)
SWEEP = st.one_of(st.floats(10.0, 350.0), st.sampled_from([90.0, 180.0, 179.999, 270.0, 300.0]))
BULGE = st.tuples(SWEEP, st.sampled_from([1.0, -1.0])).map(
    lambda pair: pair[1] * math.tan(math.radians(pair[0]) / 4.0)
)


@st.composite
def contours(draw, kinds="lac"):
    """Closed contours of lines, arcs and cubics through random points at least 1 mm apart.

    All points differ: a contour that runs over itself has doubled pieces, which are dropped.
    """
    points = draw(st.lists(POINT, min_size=2, max_size=6, unique=True))
    pairs = list(zip(points, [*points[1:], points[0]], strict=True))
    assume(all(math.dist(p, q) > 1.0 for p, q in pairs))
    segments = []
    for p, q in pairs:
        kind = draw(st.sampled_from(kinds))
        if kind == "l":
            segments.append(Line(p, q))
        elif kind == "a":
            segments.append(Arc(p, q, draw(BULGE)))
        else:
            segments.append(Cubic(p, draw(POINT), draw(POINT), q))
    return closed("WHEEL", segments)


def line(p, q):
    return p, q, lambda t: (p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]))


def cubic(p, q, r, s):
    def point(t):
        weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3]
        return tuple(np.dot(weights, [p, q, r, s]))

    return p, s, point


def arc(centre, radius, start, sweep):
    def point(t):
        angle = start + t * sweep
        return centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)

    return point(0.0), point(1.0), point


def of_segment(segment):
    if isinstance(segment, Line):
        return line(*segment)
    if isinstance(segment, Cubic):
        return cubic(*segment)
    (x, y), (u, v) = segment.start, segment.end
    # the centre lies on the chord's left at half the chord over tan(sweep / 2)
    half, away = 0.5 * math.dist((x, y), (u, v)), math.pi / 2 - 2 * math.atan(segment.bulge)
    along = math.atan2(v - y, u - x)
    far = half * math.tan(away)
    centre = 0.5 * (x + u) - far * math.sin(along), 0.5 * (y + v) + far * math.cos(along)
    start = math.atan2(y - centre[1], x - centre[0])
    return arc(centre, math.dist(centre, (x, y)), start, 4 * math.atan(segment.bulge))


def backwards(piece):
    start, end, point = piece
    return end, start, lambda t: point(1.0 - t)


def dxf_document(text):
    import ezdxf

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ezdxf.read(io.StringIO(text))


def dxf_pieces(entity):
    kind = entity.dxftype()
    if kind == "LWPOLYLINE":
        points = list(entity.get_points("xyb"))
        pairs = zip(points, [*points[1:], points[0]] if entity.closed else points[1:], strict=False)
        segments = [
            Arc(p[:2], q[:2], p[2]) if p[2] else Line(tuple(p[:2]), tuple(q[:2])) for p, q in pairs
        ]
        return [of_segment(segment) for segment in segments]
    if kind == "LINE":
        return [line(entity.dxf.start.vec2, entity.dxf.end.vec2)]
    if kind == "ARC":
        start, end = math.radians(entity.dxf.start_angle), math.radians(entity.dxf.end_angle)
        sweep = (end - start) % (2 * math.pi)
        return [arc(entity.dxf.center.vec2, entity.dxf.radius, start, sweep)]
    assert kind == "SPLINE"
    spline = entity.construction_tool()
    knots = sorted(set(spline.knots()))

    def between(a, b):
        return lambda t: tuple(spline.point(a + t * (b - a)).vec2)

    parts = [between(a, b) for a, b in zip(knots, knots[1:], strict=False)]
    return [(part(0.0), part(1.0), part) for part in parts]


def dxf_shapes(text):
    """Layer -> circles ``(centre, radius)`` and chains of pieces, in the file's order."""
    shapes = {}
    for entity in dxf_document(text).modelspace():
        chains = shapes.setdefault(entity.dxf.layer, [])
        if entity.dxftype() == "CIRCLE":
            chains.append((tuple(entity.dxf.center.vec2), entity.dxf.radius))
            continue
        pieces = dxf_pieces(entity)
        last = chains[-1] if chains and isinstance(chains[-1], list) else None
        if last and math.dist(last[-1][1], last[0][0]) > CHAIN:
            # an ARC always runs counterclockwise: the start of the second entity, known if that is
            # no arc, shows the direction of the first one
            starts = [pieces[0][0], *([pieces[0][1]] if entity.dxftype() == "ARC" else [])]
            if len(last) == 1 and min(math.dist(last[0][1], start) for start in starts) > CHAIN:
                last[0] = backwards(last[0])
            if math.dist(last[-1][1], pieces[0][0]) < CHAIN:
                last += pieces
                continue
            if math.dist(last[-1][1], pieces[-1][1]) < CHAIN:
                last += [backwards(piece) for piece in reversed(pieces)]
                continue
        chains.append(pieces)
    return shapes


def svg_arc(p, radius, large, sweep, q):
    """The arc by the standard's conversion from ends to centre (implementation notes, F.6.5)."""
    half = 0.5 * (p[0] - q[0]), 0.5 * (p[1] - q[1])
    square = half[0] ** 2 + half[1] ** 2
    radius = max(radius, math.sqrt(square))
    root = math.sqrt(max(radius**2 / square - 1.0, 0.0)) * (-1.0 if large == sweep else 1.0)
    centre = root * half[1] + 0.5 * (p[0] + q[0]), -root * half[0] + 0.5 * (p[1] + q[1])
    start = math.atan2(p[1] - centre[1], p[0] - centre[0])
    turn = (math.atan2(q[1] - centre[1], q[0] - centre[0]) - start) % (2 * math.pi)
    return arc(centre, radius, start, turn if sweep else turn - 2 * math.pi)


def svg_path(text):
    """A path's pieces in the file's coordinates; fails on other commands than ours."""
    words = re.findall(r"[A-Za-z]|-?\d+\.?\d*", text)
    assert "".join(words) == re.sub(r"[\s,]", "", text)
    pieces, at, first, i = [], None, None, 0

    def take(count):
        nonlocal i
        numbers = [float(w) for w in words[i : i + count]]
        i += count
        return numbers

    while i < len(words):
        command, i = words[i], i + 1
        if command == "M":
            assert not pieces, "one path is one part"
            first = at = tuple(take(2))
            continue
        if command == "Z":
            assert i == len(words)
            if at != first:
                pieces.append(line(at, first))
            continue
        if command == "L":
            pieces.append(line(at, tuple(take(2))))
        elif command == "C":
            x = take(6)
            pieces.append(cubic(at, (x[0], x[1]), (x[2], x[3]), (x[4], x[5])))
        else:
            assert command == "A"
            rx, ry, turned, large, sweep, x, y = take(7)
            assert rx == ry
            assert turned == 0.0
            pieces.append(svg_arc(at, rx, large, sweep, (x, y)))
            assert math.dist(pieces[-1][1], (x, y)) < 1e-8
        at = pieces[-1][1] if command != "A" else (x, y)
    return pieces


def up(piece):
    """The piece with y up."""
    start, end, point = piece

    def flipped(t):
        x, y = point(t)
        return x, -y

    return (start[0], -start[1]), (end[0], -end[1]), flipped


NO_LAYERS = ("FILL", "NOTES", "ARROWS", "TEXT")  # groups


def svg_shapes(text):
    """The result of ``dxf_shapes`` for an SVG, with y up; notes and fills are left out."""
    shapes = {}
    for group in ElementTree.fromstring(text):
        if not group.tag.endswith("}g") or group.get("id") in NO_LAYERS:
            continue
        assert not group.get("transform")
        chains = shapes.setdefault(group.get("id"), [])
        for element in group:
            if element.tag.endswith("}circle"):
                x, y, r = (float(element.get(name)) for name in ("cx", "cy", "r"))
                chains.append(((x, -y), r))
            else:
                chains.append([up(piece) for piece in svg_path(element.get("d"))])
    return shapes


def drawn_shapes(drawing):
    """The result of ``dxf_shapes`` for a drawing."""
    shapes = {}
    for shape in drawing.shapes:
        is_circle = isinstance(shape, Circle)
        shapes.setdefault(shape.layer, []).append(
            (shape.centre, shape.radius)
            if is_circle
            else [of_segment(segment) for segment in shape.segments]
        )
    return shapes


def apart(read, drawn):
    """The greatest distance between two results of ``dxf_shapes``; infinite if kinds differ.

    Several equal parts of an arc in ``read`` are compared with one piece in ``drawn``.
    """
    if read.keys() != drawn.keys() or any(len(read[k]) != len(drawn[k]) for k in drawn):
        return math.inf
    worst = 0.0
    for layer in drawn:
        for one, other in zip(read[layer], drawn[layer], strict=True):
            if isinstance(one, tuple) != isinstance(other, tuple):
                return math.inf
            if isinstance(one, tuple):
                worst = max(worst, math.dist(one[0], other[0]), abs(one[1] - other[1]))
                continue
            rest = list(one)
            for _, end, point in other:
                if not rest:
                    return math.inf
                part = [rest.pop(0)]
                while math.dist(part[-1][1], end) > 1e-6 and rest:
                    part.append(rest.pop(0))
                for t in FRACTIONS:
                    number = min(int(t * len(part)), len(part) - 1)
                    where = part[number][2](t * len(part) - number)
                    worst = max(worst, math.dist(where, point(t)))
            if rest:
                return math.inf
    return worst


def vertices(shape, tolerance):
    """A polyline whose chords stay within ``tolerance`` of the shape, with all segments' ends.

    It runs from the first start to the last end: on a closed contour the last point is the first
    one again.
    """
    if isinstance(shape, Circle):
        (x, y), r = shape.centre, shape.radius
        count = max(chords(2.0 * math.pi, r, tolerance), 3)
        turns = [2.0 * math.pi * i / count for i in range(count)]
        points = [(x + r * math.cos(a), y + r * math.sin(a)) for a in turns]
        return [*points, points[0]]
    points = [shape.segments[0].start] if shape.segments else []
    for segment in shape.segments:
        count = pieces(segment, tolerance)
        points += [at(segment, i / count) for i in range(1, count + 1)]
    return points


def polygon(shape, tolerance=1e-4):
    """A closed contour or a circle as a polygon of chords, within ``tolerance`` of it, mm."""
    return Polygon(vertices(shape, tolerance))


def pieces(segment, tolerance):
    """Number of chords that a segment needs."""
    if isinstance(segment, Cubic):
        bends = [
            math.hypot(p[0] - 2.0 * q[0] + r[0], p[1] - 2.0 * q[1] + r[1])
            for p, q, r in zip(segment[:-2], segment[1:-1], segment[2:], strict=True)
        ]
        # a chord is off by at most an eighth of the second derivative, which is 6 bends
        return max(math.ceil(math.sqrt(0.75 * max(bends) / tolerance)), 1)
    if isinstance(segment, Line) or abs(segment.bulge) < STRAIGHT:
        return 1
    return chords(abs(segment.sweep), segment.radius, tolerance)


def chords(sweep, radius, tolerance):
    """Number of chords within the tolerance of an arc: one misses it by r (1 - cos(step / 2))."""
    step = 4.0 * math.asin(math.sqrt(tolerance / max(2.0 * radius, tolerance)))
    return max(math.ceil(sweep / step), 1)


def length(shape):
    """The length of a shape's line."""
    if isinstance(shape, Circle):
        return 2.0 * math.pi * shape.radius
    return math.fsum(map(_length, shape.segments))


def _length(segment):
    if not isinstance(segment, Cubic):
        return segment_length(segment)
    sides = 3.0 * np.diff(np.array(segment), axis=0)

    def speed(t):
        return math.hypot(
            *(sides[0] * (1 - t) ** 2 + sides[1] * 2 * t * (1 - t) + sides[2] * t * t)
        )

    return quad(speed, 0.0, 1.0, epsabs=1e-13, epsrel=1e-13, limit=400)[0]
