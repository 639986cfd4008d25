"""Contours as entities of a DXF file.

A contour of lines and arcs is one polyline, whose bulges are true arcs. A polyline cannot hold
cubics, so a contour with cubics is LINE, ARC and SPLINE entities end to end.
"""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import halved
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Cubic, Line, Segment, Shape
from geneva_cli.output.ezdxf_alone import BaseLayout
from geneva_cli.output.splines import Piece, pieces


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
        for piece in pieces(segments):
            _entity(space, contour.layer, piece)
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


def _entity(space: BaseLayout, layer: str, piece: Piece) -> None:
    """A line, an arc or a spline as an entity of its own."""
    attributes = {"layer": layer}
    if isinstance(piece, Line):
        space.add_line(piece.start, piece.end, dxfattribs=attributes)
    elif isinstance(piece, Arc):
        # Centre and angles of a larger arc are not precise enough for its ends.
        if piece.radius > 1e5:
            _polyline(space, layer, [piece], False)
            return
        start, end = (_direction(piece.centre, p) for p in (piece.start, piece.end))
        angles = (start, end) if piece.bulge > 0.0 else (end, start)  # always counterclockwise
        space.add_arc(piece.centre, piece.radius, *angles, dxfattribs=attributes)
    else:
        spline = space.add_spline(degree=3, dxfattribs=attributes)
        spline.control_points = piece.poles
        # about as long as the curve, so that the decimals of knots are those of lengths
        scale = sum(map(math.dist, piece.poles, piece.poles[1:])) / piece.knots[-1]
        # a cubic's ends are double knots, and the curve's quadruple ones
        double = [scale * knot for knot in piece.knots for _ in range(2)]
        spline.knots = [*double[:2], *double, *double[-2:]]
        spline.dxf.flags = 8  # in a plane


def _direction(centre: tuple[float, float], point: tuple[float, float]) -> float:
    return math.degrees(math.atan2(point[1] - centre[1], point[0] - centre[0])) % 360.0
