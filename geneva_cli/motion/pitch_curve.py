"""Tangent, curvature and pressure angle of a slot's pitch curve, in jets of any numbers."""

from functools import lru_cache
from typing import NamedTuple, cast

from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import Array, library, size
from geneva_cli.numerics.jet import Number

# table columns for a pitch curve with a wall on either side
WALLED = (
    *("x_mm", "y_mm", "left_x_mm", "left_y_mm", "right_x_mm", "right_y_mm"),
    *("pressure_deg", "curvature_radius_mm"),
)


class Pitch(NamedTuple):
    """The pitch curve M at one input angle or at an array of them."""

    x: Number
    y: Number
    tangent_x: Number  # direction of travel of the pin in the wheel
    tangent_y: Number
    speed: Number  # |M'|
    turning: Number  # rate at which it turns left, radians per input radian: curvature x speed
    pressure: Number  # radians, 0 to pi/2


@lru_cache(maxsize=16)
def retraces(engagement: Engagement) -> bool:
    """True if the pin stops in the wheel at mid-motion and leaves along the path it came by.

    This holds for straight slots and at the mid condition. Otherwise the pin passes mid-motion
    across the slot's radius, and the pressure angle is 90 degrees there. For a batch the result is
    an array.
    """
    x, y = engagement.slot(0.0, 1)
    m = library(x.c[0])
    left = m.hypot(x.c[1], y.c[1])
    (x0, x1), (y0, y1) = (jet.derivatives() for jet in engagement.path(0.0, 1))
    turns, far = size(engagement.motion(0.0, 1).c[1]), m.hypot(x0, y0)
    # |M'| below 1e-9 of the speeds of pin and wheel is rounding. If a matched R/L is nearly 1, the
    # pin's distance ``far`` itself is only rounding, 2**-52.
    bar = 1e-9 * (m.hypot(x1, y1) + turns * far) + 2.0**-52 * turns
    return cast("bool", left < bar)


def pitch(engagement: Engagement, input_deg: Number) -> Pitch:
    """Compute the pitch curve at input angles other than a retracing mid-motion."""
    x, y = engagement.slot(input_deg, 2)
    m = library(x.c[0])
    (x0, x1, x2), (y0, y1, y2) = x.derivatives(), y.derivatives()
    speed = m.hypot(x1, y1)
    turning = (x1 * y2 - y1 * x2) / (speed * speed)
    pressure = m.atan2(size(x0 * y1 - y0 * x1), size(x0 * x1 + y0 * y1))
    return Pitch(x0, y0, x1 / speed, y1 / speed, speed, turning, pressure)


def opposites(engagement: Engagement, input_deg: Array) -> Array:
    """Input angles on the other branch at which the roller is as far from the wheel's axis."""
    return engagement.inputs_deg(-engagement.own_deg(input_deg))


@lru_cache(maxsize=16)
def pitch_at_retrace(engagement: Engagement) -> Pitch:
    """Limit of the pitch curve at mid-motion for a pin that retraces, approached from the entry."""
    x, y = engagement.slot(0.0, 3)
    m = library(x.c[0])
    (x0, _, x2, x3), (y0, _, y2, y3) = x.derivatives(), y.derivatives()
    bend = m.hypot(x2, y2)
    turning = (x2 * y3 - y2 * x3) / (2.0 * bend * bend)
    pressure = m.atan2(size(x0 * y2 - y0 * x2), size(x0 * x2 + y0 * y2))
    return Pitch(x0, y0, -x2 / bend, -y2 / bend, 0.0, turning, pressure)
