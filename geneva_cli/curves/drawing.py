"""The drawing: what every command that makes a shape hands to the output, in millimetres."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.curves.measure import Box, bounds
from geneva_cli.curves.shapes import Arc, Point, Shape
from geneva_cli.errors import GenevaError

if TYPE_CHECKING:
    from geneva_cli.curves.plates import Part


class LevelDistance(NamedTuple):
    """A level distance between two points, and the name that it goes by."""

    start: Point
    end: Point
    name: str


class Annotations(NamedTuple):
    """What a drawing that is to be looked at has besides its shapes: distances, and what turns.

    Turns are arcs, with an arrow at their end.
    """

    spans: tuple[LevelDistance, ...] = ()
    turns: tuple[Arc, ...] = ()


class Drawing(NamedTuple):
    """Shapes and a title.

    ``look`` is for drawings to look at, where the format has such, and None for those to cut.
    ``solid`` is what is drawn as the solid that it is, for formats of solids; ``shells`` are
    what it becomes where it is laid flat here, and go before it.
    """

    title: str
    shapes: tuple[Shape, ...]
    look: Annotations | None = None
    solid: Part | None = None
    shells: Part | None = None

    @property
    def layers(self) -> tuple[str, ...]:
        """The layers in use, in the order of their first shape."""
        return tuple(dict.fromkeys(shape.layer for shape in self.shapes))


def extent(drawing: Drawing) -> Box:
    """The smallest box around all shapes; raises GenevaError where there are none."""
    boxes = [bounds(shape) for shape in drawing.shapes]
    if not boxes:
        raise GenevaError("nothing to draw: a drawing must have a shape")
    low_x, low_y, high_x, high_y = zip(*boxes, strict=True)
    return Box(min(low_x), min(low_y), max(high_x), max(high_y))
