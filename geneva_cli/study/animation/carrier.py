"""The wheels on a carrier: where each stands and moves, and the carrier's rotation."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import radians
from geneva_cli.scene import Push, Rotation, Track


class WheelPlace(NamedTuple):
    """A wheel on the carrier, whose axis is turned about the fixed one from the first wheel's."""

    number: int  # from 1
    behind_deg: float  # the carrier's angle after which it does what the first wheel did
    turn: float  # radians, counterclockwise in the carrier's frame
    centre: tuple[float, float]  # mm


def wheel_places(mechanism: Mechanism) -> list[WheelPlace]:
    """The places of all wheels; of the one wheel, if it does not orbit."""
    count, L = max(1, mechanism.spec.drive.wheels_on_carrier), mechanism.center_distance_mm
    out = []
    for k in range(count):
        turn = -mechanism.frame * math.tau * k / count if k else 0.0
        centre = L - L * math.cos(turn), -L * math.sin(turn) if k else 0.0
        out.append(WheelPlace(k + 1, 360.0 * k / count, turn, centre))
    return out


def frame_rotation(mechanism: Mechanism, start: float, whole: float) -> Rotation | None:
    """The carrier's rotation over ``whole`` degrees of the input from ``start``; None without."""
    if not mechanism.frame:
        return None
    rate = mechanism.frame * radians(1.0)
    ends = rate * start, rate * (start + whole)
    angle = Track((0.0, whole), ends, (rate, rate), ends[1] - ends[0])
    return Rotation((mechanism.center_distance_mm, 0.0), angle)


def moved_push(push: Push, place: WheelPlace, L: float) -> Push:
    """The force on the first wheel as that on another, which meets the roller later."""
    c, s = math.cos(place.turn), math.sin(place.turn)

    def turned(x: tuple[float, ...], y: tuple[float, ...], about: float) -> list[list[float]]:
        pairs = [(u - about, v) for u, v in zip(x, y, strict=True)]
        return [[about + c * u - s * v for u, v in pairs], [s * u + c * v for u, v in pairs]]

    places = turned(push.x, push.y, L)
    forces = turned(push.force_x, push.force_y, 0.0)
    later = tuple(t + place.behind_deg for t in push.at)
    return Push(later, *map(tuple, (*places, *forces)))
