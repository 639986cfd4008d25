"""DXF, R2000 by default: one closed polyline for each part, circles for bores.

The output is equal on every run.
"""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Iterator

from geneva_cli.errors import GenevaError, clean, cut
from geneva_cli.geometry.measure import halved
from geneva_cli.geometry.pieces import UNITS, prepared
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Cubic, Line, Segment, Shape
from geneva_cli.geometry.sheet import Drawing, extent
from geneva_cli.output.ezdxf_alone import BaseLayout, Document, Modelspace, options
from geneva_cli.output.formats import DXF_VERSIONS
from geneva_cli.output.inks import CENTRE_LINES, DASHES, inks
from geneva_cli.output.splines import Piece, pieces

USUAL = "R2000"


def chunks(drawing: Drawing, units: str, version: str = USUAL) -> Iterator[str]:
    """The file's text; ``units`` is mm or inch, ``version`` one of ``output.DXF_VERSIONS``.

    Raises GenevaError for another unit or version, a coordinate that is not finite, a drawing
    without shapes, or cubics in R12.
    """
    drawing = prepared(drawing, units)

    def fill(document: Document, space: Modelspace) -> None:
        _layers(document, drawing, 1.0 / UNITS[units])
        for shape in drawing.shapes:
            draw(space, shape)
        extents(document, space, extent(drawing))

    yield from dxf_text(drawing.title, units, version, fill)


def _layers(document: Document, drawing: Drawing, millimetre: float) -> None:
    for layer, ink in inks(drawing.layers).items():
        name = "Continuous"
        if layer in CENTRE_LINES:
            name = "CENTER"
            linetype(document, name, tuple(millimetre * d for d in DASHES))
        document.layers.add(layer, color=ink.number, linetype=name)


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
    attributes = {"layer": layer}
    if isinstance(piece, Line):
        space.add_line(piece.start, piece.end, dxfattribs=attributes)
    elif isinstance(piece, Arc):
        # Centre and angles of a larger arc are not precise enough for its ends.
        if piece.radius > 1e5:
            _polyline(space, layer, [piece], False)
            return
        x, y = piece.centre
        start, end = (
            math.degrees(math.atan2(q - y, p - x)) % 360.0 for p, q in (piece.start, piece.end)
        )
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


FLOAT_CODES = {
    code
    for codes in (
        range(10, 60),
        range(110, 150),
        range(210, 240),
        range(460, 470),
        range(1010, 1060),
    )
    for code in codes
}


def dxf_text(
    title: str, units: str, version: str, fill: Callable[[Document, Modelspace], None]
) -> Iterator[str]:
    """The text of a file whose document ``fill`` fills; R12 has no unit.

    Raises GenevaError for a version that is not known.
    """
    lines = _document(units, version, fill).split("\n")
    title = clean(title)[:200].strip()  # a line may have 255 characters
    if title:
        yield _ascii(f"999\n{title}\n")  # a comment: a text entity would be cut by machines
    block = 1024  # values at a time
    for start in range(0, len(lines) - 1, 2 * block):
        part = lines[start : start + 2 * block]
        pairs = zip(part[::2], part[1::2], strict=False)
        yield _ascii("".join(f"{code}\n{_fixed(int(code), value)}\n" for code, value in pairs))


def _document(units: str, version: str, fill: Callable[[Document, Modelspace], None]) -> str:
    if version not in DXF_VERSIONS:
        raise GenevaError(
            f"--dxf-version {cut(version)}: it must be one of {', '.join(DXF_VERSIONS)}"
        )
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        document = Document.new(version)
        if version != "R12":
            document.units = {"mm": 4, "inch": 1}[units]
            document.header["$MEASUREMENT"] = 1 if units == "mm" else 0
        fill(document, document.modelspace())
        stream = io.StringIO()
        document.write(stream)
    finally:
        options.write_fixed_meta_data_for_testing = before
    return stream.getvalue()


def extents(document: Document, space: Modelspace, box: tuple[float, float, float, float]) -> None:
    """Set the extent that a reader shows first: x0, y0, x1, y1."""
    x0, y0, x1, y1 = box
    low, high = (x0, y0, 0.0), (x1, y1, 0.0)
    space.reset_extents(low, high)
    space.reset_limits(low[:2], high[:2])
    # ezdxf treats a corner at the origin as missing when it copies them here
    document.header["$EXTMIN"], document.header["$EXTMAX"] = low, high
    middle = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
    document.set_modelspace_vport(1.1 * max(x1 - x0, y1 - y0), middle)


def linetype(document: Document, name: str, dashes: tuple[float, ...]) -> None:
    """Define a pattern of dashes and gaps, once."""
    if name not in document.linetypes:
        pattern = [d * (1 if i % 2 == 0 else -1) for i, d in enumerate(dashes)]
        shown = "____ _ ____ _ ____" if len(dashes) > 2 else "__ __ __ __"
        document.linetypes.add(name, [sum(dashes), *pattern], description=shown)


def _fixed(code: int, value: str) -> str:
    """A value with fixed decimals if it is a float: no exponent, no negative zero."""
    if code not in FLOAT_CODES:
        return value
    # Bulges and angles (codes 42, 50 and 51) act through a radius, so they have more decimals. The
    # decimals of a length are more than a float has with large coordinates.
    text = f"{float(value):.{15 if code in {42, 50, 51} else 12}f}"
    return text if text.strip("-0.") else text.lstrip("-")


def _ascii(text: str) -> str:
    """Letters beyond ASCII as DXF escapes, or a question mark beyond four digits."""
    return "".join(
        c if c < "\x80" else f"\\U+{ord(c):04X}" if c < "\U00010000" else "?" for c in text
    )
