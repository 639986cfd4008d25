"""SVG at true size, in plain coordinates: drawings with a path for each part, and drawing sheets.

Drawings to cut have hairlines only. Drawings to view have lines in proportion to their size, tinted
plates, and notes. A sheet is black on white, or white on black in dark mode.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from typing import TypeAlias

from geneva_cli.errors import clean
from geneva_cli.geometry import shapes
from geneva_cli.geometry import sheet as papers
from geneva_cli.geometry.plates import Member, Part, in_place
from geneva_cli.geometry.shapes import Circle, Contour, Layer, Line, Point, Segment, Shape
from geneva_cli.geometry.sheet import CAPITALS, DASHED, WIDTHS, Drawing, Sheet
from geneva_cli.output.inks import CENTRE_LINES, DARK, DASHES, INKS, LIGHT, Paper, mixed
from geneva_cli.output.notes import LETTERS, notes
from geneva_cli.output.templates import filled

# For drawings to cut, in mm; for drawings to view, as if these were 250 mm wide
STROKE = 0.25
MARGIN = 2.0
Ring: TypeAlias = tuple[Layer, tuple[Contour, ...]]  # outline and holes of a plate


def chunks(drawing: Drawing) -> Iterator[str]:
    """Yield a drawing's text. Raises GenevaError for a drawing without shapes."""
    look, drawing = drawing.look, papers.prepared(drawing)
    box = papers.extent(drawing)
    mm = max(box.x1 - box.x0, box.y1 - box.y0) / 250.0 if look else 1.0
    title = clean(drawing.title).strip()
    shown = notes(look, box, title, mm) if look else None
    frame = shown.box if shown else box
    margin = mm * (2.0 * MARGIN if look else MARGIN + STROKE)
    wide, high = frame.x1 - frame.x0 + 2.0 * margin, frame.y1 - frame.y0 + 2.0 * margin
    parts = {"LEFT": number(frame.x0 - margin), "TOP": number(-frame.y1 - margin)}
    parts |= {"WIDE": number(wide), "HIGH": number(high), "TITLE": escape(title, quote=False)}
    parts["LAYERS"] = ""
    for name in drawing.layers:
        dashes, stroke = "", mm * STROKE * (1.6 if look else 1.0)  # wider lines to view
        if name in CENTRE_LINES:
            dashes = f' stroke-dasharray="{" ".join(number(mm * d) for d in DASHES)}"'
        # rollers' paths, and the lowest layer
        if look and name in (*CENTRE_LINES, "FRAME"):
            stroke *= 0.6
        ink = f'stroke="{INKS[name].rgb}" stroke-width="{number(stroke)}"{dashes}'
        own = (element(shape) for shape in drawing.shapes if shape.layer == name)
        parts["LAYERS"] += f'<g id="{escape(name)}" {ink}>\n{"".join(own)}</g>\n'
    if shown:
        parts |= _colours(drawing.layers, rings(drawing.solid) if drawing.solid else [])
        parts |= {"STROKE": number(mm * 0.25), "SIZE": number(mm * LETTERS)}
        parts |= {"NOTES": "".join(map(element, shown.lines)), "ARROWS": _arrows(shown.heads)}
        parts["BAR"] = " ".join(map(path, shown.scale_bar))
        texts = (f"<text {place(at)}>{escape(t, quote=False)}</text>\n" for at, t in shown.texts)
        parts["TEXTS"] = "".join(texts)
    yield filled("view.svg" if shown else "cut.svg", parts)


def _colours(layers: Sequence[str], plates: Sequence[Ring]) -> dict[str, str]:
    """The tinted plates of a drawing to view, and the colours of a dark page.

    Programs without CSS show the light one.
    """
    tints = "".join(
        f'<path class="{layer}" fill="{tint(layer, LIGHT)}" d="{" ".join(map(path, ring))}"/>\n'
        for layer, ring in plates
    )
    fill = f'<g id="FILL" stroke="none" fill-rule="evenodd">\n{tints}</g>\n' if plates else ""
    dark = [
        f"g[id='{layer}'] {{ stroke: {mixed(INKS[layer].rgb, 0.55, '#ffffff')} }}\n"
        for layer in layers
    ]
    for layer in dict.fromkeys(layer for layer, _ in plates):
        dark.append(f"path[class='{layer}'] {{ fill: {tint(layer, DARK)} }}\n")
    parts = {"FILL": fill, "DARK": "".join(dark), "PAGE": LIGHT.page}
    parts |= {"DARKPAGE": DARK.page, "DARKLINE": DARK.axis, "DARKTEXT": DARK.text}
    return parts | {"INK": LIGHT.text}


def sheet_chunks(sheet: Sheet) -> Iterator[str]:
    """Yield a drawing sheet's text."""
    parts = {"WIDE": number(sheet.width), "HIGH": number(sheet.height), "LAYERS": ""}
    parts |= {"TOP": number(-sheet.height), "TITLE": escape(clean(sheet.title), quote=False)}
    for layer, own in sheet.by_layer():
        dashes = ""
        if layer in DASHED:
            dashes = f' stroke-dasharray="{" ".join(map(str, DASHED[layer]))}"'
        ink = f'stroke-width="{WIDTHS[layer]}"{dashes}'
        parts["LAYERS"] += f'<g id="{layer}" {ink}>\n{"".join(map(element, own))}</g>\n'
    parts |= {"ARROWS": _arrows(sheet.arrows)}
    yield filled("sheet.svg", parts | {"TEXTS": "".join(map(_label, sheet.texts))})


def _label(label: papers.Label) -> str:
    turn = ""
    if label.turn:
        x, y = label.at
        degrees = number(-math.degrees(label.turn))
        turn = f' transform="rotate({degrees} {number(x)} {number(-y)})"'
    # stretched to the width that the sheet assumes, whatever the font
    return (
        f'<text {place(label.at)} font-size="{number(label.height / CAPITALS)}"'
        f' textLength="{number(label.width)}" lengthAdjust="spacingAndGlyphs"{turn}>'
        f"{escape(clean(label.text), quote=False)}</text>\n"
    )


def _arrows(heads: Iterable[papers.Arrow]) -> str:
    return "".join(f'<path d="M {" L ".join(map(point, head.corners))} Z"/>\n' for head in heads)


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


def tint(layer: Layer, paper: Paper) -> str:
    """The colour of a layer's plates on a page, as hexadecimal RGB."""
    return mixed(INKS[layer].rgb, 0.55 if layer == "ROLLER" else 0.16, paper.page)


def rings(solid: Part) -> list[Ring]:
    """The layer of each plate with its outline and holes; the lowest plate first.

    Of plates of one shape above each other only the highest is there, which covers the others.
    """
    placed = (plate for _, plate in in_place([Member(solid)]))
    every = sorted(placed, key=lambda plate: (plate.high, plate.low))
    drawn = [(one.layer, tuple(map(shapes.as_contour, (one.outline, *one.holes)))) for one in every]
    return list(dict.fromkeys(reversed(drawn)))[::-1]
