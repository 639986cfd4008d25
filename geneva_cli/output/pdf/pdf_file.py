"""PDF 1.4 with lines, filled shapes and texts only.

The fonts are Helvetica and its bold, which every reader has. They lack letters beyond Windows'
western ones, which would be question marks, so ``western`` in output/letters.py spells those. The
output is plain ASCII, and equal on every run.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from itertools import chain
from typing import NamedTuple

from geneva_cli.errors import clean
from geneva_cli.geometry import sheet
from geneva_cli.geometry.measure import as_cubic, halved
from geneva_cli.geometry.shapes import Arc, Cubic, Point, Segment, Shape, as_contour
from geneva_cli.table import in_decimals

POINT = 72.0 / 25.4  # points per millimetre
# a power of ten is raised: its size and its height, over that of the text
EXPONENT = re.compile(r"(?<=10)\^(-?\d+)")
EXPONENT_SIZE, EXPONENT_RISE = 0.7, 0.33


class Page(NamedTuple):
    """A page of a size in millimetres, and the operators that fill it."""

    width: float
    height: float
    content: str
    fonts: int = 1  # number of fonts that it uses


def pdf_text(title: str, pages: Sequence[Page]) -> Iterator[str]:
    """The file's text."""
    fonts = ("Helvetica", "Helvetica-Bold")[: max(page.fonts for page in pages)]
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
    text = "%PDF-1.4\n"
    places = []
    for i, body in enumerate(objects, 1):
        places.append(len(text))
        text += f"{i} 0 obj\n{body}\nendobj\n"
    count = len(objects) + 1
    table = "".join(f"{place:010d} 00000 n \n" for place in places)
    yield text
    yield f"xref\n0 {count}\n0000000000 65535 f \n{table}"
    yield f"trailer\n<< /Size {count} /Root 1 0 R /Info {count - 1} 0 R >>\n"
    yield f"startxref\n{len(text)}\n%%EOF\n"


def outline(shape: Shape) -> str:
    """The operators that trace a shape, closed if the shape is."""
    shape = as_contour(shape)
    words = [f"{point(shape.segments[0].start)} m\n"]
    # The bulge of slightly more than 90 degrees: a longer arc needs more than one cubic.
    parts = (halved(segment, lambda bulge: bulge > 0.415) for segment in shape.segments)
    words += map(_piece, chain.from_iterable(parts))
    return "".join(words) + ("h\n" if shape.closed else "")


def _piece(segment: Segment) -> str:
    if isinstance(segment, Arc):
        segment = as_cubic(segment)
    if isinstance(segment, Cubic):
        return " ".join(map(point, segment[1:])) + " c\n"
    return f"{point(segment.end)} l\n"


def text(words: str, at: Point, size: float, turn: float = 0.0, font: int = 1) -> str:
    """A text that starts at a point on its base line; ``turn`` is in radians."""
    c, s = math.cos(turn), math.sin(turn)
    matrix = " ".join(number(v) for v in (c, s, -s, c, *at))
    first, *others = EXPONENT.split(words)
    shown = f"({_escaped(first)}) Tj"
    for i, part in enumerate(others):
        tall, rise = (size, 0.0) if i % 2 else (EXPONENT_SIZE * size, EXPONENT_RISE * size)
        shown += f" /F{font} {number(tall)} Tf {number(rise)} Ts ({_escaped(part)}) Tj"
    return f"BT /F{font} {number(size)} Tf {matrix} Tm {shown}{' 0 Ts' * bool(others)} ET\n"


def wide(words: str, size: float, bold: bool = False) -> float:
    """A text's width in Helvetica, as ``text`` shows it."""
    parts = EXPONENT.split(words)
    sizes = (EXPONENT_SIZE * size if i % 2 else size for i in range(len(parts)))
    widths = (sheet.width(part, bold) * tall for part, tall in zip(parts, sizes, strict=True))
    return sheet.CAPITALS * sum(widths)


def _escaped(words: str) -> str:
    codes = clean(words).encode("cp1252", "replace")
    return "".join(
        chr(c) if 32 <= c < 127 and chr(c) not in "()\\" else f"\\{c:03o}" for c in codes
    )


def tint(rgb: str, fraction: float = 1.0) -> str:
    """A colour, or a fraction of it on white, as the operands of an operator."""
    parts = (int(rgb[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    return " ".join(number(1.0 - fraction * (1.0 - p)) for p in parts)


def point(p: Point) -> str:
    """A point's coordinates."""
    return f"{number(p[0])} {number(p[1])}"


def number(value: float) -> str:
    """A number with at most five decimals, without a negative zero."""
    return in_decimals(value, 5)
