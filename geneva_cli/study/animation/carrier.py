"""The rotation of a carrier, and the forces on its wheels."""

from __future__ import annotations

import math

from geneva_cli.kinematics.layout import AxisPlace
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import radians
from geneva_cli.scene import Push, Rotation, Track


def frame_rotation(mechanism: Mechanism, start: float, whole: float) -> Rotation | None:
    """The carrier's rotation over ``whole`` degrees of the input from ``start``; None without."""
    if not mechanism.frame:
        return None
    rate = mechanism.frame * radians(1.0)
    ends = rate * start, rate * (start + whole)
    angle = Track((0.0, whole), ends, (rate, rate), ends[1] - ends[0])
    return Rotation((mechanism.center_distance_mm, 0.0), angle)


def moved_push(push: Push, place: AxisPlace, axis: float) -> Push:
    """The force at the first wheel or crank as that at another one, which works later.

    ``axis`` is the place on the line of centres, mm, about which they stand.
    """
    c, s = math.cos(place.turn), math.sin(place.turn)

    def turned(x: tuple[float, ...], y: tuple[float, ...], about: float) -> list[list[float]]:
        pairs = [(u - about, v) for u, v in zip(x, y, strict=True)]
        return [[about + c * u - s * v for u, v in pairs], [s * u + c * v for u, v in pairs]]

    places = turned(push.x, push.y, axis)
    forces = turned(push.force_x, push.force_y, 0.0)
    later = tuple(t + place.behind_deg for t in push.at)
    return Push(later, *map(tuple, (*places, *forces)))
