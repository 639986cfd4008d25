"""The walls of a straight slot: two flanks and a round end.

Where gears drive between two rollers, a motion has two slots: one starts the wheel, one stops it.
They lie half of the angle between them on either side of its middle. A roller leaves the first slot
on an epicycloid with its cusp at the slot's end, and comes to the second on another. Each
epicycloid leans to the other slot and sweeps away that side of its own slot. So each slot keeps the
wall on its recess's side. Between the two lies an arc about the wheel's axis, as deep as the slots.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import turned, turned_pieces
from geneva_cli.geometry.shapes import Arc, Contour, Line, Segment, about, joined
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import array, scalar
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots.roller_paths import corner, mouth, rest


def straight_walls(assembly: Assembly, sizes: Sizes, engagement: Engagement) -> Contour:
    """Return a straight slot's walls, counterclockwise from one corner of its mouth to the other.

    A pair of slots has the arc between them too. The wall that faces the crank's axis at entry ends
    where the roller enters, the other where it leaves. These ends lie at different radii if the
    slots are offset or unequal. Raises GenevaError where the wheel ends short of the slot's end.
    """
    apart, engagement = engagement.apart, engagement.through
    w, out = sizes.half_width, assembly.sign
    angle, level = _axis(assembly, engagement)
    bottom = _deepest(assembly, engagement, angle) - out * sizes.slot_bottom
    starts = []
    for side in (-1.0, 1.0):
        rim, y = _rim(assembly, sizes, engagement, angle, level, side), level + side * w
        start = math.sqrt(max(rim * rim - y * y, 0.0))
        if not out * (start - bottom) > 0.0:
            raise GenevaError(
                f"wheel_radius_mm = {sizes.rim:g}: the rim does not reach the slots' ends, which "
                f"lie at {bottom:.6g} mm",
                ("size", "wheel_radius_mm"),
            )
        starts.append(start)
    first = Line((starts[0], level - w), (bottom, level - w))
    last = Line((bottom, level + w), (starts[1], level + w))
    if abs(apart) < SAME_ANGLE:
        pieces: tuple[Segment, ...] = (first, Arc(first.end, last.start, -out), last)
    else:
        _refuse_crossed(apart)
        end = (bottom - w, 0.0)
        quarter = math.tan(math.pi / 8.0)  # the bulge of a quarter of a circle
        begin = turned_pieces([first, Arc(first.end, end, -quarter)], -apart)
        between = about((0.0, 0.0), end[0], -apart, 2.0 * apart)
        finish = turned_pieces([Arc(end, last.start, -quarter), last], apart)
        pieces = (*begin, between, *finish)
    return turned(Contour("WHEEL", joined(pieces), closed=False), angle)


def _refuse_crossed(apart: float) -> None:
    """Raise GenevaError where the slot that stops the wheel would lie ahead of the other."""
    if apart < 0.0:
        raise GenevaError(
            f"the slots that start and stop the wheel cross by {math.degrees(-2.0 * apart):.4g} "
            'deg: increase sector_deg, or set gear_ratio = "shockless"',
            ("drive", "sector_deg"),
        )


def _axis(assembly: Assembly, engagement: Engagement) -> tuple[float, float]:
    """Return the direction of the slot's axis, and its distance from the wheel's centre, mm."""
    x, y = engagement.slot(engagement.entry_deg, 0)
    u, v = engagement.slot(0.0, 0)
    px, py = assembly.L * x.c[0], assembly.L * y.c[0]
    angle = math.atan2(assembly.sign * (y.c[0] - v.c[0]), assembly.sign * (x.c[0] - u.c[0]))
    level = scalar(py * math.cos(angle) - px * math.sin(angle))
    return angle, level if abs(level) > 1e-12 * assembly.L else 0.0


def _deepest(assembly: Assembly, engagement: Engagement, angle: float) -> float:
    """Return the deepest position of the roller's centre along the slot's axis, mm."""
    x, y = engagement.slot(np.linspace(engagement.entry_deg, engagement.exit_deg, 721), 0)
    along = array(assembly.L * (x.c[0] * math.cos(angle) + y.c[0] * math.sin(angle)))
    return float(along.min() if assembly.sign > 0.0 else along.max())


def _rim(
    assembly: Assembly,
    sizes: Sizes,
    engagement: Engagement,
    angle: float,
    level: float,
    side: float,
) -> float:
    """Return the wheel's radius at one side of the slot's mouth."""
    largest = max(mouth(assembly, s, sizes.roller) for s in assembly.kinds)
    own = mouth(assembly, engagement, sizes.roller)
    if level:
        x, y = rest(assembly, engagement, -1.0)
        entry_side = y * math.cos(angle) - x * math.sin(angle) > level
        end = -1.0 if entry_side == (side > 0.0) else 1.0
        own = math.hypot(*corner(assembly, engagement, end, sizes.roller))
    return own + (sizes.rim - largest)
