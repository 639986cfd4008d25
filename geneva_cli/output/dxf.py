"""DXF, R2000 by default, with equal bytes on every run.

A drawing to cut has one closed polyline for each part, and circles for bores. The dimensions of a
drawing sheet are DIMENSION entities. Each has a block with its lines and its text, so that every
reader shows it as the other formats do. Each scale has a style, with which a CAD program that
measures again gets the part's own size.
"""

import io
import math
from collections.abc import Callable, Iterator
from typing import Any

from geneva_cli.errors import GenevaError, clean, cut
from geneva_cli.geometry import shapes
from geneva_cli.geometry import sheet as papers
from geneva_cli.geometry.sheet import DIMENSION, TEXT, Label, Measure, Sheet
from geneva_cli.output import DXF_VERSIONS
from geneva_cli.output.ezdxf_alone import BaseLayout, Document, Modelspace, options
from geneva_cli.output.inks import CENTRE_LINES, DASHES, INKS
from geneva_cli.output.splines import Piece, pieces

USUAL, R12 = "R2000", "AC1009"
FLOAT_CODES = {*range(10, 60), *range(110, 150), *range(210, 240), *range(460, 470)}
FLOAT_CODES |= {*range(1010, 1060)}
# group code 70 of a DIMENSION, and the attributes that hold its points
KINDS = {
    "length": (0, ("defpoint2", "defpoint3", "defpoint")),
    "angular": (5, ("defpoint4", "defpoint2", "defpoint3", "defpoint")),
    "diameter": (3, ("defpoint", "defpoint4")),
    "radius": (4, ("defpoint", "defpoint4")),
}


def chunks(drawing: papers.Drawing, version: str = USUAL) -> Iterator[str]:
    """Yield a drawing's text. Raises GenevaError for an unknown version, or cubics in R12."""
    drawing = papers.prepared(drawing)

    def fill(document: Document, space: Modelspace) -> None:
        for layer in drawing.layers:
            dashes = DASHES if layer in CENTRE_LINES else ()
            _layer(document, layer, dashes, color=INKS[layer].number)
        for shape in drawing.shapes:
            _draw(space, shape)
        _extents(document, space, papers.extent(drawing))

    yield from _text_of(drawing.title, version, fill)


def sheet_chunks(sheet: Sheet, version: str = USUAL) -> Iterator[str]:
    """Yield a sheet's text, in millimetres on paper. Raises GenevaError for an unknown version."""

    def fill(document: Document, space: Modelspace) -> None:
        for name, width in papers.WIDTHS.items():
            dashes = papers.DASHED.get(name, ())
            _layer(document, name, dashes, color=7, lineweight=round(100.0 * width))
        document.styles.add("SHEET", font="arial.ttf")
        for shape in sheet.shapes:
            _draw(space, shape)
        for label in sheet.labels:
            _text(space, label, TEXT)
        for measure in sheet.measures:
            _measure(document, space, measure)
        _extents(document, space, (0.0, 0.0, sheet.width, sheet.height))

    yield from _text_of(sheet.title, version, fill)


def _draw(space: BaseLayout, shape: shapes.Shape) -> None:
    if isinstance(shape, shapes.Circle):
        space.add_circle(shape.centre, shape.radius, dxfattribs={"layer": shape.layer})
        return
    # The bulge of 300 degrees: beyond it the chord determines the radius badly.
    segments = [*shapes.halved(shape.segments, lambda bulge: bulge > 3.7)]
    if not any(isinstance(segment, shapes.Cubic) for segment in segments):
        _polyline(space, shape.layer, segments, shape.closed)
        return
    if space.dxfversion == R12:
        raise GenevaError(
            "--dxf-version R12 has no splines: leave out --curves spline, or take a newer one"
        )
    for piece in pieces(segments):
        _entity(space, shape.layer, piece)


def _polyline(space: BaseLayout, layer: str, segments: list[shapes.Segment], close: bool) -> None:
    points = [(*s.start, s.bulge if isinstance(s, shapes.Arc) else 0.0) for s in segments]
    if not close:
        points.append((*segments[-1].end, 0.0))
    # R12 has no LWPOLYLINE
    add = space.add_polyline2d if space.dxfversion == R12 else space.add_lwpolyline
    add(points, format="xyb", close=close, dxfattribs={"layer": layer})


def _entity(space: BaseLayout, layer: str, piece: Piece) -> None:
    attributes = {"layer": layer}
    if isinstance(piece, shapes.Line):
        space.add_line(piece.start, piece.end, dxfattribs=attributes)
    elif isinstance(piece, shapes.Arc):
        start, end = (math.degrees(leg) % 360.0 for leg in shapes.legs(piece))
        space.add_arc(piece.centre, piece.radius, start, end, dxfattribs=attributes)
    else:
        spline = space.add_spline(degree=3, dxfattribs=attributes)
        spline.control_points = piece.poles
        # about as long as the curve, so that the decimals of knots are those of lengths
        scale = sum(map(math.dist, piece.poles, piece.poles[1:])) / piece.knots[-1]
        # a cubic's ends are double knots, and the curve's quadruple ones
        double = [scale * knot for knot in piece.knots for _ in range(2)]
        spline.knots = [*double[:2], *double, *double[-2:]]
        spline.dxf.flags = 8  # in a plane


def _measure(document: Document, space: Modelspace, measure: Measure) -> None:
    if measure.kind not in KINDS:
        _draw_measure(space, measure)
        return
    block = document.blocks.new_anonymous_block(type_char="D")
    _draw_measure(block, measure)
    factor, value = 1.0, measure.value
    if measure.kind == "angular":
        value = math.radians(value)
    else:
        (x, y), (u, v) = measure.points[:2]
        along = (u - x) * math.cos(measure.turn) + (v - y) * math.sin(measure.turn)
        long = abs(along) if measure.kind == "length" else math.dist((x, y), (u, v))
        factor = value / long
    style = f"TIMES_{factor:.4g}".replace(".", "_")
    if style not in document.dimstyles:
        # text above the line (dimtad) and along it (dimtih, dimtoh)
        look = {"dimlfac": float(f"{factor:.9g}"), "dimtxt": measure.label.height}
        look |= {"dimasz": 3.0, "dimexe": 1.5, "dimexo": 0.8, "dimgap": 0.8, "dimtad": 1}
        look |= {"dimtih": 0, "dimtoh": 0, "dimdec": 3}
        document.dimstyles.new(style, dxfattribs={**look, "dimtxsty": "SHEET"})
    number, names = KINDS[measure.kind]
    # 32: no other dimension uses this block; 128: the text stays at its place
    attributes = {"layer": DIMENSION, "dimstyle": style, "dimtype": number + 32 + 128}
    attributes |= {"geometry": block.name, "text": _signed(measure.label.text)}
    attributes |= {"text_midpoint": measure.label.middle, "angle": math.degrees(measure.turn)}
    attributes |= {"actual_measurement": value, **dict(zip(names, measure.points, strict=True))}
    space.new_entity("DIMENSION", attributes)


def _draw_measure(space: BaseLayout, measure: Measure) -> None:
    for piece in measure.lines:
        _draw(space, shapes.Contour(DIMENSION, (piece,), closed=False))
    for arrow in measure.arrows:
        tip, left, right = arrow.corners
        space.add_solid([tip, left, right, right], dxfattribs={"layer": DIMENSION})
    _text(space, measure.label, DIMENSION)


def _text(space: BaseLayout, label: Label, layer: shapes.Layer) -> None:
    attributes = {"layer": layer, "style": "SHEET", "insert": label.at, "height": label.height}
    attributes["rotation"] = math.degrees(label.turn)
    space.add_text(_signed(label.text), dxfattribs=attributes)


def _signed(text: str) -> str:
    """A text with DXF's own signs, which every version has; accidental ones are separated."""
    signs = {"Ø": "%%c", "°": "%%d", "±": "%%p"}
    return "".join(signs.get(c, c) for c in clean(text).replace("%%", "% %"))


def _text_of(
    title: str, version: str, fill: Callable[[Document, Modelspace], None]
) -> Iterator[str]:
    """Yield the text of a file whose document ``fill`` fills; R12 has no unit."""
    if version not in DXF_VERSIONS:
        known = ", ".join(DXF_VERSIONS)
        raise GenevaError(f"--dxf-version {cut(version)}: it must be one of {known}")
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        document, stream = Document.new(version), io.StringIO()
        if version != "R12":
            document.units = 4  # millimetres
            document.header["$MEASUREMENT"] = 1
        fill(document, document.modelspace())
        document.write(stream)
    finally:
        options.write_fixed_meta_data_for_testing = before
    lines = stream.getvalue().split("\n")
    title = clean(title)[:200].strip()  # a line may have 255 characters
    if title:
        yield _ascii(f"999\n{title}\n")  # a comment: a text entity would be cut by machines
    for code, value in zip(lines[:-1:2], lines[1::2], strict=True):
        yield _ascii(f"{code}\n{_fixed(int(code), value)}\n")


def _extents(document: Document, space: Modelspace, box: tuple[float, float, float, float]) -> None:
    """Set the extent that a reader shows first: x0, y0, x1, y1."""
    x0, y0, x1, y1 = box
    low, high = (x0, y0, 0.0), (x1, y1, 0.0)
    space.reset_extents(low, high)
    space.reset_limits(low[:2], high[:2])
    # ezdxf treats a corner at the origin as missing when it copies them here
    document.header["$EXTMIN"], document.header["$EXTMAX"] = low, high
    middle = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
    document.set_modelspace_vport(1.1 * max(x1 - x0, y1 - y0), middle)


def _layer(document: Document, name: str, dashes: tuple[float, ...], **look: Any) -> None:
    """Define a layer, and once its pattern of dashes and gaps."""
    pattern, shown = {
        0: ("Continuous", ""),
        2: ("HIDDEN", "__ __ __ __"),
        4: ("CENTER", "____ _ ____ _ ____"),
    }[len(dashes)]
    if pattern not in document.linetypes:
        lengths = [d * (1 if i % 2 == 0 else -1) for i, d in enumerate(dashes)]
        document.linetypes.add(pattern, [sum(dashes), *lengths], description=shown)
    document.layers.add(name, linetype=pattern, **look)


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
