"""A drawing sheet as PDF 1.4: one page of the paper's size, lines and texts, and nothing else.

The font is Helvetica, which every reader has; letters beyond Windows' western ones, which that has
not, are question marks. Plain ASCII, and the same bytes on every run.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.curves.helvetica import CAPITALS
from geneva_cli.curves.measure import halves
from geneva_cli.curves.shapes import Arc, Circle, Contour, Cubic, Point, Segment, Shape, about
from geneva_cli.curves.sheet import DASHED, WIDTHS, Arrow, Label, Sheet
from geneva_cli.errors import clean
from geneva_cli.output.sheets.parts import arrows, by_layer

POINT = 72.0 / 25.4  # of PDF, in a millimetre
QUARTER = 0.415  # bulge of an arc of 90 degrees, and a little: what one cubic stands for


def chunks(sheet: Sheet) -> Iterator[str]:
    """The file's text."""
    content = "".join(_content(sheet))
    box = f"0 0 {_number(POINT * sheet.width)} {_number(POINT * sheet.height)}"
    objects = [
        "<< /Type /Catalog /Pages 2 0 R >>",
        "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        f"<< /Type /Page /Parent 2 0 R /MediaBox [{box}] /Contents 4 0 R"
        " /Resources << /Font << /F1 5 0 R >> >> >>",
        f"<< /Length {len(content)} >>\nstream\n{content}endstream",
        "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>",
        f"<< /Title <feff{clean(sheet.title).encode('utf-16-be', 'replace').hex()}> >>",
    ]
    text = "%PDF-1.4\n"
    places = []
    for number, body in enumerate(objects, 1):
        places.append(len(text))
        text += f"{number} 0 obj\n{body}\nendobj\n"
    count = len(objects) + 1
    table = "".join(f"{place:010d} 00000 n \n" for place in places)
    yield text
    yield f"xref\n0 {count}\n0000000000 65535 f \n{table}"
    yield f"trailer\n<< /Size {count} /Root 1 0 R /Info {count - 1} 0 R >>\n"
    yield f"startxref\n{len(text)}\n%%EOF\n"


def _content(sheet: Sheet) -> Iterator[str]:
    """The page's operators, in millimetres."""
    yield f"{POINT:.9f} 0 0 {POINT:.9f} 0 0 cm\n1 J 1 j\n"
    for layer, shapes in by_layer(sheet):
        dashes = " ".join(map(_number, DASHED.get(layer, ())))
        yield f"{_number(WIDTHS[layer])} w [{dashes}] 0 d\n"
        yield from map(_shape, shapes)
    yield from map(_arrow, arrows(sheet))
    for label in sheet.texts:
        yield _text(label)


def _shape(shape: Shape) -> str:
    if isinstance(shape, Circle):
        pieces = tuple(
            about(shape.centre, shape.radius, start, math.pi) for start in (0.0, math.pi)
        )
        shape = Contour(shape.layer, pieces)
    words = [f"{_point(shape.segments[0].start)} m\n"]
    words += [_piece(part) for segment in shape.segments for part in _quarters(segment)]
    return "".join(words) + ("s\n" if shape.closed else "S\n")


def _quarters(segment: Segment) -> list[Segment]:
    if isinstance(segment, Arc) and abs(segment.bulge) > QUARTER:
        return [part for half in halves(segment) for part in _quarters(half)]
    return [segment]


def _piece(segment: Segment) -> str:
    if isinstance(segment, Arc):
        segment = _cubic(segment)
    if isinstance(segment, Cubic):
        return " ".join(map(_point, segment[1:])) + " c\n"
    return f"{_point(segment.end)} l\n"


def _cubic(arc: Arc) -> Cubic:
    """The cubic with the arc's ends, tangents and middle: at 90 degrees off by 3e-4 of its radius.

    Its handles are 4/3 tan(sweep/4) of the radius long, which with the bulge b is (1 + b²)/3 of
    the chord.
    """
    (x0, y0), (x1, y1) = arc.start, arc.end
    long = (1.0 + arc.bulge * arc.bulge) / 3.0
    half = 0.5 * arc.sweep
    c, s = long * math.cos(half), long * math.sin(half)
    x, y = x1 - x0, y1 - y0
    first = x0 + c * x + s * y, y0 + c * y - s * x
    second = x1 - c * x + s * y, y1 - c * y - s * x
    return Cubic(arc.start, first, second, arc.end)


def _arrow(arrow: Arrow) -> str:
    a, b, c = map(_point, arrow.corners)
    return f"{a} m {b} l {c} l f\n"


def _text(label: Label) -> str:
    c, s = math.cos(label.turn), math.sin(label.turn)
    matrix = " ".join(_number(v) for v in (c, s, -s, c, *label.at))
    size = _number(label.height / CAPITALS)
    return f"BT /F1 {size} Tf {matrix} Tm ({_escaped(label.text)}) Tj ET\n"


def _escaped(text: str) -> str:
    codes = clean(text).encode("cp1252", "replace")
    return "".join(
        chr(c) if 32 <= c < 127 and chr(c) not in "()\\" else f"\\{c:03o}" for c in codes
    )


def _point(p: Point) -> str:
    return f"{_number(p[0])} {_number(p[1])}"


def _number(value: float) -> str:
    text = f"{value:.5f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
