"""The paper: formats (ISO 5457), frame, title block (ISO 7200), list of items, tables."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from geneva_cli.drawings.sheet.view import Block
from geneva_cli.geometry.shapes import Circle, Point, Shape
from geneva_cli.geometry.sheet import (
    FRAME,
    LARGE,
    OUTLINE,
    SMALL,
    TEXT,
    Label,
    line,
    polar,
    rectangle,
    width,
)

LEFT, MARGIN = 20.0, 10.0  # mm: margin of the frame on the filing side, and on the others
TITLE_WIDTH = 180.0  # mm: width of the title block


class PaperSize(NamedTuple):
    """A trimmed sheet, mm; A4 is upright."""

    name: str
    width: float
    height: float


FORMATS = (
    PaperSize("A4", 210.0, 297.0),
    PaperSize("A3", 420.0, 297.0),
    PaperSize("A2", 594.0, 420.0),
    PaperSize("A1", 841.0, 594.0),
)
# ISO 5455, with its powers of ten
SCALES = [1.0 * n * 10**k for k in (4, 3, 2, 1, 0) for n in (5, 2, 1)] + [
    1 / (n * 10**k) for k in (0, 1, 2, 3, 4) for n in (1, 2, 5) if (n, k) != (1, 0)
]


def scale_name(scale: float) -> str:
    """Return a scale as text.

    >>> scale_name(2.0), scale_name(0.2)
    ('2:1', '1:5')
    """
    return f"{scale:.0f}:1" if scale >= 1.0 else f"1:{1.0 / scale:.0f}"


def smaller(scale: float, times: float) -> float:
    """Return the largest standard scale that is smaller by a factor; else the smallest one."""
    return max((s for s in SCALES if s <= scale / times * (1.0 + 1e-9)), default=SCALES[-1])


def frame(paper: PaperSize) -> list[Shape]:
    """Return the frame, with marks at the middle of its sides."""
    w, h = paper.width, paper.height
    shapes: list[Shape] = [rectangle(FRAME, LEFT, MARGIN, w - MARGIN, h - MARGIN)]
    x, y = 0.5 * w, 0.5 * h
    for start, end in (
        ((x, 0.0), (x, MARGIN)),
        ((x, h), (x, h - MARGIN)),
        ((0.0, y), (LEFT, y)),
        ((w, y), (w - MARGIN, y)),
    ):
        shapes.append(line(FRAME, start, end))
    return shapes


def title_block(title: str, rows: Sequence[Mapping[str, str]]) -> Block:
    """Return the title block of a title and rows of fields; its lower left corner is the origin.

    Fields without a value are empty, for a pen. The rows are given from below; the second one has
    the symbol of projection at its end.
    """
    high = 12.0  # mm, of a row
    top = high * len(rows)
    shapes: list[Shape] = [rectangle(FRAME, 0.0, 0.0, TITLE_WIDTH, top + high)]
    labels = _field((0.0, top), "title", title, LARGE, TITLE_WIDTH)
    for k, fields in enumerate(rows):
        y = high * k
        long = TITLE_WIDTH
        if k == 1:
            long -= 30.0
            shapes += projection((TITLE_WIDTH - 15.0, y + 0.5 * high))
        shapes.append(line(TEXT, (0.0, y + high), (TITLE_WIDTH, y + high)))
        x = 0.0
        for (name, value), cell in zip(fields.items(), _cells(fields, long), strict=True):
            labels += _field((x, y), name, value, SMALL, cell)
            x += cell
            shapes.append(line(TEXT, (x, y), (x, y + high)))
    return Block(0.0, 0.0, TITLE_WIDTH, top + high, tuple(shapes), tuple(labels))


def _cells(fields: Mapping[str, str], long: float) -> list[float]:
    """Return the widths of fields: what they need, and an equal part of what is left."""
    needed = [max(width(value) * SMALL, width(name) * 1.8) + 4.0 for name, value in fields.items()]
    spare = (long - sum(needed)) / len(fields)
    return [need + spare for need in needed]


def _field(at: Point, name: str, value: str, height: float, limit: float) -> list[Label]:
    x, y = at[0] + 2.0, at[1]
    shown = cut_to(value, height, limit - 4.0)
    labels = [Label(name, (x, y + 8.4), 1.8)]
    return [*labels, Label(shown, (x, y + 3.0), height)] if shown else labels


def cut_to(text: str, height: float, limit: float) -> str:
    """Return a text, cut if it is longer than ``limit``."""
    if _fits(text, height, limit):
        return text
    while text and not _fits(text + "...", height, limit):
        text = text[:-1]
    return text + "..."


def _fits(text: str, height: float, limit: float) -> bool:
    return width(text) * height <= limit


def projection(at: Point) -> list[Shape]:
    """Return the symbol of first angle projection (ISO 5456-2): a frustum and its view."""
    x, y = at
    small, large, long = 1.75, 3.5, 7.0
    side = ((-10.0, -small), (-10.0 + long, -large), (-10.0 + long, large), (-10.0, small))
    corners = [(x + a, y + b) for a, b in side]
    shapes: list[Shape] = [line(OUTLINE, *corners, corners[0])]
    centre = (x + 6.0, y)
    shapes += [Circle(OUTLINE, centre, small), Circle(OUTLINE, centre, large)]
    shapes.append(line(TEXT, (x - 11.5, y), (x - 1.5, y)))
    for angle in (0.0, 0.5 * math.pi):
        shapes.append(line(TEXT, polar(centre, -5.0, angle), polar(centre, 5.0, angle)))
    return shapes


def table(heading: Sequence[str], rows: Sequence[Sequence[str]], columns: Sequence[float]) -> Block:
    """Return a table, with lines of text above it that are wrapped to its width.

    The first row has the names of its columns. ``columns`` are widths in mm.
    """
    row_height = 5.0  # mm
    wide, high = sum(columns), row_height * len(rows)
    shapes: list[Shape] = [rectangle(OUTLINE, 0.0, 0.0, wide, high)]
    labels: list[Label] = []
    for i, row in enumerate(rows):
        y = high - row_height * (i + 1)
        if i:
            shapes.append(line(TEXT, (0.0, y + row_height), (wide, y + row_height)))
        x = 0.0
        for text, column in zip(row, columns, strict=True):
            shown = cut_to(text, SMALL, column - 2.0)
            if shown:
                labels.append(Label(shown, (x + 1.0, y + 1.4), SMALL))
            x += column
    x = 0.0
    for column in columns[:-1]:
        x += column
        shapes.append(line(TEXT, (x, 0.0), (x, high)))
    # text above a narrow table is up to 60 mm wide
    lines = [part for text in heading for part in broken(text, SMALL, max(wide, 60.0))]
    top = high
    for text in reversed(lines):
        top += 1.8 * SMALL
        labels.append(Label(text, (0.0, top - 1.2 * SMALL), SMALL))
        wide = max(wide, labels[-1].width)
    return Block(0.0, 0.0, wide, top, tuple(shapes), tuple(labels))


def broken(text: str, height: float, limit: float) -> list[str]:
    """Return the lines of a text, wrapped at spaces to the width ``limit``."""
    lines: list[str] = []
    for word in text.split():
        if lines and width(f"{lines[-1]} {word}") * height <= limit:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines
