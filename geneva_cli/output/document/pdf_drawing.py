"""A drawing on paper at the largest scale: tinted plates, inked lines, distances."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TypeAlias

from geneva_cli import output
from geneva_cli.curves.drawing import Annotations, Drawing, extent
from geneva_cli.curves.measure import bounds, mapped
from geneva_cli.curves.pieces import SUFFIX, UNITS
from geneva_cli.curves.shapes import Arc, Contour, Point, Shape
from geneva_cli.output.document.paper import INK, LEFT, SMALL, SOFT, WIDE, Item, rule, wide, words
from geneva_cli.output.inks import CENTRE_LINES, inks
from geneva_cli.output.pdf_file import outline, point, tint
from geneva_cli.output.svg_fill import opacity, rings
from geneva_cli.output.svg_look import arrow, heading, round_length, span_text

STROKE, THIN = 0.3, 0.16
SPAN = 6.0  # from one distance to the next
ARROW = 2.6, 0.45

Move: TypeAlias = Callable[[Shape], Shape]
Put: TypeAlias = Callable[[Point], Point]


def drawing(shown: Drawing) -> Item:
    """The drawing centred on the page; below it distances and a scale bar."""
    box = extent(shown)
    turns = (
        [bounds(Contour("", (t,), closed=False)) for t in shown.look.turns] if shown.look else []
    )
    x0, x1 = min(b.x0 for b in (box, *turns)), max(b.x1 for b in (box, *turns))
    y0, y1 = min(b.y0 for b in (box, *turns)), max(b.y1 for b in (box, *turns))
    margin = 3.0
    scale = min((WIDE - 2.0 * margin) / (x1 - x0), 92.0 / (y1 - y0))  # 92: greatest height
    left = LEFT + 0.5 * (WIDE - scale * (x1 - x0))
    spans = len(shown.look.spans) if shown.look else 0
    high = scale * (y1 - y0) + 2.0 * margin

    def draw(top: float) -> str:
        def at(p: Point) -> Point:
            return left + scale * (p[0] - x0), top - margin + scale * (p[1] - y1)

        def placed(shape: Shape) -> Shape:
            return mapped(shape, at, lambda radius: radius * scale)

        out = "".join(_fills(shown, placed)) + "".join(_lines(shown, placed))
        if shown.look:
            out += "".join(_look(shown.look, at, placed, top - high))
        units = output.choice.units
        bar = round_length(0.25 * (x1 - x0) / UNITS[units])
        long = scale * bar * UNITS[units]
        y = top - high - spans * SPAN - SPAN
        out += rule(LEFT, y, long, 0.5, INK)
        label = f"{bar:g} {SUFFIX[units]}"
        return out + words(label, (LEFT + long + 2.0, y - 0.35 * SMALL), SMALL)

    return Item(high + (spans + 1) * SPAN + 5.0, draw)


def _fills(shown: Drawing, placed: Move) -> Iterator[str]:
    if shown.solid is None:
        return
    every = rings(shown.solid)
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
    yield "[] 0 d\n"


def _look(look: Annotations, at: Put, placed: Move, bottom: float) -> Iterator[str]:
    """Arrows of rotation, and distances below the shapes."""
    yield f"{SOFT} RG {THIN} w\n"
    for turn in look.turns:
        arc = Arc(at(turn.start), at(turn.end), turn.bulge)
        yield f"{outline(Contour('', (arc,), closed=False))}S\n"
        yield _arrow(arc.end, heading(arc, ARROW[0]))
    for number_, span in enumerate(look.spans, 1):
        a, b = sorted((at(span.start), at(span.end)))
        y = bottom - number_ * SPAN + 1.5
        text = span_text(span, output.choice.units)
        yield f"{SOFT} RG {THIN} w\n"
        for p in (a, b):
            yield f"{point(p)} m {point((p[0], y - 1.0))} l S\n"
        yield rule(a[0], y, b[0] - a[0], THIN, SOFT)
        yield _arrow((a[0], y), math.pi) + _arrow((b[0], y), 0.0)
        yield words(text, (0.5 * (a[0] + b[0] - wide(text, SMALL)), y + 0.9), SMALL)


def _arrow(tip: Point, angle: float) -> str:
    a, b, c = map(point, arrow(tip, angle, ARROW))
    return f"{SOFT} rg {a} m {b} l {c} l f\n"
