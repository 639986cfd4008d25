"""The shapes of a scene at one input angle, each in its place, with its colours.

A still picture draws this list in its order. A hole is a shape of the page's colour, behind the
shapes that it opens.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.geometry.shapes import Circle, Contour, Line, Shape
from geneva_cli.output.inks import INKS
from geneva_cli.output.scene import Bar, Scene, body_pose, place_at, pose

GREY, BROWN = "#757575", "#a56752"
PAGE = "#ffffff"
BODY, LINK, ROLLER = "30", "33", "66"  # opacity of fills, of 255 in hexadecimal


class PlacedShape(NamedTuple):
    """A shape, the place and rotation of its frame, the ink of its line, and its fill.

    The fill is PAGE for a hole, "" for a line, otherwise the ink with an opacity.
    """

    shape: Shape
    pose: tuple[float, float, float]  # x, y, and radians
    ink: str
    fill: str = ""
    wide: bool = False  # a line twice as wide


def placed_shapes(scene: Scene, t: float) -> Iterator[PlacedShape]:
    """Yield all shapes at an input angle, in the frame of the picture."""
    for body in scene.bodies:
        at = body_pose(body, t)
        yield from (_of_body(shape, at) for shape in body.shapes)
    size = max(scene.box[2] - scene.box[0], scene.box[3] - scene.box[1])
    for bar in scene.bars:
        yield from _of_bar(bar, t, 0.008 * size)
    ink, roller = INKS["ROLLER"].rgb, Circle("ROLLER", (0.0, 0.0), scene.roller_radius)
    for place in scene.rollers:
        yield PlacedShape(roller, (*place_at(place, t), 0.0), ink, ink + ROLLER)


def _of_body(shape: Shape, at: tuple[float, float, float]) -> PlacedShape:
    layer = "WHEEL" if shape.layer == "HOLLOW" else shape.layer
    ink = INKS[layer].rgb if layer in INKS else GREY
    if shape.layer in ("BORE", "HOLLOW"):
        return PlacedShape(shape, at, ink, PAGE)
    is_closed = isinstance(shape, Circle) or shape.closed
    is_line = shape.layer in ("PITCH", "GROOVE", "SLOT") or not is_closed
    return PlacedShape(shape, at, ink, "" if is_line else ink + BODY)


def _of_bar(bar: Bar, t: float, joint: float) -> Iterator[PlacedShape]:
    """Yield a circle, a link with its blocks, or a bar; ``joint`` is the radius of its joints."""
    here = (0.0, 0.0, 0.0)
    ends = [place_at(place, t) for place in bar.joints]
    if bar.radius:
        yield PlacedShape(Circle("", ends[0], bar.radius), here, GREY)
        return
    for plate in bar.plates:
        at = pose(bar, plate, t)
        outline, *holes = plate.shapes
        yield PlacedShape(outline, at, BROWN, BROWN + LINK)
        yield from (PlacedShape(hole, at, BROWN, PAGE) for hole in holes)
    if bar.plates:
        return
    if len(ends) > 1:
        sides = tuple(map(Line, ends, [*ends[1:], ends[0]]))
        yield PlacedShape(Contour("LINK", sides), here, BROWN, BROWN + LINK, wide=True)
    for end in ends:
        yield PlacedShape(Circle("", end, joint), here, GREY, PAGE)
