"""The layout of notes around a drawing to view: distances, arrows, scale bar and title.

Each format writes it with its own pen.
"""

import math
from typing import NamedTuple

from geneva_cli.geometry.shapes import Arc, Box, Contour, Point, bounds
from geneva_cli.geometry.sheet import Annotations, LevelDistance, line
from geneva_cli.output.letters import width
from geneva_cli.table import in_decimals

LETTERS = 5.0  # height of letters, mm of the page
ARROW = 4.5, 0.9  # an arrow's length, and half its width, mm of the page


class Notes(NamedTuple):
    """Annotations as drawn: lines, arrows' heads, and texts by the start of their base line.

    ``box`` is around the shapes and all of these.
    """

    lines: tuple[Contour, ...]
    scale_bar: tuple[Contour, ...]
    heads: tuple[tuple[Point, Point, Point], ...]
    texts: tuple[tuple[Point, str], ...]
    box: Box


def notes(look: Annotations, box: Box, title: str, mm: float) -> Notes:
    """Return lines, arrows and texts around the shapes, whose box this is.

    ``mm`` is a millimetre of the page in those of the drawing. Distances stand below the shapes;
    below them are the scale bar and the title.
    """
    lines: list[Contour] = []
    heads: list[tuple[Point, Point, Point]] = []
    texts: list[tuple[Point, str]] = []
    text, gap = mm * LETTERS, mm * 3.0
    left, right, low, high = box.x0, box.x1, box.y0, box.y1
    for turn in look.turns:
        arc = Arc(turn.start, turn.end, turn.bulge)
        contour = Contour("", (arc,), closed=False)
        lines.append(contour)
        (x, y), back = arc.centre, 0.5 * mm * ARROW[0] / arc.radius
        ahead = math.copysign(0.5 * math.pi - back, arc.bulge)  # that of the arc under the head
        last = turn.end
        heads.append(_head(last, math.atan2(last[1] - y, last[0] - x) + ahead, mm))
        around = bounds(contour)
        left, right = min(left, around.x0), max(right, around.x1)
        low, high = min(low, around.y0), max(high, around.y1)
    for span in look.spans:
        low -= gap + 1.4 * text
        a, b = sorted((span.start[0], span.end[0]))
        lines.append(line("", (a, low), (b, low)))
        lines += [line("", end, (end[0], low - 0.4 * gap)) for end in (span.start, span.end)]
        heads += [_head((a, low), math.pi, mm), _head((b, low), 0.0, mm)]
        shown = span_text(span)
        wide = width(shown) * text
        # a text that does not fit between the lines from the ends stands to their right
        start = 0.5 * (a + b - wide) if wide < b - a else b + gap
        texts.append(((start, low + 0.35 * text), shown))
        left, right = min(left, start), max(right, start + wide)
    tick = mm * 1.5  # half a scale bar's end mark
    bar = round_length(0.2 * (box.x1 - box.x0 or box.y1 - box.y0))
    y = low - gap - max(tick, 0.5 * text)
    ends = [((x, y - tick), (x, y + tick)) for x in (left, left + bar)]
    ruler = (*(line("", *end) for end in ends), line("", (left, y), (left + bar, y)))
    label = f"{bar:g} mm"
    texts.append(((left + bar + gap, y - 0.35 * text), label))
    right = max(right, left + bar + gap + width(label) * text)
    low = y - max(tick, 0.5 * text)
    if title:
        texts.append(((left, low - 1.2 * text), title))
        right = max(right, left + width(title) * text)
        low -= 1.5 * text
    return Notes(tuple(lines), ruler, tuple(heads), tuple(texts), Box(left, low, right, high))


def span_text(span: LevelDistance) -> str:
    """The name and the length, to three decimals of a millimetre."""
    return f"{span.name} = {in_decimals(abs(span.end[0] - span.start[0]), 3)} mm"


def _head(tip: Point, angle: float, mm: float) -> tuple[Point, Point, Point]:
    long, half, c, s = mm * ARROW[0], mm * ARROW[1], math.cos(angle), math.sin(angle)
    x, y = tip[0] - long * c, tip[1] - long * s
    return tip, (x - half * s, y + half * c), (x + half * s, y - half * c)


def round_length(length: float) -> float:
    """The number 1, 2 or 5 times a power of ten that is nearest by ratio."""
    power = 10.0 ** math.floor(math.log10(length))
    rounds = [float(f"{n * power:.0e}") for n in (1, 2, 5, 10)]
    return min(rounds, key=lambda r: abs(math.log(r / length)))
