"""The drawing: the shapes that a command passes to the output, in millimetres."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import Box, bounds_of
from geneva_cli.geometry.shapes import Arc, Point, Shape

if TYPE_CHECKING:
    from geneva_cli.geometry.plates import Part


class LevelDistance(NamedTuple):
    """A horizontal distance between two points, and its name."""

    start: Point
    end: Point
    name: str


class Annotations(NamedTuple):
    """Annotations of a drawing for people: distances and rotations.

    Rotations are arcs, with an arrow at their end.
    """

    spans: tuple[LevelDistance, ...] = ()
    turns: tuple[Arc, ...] = ()


class Drawing(NamedTuple):
    """Shapes and a title.

    ``look`` holds the annotations of a drawing for people; it is None for a drawing to cut from.
    ``solid`` is the drawing as a solid, for formats of solids. ``shells`` replaces it if the
    drawing is a flattened shell. ``tolerance`` is the greatest distance from it, in mm, that
    chords of a mesh may have.
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
    return bounds_of(drawing.shapes)
