"""A drawing on paper at the largest scale: tinted plates, inked lines, and notes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

from geneva_cli import output
from geneva_cli.geometry.measure import mapped
from geneva_cli.geometry.pieces import UNITS, prepared
from geneva_cli.geometry.plates import Part
from geneva_cli.geometry.shapes import Point, Shape
from geneva_cli.geometry.sheet import Annotations, Drawing, extent
from geneva_cli.output.inks import CENTRE_LINES, inks
from geneva_cli.output.notes import LETTERS, Notes, notes
from geneva_cli.output.pdf.pdf_file import outline, point, tint
from geneva_cli.output.pdf.pdf_pages import LEFT, SMALL, SOFT, WIDE, Item, words
from geneva_cli.output.svg.drawing_svg import opacity, rings

STROKE, THIN = 0.3, 0.16
MARGIN = 3.0
TALL = 92.0  # greatest height of the shapes

Move: TypeAlias = Callable[[Shape], Shape]
Put: TypeAlias = Callable[[Point], Point]


def drawing(drawn: Drawing) -> Item:
    """Return the drawing, centred on the page, with its notes."""
    units = output.choice.units
    shown = prepared(drawn, units)
    look, box = shown.look or Annotations(), extent(shown)
    # notes add little to a drawing's width, and its arrows of rotation may add much
    around = notes(Annotations(turns=look.turns), box, "", 0.0, units).box
    wide, tall = around.x1 - around.x0, around.y1 - around.y0
    scale = min((WIDE - 2.0 * MARGIN) / wide, TALL / tall)
    noted = notes(look, box, "", SMALL / LETTERS / scale, units)
    left = LEFT + 0.5 * (WIDE - scale * wide)

    def draw(top: float) -> str:
        def at(p: Point) -> Point:
            return left + scale * (p[0] - around.x0), top - MARGIN + scale * (p[1] - around.y1)

        def placed(shape: Shape) -> Shape:
            return mapped(shape, at, lambda radius: radius * scale)

        fills = _fills(shown.solid, UNITS[units], placed) if shown.solid else ()
        return "".join((*fills, *_lines(shown, placed), *_notes(noted, at, placed)))

    return Item(scale * (noted.box.y1 - noted.box.y0) + 2.0 * MARGIN, draw)


def _fills(solid: Part, unit: float, placed: Move) -> Iterator[str]:
    every = rings(solid, unit)
    inked = inks(tuple(dict.fromkeys(layer for layer, _ in every)))
    for layer, contours in every:
        yield f"{tint(inked[layer].rgb, opacity(layer))} rg\n"
        yield "".join(outline(placed(contour)) for contour in contours) + "f*\n"


def _lines(shown: Drawing, placed: Move) -> Iterator[str]:
    for layer, ink in inks(shown.layers).items():
        is_thin = layer in CENTRE_LINES
        yield f"{tint(ink.rgb)} RG {THIN if is_thin else STROKE} w"
        yield f" [{'4 0.8 0.8 0.8' if is_thin else ''}] 0 d\n"
        for shape in shown.shapes:
            if shape.layer == layer:
                yield f"{outline(placed(shape))}S\n"


def _notes(noted: Notes, at: Put, placed: Move) -> Iterator[str]:
    yield f"{SOFT} RG {SOFT} rg {THIN} w [] 0 d\n"
    for shape in (*noted.lines, *noted.scale_bar):
        yield f"{outline(placed(shape))}S\n"
    for head in noted.heads:
        a, b, c = (point(at(corner)) for corner in head)
        yield f"{a} m {b} l {c} l f\n"
    for place, text in noted.texts:
        yield words(text, at(place), SMALL)
