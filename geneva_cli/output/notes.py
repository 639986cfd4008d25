"""The layout of notes around a drawing to view: distances, arrows, scale bar and title.

Each format writes it with its own pen.
"""

import math
from typing import NamedTuple

from geneva_cli.geometry.shapes import Box, Contour, Point, bounds
from geneva_cli.geometry.sheet import Annotations, Arrow, line
from geneva_cli.output.letters import width

LETTERS = 5.0  # height of letters, mm of the page
ARROW = 4.5, 0.9  # an arrow's length, and half its width, mm of the page


class Notes(NamedTuple):
    """Annotations as drawn: lines, arrows' heads, and texts by the start of their base line.

    ``box`` is around the shapes and all of these.
    """

    lines: tuple[Contour, ...]
    scale_bar: tuple[Contour, ...]
    heads: tuple[Arrow, ...]
    texts: tuple[tuple[Point, str], ...]
    box: Box


def notes(look: Annotations, box: Box, title: str, mm: float) -> Notes:
    """Return lines, arrows and texts around the shapes, whose box this is.

    ``mm`` is a millimetre of the page in those of the drawing. Distances stand below the shapes;
    below them are the scale bar and the title.
    """
    lines: list[Contour] = []
    heads: list[Arrow] = []
    texts: list[tuple[Point, str]] = []
    text, gap = mm * LETTERS, mm * 3.0
    size = mm * ARROW[0], mm * ARROW[1]
    for turn in look.turns:
        lines.append(Contour("", (turn,), closed=False))
        (x, y), back = turn.centre, 0.5 * size[0] / turn.radius
        ahead = math.copysign(0.5 * math.pi - back, turn.bulge)  # that of the arc under the head
        angle = math.atan2(turn.end[1] - y, turn.end[0] - x) + ahead
        heads.append(Arrow(turn.end, angle, size))
    x0, y0, x1, y1 = zip(box, *map(bounds, lines), strict=True)
    left, low, right, high = min(x0), min(y0), max(x1), max(y1)
    for span in look.spans:
        low -= gap + 1.4 * text
        a, b = sorted((span.start[0], span.end[0]))
        lines.append(line("", (a, low), (b, low)))
        lines += [line("", end, (end[0], low - 0.4 * gap)) for end in (span.start, span.end)]
        heads += [Arrow((a, low), math.pi, size), Arrow((b, low), 0.0, size)]
        wide = width(span.text) * text
        # a text that does not fit between the lines from the ends stands to their right
        start = 0.5 * (a + b - wide) if wide < b - a else b + gap
        texts.append(((start, low + 0.35 * text), span.text))
    tick = mm * 1.5  # half a scale bar's end mark
    bar = round_length(0.2 * (box.x1 - box.x0 or box.y1 - box.y0))
    y = low - gap - max(tick, 0.5 * text)
    ends = [((x, y - tick), (x, y + tick)) for x in (left, left + bar)]
    ruler = (*(line("", *end) for end in ends), line("", (left, y), (left + bar, y)))
    texts.append(((left + bar + gap, y - 0.35 * text), f"{bar:g} mm"))
    low = y - max(tick, 0.5 * text)
    if title:
        texts.append(((left, low - 1.2 * text), title))
        low -= 1.5 * text
    right = max(right, *(x + width(words) * text for (x, _), words in texts))
    return Notes(tuple(lines), ruler, tuple(heads), tuple(texts), Box(left, low, right, high))


def round_length(length: float) -> float:
    """The number 1, 2 or 5 times a power of ten that is nearest by ratio."""
    power = 10.0 ** math.floor(math.log10(length))
    rounds = [float(f"{n * power:.0e}") for n in (1, 2, 5, 10)]
    return min(rounds, key=lambda r: abs(math.log(r / length)))
