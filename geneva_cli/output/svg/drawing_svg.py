"""SVG at true size: one path for each part, circles for bores, in plain coordinates.

Drawings to cut have hairlines only. Drawings to view have lines in proportion to their size, filled
plates, and notes; see ``svg_look``.
"""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from geneva_cli.errors import GenevaError, clean, cut
from geneva_cli.geometry.drawing import Drawing, extent
from geneva_cli.geometry.measure import Box
from geneva_cli.geometry.pieces import SUFFIX, UNITS, prepared
from geneva_cli.output.formats import FILLS
from geneva_cli.output.inks import CENTRE_LINES, DASHES, inks
from geneva_cli.output.notes import notes
from geneva_cli.output.svg.svg_fill import filled, rings
from geneva_cli.output.svg.svg_look import noted, style
from geneva_cli.output.svg.svg_paths import element, number

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
    """Yield the shapes by their layers; ``mm`` is a millimetre of the page in the file's unit."""
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
