"""Drawings of the links: side by side for cutting, and at their positions in the machine."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from geneva_cli.curves.drawing import Drawing
from geneva_cli.curves.measure import S, bounds, mapped, turned
from geneva_cli.curves.plates import Group, Member, Plate
from geneva_cli.curves.shapes import Circle, Point, Shape
from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.links import LAYER, Links, drawn_links
from geneva_cli.parts.model import PartsModel

BETWEEN = 0.05  # of the centre distance: gap between links side by side
PITCH = "PITCH"


def links(model: PartsModel, tolerance: float, curves: str) -> Drawing:
    """Return every link and sliding block once, one above the other, each in its own frame."""
    mechanism = model.mechanism
    bars = drawn_links(mechanism, model.outlines if mechanism.spec.is_flat else None)
    if not bars.cut:
        raise GenevaError(
            f'--part links: kind = "{mechanism.spec.drive.NAME}" has no links: '
            + (
                "its crank is --part arm"
                if mechanism.spec.drive.ONE_ARM
                else "--part parts lists what it has"
            )
        )
    members = list(_side_by_side(bars.plates, BETWEEN * mechanism.center_distance_mm))
    title = f"{titled(mechanism)}: links"
    return Drawing(title, tuple(shapes(members)), solid=Group(title, tuple(members)))


def titled(mechanism: Mechanism) -> str:
    """Return the title of a machine's drawings."""
    spec = mechanism.spec
    return spec.title or f"Geneva wheel of {spec.wheel.z} slots"


def _side_by_side(plates: Iterable[Plate], between: float) -> Iterator[Member]:
    top = 0.0
    for plate in dict.fromkeys(plates):
        box = bounds(plate.outline)
        up = (0.0, top - box.y0)
        yield Member(  # moved itself, so that the kerf finds its outlines in the drawing
            plate._replace(
                outline=placed(plate.outline, up, 0.0),
                holes=tuple(placed(hole, up, 0.0) for hole in plate.holes),
            )
        )
        top += box.y1 - box.y0 + between


def shapes(members: Iterable[Member]) -> Iterator[Shape]:
    """Yield the outlines and holes of plates at their positions."""
    for one in members:
        assert isinstance(one.part, Plate)
        for shape in (one.part.outline, *one.part.holes):
            yield placed(shape, one.at, one.turn)


def placed(shape: S, at: Point, turn: float) -> S:
    """Return a shape turned about its own origin, and then moved."""
    return mapped(turned(shape, turn), lambda p: (p[0] + at[0], p[1] + at[1]))


def together(bars: Links) -> Iterator[Shape]:
    """Yield the links in the machine, and the gears by their pitch circles, with all holes."""
    cut = [shape._replace(layer=LAYER) for shape in shapes(bars.cut)]
    blanks = list(shapes(gear.member for gear in bars.gears))
    yield from cut
    yield from (shape for shape in blanks if shape.layer == PITCH)
    yield from (shape._replace(layer=LAYER) for shape in blanks if shape.layer != PITCH)


def once(shapes: Iterable[Shape]) -> Iterator[Shape]:
    """Yield shapes without repeating circles of one layer that coincide."""
    seen = set()
    for shape in shapes:
        if isinstance(shape, Circle):
            (x, y), r = shape.centre, shape.radius
            key = shape.layer, round(x, 6), round(y, 6), round(r, 6)
            if key in seen:
                continue
            seen.add(key)
        yield shape
