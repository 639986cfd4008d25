"""What a drawing shows of solids: their outlines and holes at their positions, along the axis."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from geneva_cli.geometry.drawing import Drawing
from geneva_cli.geometry.placed import in_place
from geneva_cli.geometry.plates import Member, Part
from geneva_cli.geometry.shapes import Circle, Shape
from geneva_cli.motion.mechanism import Mechanism

# in the order of a drawing
LAYERS = (
    *("WHEEL", "CRANK", "ARM", "LINK", "FRAME", "GROOVE"),
    *("PITCH", "ROLLER", "BORE", "HUB", "SHAFT"),
)


def titled(mechanism: Mechanism, part: str = "") -> str:
    """Return the title of a machine's drawings, or of one part's."""
    spec = mechanism.spec
    title = spec.title or spec.wheel.title
    return f"{title}: {part}" if part else title


def outlines_of(part: Part) -> tuple[Shape, ...]:
    """Return the outlines and holes of a part in its own frame, each once, layer by layer."""
    return tuple(sorted(once(shapes([Member(part)])), key=_order))


def drawing_of(mechanism: Mechanism, part: str, solid: Part) -> Drawing:
    """Return the drawing of a part in its own frame, under its name."""
    return Drawing(titled(mechanism, part), outlines_of(solid), solid=solid)


def _order(shape: Shape) -> tuple[int, bool]:
    """Return the place of a shape among others: by layer, and contours before circles."""
    return LAYERS.index(shape.layer), isinstance(shape, Circle)


def shapes(members: Iterable[Member]) -> Iterator[Shape]:
    """Yield the outlines and holes of plates at their positions."""
    for _, plate in in_place(members):
        yield from (plate.outline, *plate.holes)


def with_frame(moving: Iterable[Member], standing: Iterable[Member]) -> tuple[Shape, ...]:
    """Return the outlines of parts that move, and on layer FRAME those of parts that stand.

    Holes of the latter that shafts and bores cover are left out.
    """
    drawn = list(shapes(moving))
    fixed = [shape._replace(layer="FRAME") for shape in uncovered(standing, drawn)]
    return tuple(once([*drawn, *fixed]))


def uncovered(standing: Iterable[Member], drawn: Iterable[Shape]) -> Iterator[Shape]:
    """Yield the outlines of parts that stand, without holes where a circle is drawn already."""
    seen = {circle_key(shape) for shape in drawn if isinstance(shape, Circle)}
    for shape in shapes(standing):
        if not (isinstance(shape, Circle) and circle_key(shape) in seen):
            yield shape


def once(shapes: Iterable[Shape]) -> Iterator[Shape]:
    """Yield shapes without those of one layer that coincide; circles coincide to 1e-6 mm."""
    seen = set()
    for shape in shapes:
        key = circle_key(shape) if isinstance(shape, Circle) else shape
        if (shape.layer, key) not in seen:
            seen.add((shape.layer, key))
            yield shape


def circle_key(circle: Circle) -> tuple[float, ...]:
    """Return the centre and radius of a circle, rounded to 1e-6 mm."""
    return tuple(round(value, 6) for value in (*circle.centre, circle.radius))
