"""DXF R2000: one closed polyline a part, circles for bores; the same bytes on every run.

A contour of lines and arcs is one LWPOLYLINE, whose bulges are true arcs. One with cubics, which a
polyline cannot hold, is LINE, ARC and SPLINE entities end to end.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator

from geneva_cli.curves.measure import extent, halves
from geneva_cli.curves.pieces import UNITS, prepared
from geneva_cli.curves.shapes import Arc, Circle, Contour, Cubic, Drawing, Line, Segment
from geneva_cli.errors import clean
from geneva_cli.output.ezdxf_alone import Document, Modelspace, new, options
from geneva_cli.output.inks import CENTRE_LINES, DASHES, inks

INSUNITS = {"mm": 4, "inch": 1}
DECIMALS = 12  # of lengths: with large coordinates more than a float has, and no exponent
FINE = 15  # decimals of bulges and angles, which act through a radius
FINE_CODES = {42, 50, 51}
FLOATS = (range(10, 60), range(110, 150), range(210, 240), range(460, 470), range(1010, 1060))
FLOAT_CODES = {code for codes in FLOATS for code in codes}
NEARLY_ROUND = 3.7  # bulge of 300 degrees; past it the chord says too little about the radius
FLAT = 1e5  # radius past which centre and angles would not hold an arc's ends
JOINT = 1e-9  # how far a spline may pass from the end that two of its cubics share
UNEVEN = 100.0  # greatest ratio of a spline's knot intervals to its first
BLOCK = 1024  # values at a time
TITLE_MAX = 200  # characters; a line may have 255


def chunks(drawing: Drawing, units: str) -> Iterator[str]:
    """The file's text; ``units`` is mm or inch.

    Raises GenevaError for another unit, a coordinate that is not finite, or a drawing without
    shapes.
    """
    lines = _document(prepared(drawing, units), units).split("\n")
    title = clean(drawing.title)[:TITLE_MAX].strip()
    if title:
        yield _ascii(f"999\n{title}\n")  # a comment: a text entity would be cut
    for start in range(0, len(lines) - 1, 2 * BLOCK):
        part = lines[start : start + 2 * BLOCK]
        pairs = zip(part[::2], part[1::2], strict=False)
        yield _ascii("".join(f"{code}\n{_fixed(int(code), value)}\n" for code, value in pairs))


def _document(drawing: Drawing, units: str) -> str:
    """The text as ezdxf writes it, with dates and numbers that do not change."""
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        document = new("R2000", units=INSUNITS[units])
        _layers(document, drawing, 1.0 / UNITS[units])
        space = document.modelspace()
        for shape in drawing.shapes:
            if isinstance(shape, Circle):
                attributes = {"layer": shape.layer}
                space.add_circle(shape.centre, shape.radius, dxfattribs=attributes)
            else:
                _contour(space, shape)
        _extents(document, space, drawing)
        stream = io.StringIO()
        document.write(stream)
    finally:
        options.write_fixed_meta_data_for_testing = before
    return stream.getvalue()


def _layers(document: Document, drawing: Drawing, millimetre: float) -> None:
    pattern = [millimetre * d * (1 if i % 2 == 0 else -1) for i, d in enumerate(DASHES)]
    for layer, ink in inks(drawing.layers).items():
        linetype = "Continuous"
        if layer in CENTRE_LINES:
            linetype = "CENTER"
            if linetype not in document.linetypes:
                dashes = [millimetre * sum(DASHES), *pattern]
                document.linetypes.add(linetype, dashes, description="____ _ ____ _ ____")
        document.layers.add(layer, color=ink.number, linetype=linetype)


def _extents(document: Document, space: Modelspace, drawing: Drawing) -> None:
    box = extent(drawing)
    low, high = (box.x0, box.y0, 0.0), (box.x1, box.y1, 0.0)
    space.reset_extents(low, high)
    space.reset_limits(low[:2], high[:2])
    # a corner at the origin counts as missing when ezdxf copies them here
    document.header["$EXTMIN"], document.header["$EXTMAX"] = low, high
    width, height = box.x1 - box.x0, box.y1 - box.y0
    middle = 0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)
    document.set_modelspace_vport(1.1 * max(width, height), middle)


def _contour(space: Modelspace, contour: Contour) -> None:
    segments = [part for segment in contour.segments for part in _split(segment)]
    if any(isinstance(segment, Cubic) for segment in segments):
        for run in _runs(segments):
            _entity(space, contour.layer, run)
    else:
        _polyline(space, contour.layer, segments, contour.closed)


def _split(segment: Segment) -> tuple[Segment, ...]:
    if isinstance(segment, Arc) and abs(segment.bulge) > NEARLY_ROUND:
        return halves(segment)
    return (segment,)


def _polyline(space: Modelspace, layer: str, segments: list[Segment], close: bool) -> None:
    points = [(*s.start, s.bulge if isinstance(s, Arc) else 0.0) for s in segments]
    if not close:
        points.append((*segments[-1].end, 0.0))
    space.add_lwpolyline(points, format="xyb", close=close, dxfattribs={"layer": layer})


def _entity(space: Modelspace, layer: str, run: list[Segment]) -> None:
    """A line, an arc or a run of cubics as an entity of its own."""
    first, attributes = run[0], {"layer": layer}
    if isinstance(first, Line):
        space.add_line(first.start, first.end, dxfattribs=attributes)
    elif isinstance(first, Arc):
        if first.radius > FLAT:
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

    A joint between its neighbours in the ratio of the knot intervals needs no point of its own.
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
    """Segments one by one, but cubics that go on smoothly together."""
    run: list[Segment] = []
    scale = 1.0  # of the knot interval, beside the run's first
    for segment in segments:
        last = run[-1] if run else None
        if isinstance(last, Cubic) and isinstance(segment, Cubic) and _smooth(last, segment):
            scale *= _ratio(last, segment)
            if 1.0 / UNEVEN < scale < UNEVEN:
                run.append(segment)
                continue
        if run:
            yield run
        run, scale = [segment], 1.0
    yield run


def _smooth(a: Cubic, b: Cubic) -> bool:
    """Whether the common end lies on the line between its neighbours."""
    before, after = math.dist(a.second, a.end), math.dist(b.start, b.first)
    if not min(before, after) > JOINT:
        return False
    share = before / (before + after)
    x, y = (p + share * (q - p) for p, q in zip(a.second, b.first, strict=True))
    return math.dist((x, y), a.end) < JOINT


def _ratio(a: Cubic, b: Cubic) -> float:
    """Of the knot intervals that make the speed the same on both sides of the joint."""
    return math.dist(b.start, b.first) / math.dist(a.second, a.end)


def _size(cubic: Cubic) -> float:
    return sum(map(math.dist, cubic[:-1], cubic[1:]))


def _direction(centre: tuple[float, float], point: tuple[float, float]) -> float:
    return math.degrees(math.atan2(point[1] - centre[1], point[0] - centre[0])) % 360.0


def _fixed(code: int, value: str) -> str:
    """A value with its decimals fixed where it is a float: no exponent, no negative zero."""
    if code not in FLOAT_CODES:
        return value
    text = f"{float(value):.{FINE if code in FINE_CODES else DECIMALS}f}"
    return text if text.strip("-0.") else text.lstrip("-")


def _ascii(text: str) -> str:
    """Letters that not every code page has, as DXF writes them; past four digits it has no way."""
    return "".join(
        c if c < "\x80" else f"\\U+{ord(c):04X}" if c < "\U00010000" else "?" for c in text
    )
