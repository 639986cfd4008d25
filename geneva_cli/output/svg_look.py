"""Additions to an SVG to view: light or dark page, distances, arrows, scale bar and title."""

from __future__ import annotations

import math
from html import escape

from geneva_cli.curves.drawing import Annotations, LevelDistance
from geneva_cli.curves.measure import Box, bounds
from geneva_cli.curves.pieces import SUFFIX, UNITS
from geneva_cli.curves.shapes import Arc, Contour, Point
from geneva_cli.output.inks import inks
from geneva_cli.output.letters import width
from geneva_cli.output.strokes import DARK, LIGHT
from geneva_cli.output.svg_paths import number, path, place, point
from geneva_cli.table import in_decimals

ARROW = 4.5, 0.9  # an arrow's length, and half its width, mm in that drawing


def style(layers: tuple[str, ...], frame: Box, margin: float) -> str:
    """The page behind the drawing, and its colours; programs without CSS show the light one."""
    dark = "".join(
        f"g[id='{layer}'] {{ stroke: {_brighter(ink.rgb)} }}\n"
        for layer, ink in inks(layers).items()
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


def notes(look: Annotations, box: Box, title: str, mm: float, units: str) -> tuple[list[str], Box]:
    """Lines, arrows and texts around the shapes, and the box around all.

    Distances stand below the shapes; below them are the scale bar and the title.
    """
    lines: list[str] = []
    heads: list[str] = []
    texts: list[tuple[Point, str]] = []
    # All lengths are in mm, for a drawing 250 mm wide; letters are 5 mm high.
    unit, text, gap = UNITS[units], mm * 5.0, mm * 3.0
    left, right, low, high = box.x0, box.x1, box.y0, box.y1
    for turn in look.turns:
        first, last = ((x / unit, y / unit) for x, y in (turn.start, turn.end))
        arc = Arc(first, last, turn.bulge)
        contour = Contour("", (arc,), closed=False)
        lines.append(path(contour))
        heads.append(_head(last, heading(arc, mm * ARROW[0]), mm))
        around = bounds(contour)
        left, right = min(left, around.x0), max(right, around.x1)
        low, high = min(low, around.y0), max(high, around.y1)
    for span in look.spans:
        low -= gap + 1.4 * text
        lines += _span(span, unit, low, gap)
        (a, b), shown = _ends(span, unit), span_text(span, units)
        heads += [_head((a, low), math.pi, mm), _head((b, low), 0.0, mm)]
        start = 0.5 * (a + b - width(shown) * text)
        texts.append(((start, low + 0.35 * text), shown))
        left, right = min(left, start), max(right, start + width(shown) * text)
    tick = mm * 1.5  # half a scale bar's end mark
    bar = round_length(0.2 * (box.x1 - box.x0 or box.y1 - box.y0))
    y = low - gap - max(tick, 0.5 * text)
    ends = [((x, y - tick), (x, y + tick)) for x in (left, left + bar)]
    ruler = " ".join(map(_line, [*ends, ((left, y), (left + bar, y))]))
    label = f"{bar:g} {SUFFIX[units]}"
    texts.append(((left + bar + gap, y - 0.35 * text), label))
    right = max(right, left + bar + gap + width(label) * text)
    low = y - max(tick, 0.5 * text)
    if title:
        texts.append(((left, low - 1.2 * text), title))
        right = max(right, left + width(title) * text)
        low -= 1.5 * text
    return _groups(lines, ruler, heads, texts, mm), Box(left, low, right, high)


def _groups(
    lines: list[str], ruler: str, heads: list[str], texts: list[tuple[Point, str]], mm: float
) -> list[str]:
    """The elements of paths, the scale bar's path, arrows and texts of 5 mm."""
    grey = "#757575"
    return [
        f'<g id="NOTES" stroke="{grey}" stroke-width="{number(mm * 0.25)}">\n',
        *(f'<path d="{d}"/>\n' for d in lines),
        f'<path id="SCALE_BAR" d="{ruler}"/>\n</g>\n',
        f'<g id="ARROWS" fill="{grey}">\n',
        *heads,
        f'</g>\n<g id="TEXT" fill="{LIGHT.text}" font-family="sans-serif"'
        f' font-size="{number(mm * 5.0)}">\n',
        *(f"<text {place(p)}>{escape(t, quote=False)}</text>\n" for p, t in texts),
        "</g>\n",
    ]


def _ends(span: LevelDistance, unit: float) -> tuple[float, float]:
    a, b = sorted((span.start[0] / unit, span.end[0] / unit))
    return a, b


def span_text(span: LevelDistance, units: str) -> str:
    """The name and the length, to four decimals of an inch and three of a millimetre."""
    a, b = _ends(span, UNITS[units])
    value = in_decimals(b - a, 4 if units == "inch" else 3)
    return f"{span.name} = {value} {SUFFIX[units]}"


def _span(span: LevelDistance, unit: float, low: float, gap: float) -> list[str]:
    """The path of a distance's line, and of the lines from its ends down to it."""
    a, b = _ends(span, unit)
    sides = (((x / unit, y / unit), (x / unit, low - 0.4 * gap)) for x, y in (span.start, span.end))
    return list(map(_line, [((a, low), (b, low)), *sides]))


def _line(ends: tuple[Point, Point]) -> str:
    return f"M {point(ends[0])} L {point(ends[1])}"


def _head(tip: Point, angle: float, mm: float) -> str:
    """An arrow's head."""
    corners = arrow(tip, angle, (mm * ARROW[0], mm * ARROW[1]))
    return f'<path d="M {" L ".join(map(point, corners))} Z"/>\n'


def arrow(tip: Point, angle: float, size: tuple[float, float]) -> tuple[Point, Point, Point]:
    """The corners of an arrow's head in a direction; ``size`` is its length and half its width."""
    (long, half), c, s = size, math.cos(angle), math.sin(angle)
    x, y = tip[0] - long * c, tip[1] - long * s
    return tip, (x - half * s, y + half * c), (x + half * s, y - half * c)


def heading(arc: Arc, long: float) -> float:
    """The direction of an arrow of this length at an arc's end: that of the arc under its head."""
    (x, y), (cx, cy) = arc.end, arc.centre
    ahead = 0.5 * math.pi - 0.5 * long / arc.radius
    return math.atan2(y - cy, x - cx) + math.copysign(ahead, arc.bulge)


def _brighter(rgb: str) -> str:
    """An ink for a dark page: 0.45 of the step to white is added."""
    parts = (int(rgb[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{round(p + 0.45 * (255 - p)):02x}" for p in parts)


def round_length(length: float) -> float:
    """The number 1, 2 or 5 times a power of ten that is nearest by ratio."""
    power = 10.0 ** math.floor(math.log10(length))
    rounds = [float(f"{n * power:.0e}") for n in (1, 2, 5, 10)]
    return min(rounds, key=lambda r: abs(math.log(r / length)))
