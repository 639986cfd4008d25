"""The slot's profile: its pitch curve and both flanks at input angles."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.pitch_curve import Pitch, pitch, pitch_at_retrace, retraces
from geneva_cli.numerics.arrays import array

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

# Nearer to mid-motion than this a sample is at it: where the pin stops there, its direction would
# be rounding, and the curve has turned by less than that rounding since.
MIDDLE_DEG = 1e-9


class Slot(NamedTuple):
    """The slot at ascending input angles, in millimetres, in the wheel's frame.

    ``left`` and ``right`` are the flanks as the pin travels in, ``radius`` the pitch curve's
    radius of curvature: positive where its centre lies to the left, infinite on a straight line.
    """

    input_deg: Array
    wheel_deg: Array
    centre: Array  # (n, 2)
    left: Array
    right: Array
    pressure_deg: Array
    radius: Array


def slot(mechanism: Mechanism, input_deg: Array) -> Slot:
    """The slot of a mechanism at ascending input angles of its first engagement."""
    engagement, size = mechanism.engagements[0].through, mechanism.spec.size
    L = mechanism.center_distance_mm
    offset = mechanism.roller_radius_mm + size.allowances.slot_clearance_mm
    back = retraces(engagement)
    if back:
        input_deg = np.where(np.abs(input_deg) < MIDDLE_DEG, 0.0, input_deg)
    at = pitch_at(engagement, input_deg, back)
    # Where the pin leaves on the way it came, its travel is reversed after mid-motion; the
    # flanks keep the sides they had on the way in.
    straight = engagement.slot.axis(engagement.entry_deg) is not None
    if straight:
        first = pitch(engagement, engagement.entry_deg)
        ahead = at.tangent_x * first.tangent_x + at.tangent_y * first.tangent_y
        side = np.where(ahead < 0.0, -1.0, 1.0)
    else:
        side = np.where(back & (input_deg > 0.0), -1.0, 1.0)
    normal = np.column_stack((-at.tangent_y * side, at.tangent_x * side))
    centre = L * np.column_stack((at.x, at.y))
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = L * side * np.divide(at.speed, at.turning)
    radius = np.where(straight | (at.turning == 0.0), np.inf, radius)
    return Slot(
        input_deg,
        np.degrees(engagement.motion(input_deg, 0).c[0]),
        centre,
        centre + offset * normal,
        centre - offset * normal,
        np.degrees(at.pressure),
        radius,
    )


def pitch_at(engagement: Engagement, input_deg: Array, back: bool) -> Pitch:
    """The pitch curve, with its limit put in at a retracing mid-motion."""
    middle = np.flatnonzero(np.abs(input_deg) < MIDDLE_DEG) if back else np.array([], dtype=int)
    safe = input_deg.copy()
    safe[middle] = 0.5 * engagement.entry_deg  # any regular place; overwritten below
    at = pitch(engagement, safe)
    if len(middle):
        limit = pitch_at_retrace(engagement)
        for column, value in zip(at, limit, strict=True):
            array(column)[middle] = value
    return at
