"""SVG at true size: one path a part, circles for bores, in plain coordinates."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple
from xml.sax.saxutils import escape, quoteattr

from geneva_cli.curves.measure import Box, extent
from geneva_cli.curves.pieces import SUFFIX, UNITS, prepared
from geneva_cli.curves.shapes import Drawing
from geneva_cli.errors import clean
from geneva_cli.output.inks import CENTRE_LINES, DASHES, inks
from geneva_cli.output.letters import width
from geneva_cli.output.svg_paths import element, number, place, point

# In millimetres on paper:
STROKE = 0.25
MARGIN = 2.0
TEXT = 3.5  # height of letters
TICK = 1.0  # half a scale bar's end mark
GREY = "#757575"
TINT = 0.15  # how opaque a layer is filled that is to be seen as a plate


class _Sheet(NamedTuple):
    """What turns millimetres on paper into the file's unit."""

    unit: float

    def mm(self, length: float) -> float:
        return length / self.unit


def chunks(drawing: Drawing, units: str) -> Iterator[str]:
    """The file's text; ``units`` is mm or inch.

    Raises GenevaError for another unit, a coordinate that is not finite, or a drawing without
    shapes.
    """
    drawing = prepared(drawing, units)
    sheet, suffix = _Sheet(UNITS[units]), SUFFIX[units]
    title = clean(drawing.title).strip()
    box = extent(drawing)
    scale: list[str] = []
    frame = box
    if drawing.scale_bar:
        scale, frame = _scale(box, title, sheet, suffix)
    margin = sheet.mm(MARGIN + STROKE)
    x, y = frame.x0 - margin, -frame.y1 - margin
    width = number(frame.x1 - frame.x0 + 2.0 * margin)
    height = number(frame.y1 - frame.y0 + 2.0 * margin)
    yield (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<svg xmlns="http://www.w3.org/2000/svg" version="1.1"'
        f' width="{width}{suffix}" height="{height}{suffix}"'
        f' viewBox="{number(x)} {number(y)} {width} {height}"'
        ' fill="none" stroke-linecap="round" stroke-linejoin="round">\n'
        f"<title>{escape(title)}</title>\n"
    )
    for layer, ink in inks(drawing.layers).items():
        dashes = ""
        if layer in CENTRE_LINES:
            dashes = f' stroke-dasharray="{" ".join(number(sheet.mm(d)) for d in DASHES)}"'
        stroke = number(sheet.mm(STROKE))
        tint = f' fill="{ink.rgb}" fill-opacity="{TINT}"' if layer in drawing.tinted else ""
        yield (
            f'<g id={quoteattr(layer)} stroke="{ink.rgb}" stroke-width="{stroke}"{dashes}{tint}>\n'
        )
        for shape in drawing.shapes:
            if shape.layer == layer:
                yield element(shape)
        yield "</g>\n"
    yield from scale
    yield "</svg>\n"


def _scale(box: Box, title: str, sheet: _Sheet, suffix: str) -> tuple[list[str], Box]:
    """A bar of round length with its label and the title below the shapes; the box around all."""
    size = box.x1 - box.x0 or box.y1 - box.y0
    bar = round_length(0.2 * size)
    label = f"{bar:g} {suffix}"
    tick, text, gap = sheet.mm(TICK), sheet.mm(TEXT), sheet.mm(MARGIN)
    x, y = box.x0, box.y0 - gap - max(tick, 0.5 * text)
    ends = [f"M {point((at, y - tick))} L {point((at, y + tick))}" for at in (x, x + bar)]
    line = f"M {point((x, y))} L {point((x + bar, y))}"
    beside = (x + bar + gap, y - 0.35 * text)  # letters are about 0.7 of the height
    below = (x, y - max(tick, 0.5 * text) - 1.2 * text)
    right = max(beside[0] + width(label) * text, below[0] + width(title) * text)
    lines = [
        f'<g id="SCALE_BAR" stroke="{GREY}" stroke-width="{number(sheet.mm(STROKE))}">\n'
        f'<path d="{ends[0]} {line} {ends[1]}"/>\n</g>\n',
        f'<g id="TEXT" fill="{GREY}" font-family="sans-serif" font-size="{number(text)}">\n',
        f"<text {place(beside)}>{label}</text>\n",
        f"<text {place(below)}>{escape(title)}</text>\n" if title else "",
        "</g>\n",
    ]
    low = below[1] - 0.3 * text if title else y - max(tick, 0.5 * text)
    return lines, Box(box.x0, low, max(box.x1, right), box.y1)


def round_length(length: float) -> float:
    """1, 2 or 5 times a power of ten: the one that is nearest by ratio."""
    power = 10.0 ** math.floor(math.log10(length))
    rounds = [float(f"{n * power:.0e}") for n in (1, 2, 5, 10)]
    return min(rounds, key=lambda r: abs(math.log(r / length)))
