"""SVG at true size, in plain coordinates: drawings with a path for each part, and drawing sheets.

Drawings to cut have hairlines only. Drawings to view have lines in proportion to their size, tinted
plates, and notes. A sheet is black on white, or white on black in dark mode.
"""

import math
from collections.abc import Iterator
from html import escape

from geneva_cli.errors import clean
from geneva_cli.geometry import shapes
from geneva_cli.geometry.plates import Member, Part, in_place
from geneva_cli.geometry.shapes import Circle, Contour, Layer, Line, Point, Segment, Shape
from geneva_cli.geometry.sheet import CAPITALS, DASHED, WIDTHS, Drawing, Sheet, extent, prepared
from geneva_cli.output.inks import CENTRE_LINES, DARK, DASHES, INKS, LIGHT, Paper, mixed
from geneva_cli.output.notes import LETTERS, Notes, notes
from geneva_cli.output.templates import template

# For drawings to cut, in mm; for drawings to view, as if these were 250 mm wide
STROKE = 0.25
MARGIN = 2.0


def chunks(drawing: Drawing) -> Iterator[str]:
    """Yield a drawing's text. Raises GenevaError for a drawing without shapes."""
    look, drawing = drawing.look, prepared(drawing)
    box = extent(drawing)
    size = max(box.x1 - box.x0, box.y1 - box.y0)
    mm = size / 250.0 if look else 1.0
    title = clean(drawing.title).strip()
    shown = notes(look, box, title, mm) if look else None
    frame = shown.box if shown else box
    margin = mm * (2.0 * MARGIN if look else MARGIN + STROKE)
    x, y = number(frame.x0 - margin), number(-frame.y1 - margin)
    width = number(frame.x1 - frame.x0 + 2.0 * margin)
    height = number(frame.y1 - frame.y0 + 2.0 * margin)
    yield _head(' version="1.1"', f"{x} {y}", width, height, title)
    plates = rings(drawing.solid) if look and drawing.solid else []
    if look:
        yield _style(drawing.layers, list(dict.fromkeys(layer for layer, _ in plates)))
        yield f'<rect class="page" fill="{LIGHT.page}" x="{x}" y="{y}" width="{width}"'
        yield f' height="{height}"/>\n'
    if plates:
        yield '<g id="FILL" stroke="none" fill-rule="evenodd">\n'
        for layer, contours in plates:
            yield f'<path class="{layer}" fill="{_tint(layer, LIGHT)}"'
            yield f' d="{" ".join(map(path, contours))}"/>\n'
        yield "</g>\n"
    for name in drawing.layers:
        dashes, stroke = "", mm * STROKE * (1.6 if look else 1.0)  # wider lines to view
        if name in CENTRE_LINES:
            dashes = f' stroke-dasharray="{" ".join(number(mm * d) for d in DASHES)}"'
        # rollers' paths, and the lowest layer
        if look and name in (*CENTRE_LINES, "FRAME"):
            stroke *= 0.6
        yield f'<g id="{escape(name)}" stroke="{INKS[name].rgb}"'
        yield f' stroke-width="{number(stroke)}"{dashes}>\n'
        yield from (element(shape) for shape in drawing.shapes if shape.layer == name)
        yield "</g>\n"
    if shown:
        yield from _noted(shown, mm)
    yield "</svg>\n"


def sheet_chunks(sheet: Sheet) -> Iterator[str]:
    """Yield a drawing sheet's text."""
    w, h, top = number(sheet.width), number(sheet.height), number(-sheet.height)
    yield _head("", f"0 {top}", w, h, clean(sheet.title)) + template("sheet.css")
    yield (
        f'<rect class="paper" y="{top}" width="{w}" height="{h}"/>\n'
        f'<g class="ink" font-family="Helvetica, Arial, \'Liberation Sans\', sans-serif">\n'
    )
    for layer, own in sheet.by_layer():
        dashes = ""
        if layer in DASHED:
            dashes = f' stroke-dasharray="{" ".join(map(str, DASHED[layer]))}"'
        yield f'<g id="{layer}" stroke-width="{WIDTHS[layer]}"{dashes}>\n'
        yield from map(element, own)
        yield "</g>\n"
    yield '<g id="ARROWS" class="full">\n'
    for arrow in sheet.arrows:
        yield f'<path d="M {" L ".join(map(point, arrow.corners))} Z"/>\n'
    yield '</g>\n<g id="TEXTS">\n'
    for label in sheet.texts:
        turn = ""
        if label.turn:
            x, y = label.at
            degrees = number(-math.degrees(label.turn))
            turn = f' transform="rotate({degrees} {number(x)} {number(-y)})"'
        # stretched to the width that the sheet assumes, whatever the font
        yield (
            f'<text {place(label.at)} font-size="{number(label.height / CAPITALS)}"'
            f' textLength="{number(label.width)}" lengthAdjust="spacingAndGlyphs"{turn}>'
            f"{escape(clean(label.text), quote=False)}</text>\n"
        )
    yield "</g>\n</g>\n</svg>\n"


def _head(version: str, corner: str, width: str, height: str, title: str) -> str:
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg"{version}'
        f' width="{width}mm" height="{height}mm"'
        f' viewBox="{corner} {width} {height}"'
        ' fill="none" stroke-linecap="round" stroke-linejoin="round">\n'
        f"<title>{escape(title, quote=False)}</title>\n"
    )


def element(shape: Shape) -> str:
    """The element of a circle or a contour."""
    if isinstance(shape, Circle):
        (x, y), r = shape.centre, shape.radius
        return f'<circle cx="{number(x)}" cy="{number(-y)}" r="{number(r)}"/>\n'
    return f'<path d="{path(shape)}"/>\n'


def path(contour: Contour) -> str:
    """A contour as the data of a path."""
    segments = contour.segments
    words = [f"M {point(segments[0].start)}"]
    if contour.closed and isinstance(segments[-1], Line):
        segments = segments[:-1]  # Z draws the last line; drawn here it would have no length there
    # Bulges of 150, 210 and 300 degrees. Near a half turn the radius determines the centre badly,
    # near a whole turn the chord does.
    split = [
        shapes.halved(one, lambda bulge: 0.7673 < bulge < 1.3032 or bulge > 3.7) for one in segments
    ]
    words += [_command(part) for parts in split for part in parts]
    return " ".join(words) + (" Z" if contour.closed else "")


def _command(segment: Segment) -> str:
    if isinstance(segment, Line):
        return f"L {point(segment.end)}"
    if isinstance(segment, shapes.Cubic):
        return "C " + " ".join(map(point, segment[1:]))
    radius, large, down = number(segment.radius), abs(segment.bulge) > 1.0, segment.bulge < 0.0
    return f"A {radius},{radius} 0 {large:d} {down:d} {point(segment.end)}"


def place(p: Point) -> str:
    """A point as two attributes."""
    return f'x="{number(p[0])}" y="{number(-p[1])}"'


def point(p: Point) -> str:
    """A point in a path."""
    return f"{number(p[0])},{number(-p[1])}"


def number(value: float) -> str:
    """A number with fixed decimals, without an exponent or a negative zero."""
    text = f"{value:.9f}"
    return text if text.strip("-0.") else text.lstrip("-")


def _tint(layer: Layer, paper: Paper) -> str:
    return mixed(INKS[layer].rgb, opacity(layer), paper.page)


def opacity(layer: Layer) -> float:
    """Opacity of a layer's tint, from 0 to 1."""
    return 0.55 if layer == "ROLLER" else 0.16


def rings(solid: Part) -> list[tuple[Layer, tuple[Contour, ...]]]:
    """The layer of each plate with its outline and holes; the lowest plate first.

    Of plates of one shape above each other only the highest is there, which covers the others.
    """
    placed = (plate for _, plate in in_place([Member(solid)]))
    every = sorted(placed, key=lambda plate: (plate.high, plate.low))
    drawn = [(one.layer, tuple(map(shapes.as_contour, (one.outline, *one.holes)))) for one in every]
    return list(dict.fromkeys(reversed(drawn)))[::-1]


def _style(layers: tuple[str, ...], plates: list[Layer]) -> str:
    """The colours of a dark page; programs without CSS show the light one."""
    dark = "".join(
        f"g[id='{layer}'] {{ stroke: {mixed(INKS[layer].rgb, 0.55, '#ffffff')} }}\n"
        for layer in layers
    )
    for layer in plates:
        dark += f"path[class='{layer}'] {{ fill: {_tint(layer, DARK)} }}\n"
    return (
        "<style>\n@media screen and (prefers-color-scheme: dark) {\n"
        f".page {{ fill: {DARK.page} }}\n"
        f"#NOTES {{ stroke: {DARK.axis} }}\n"
        f"#TEXT, #ARROWS {{ fill: {DARK.text} }}\n{dark}"
        "}\n</style>\n"
    )


def _noted(shown: Notes, mm: float) -> Iterator[str]:
    grey = "#757575"
    yield f'<g id="NOTES" stroke="{grey}" stroke-width="{number(mm * 0.25)}">\n'
    yield from map(element, shown.lines)
    yield f'<path id="SCALE_BAR" d="{" ".join(map(path, shown.scale_bar))}"/>\n</g>\n'
    yield f'<g id="ARROWS" fill="{grey}">\n'
    yield from (f'<path d="M {" L ".join(map(point, head))} Z"/>\n' for head in shown.heads)
    yield f'</g>\n<g id="TEXT" fill="{LIGHT.text}" font-family="sans-serif"'
    yield f' font-size="{number(mm * LETTERS)}">\n'
    for at, text in shown.texts:
        yield f"<text {place(at)}>{escape(text, quote=False)}</text>\n"
    yield "</g>\n"
