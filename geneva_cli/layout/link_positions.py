"""Positions of a machine's links at input angles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.curves.shapes import Point
from geneva_cli.kinematics.layout import Joint, Link
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_LENGTH

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


def links_at(mechanism: Mechanism, input_deg: Array) -> tuple[Link, ...]:
    """Return a machine's links at input angles (n,), in degrees within half a period of mid-motion.

    They are the drive's own links and, for a cam-Geneva, the crank along which its rollers slide.
    The drive cannot describe that crank: in the dwell the rollers follow the groove as it is cut.
    """
    sign, own_deg = mechanism.spec.wheel.SIGN, mechanism.own_deg(input_deg)
    own = mechanism.spec.drive.links(mechanism.plan, sign, own_deg)
    groove = mechanism.engagements[0].groove
    if groove is None:
        return own
    from geneva_cli.layout.groove import roller_in_groove

    L, m, still = mechanism.center_distance_mm, mechanism.spec.drive.rollers, 0.0 * input_deg
    joints = [(still + L, still)]
    for k in range(m):
        x, y = L * roller_in_groove(groove, input_deg - 360.0 * k / m).T
        joints.append((x, y))
    return (*own, Link("crank", tuple(joints), (Joint.SHAFT, *[Joint.CARRIED] * m), 1))


def gear_plane(mechanism: Mechanism) -> int:
    """Return the number of the plane of noncircular gears: below the arm and all links."""
    import numpy as np

    return 1 + max((link.plane for link in links_at(mechanism, np.zeros(1))), default=1)


def same(p: Point, q: Point, L: float) -> bool:
    """Return True if two points coincide, with the centre distance L."""
    return abs(complex(*p) - complex(*q)) < SAME_LENGTH * L
