"""SVG at true size: one path for each part, circles for bores, in plain coordinates.

Drawings to cut have hairlines only. Drawings to view have lines in proportion to their size, filled
plates, and notes.
"""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import TypeAlias

from geneva_cli.errors import GenevaError, clean, cut
from geneva_cli.geometry.measure import Box, halved, mapped
from geneva_cli.geometry.pieces import SUFFIX, UNITS, prepared
from geneva_cli.geometry.plates import Member, Part, in_place
from geneva_cli.geometry.shapes import (
    Circle,
    Contour,
    Cubic,
    Layer,
    Line,
    Point,
    Segment,
    Shape,
    as_contour,
)
from geneva_cli.geometry.sheet import Drawing, extent
from geneva_cli.output.formats import FILLS
from geneva_cli.output.inks import CENTRE_LINES, DARK, DASHES, INKS, LIGHT, Paper, inks, mixed
from geneva_cli.output.notes import LETTERS, Notes, notes

# For drawings to cut, in mm; for drawings to view, as if these were 250 mm wide
STROKE = 0.25
MARGIN = 2.0


def chunks(drawing: Drawing, units: str, fill: str = "") -> Iterator[str]:
    """The file's text; ``units`` is mm or inch, ``fill`` one of ``output.FILLS``.

    Drawings to view are filled with tints by default. Raises GenevaError for another unit or fill,
    a coordinate that is not finite, or a drawing without shapes.
    """
    look, solid = drawing.look, drawing.solid
    fill = fill or ("tint" if look and solid else "none")
    if fill not in FILLS:
        raise GenevaError(f"--fill {cut(fill)}: it must be one of {', '.join(FILLS)}")
    if fill != "none" and solid is None:
        raise GenevaError("--fill: this drawing has no plates; leave it out")
    drawing = prepared(drawing, units)
    box, suffix = extent(drawing), SUFFIX[units]
    size = max(box.x1 - box.x0, box.y1 - box.y0)
    mm = size / 250.0 if look else 1.0 / UNITS[units]
    title = clean(drawing.title).strip()
    shown = notes(look, box, title, mm, units) if look else None
    frame = shown.box if shown else box
    margin = mm * (2.0 * MARGIN if look else MARGIN + STROKE)
    yield _head(frame, margin, title, suffix)
    plates = rings(solid, UNITS[units]) if solid is not None and fill != "none" else []
    if look:
        tinted = [layer for layer, _ in plates if fill == "tint"]
        yield style(drawing.layers, tuple(tinted), frame, margin)
    if plates:
        yield from filled(plates, fill, mm)
    yield from _layers(drawing, mm)
    if shown:
        yield from noted(shown, mm)
    yield "</svg>\n"


def _layers(drawing: Drawing, mm: float) -> Iterator[str]:
    for layer, ink in inks(drawing.layers).items():
        dashes, stroke = "", mm * STROKE * (1.6 if drawing.look else 1.0)  # wider lines to view
        if layer in CENTRE_LINES:
            dashes = f' stroke-dasharray="{" ".join(number(mm * d) for d in DASHES)}"'
        # rollers' paths, and the lowest layer
        if drawing.look and layer in (*CENTRE_LINES, "FRAME"):
            stroke *= 0.6
        yield (
            f'<g id="{escape(layer)}" stroke="{ink.rgb}" stroke-width="{number(stroke)}"{dashes}>\n'
        )
        for shape in drawing.shapes:
            if shape.layer == layer:
                yield element(shape)
        yield "</g>\n"


def _head(frame: Box, margin: float, title: str, suffix: str) -> str:
    x, y = frame.x0 - margin, -frame.y1 - margin
    width = number(frame.x1 - frame.x0 + 2.0 * margin)
    height = number(frame.y1 - frame.y0 + 2.0 * margin)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<svg xmlns="http://www.w3.org/2000/svg" version="1.1"'
        f' width="{width}{suffix}" height="{height}{suffix}"'
        f' viewBox="{number(x)} {number(y)} {width} {height}"'
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
    split = [halved(one, lambda bulge: 0.7673 < bulge < 1.3032 or bulge > 3.7) for one in segments]
    words += [_command(part) for parts in split for part in parts]
    return " ".join(words) + (" Z" if contour.closed else "")


def _command(segment: Segment) -> str:
    if isinstance(segment, Line):
        return f"L {point(segment.end)}"
    if isinstance(segment, Cubic):
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


Plates: TypeAlias = list[tuple[Layer, tuple[Contour, ...]]]  # layers, outlines with their holes


def filled(every: Plates, fill: str, mm: float) -> Iterator[str]:
    """The plates of ``rings``; ``mm`` is a millimetre of lines in the file's unit."""
    here = dict.fromkeys(layer for layer, _ in every)
    layers = tuple(sorted(here, key=[*INKS, *here].index))  # the wheel's hatch first
    turns_deg = (45, 135, 75, 105, 15, 165)  # the layers' hatches have these in turn
    if fill == "hatch":
        yield "<defs>\n"
        for turn, (layer, ink) in zip(turns_deg * len(layers), inks(layers).items(), strict=False):
            step = number(mm * 4.0)  # distance of hatch lines
            yield (
                f'<pattern id="hatch-{layer}" width="{step}" height="{step}"'
                f' patternUnits="userSpaceOnUse" patternTransform="rotate({turn})">'
                f'<path d="M 0,0 L {step},0" stroke="{ink.rgb}"'
                f' stroke-width="{number(mm * 0.25)}"/></pattern>\n'
            )
        yield "</defs>\n"
    tint = tints(layers, LIGHT)
    yield '<g id="FILL" stroke="none" fill-rule="evenodd">\n'
    for layer, contours in every:
        if fill == "hatch":
            how = f'fill="url(#hatch-{layer})"'
        else:
            how = f'class="{layer}" fill="{tint[layer]}"'
        yield f'<path {how} d="{" ".join(map(path, contours))}"/>\n'
    yield "</g>\n"


def tints(layers: tuple[Layer, ...], paper: Paper) -> dict[Layer, str]:
    """The tint of each layer on a page."""
    inked = inks(layers)
    return {layer: mixed(inked[layer].rgb, opacity(layer), paper.page) for layer in layers}


def opacity(layer: Layer) -> float:
    """Opacity of a layer's tint, from 0 to 1."""
    return 0.55 if layer == "ROLLER" else 0.16


def rings(solid: Part, unit: float = 1.0) -> Plates:
    """The outline and holes of each plate, with its layer; the lowest plate first.

    Of plates of one shape above each other only the highest is there, which covers the others.
    ``unit`` is the file's unit in mm.
    """
    placed = (plate for _, plate in in_place([Member(solid)]))
    every = sorted(placed, key=lambda plate: (plate.high, plate.low))

    def in_unit(shape: Shape) -> Contour:
        return as_contour(mapped(shape, lambda p: (p[0] / unit, p[1] / unit), lambda r: r / unit))

    drawn = [(one.layer, tuple(map(in_unit, (one.outline, *one.holes)))) for one in every]
    return list(dict.fromkeys(reversed(drawn)))[::-1]


def style(layers: tuple[str, ...], plates: tuple[Layer, ...], frame: Box, margin: float) -> str:
    """The page behind the drawing, and its colours; programs without CSS show the light one.

    ``plates`` are the layers of its filled plates.
    """
    dark = "".join(
        f"g[id='{layer}'] {{ stroke: {mixed(ink.rgb, 0.55, '#ffffff')} }}\n"
        for layer, ink in inks(layers).items()
    )
    dark += "".join(
        f"path[class='{layer}'] {{ fill: {tint} }}\n" for layer, tint in tints(plates, DARK).items()
    )
    x, y = number(frame.x0 - margin), number(-frame.y1 - margin)
    wide, high = frame.x1 - frame.x0 + 2.0 * margin, frame.y1 - frame.y0 + 2.0 * margin
    return (
        "<style>\n@media screen and (prefers-color-scheme: dark) {\n"
        f".page {{ fill: {DARK.page} }}\n"
        f"#NOTES {{ stroke: {DARK.axis} }}\n"
        f"#TEXT, #ARROWS {{ fill: {DARK.text} }}\n{dark}"
        "}\n</style>\n"
        f'<rect class="page" fill="{LIGHT.page}" x="{x}" y="{y}" width="{number(wide)}"'
        f' height="{number(high)}"/>\n'
    )


def noted(shown: Notes, mm: float) -> Iterator[str]:
    """Yield the elements of annotations."""
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
