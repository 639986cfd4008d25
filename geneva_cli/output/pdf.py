"""PDF 1.4 with lines, filled shapes and texts only: files, A4 pages of items, drawing sheets.

The fonts are Helvetica and its bold, which every reader has. They lack letters beyond Windows'
western ones, which would be question marks, so ``western`` in output/letters.py spells those. The
output is plain ASCII, and equal on every run. Lengths are in millimetres, y up.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import chain
from typing import NamedTuple

from geneva_cli.errors import clean
from geneva_cli.geometry import shapes
from geneva_cli.geometry import sheet as letters
from geneva_cli.geometry.sheet import CAPITALS, DASHED, WIDTHS, Sheet
from geneva_cli.output.letters import western
from geneva_cli.table import in_decimals

POINT = 72.0 / 25.4  # points per millimetre
BEGIN = f"{POINT:.9f} 0 0 {POINT:.9f} 0 0 cm\n1 J 1 j\n"  # of a page's content
INK = "0.1 0.12 0.14"


class Page(NamedTuple):
    """A page of a size in millimetres, and the operators that fill it."""

    width: float
    height: float
    content: str


def pdf_text(title: str, pages: Sequence[Page]) -> Iterator[str]:
    """Yield a file's text."""
    fonts = "Helvetica", "Helvetica-Bold"
    first = 3 + 2 * len(pages)  # the number of the first font
    known = " ".join(f"/F{i + 1} {first + i} 0 R" for i in range(len(fonts)))
    kids = " ".join(f"{3 + 2 * i} 0 R" for i in range(len(pages)))
    objects = [
        "<< /Type /Catalog /Pages 2 0 R >>",
        f"<< /Type /Pages /Kids [{kids}] /Count {len(pages)} >>",
    ]
    for i, page in enumerate(pages):
        box = f"0 0 {number(POINT * page.width)} {number(POINT * page.height)}"
        objects += [
            f"<< /Type /Page /Parent 2 0 R /MediaBox [{box}] /Contents {4 + 2 * i} 0 R"
            f" /Resources << /Font << {known} >> >> >>",
            f"<< /Length {len(page.content)} >>\nstream\n{page.content}endstream",
        ]
    objects += [
        f"<< /Type /Font /Subtype /Type1 /BaseFont /{font} /Encoding /WinAnsiEncoding >>"
        for font in fonts
    ]
    objects.append(f"<< /Title <feff{clean(title).encode('utf-16-be', 'replace').hex()}> >>")
    text, table = "%PDF-1.4\n", ""
    for i, body in enumerate(objects, 1):
        table += f"{len(text):010d} 00000 n \n"
        text += f"{i} 0 obj\n{body}\nendobj\n"
    count = len(objects) + 1
    yield text
    yield f"xref\n0 {count}\n0000000000 65535 f \n{table}"
    yield f"trailer\n<< /Size {count} /Root 1 0 R /Info {count - 1} 0 R >>\n"
    yield f"startxref\n{len(text)}\n%%EOF\n"


def sheet_chunks(sheet: Sheet) -> Iterator[str]:
    """Yield the text of a drawing sheet: one page of the paper's size with lines and texts."""
    content = BEGIN
    for layer, own in sheet.by_layer():
        dashes = " ".join(map(number, DASHED.get(layer, ())))
        content += f"{number(WIDTHS[layer])} w [{dashes}] 0 d\n"
        content += "".join(f"{outline(shape)}S\n" for shape in own)
    for arrow in sheet.arrows:
        content += triangle(arrow.corners)
    for label in sheet.texts:
        content += _text(label.text, label.at, label.height / CAPITALS, label.turn)
    yield from pdf_text(sheet.title, [Page(sheet.width, sheet.height, content)])


def outline(shape: shapes.Shape) -> str:
    """The operators that trace a shape, closed if the shape is."""
    shape = shapes.as_contour(shape)
    words = [f"{point(shape.segments[0].start)} m\n"]
    # The bulge of slightly more than 90 degrees: a longer arc needs more than one cubic.
    parts = (shapes.halved(segment, lambda bulge: bulge > 0.415) for segment in shape.segments)
    words += map(_piece, chain.from_iterable(parts))
    return "".join(words) + ("h\n" if shape.closed else "")


def _piece(segment: shapes.Segment) -> str:
    if isinstance(segment, shapes.Arc):
        segment = shapes.as_cubic(segment)
    if isinstance(segment, shapes.Cubic):
        return " ".join(map(point, segment[1:])) + " c\n"
    return f"{point(segment.end)} l\n"


def triangle(corners: Sequence[shapes.Point]) -> str:
    """A filled triangle."""
    a, b, c = map(point, corners)
    return f"{a} m {b} l {c} l f\n"


def words(text: str, at: shapes.Point, size: float, bold: bool = False, ink: str = INK) -> str:
    """A coloured text that starts at a point on its base line."""
    return f"{ink} rg\n" + _text(western(text), at, size, 0, 2 if bold else 1)


def _text(words: str, at: shapes.Point, size: float, turn: float, font: int = 1) -> str:
    """A text that starts at a point on its base line; ``turn`` is in radians."""
    c, s = math.cos(turn), math.sin(turn)
    matrix = " ".join(number(v) for v in (c, s, -s, c, *at))
    return f"BT /F{font} {number(size)} Tf {matrix} Tm ({_escaped(words)}) Tj ET\n"


def _escaped(words: str) -> str:
    codes = clean(words).encode("cp1252", "replace")
    return "".join(
        chr(c) if 32 <= c < 127 and chr(c) not in "()\\" else f"\\{c:03o}" for c in codes
    )


def wide(text: str, size: float, bold: bool = False) -> float:
    """A text's width in Helvetica, as ``words`` shows it."""
    return CAPITALS * size * letters.width(western(text), bold)


def box(x: float, y: float, long: float, high: float, ink: str) -> str:
    """A filled rectangle up from its lower left corner."""
    return f"{ink} rg {number(x)} {number(y)} {number(long)} {number(high)} re f\n"


def moved(content: str, x: float, y: float, scale: float = 1.0) -> str:
    """Operators with their origin at a point, and scaled."""
    return f"q {scale:.9f} 0 0 {scale:.9f} {number(x)} {number(y)} cm\n{content}Q\n"


def colour(rgb: str) -> str:
    """A colour as the operands of an operator."""
    return " ".join(number(int(rgb[i : i + 2], 16) / 255.0) for i in (1, 3, 5))


def point(p: shapes.Point) -> str:
    """A point's coordinates."""
    return f"{number(p[0])} {number(p[1])}"


def number(value: float) -> str:
    """A number with at most five decimals, without a negative zero."""
    return in_decimals(value, 5)
