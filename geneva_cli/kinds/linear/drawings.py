"""Drawings of the parts of a linear Geneva and of the whole machine, and its animated scene."""

from collections.abc import Iterator

from geneva_cli.geometry.plates import Group
from geneva_cli.geometry.shapes import Circle, Contour, Line, Shape, bounds, closed
from geneva_cli.geometry.sheet import Annotations, Drawing, LevelDistance
from geneva_cli.kinds.linear.parts import RackParts
from geneva_cli.kinds.linear.rack import rack_sizes, slot_walls
from geneva_cli.motion.pivots import Dimension
from geneva_cli.output.scene import Body, Box
from geneva_cli.parts import projection
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.study.animation.animated_turn import STILL, MachineTurn
from geneva_cli.study.animation.turning_scene import WheelScene


def arm(parts: RackParts) -> Drawing:
    """Return the arm, whose x is from the crank's axis to the roller."""
    return projection.drawing_of(parts.mechanism, "arm", parts.required_arm)


def slot(parts: RackParts) -> Drawing:
    """Return a slot, closed along the rack's edge, and the roller's path in it."""
    sizes = parts.sizes
    walls = slot_walls(sizes, 0.0)
    outline = closed("WHEEL", [*walls, Line(walls[-1].end, walls[0].start)])
    path = Contour("PITCH", (Line((0.0, 0.0), (sizes.arm, 0.0)),), closed=False)
    return Drawing(projection.titled(parts.mechanism, "slot"), (outline, path))


def guide(parts: RackParts) -> Drawing:
    """Return rail and wall of the guide, with the bar of the rack between them."""
    title = projection.titled(parts.mechanism, "guide")
    solid = Group(title, (parts.bar, *parts.guide))
    return Drawing(title, projection.outlines_of(solid), solid=solid)


def assembly(parts: RackParts) -> Drawing:
    """Return the machine at input angle 0: the roller is at the origin, the axis at (R, 0)."""
    gears = () if parts.mechanism.spec.no_parts else parts.gear_pair
    moving = parts.wheel, parts.crank, parts.bar, *gears
    title = projection.titled(parts.mechanism)
    drawn = projection.with_frame(projection.shapes(moving), parts.standing)
    look = Annotations((LevelDistance((0.0, 0.0), (parts.sizes.arm, 0.0), "R"),))
    return Drawing(title, drawn, look, Group(title, parts.members))


def dimensions(parts: RackParts) -> Iterator[Dimension | projection.Missing]:
    """Yield the dimensions of the rack, or the reason why there are none."""

    def listed() -> Iterator[Dimension]:
        sizes = parts.sizes
        yield Dimension("distance of the slots", 2.0 * sizes.arm, "mm")
        yield Dimension("edge, from the deepest roller", sizes.rim, "mm")
        if sizes.lock:
            yield Dimension("recess radius", sizes.recess, "mm")
            yield Dimension("locking sector: outer radius", sizes.lock, "mm")
            yield Dimension("locking sector: inner radius", sizes.floor, "mm")
        yield Dimension("guide bar: width", sizes.guide.bar, "mm")
        yield Dimension("guide: clearance on either side", sizes.guide.slide, "mm")
        yield Dimension("guide: length", 2.0 * sizes.guide.half, "mm")

    return projection.or_missing("dimensions of the rack", listed)


class RackScene(WheelScene):
    """What a page shows of a rack."""

    def bodies(self, shapes: tuple[Shape, ...], turn: MachineTurn) -> Iterator[Body]:
        """Yield the rack, with a dot behind the end of its first slot to tell the slots apart."""
        mechanism = turn.mechanism
        travel = turn.wheel(mechanism.wheel_places[0], mechanism.output.per_radian)
        sizes = rack_sizes(mechanism)
        end = -(sizes.guide.bottom + sizes.half_width)
        middle, radius = 0.5 * (end + sizes.behind), 0.15 * (end - sizes.behind)
        mark = Circle("PITCH", (middle, 0.0), radius)
        yield Body("wheel", (*shapes, mark), (0.0, 0.0), STILL, travel)

    def view(self, wheel: Body, box: Box, turn: MachineTurn) -> Box:
        """Return the box that a page shows: the rack's width, and the slots next to the crank."""
        R = turn.mechanism.output.per_radian
        own = bounds(wheel.shapes[0])
        x0, y0, x1, y1 = box
        return min(x0, own.x0), min(y0, -3.0 * R), max(x1, own.x1), max(y1, 3.0 * R)

    def stops(self, outlines: Outlines | None, turn: MachineTurn) -> tuple[float, float]:
        """Return the input angles from the start between which all slots of the rack pass."""
        z, step_deg = turn.mechanism.spec.wheel.z, turn.turn_deg / len(turn.passages)
        return -step_deg * (z // 2), step_deg * ((z + 1) // 2)
