"""A drawing, and a drawing sheet: shapes, texts and dimensions on layers, in millimetres.

The origin is the paper's lower left corner.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import shapes
from geneva_cli.geometry.shapes import Arc, Box, Circle, Contour, Layer, Line, Point, Segment, Shape
from geneva_cli.table import in_decimals

if TYPE_CHECKING:
    from geneva_cli.geometry.plates import Part


SHORTEST_MM = 1e-9  # no file shows a piece that is shorter, or the bend of one that is flatter


class LevelDistance(NamedTuple):
    """A horizontal distance between two points, and its name."""

    start: Point
    end: Point
    name: str

    @property
    def text(self) -> str:
        """The name and the length, to three decimals of a millimetre."""
        return f"{self.name} = {in_decimals(abs(self.end[0] - self.start[0]), 3)} mm"


class Annotations(NamedTuple):
    """Distances of a drawing for people, and rotations as arcs with an arrow at their end."""

    spans: tuple[LevelDistance, ...] = ()
    turns: tuple[Arc, ...] = ()


class Drawing(NamedTuple):
    """Shapes and a title.

    ``look`` has the annotations for people; it is None for a drawing to cut from. ``solid`` is the
    drawing as a solid, replaced by ``shells`` if it is a flattened shell, and chords of a mesh are
    within ``tolerance`` mm of it.
    """

    title: str
    shapes: tuple[Shape, ...]
    look: Annotations | None = None
    solid: Part | None = None
    shells: Part | None = None
    tolerance: float = 0.001

    @property
    def layers(self) -> tuple[str, ...]:
        """Layers in use, in the order of their first shape."""
        return tuple(dict.fromkeys(shape.layer for shape in self.shapes))


def extent(drawing: Drawing) -> Box:
    """Smallest box around all shapes; raises GenevaError if there are none."""
    if not drawing.shapes:
        raise GenevaError("nothing to draw: a drawing must have a shape")
    return shapes.bounds_of(drawing.shapes)


def prepared(drawing: Drawing) -> Drawing:
    """Drawing without duplicate shapes and pieces shorter than ``SHORTEST_MM``.

    Raises GenevaError for a coordinate that is not finite.
    """
    seen: dict[Shape, None] = {}
    for shape in drawing.shapes:
        pieces = shape.segments if isinstance(shape, Contour) else (shape,)
        values = (v for piece in pieces for v in piece if not isinstance(v, str))
        if not math.isfinite(sum(sum(v) if isinstance(v, tuple) else v for v in values)):
            raise GenevaError(f"layer {shape.layer}: the coordinates of a shape must be finite")
        if isinstance(shape, Circle):
            if shape.radius > SHORTEST_MM:
                seen[shape] = None
            continue
        kept = []
        for one in shape.segments:
            if shapes.segment_length(one) > SHORTEST_MM:
                # the centre of an arc that is so flat would only be noise
                half = 0.5 * math.dist(one.start, one.end)
                flat = isinstance(one, Arc) and half * abs(one.bulge) < SHORTEST_MM
                kept.append(Line(one.start, one.end) if flat else one)
        if kept:
            open_one = Contour(shape.layer, shapes.joined(kept), closed=False)
            seen[shapes.closed(shape.layer, kept) if shape.closed else open_one] = None
    return drawing._replace(shapes=tuple(seen))


CAPITALS = 0.718  # height of capital letters, over the font's size
_ASCII = (  # from the space on
    *(278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278),
    *(556,) * 10,
    *(278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278),
    *(500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667),
    *(611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222),
    *(222, 500, 222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500),
    *(500, 334, 260, 334, 584),
)
# the first is the non-breaking space
_OTHERS = {
    **{"\u00a0": 278, "·": 278, "²": 333, "³": 333, "°": 400},
    **{"–": 556, "±": 584, "×": 584, "Ø": 778},
}


@lru_cache(maxsize=256)  # a text is tried at many places
def width(text: str, bold: bool = False) -> float:
    """Width of a text over the height of its capitals; unlisted letters count as the widest."""
    widest = 1000  # for letters that are not listed
    units = sum(_ASCII[ord(c) - 32] if " " <= c <= "~" else _OTHERS.get(c, widest) for c in text)
    if bold:  # letters are wider by at most this, digits by nothing
        units += 56 * sum(map(str.isalpha, text))
    return units / (1000.0 * CAPITALS)


ARROW = 3.0, 0.4  # mm: an arrow's length, and half its width (ISO 129-1: filled, 15 degrees)
SMALL, LARGE = 2.5, 3.5  # mm: capitals of dimensions, and of titles (ISO 3098-1)
BELOW, ABOVE = 0.3, 1.1  # of a text's height: how far its letters reach below and above the line

# The layers of a sheet, with the width of their lines in mm (ISO 128-2: two widths, 2 to 1).
WIDTHS: dict[Layer, float] = {"OUTLINE": 0.5, "HIDDEN": 0.25, "CENTER": 0.25, "HATCH": 0.18}
WIDTHS |= {"DIMENSION": 0.25, "TEXT": 0.25, "FRAME": 0.7}
OUTLINE, HIDDEN, CENTRE, HATCH, DIMENSION, TEXT, FRAME = WIDTHS
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
    def corners(self) -> tuple[Point, ...]:
        """Corners of the box around its letters, counterclockwise from the lower left."""
        low, high = -BELOW * self.height, ABOVE * self.height
        box = ((0.0, low), (self.width, low), (self.width, high), (0.0, high))
        return tuple(_turned(p, self.turn, self.at) for p in box)

    @property
    def middle(self) -> Point:
        """Middle of its capitals."""
        return _turned((0.5 * self.width, 0.5 * self.height), self.turn, self.at)


class Arrow(NamedTuple):
    """An arrow's head: the position of its tip, and its direction in radians."""

    tip: Point
    turn: float
    size: tuple[float, float] = ARROW

    @property
    def corners(self) -> tuple[Point, ...]:
        """Tip and both other corners."""
        length, half = self.size
        ends = ((0.0, 0.0), (-length, half), (-length, -half))
        return tuple(_turned(p, self.turn, self.tip) for p in ends)


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
            own = [shape for shape in (*self.shapes, *lines) if shape.layer == layer]
            if own:
                yield layer, own


def line(layer: Layer, *points: Point) -> Contour:
    """An open polyline."""
    pieces = (Line(a, b) for a, b in zip(points, points[1:], strict=False))
    return Contour(layer, tuple(pieces), closed=False)


def rectangle(layer: Layer, x0: float, y0: float, x1: float, y1: float) -> Contour:
    """A rectangular frame."""
    return shapes.polygon(layer, [(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def _turned(p: Point, turn: float, about: Point) -> Point:
    c, s = math.cos(turn), math.sin(turn)
    return about[0] + c * p[0] - s * p[1], about[1] + s * p[0] + c * p[1]
