"""A drawing sheet: shapes, texts and dimensions on layers, in millimetres on paper.

The formats of sheets write it without knowing the part. The origin is the paper's lower left
corner.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.geometry.helvetica import width
from geneva_cli.geometry.shapes import Contour, Layer, Line, Point, Segment, Shape, polygon

ARROW = 3.0, 0.4  # mm: an arrow's length, and half its width (ISO 129-1: filled, 15 degrees)
SMALL, LARGE = 2.5, 3.5  # mm: capitals of dimensions, and of titles (ISO 3098-1)
BELOW, ABOVE = 0.3, 1.1  # of a text's height: how far its letters reach below and above the line

# The layers of a sheet, with the width of their lines in mm (ISO 128-2: two widths, 2 to 1).
OUTLINE: Layer = "OUTLINE"
HIDDEN: Layer = "HIDDEN"
CENTRE: Layer = "CENTER"
HATCH: Layer = "HATCH"
DIMENSION: Layer = "DIMENSION"
TEXT: Layer = "TEXT"
FRAME: Layer = "FRAME"
WIDTHS = {
    **{OUTLINE: 0.5, HIDDEN: 0.25, CENTRE: 0.25, HATCH: 0.18, DIMENSION: 0.25, TEXT: 0.25},
    FRAME: 0.7,
}
DASHED = {CENTRE: (8.0, 1.5, 1.0, 1.5), HIDDEN: (3.0, 1.5)}  # mm: dash, gap, dash, gap


class Label(NamedTuple):
    """A text; ``at`` is where its first letter's base line starts, ``turn`` its direction."""

    text: str
    at: Point
    height: float  # mm, of its capitals
    turn: float = 0.0  # radians

    @property
    def width(self) -> float:
        """Length along its base line, mm."""
        return width(self.text) * self.height

    @property
    def corners(self) -> tuple[Point, Point, Point, Point]:
        """Corners of the box around its letters, counterclockwise from the lower left."""
        low, high = -BELOW * self.height, ABOVE * self.height
        box = ((0.0, low), (self.width, low), (self.width, high), (0.0, high))
        a, b, c, d = (_turned(p, self.turn, self.at) for p in box)
        return a, b, c, d

    @property
    def middle(self) -> Point:
        """Middle of its capitals."""
        return _turned((0.5 * self.width, 0.5 * self.height), self.turn, self.at)


class Arrow(NamedTuple):
    """An arrow's head: the position of its tip, and its direction in radians."""

    tip: Point
    turn: float

    @property
    def corners(self) -> tuple[Point, Point, Point]:
        """Tip and both other corners."""
        length, half = ARROW
        back = ((-length, half), (-length, -half))
        left, right = (_turned(p, self.turn, self.tip) for p in back)
        return self.tip, left, right


class Measure(NamedTuple):
    """A dimension as drawn: lines (its own before its extension lines), arrows and text.

    ``kind`` names the meaning of ``points``. ``length``: both ends and a place on the dimension
    line, all in the direction ``turn``. ``angular``: the apex, a point on each leg and one on the
    arc. ``radius``: the centre and the point on the arc. ``diameter``: both points on the circle.
    """

    kind: str
    points: tuple[Point, ...]
    value: float  # mm or degrees of the part
    label: Label
    lines: tuple[Segment, ...]
    arrows: tuple[Arrow, ...]
    turn: float = 0.0

    @property
    def main_lines(self) -> tuple[Segment, ...]:
        """The dimension line, or the leader and the line under its text."""
        return self.lines[:1] if self.kind in ("length", "angular") else self.lines

    @property
    def extension_lines(self) -> tuple[Segment, ...]:
        """The lines from the part to the dimension line."""
        return self.lines[len(self.main_lines) :]


class Sheet(NamedTuple):
    """A sheet of paper with its contents."""

    title: str
    width: float
    height: float
    scale: float  # scale of the views: mm on paper per mm of the part
    shapes: tuple[Shape, ...]
    labels: tuple[Label, ...]
    measures: tuple[Measure, ...]
    units: str = "mm"  # of the dimensions' texts: mm or inch

    @property
    def texts(self) -> list[Label]:
        """All texts, including those of dimensions."""
        return [*self.labels, *(m.label for m in self.measures)]

    @property
    def arrows(self) -> list[Arrow]:
        """All arrows of dimensions."""
        return [arrow for measure in self.measures for arrow in measure.arrows]

    def by_layer(self) -> Iterator[tuple[Layer, list[Shape]]]:
        """Yield the shapes of each layer, including the lines of dimensions."""
        lines = [Contour(DIMENSION, (p,), closed=False) for m in self.measures for p in m.lines]
        for layer in WIDTHS:
            shapes = [shape for shape in (*self.shapes, *lines) if shape.layer == layer]
            if shapes:
                yield layer, shapes


def line(layer: Layer, *points: Point) -> Contour:
    """An open polyline."""
    pieces = (Line(a, b) for a, b in zip(points, points[1:], strict=False))
    return Contour(layer, tuple(pieces), closed=False)


def rectangle(layer: Layer, x0: float, y0: float, x1: float, y1: float) -> Contour:
    """A rectangular frame."""
    return polygon(layer, [(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def polar(centre: Point, radius: float, turn: float) -> Point:
    """Point in a direction, radians, at a distance from another point."""
    return centre[0] + radius * math.cos(turn), centre[1] + radius * math.sin(turn)


def _turned(p: Point, turn: float, about: Point) -> Point:
    c, s = math.cos(turn), math.sin(turn)
    return about[0] + c * p[0] - s * p[1], about[1] + s * p[0] + c * p[1]
