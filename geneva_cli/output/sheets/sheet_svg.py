"""A drawing sheet as SVG, of the paper's size; black on white, or white on black in dark mode."""

from __future__ import annotations

import math
from collections.abc import Iterator
from html import escape

from geneva_cli.errors import clean
from geneva_cli.geometry.sheet import CAPITALS, DASHED, WIDTHS, Label, Sheet
from geneva_cli.output.svg.drawing_svg import element, number, place, point

STYLE = """<style>
.paper { fill: #ffffff; stroke: none }
.ink { stroke: #000000 }
.ink text, .ink .full { fill: #000000; stroke: none }
@media screen and (prefers-color-scheme: dark) {
.paper { fill: #15181c }
.ink { stroke: #e8e8e8 }
.ink text, .ink .full { fill: #e8e8e8 }
}
</style>
"""


def chunks(sheet: Sheet) -> Iterator[str]:
    """The file's text."""
    w, h = number(sheet.width), number(sheet.height)
    yield (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}mm" height="{h}mm"'
        f' viewBox="0 {number(-sheet.height)} {w} {h}"'
        ' fill="none" stroke-linecap="round" stroke-linejoin="round">\n'
        f"<title>{escape(clean(sheet.title), quote=False)}</title>\n{STYLE}"
        f'<rect class="paper" y="{number(-sheet.height)}" width="{w}" height="{h}"/>\n'
        f'<g class="ink" font-family="Helvetica, Arial, \'Liberation Sans\', sans-serif">\n'
    )
    for layer, shapes in sheet.by_layer():
        dashes = ""
        if layer in DASHED:
            dashes = f' stroke-dasharray="{" ".join(map(str, DASHED[layer]))}"'
        yield f'<g id="{layer}" stroke-width="{WIDTHS[layer]}"{dashes}>\n'
        yield from map(element, shapes)
        yield "</g>\n"
    yield '<g id="ARROWS" class="full">\n'
    for arrow in sheet.arrows:
        yield f'<path d="M {" L ".join(map(point, arrow.corners))} Z"/>\n'
    yield '</g>\n<g id="TEXTS">\n'
    yield from map(_text, sheet.texts)
    yield "</g>\n</g>\n</svg>\n"


def _text(label: Label) -> str:
    """The element of a text, stretched to the width that the sheet assumes, whatever the font."""
    turn = ""
    if label.turn:
        x, y = label.at
        degrees = number(-math.degrees(label.turn))
        turn = f' transform="rotate({degrees} {number(x)} {number(-y)})"'
    return (
        f'<text {place(label.at)} font-size="{number(label.height / CAPITALS)}"'
        f' textLength="{number(label.width)}" lengthAdjust="spacingAndGlyphs"{turn}>'
        f"{escape(clean(label.text), quote=False)}</text>\n"
    )
