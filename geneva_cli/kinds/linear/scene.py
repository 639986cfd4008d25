"""The rack of a linear Geneva on a page: its travel, the part of it in view, and its ends."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geneva_cli.geometry.measure import bounds
from geneva_cli.geometry.shapes import Circle, Shape
from geneva_cli.kinds.linear.rack import rack_sizes
from geneva_cli.output.scene import Body, Box, Track
from geneva_cli.study.animation.animated_turn import MachineTurn
from geneva_cli.study.animation.bodies import WheelScene
from geneva_cli.study.animation.tracks import still

if TYPE_CHECKING:
    from geneva_cli.parts.outlines.outlines import Outlines


class RackScene(WheelScene):
    """What a page shows of a rack."""

    def bodies(self, shapes: tuple[Shape, ...], turn: MachineTurn) -> Iterator[Body]:
        """Yield the rack, with a dot behind the end of its first slot to tell the slots apart."""
        mechanism = turn.mechanism
        pinion, R = turn.wheel(mechanism.wheel_places[0]), mechanism.output.per_radian
        values, slopes = (tuple(R * x for x in column) for column in (pinion.value, pinion.slope))
        travel = Track(pinion.at, values, slopes, R * pinion.gain)
        sizes = rack_sizes(mechanism)
        behind = -(sizes.slot_bottom + sizes.half_width + 0.5 * sizes.back)
        mark = Circle("PITCH", (behind, 0.0), 0.15 * sizes.back)
        yield Body("wheel", (*shapes, mark), (0.0, 0.0), still(), travel)

    def view(self, wheel: Body, box: Box, turn: MachineTurn) -> Box:
        """Return the box that a page shows: the rack's width, and the slots next to the crank.

        A rack of many slots is much longer than its machine. 3 R on either side stay full of any
        rack in the first turn: the shortest one has 4 R on either side, and travels by R from its
        middle.
        """
        R = turn.mechanism.output.per_radian
        own = bounds(wheel.shapes[0])
        x0, y0, x1, y1 = box
        return min(x0, own.x0), min(y0, -3.0 * R), max(x1, own.x1), max(y1, 3.0 * R)

    def stops(self, outlines: Outlines | None, turn: MachineTurn) -> tuple[float, float]:
        """Return the input angles from the start between which all slots of the rack have passed.

        The middle slot is the first to pass.
        """
        z, step_deg = turn.mechanism.spec.wheel.z, turn.turn_deg / len(turn.passages)
        return -step_deg * (z // 2), step_deg * ((z + 1) // 2)
