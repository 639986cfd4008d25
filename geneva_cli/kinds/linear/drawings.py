"""Drawings of the parts of a linear Geneva, each in its own frame, and of the whole machine."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.geometry.drawing import Annotations, Drawing, LevelDistance
from geneva_cli.geometry.plates import Group
from geneva_cli.geometry.shapes import Contour, Line, closed
from geneva_cli.kinds.linear.arm import rack_arm
from geneva_cli.kinds.linear.frame import rack_dimensions
from geneva_cli.kinds.linear.parts import RackParts
from geneva_cli.kinds.linear.rack import slot_walls
from geneva_cli.motion.pivots import Dimension
from geneva_cli.parts.missing import Missing, or_missing
from geneva_cli.parts.projection import drawing_of, outlines_of, titled, with_frame


def arm(parts: RackParts) -> Drawing:
    """Return the arm, whose x is from the crank's axis to the roller."""
    # without an arm the error says why
    return drawing_of(parts.mechanism, "arm", parts.arm or rack_arm(parts.mechanism))


def slot(parts: RackParts) -> Drawing:
    """Return a slot, closed along the rack's edge, and the roller's path in it."""
    sizes = parts.sizes
    walls = slot_walls(sizes, 0.0)
    outline = closed("WHEEL", [*walls, Line(walls[-1].end, walls[0].start)])
    path = Contour("PITCH", (Line((0.0, 0.0), (sizes.arm, 0.0)),), closed=False)
    return Drawing(titled(parts.mechanism, "slot"), (outline, path))


def guide(parts: RackParts) -> Drawing:
    """Return rail and wall of the guide, with the bar of the rack between them.

    The cover lies on wall and bar, and its holes are those of the wall.
    """
    title = titled(parts.mechanism, "guide")
    solid = Group(title, (parts.bar, *parts.guide))
    return Drawing(title, outlines_of(solid), solid=solid)


def assembly(parts: RackParts) -> Drawing:
    """Return the machine at input angle 0: the roller is at the origin, the axis at (R, 0)."""
    gears = parts.gear_pair if parts.mechanism.spec.has_parts else ()
    moving = parts.wheel, parts.crank, parts.bar, *gears
    title, drawn = titled(parts.mechanism), with_frame(moving, parts.standing)
    look = Annotations((LevelDistance((0.0, 0.0), parts.axis, "R"),))
    return Drawing(title, drawn, look, Group(title, parts.members))


def dimensions(parts: RackParts) -> Iterator[Dimension | Missing]:
    """Yield the dimensions of the rack, or the reason why there are none."""
    return or_missing("dimensions of the rack", lambda: rack_dimensions(parts.sizes))
