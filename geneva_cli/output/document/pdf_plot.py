"""A figure on paper: each panel an item, so that what fits stands together."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from geneva_cli.document import Curves
from geneva_cli.figure import Curve, Figure, Panel
from geneva_cli.output.document.paper import LEFT, SMALL, SOFT, WIDE, Item, box, wide, words
from geneva_cli.output.pdf_file import number
from geneva_cli.output.plot_svg import padded
from geneva_cli.output.strokes import LIGHT
from geneva_cli.output.ticks import labels, named, said, ticks

AXIS, BESIDE = 16.0, 44.0  # left of the panels, and right of them
HIGH, ABOVE, BELOW = 27.0, 6.5, 12.0
TEXT = 2.6
ACROSS, UP = 17.0, 6.0  # between ticks, at the least
DOT = 0.7


def figure(curves: Curves) -> Iterator[Item]:
    """The panels, the last with the axis."""
    made = curves.figure
    yield Item(
        SMALL + 2.5,
        lambda top: words(made.title, LEFT, top - SMALL, SMALL, bold=True, ink=SOFT),
        keeps=True,
    )
    for panel in made.panels:
        is_last = panel is made.panels[-1]
        high = ABOVE + HIGH + (BELOW if is_last else 0.0)
        yield Item(high, partial(_panel, made, panel, is_last), keeps=not is_last)


class _Frame:
    """Where a panel is on the page."""

    def __init__(self, made: Figure, panel: Panel, top: float) -> None:
        self.window, self.span = made.window, padded(panel)
        self.top, self.bottom = top - ABOVE, top - ABOVE - HIGH
        self.left, self.wide = LEFT + AXIS, WIDE - AXIS - BESIDE

    def x(self, value: float) -> float:
        low, high = self.window
        return self.left + (value - low) / (high - low) * self.wide

    def y(self, value: float) -> float:
        low, high = self.span
        return self.bottom + (value - low) / (high - low) * HIGH

    def at(self, x: float, y: float) -> str:
        return f"{number(self.x(x))} {number(self.y(y))}"


def _panel(made: Figure, panel: Panel, is_last: bool, top: float) -> str:
    frame = _Frame(made, panel, top)
    across = ticks(*made.window, int(frame.wide / ACROSS), made.x.unit)
    up = ticks(*frame.span, int(HIGH / UP), panel.y.unit)
    out = "".join(
        box(frame.x(a), frame.bottom, frame.x(b) - frame.x(a), HIGH, _ink(LIGHT.rest))
        for a, b in made.shaded
    )
    ends = frame.window, frame.span
    out += f"0.12 w [] 0 d {_ink(LIGHT.grid)} RG\n"
    out += "".join(_line(frame, (ends[0][0], v), (ends[0][1], v)) for v in up)
    out += "".join(_line(frame, (v, ends[1][0]), (v, ends[1][1])) for v in across) + "S\n"
    out += f"0.2 w {_ink(LIGHT.axis)} RG\n"
    base = 0.0 if frame.span[0] < 0.0 < frame.span[1] else frame.span[0]
    out += _line(frame, (ends[0][0], ends[1][0]), (ends[0][0], ends[1][1]))
    out += _line(frame, (ends[0][0], base), (ends[0][1], base)) + "S\n"
    for value, label in zip(up, labels(up), strict=True):
        x = frame.left - 1.5 - wide(label, TEXT)
        out += words(label, x, frame.y(value) - 0.35 * TEXT, TEXT)
    out += words(named(panel.y), frame.left, frame.top + 1.6, SMALL, bold=True)
    y = frame.top - TEXT
    for curve in panel.curves:
        out += _curve(frame, curve)
        for mark in curve.marks:
            text = said(mark, "°" if made.x.unit else "")
            out += words(text, frame.left + frame.wide + 3.0, y, TEXT)
            y -= 1.35 * TEXT
    return out + (_below(made, frame, across) if is_last else "")


def _below(made: Figure, frame: _Frame, across: list[float]) -> str:
    out = ""
    for value, label in zip(across, labels(across), strict=True):
        out += words(label, frame.x(value) - 0.5 * wide(label, TEXT), frame.bottom - 4.0, TEXT)
    text = named(made.x)
    if made.shaded:
        text += "; shaded: the wheel rests"
    middle = frame.left + 0.5 * (frame.wide - wide(text, TEXT))
    return out + words(text, middle, frame.bottom - 8.5, TEXT)


def _curve(frame: _Frame, curve: Curve) -> str:
    """The pieces, jumps as thin lines, and a dot at each peak."""
    ink = _ink(LIGHT.curves[curve.number % len(LIGHT.curves)])
    out = f"{ink} RG {ink} rg 0.4 w\n"
    for x, y in curve.pieces:
        points = dict.fromkeys(frame.at(a, b) for a, b in zip(x, y, strict=True))
        first, *rest = points
        out += f"{first} m\n" + "".join(f"{p} l\n" for p in rest or [first]) + "S\n"
    jumps = [(x, a, b) for x, a, b in curve.jumps()]
    out += "0.2 w\n" + "".join(_line(frame, (x, a), (x, b)) + "S\n" for x, a, b in jumps)
    seen = [(m.x, m.y) for m in curve.marks if m.y is not None]
    return out + "".join(f"{2 * DOT} w {frame.at(*p)} m {frame.at(*p)} l S\n" for p in seen)


def _line(frame: _Frame, a: tuple[float, float], b: tuple[float, float]) -> str:
    return f"{frame.at(*a)} m {frame.at(*b)} l\n"


def _ink(rgb: str) -> str:
    return " ".join(number(int(rgb[i : i + 2], 16) / 255.0) for i in (1, 3, 5))
