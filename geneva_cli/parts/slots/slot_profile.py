"""The slot's profile: its pitch curve and both flanks at input angles."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeVar

import numpy as np

from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pitch_curve import (
    PinHeading,
    Pitch,
    pin_heading,
    pitch,
    pitch_at_retrace,
    retraces,
)
from geneva_cli.numerics.arrays import Array, Number, array
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG

T = TypeVar("T", PinHeading, Pitch)


class SlotProfile(NamedTuple):
    """The slot at ascending input angles, in millimetres, in the wheel's frame.

    ``left`` and ``right`` are the flanks in the pin's direction of travel at entry. ``radius`` is
    the pitch curve's radius of curvature: positive where its centre lies to the left, infinite on a
    straight line.
    """

    input_deg: Array
    output: Array  # the wheel's angle, or a rack's travel, in its unit
    centre: Array  # (n, 2)
    left: Array
    right: Array
    pressure_deg: Array
    radius: Array


def slot(mechanism: Mechanism, input_deg: Array) -> SlotProfile:
    """Return the slot of a mechanism at ascending input angles of its first engagement."""
    engagement, L = mechanism.engagements[0].through, mechanism.center_distance_mm
    input_deg = _snapped(engagement, input_deg)
    at = pitch_at(engagement, input_deg)
    side = _side(engagement, input_deg, at)
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = L * side * np.divide(at.speed, at.turning)
    straight = engagement.slot.axis(engagement.entry_deg) is not None
    return SlotProfile(
        input_deg,
        array(engagement.motion(input_deg, 0).c[0]) * mechanism.output.per_radian,
        *_offsets(mechanism, at, side),
        np.degrees(at.pressure),
        np.where(straight | (at.turning == 0.0), np.inf, radius),
    )


def flanks(mechanism: Mechanism, input_deg: Array) -> tuple[Array, Array, Array]:
    """Return the pitch curve and both flanks at input angles, mm, (n, 2) each."""
    engagement = mechanism.engagements[0].through
    input_deg = _snapped(engagement, input_deg)
    at = heading_at(engagement, input_deg)
    return _offsets(mechanism, at, _side(engagement, input_deg, at))


def _snapped(engagement: Engagement, input_deg: Array) -> Array:
    """Return input angles, with those near a retracing mid-motion set to exactly 0."""
    near = (np.abs(input_deg) < SAME_INPUT_DEG) & retraces(engagement)
    return np.where(near, 0.0, input_deg)


def _side(engagement: Engagement, input_deg: Array, at: PinHeading | Pitch) -> Array:
    """Return 1, or -1 where the pin leaves on the path on which it came.

    Its travel is reversed after mid-motion; the flanks keep the sides that they had at entry.
    """
    if engagement.slot.axis(engagement.entry_deg) is None:
        return np.where(retraces(engagement) & (input_deg > 0.0), -1.0, 1.0)
    first = pin_heading(engagement, engagement.entry_deg)
    ahead = at.tangent_x * first.tangent_x + at.tangent_y * first.tangent_y
    return np.where(ahead < 0.0, -1.0, 1.0)


def _offsets(
    mechanism: Mechanism, at: PinHeading | Pitch, side: Array
) -> tuple[Array, Array, Array]:
    """Return the pitch curve and its two offsets by the roller's radius and clearance, mm."""
    L, size = mechanism.center_distance_mm, mechanism.spec.size
    offset = mechanism.roller_radius_mm + size.allowances.slot_clearance_mm
    normal = np.column_stack((-at.tangent_y * side, at.tangent_x * side))
    centre = L * np.column_stack((at.x, at.y))
    return centre, centre + offset * normal, centre - offset * normal


def pitch_at(engagement: Engagement, input_deg: Array) -> Pitch:
    """Return the pitch curve, with its limit at a retracing mid-motion."""
    return _with_limit(pitch, engagement, input_deg)


def heading_at(engagement: Engagement, input_deg: Array) -> PinHeading:
    """Return the pin's path in the wheel, with its limit at a retracing mid-motion."""
    return _with_limit(pin_heading, engagement, input_deg)


def _with_limit(
    of: Callable[[Engagement, Number], T], engagement: Engagement, input_deg: Array
) -> T:
    middle = np.abs(input_deg) < SAME_INPUT_DEG
    if not middle.any() or not retraces(engagement):
        return of(engagement, input_deg)
    # any regular place stands in for mid-motion
    at = of(engagement, np.where(middle, 0.5 * engagement.entry_deg, input_deg))
    limit = pitch_at_retrace(engagement)  # its first fields are those of a heading
    columns = zip(at, limit, strict=False)
    build: Callable[..., T] = type(at)
    return build(*(np.where(middle, value, array(column)) for column, value in columns))
