"""The walls of a straight slot: two flanks and a round end."""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.curves.measure import turned
from geneva_cli.curves.shapes import Arc, Contour, Line, joined
from geneva_cli.errors import GenevaError
from geneva_cli.machine.engagement import Engagement
from geneva_cli.numerics.arrays import array, scalar
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.roller_paths import corner, mouth, rest
from geneva_cli.parts.sizes import Sizes

LAYER = "WHEEL"
LOOKS = 721  # places at which the deepest is looked for


def straight_walls(assembly: Assembly, sizes: Sizes, engagement: Engagement) -> Contour:
    """A straight slot from one corner of its mouth round the end to the other, counterclockwise
    about the wheel's axis.

    The wall that faces the crank's axis at entry ends where the roller enters, the other where it
    leaves; of offset slots, and of unequal ones, these ends lie at different radii. Raises
    GenevaError where the wheel ends short of the slot's end.
    """
    w, out = sizes.half_width, assembly.sign
    angle, level = _axis(assembly, engagement)
    bottom = _deepest(assembly, engagement, angle) - out * sizes.slot_bottom
    starts = []
    for side in (-1.0, 1.0):
        rim, y = _rim(assembly, sizes, engagement, angle, level, side), level + side * w
        start = math.sqrt(max(rim * rim - y * y, 0.0))
        if not out * (start - bottom) > 0.0:
            raise GenevaError(
                f"wheel_radius_mm = {sizes.rim:g}: the rim ends short of the slots' ends, which "
                f"lie at {bottom:.6g} mm",
                ("size", "wheel_radius_mm"),
            )
        starts.append(start)
    pieces = joined(
        (
            Line((starts[0], level - w), (bottom, level - w)),
            Arc((bottom, level - w), (bottom, level + w), -out),
            Line((bottom, level + w), (starts[1], level + w)),
        )
    )
    return turned(Contour(LAYER, pieces, closed=False), angle)


def _axis(assembly: Assembly, engagement: Engagement) -> tuple[float, float]:
    """The direction of the slot's axis in the wheel, and its distance from the centre, mm."""
    x, y = engagement.slot(engagement.entry_deg, 0)
    u, v = engagement.slot(0.0, 0)
    px, py = assembly.L * x.c[0], assembly.L * y.c[0]
    angle = math.atan2(assembly.sign * (y.c[0] - v.c[0]), assembly.sign * (x.c[0] - u.c[0]))
    level = scalar(py * math.cos(angle) - px * math.sin(angle))
    return angle, level if abs(level) > 1e-12 * assembly.L else 0.0


def _deepest(assembly: Assembly, engagement: Engagement, angle: float) -> float:
    """The deepest position of the roller's centre along the slot's axis, mm."""
    x, y = engagement.slot(np.linspace(engagement.entry_deg, engagement.exit_deg, LOOKS), 0)
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
    """The wheel's radius at one side of the slot's mouth.

    A rim that the spec sets is moved everywhere by as much as where it is widest.
    """
    largest = max(mouth(assembly, s, sizes.roller) for s in assembly.kinds)
    own = mouth(assembly, engagement, sizes.roller)
    if level:
        x, y = rest(assembly, engagement, -1.0)
        entry_side = y * math.cos(angle) - x * math.sin(angle) > level
        end = -1.0 if entry_side == (side > 0.0) else 1.0
        own = math.hypot(*corner(assembly, engagement, end, sizes.roller))
    return own + (sizes.rim - largest)
