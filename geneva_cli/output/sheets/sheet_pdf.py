"""A drawing sheet as PDF: one page of the paper's size with lines and texts only."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.geometry.sheet import CAPITALS, DASHED, WIDTHS, Sheet
from geneva_cli.output.pdf import pdf_file
from geneva_cli.output.pdf.pdf_file import POINT, Page, number, outline, point


def chunks(sheet: Sheet) -> Iterator[str]:
    """The file's text."""
    page = Page(sheet.width, sheet.height, "".join(_content(sheet)))
    yield from pdf_file.pdf_text(sheet.title, [page])


def _content(sheet: Sheet) -> Iterator[str]:
    yield f"{POINT:.9f} 0 0 {POINT:.9f} 0 0 cm\n1 J 1 j\n"
    for layer, shapes in sheet.by_layer():
        dashes = " ".join(map(number, DASHED.get(layer, ())))
        yield f"{number(WIDTHS[layer])} w [{dashes}] 0 d\n"
        yield from (f"{outline(shape)}S\n" for shape in shapes)
    for arrow in sheet.arrows:
        a, b, c = map(point, arrow.corners)
        yield f"{a} m {b} l {c} l f\n"
    for label in sheet.texts:
        yield pdf_file.text(label.text, label.at, label.height / CAPITALS, label.turn)
