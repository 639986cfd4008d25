"""Contours as entities of a DXF file.

A contour of lines and arcs is one polyline, whose bulges are true arcs. A polyline cannot hold
cubics, so a contour with cubics is LINE, ARC and SPLINE entities end to end.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.curves.measure import halved
from geneva_cli.curves.shapes import Arc, Circle, Contour, Cubic, Line, Segment, Shape
from geneva_cli.errors import GenevaError
from geneva_cli.output.ezdxf_alone import BaseLayout


def draw(space: BaseLayout, shape: Shape) -> None:
    """Draw a circle or a contour on its layer.

    Raises GenevaError for cubics in R12, which has no splines.
    """
    if isinstance(shape, Circle):
        space.add_circle(shape.centre, shape.radius, dxfattribs={"layer": shape.layer})
    else:
        _contour(space, shape)


def _contour(space: BaseLayout, contour: Contour) -> None:
    # The bulge of 300 degrees: beyond it the chord determines the radius badly.
    segments = [part for one in contour.segments for part in halved(one, lambda bulge: bulge > 3.7)]
    if any(isinstance(segment, Cubic) for segment in segments):
        if _is_r12(space):
            raise GenevaError(
                "--dxf-version R12 has no splines: leave out --curves spline, or take a newer one"
            )
        for run in _runs(segments):
            _entity(space, contour.layer, run)
    else:
        _polyline(space, contour.layer, segments, contour.closed)


def _polyline(space: BaseLayout, layer: str, segments: list[Segment], close: bool) -> None:
    points = [(*s.start, s.bulge if isinstance(s, Arc) else 0.0) for s in segments]
    if not close:
        points.append((*segments[-1].end, 0.0))
    if _is_r12(space):  # R12 has no LWPOLYLINE
        space.add_polyline2d(points, format="xyb", close=close, dxfattribs={"layer": layer})
    else:
        space.add_lwpolyline(points, format="xyb", close=close, dxfattribs={"layer": layer})


def _is_r12(space: BaseLayout) -> bool:
    assert space.doc is not None
    return bool(space.doc.dxfversion == "AC1009")


def _entity(space: BaseLayout, layer: str, run: list[Segment]) -> None:
    """A line, an arc or a run of cubics as an entity of its own."""
    first, attributes = run[0], {"layer": layer}
    if isinstance(first, Line):
        space.add_line(first.start, first.end, dxfattribs=attributes)
    elif isinstance(first, Arc):
        # Centre and angles of a larger arc are not precise enough for its ends.
        if first.radius > 1e5:
            _polyline(space, layer, run, False)
            return
        start, end = (_direction(first.centre, p) for p in (first.start, first.end))
        angles = (start, end) if first.bulge > 0.0 else (end, start)  # always counterclockwise
        space.add_arc(first.centre, first.radius, *angles, dxfattribs=attributes)
    else:
        cubics = [s for s in run if isinstance(s, Cubic)]
        inner = [p for cubic in cubics for p in (cubic.first, cubic.second)]
        ends, knots = _knots(cubics)
        spline = space.add_spline(degree=3, dxfattribs=attributes)
        spline.control_points = [ends[0], *inner, ends[1]]
        spline.knots = knots
        spline.dxf.flags = 8  # in a plane


def _knots(cubics: list[Cubic]) -> tuple[tuple[tuple[float, float], ...], list[float]]:
    """A run's first and last point, and its knots: two at each joint, so that it is smooth there.

    A joint that divides the distance of its neighbours in the ratio of the knot intervals needs no
    point of its own.
    """
    at, interval = 0.0, _size(cubics[0])
    knots = [at] * 4
    for cubic, following in zip(cubics, [*cubics[1:], None], strict=True):
        at += interval
        knots += [at, at]
        if following is not None:
            interval *= _ratio(cubic, following)
    return (cubics[0].start, cubics[-1].end), [*knots, at, at]


def _runs(segments: list[Segment]) -> Iterator[list[Segment]]:
    """Segments one by one, but smoothly connected cubics together."""
    run: list[Segment] = []
    scale = 1.0  # the knot interval over that of the run's first
    uneven = 100.0  # greatest ratio of a spline's knot intervals to its first
    for segment in segments:
        last = run[-1] if run else None
        if isinstance(last, Cubic) and isinstance(segment, Cubic) and _smooth(last, segment):
            scale *= _ratio(last, segment)
            if 1.0 / uneven < scale < uneven:
                run.append(segment)
                continue
        if run:
            yield run
        run, scale = [segment], 1.0
    yield run


def _smooth(a: Cubic, b: Cubic) -> bool:
    """Return True if the common end lies on the line between its neighbours."""
    before, after = math.dist(a.second, a.end), math.dist(b.start, b.first)
    joint_mm = 1e-9  # allowed distance of a spline from the joint of two of its cubics
    if not min(before, after) > joint_mm:
        return False
    fraction = before / (before + after)
    x, y = (p + fraction * (q - p) for p, q in zip(a.second, b.first, strict=True))
    return math.dist((x, y), a.end) < joint_mm


def _ratio(a: Cubic, b: Cubic) -> float:
    """The ratio of knot intervals that makes the speed equal on both sides of a joint."""
    return math.dist(b.start, b.first) / math.dist(a.second, a.end)


def _size(cubic: Cubic) -> float:
    return sum(map(math.dist, cubic[:-1], cubic[1:]))


def _direction(centre: tuple[float, float], point: tuple[float, float]) -> float:
    return math.degrees(math.atan2(point[1] - centre[1], point[0] - centre[0])) % 360.0
