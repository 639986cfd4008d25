"""Angles by which the wheel can be turned until parts touch, at requested input angles."""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.turn.machine_parts import MachineParts, rim_lever
from geneva_cli.parts.turn.pairs import Stop, smallest_clearance

EXACT = 1e-10  # radians: smaller angles are rounding


def search_deg(parts: MachineParts) -> float:
    """Return the largest play that is searched for: half a step, in degrees.

    Beyond it the wheel's position is lost.
    """
    return math.degrees(min(engagement.half_step for engagement, _ in parts.assembly.motions))


def free_angles(parts: MachineParts, at: Array, fits: bool = False) -> tuple[Array, Array]:
    """Return the angles that the wheel can be turned back and on at input angles (n,), radians."""
    back, on = wheel_stops(parts, at, fits)
    return back.lead, on.lead


def wheel_stops(parts: MachineParts, at: Array, fits: bool = False) -> tuple[Stop, Stop]:
    """Return the stops of the wheel, turned back and turned on at input angles (n,).

    ``fits`` says that no parts overlap there; otherwise that is tested. Where gears drive the wheel
    they hold it both ways: their teeth are assumed to mesh without play.
    """
    gaps, close = parts.gaps, parts.close
    pose, held = gaps.pose(at), parts.assembly.geared(at)
    if not fits:  # parts that overlap from the start leave no play
        held |= smallest_clearance(gaps, pose, np.zeros(len(at)), close) < -close
    back, on = gaps.stops(pose, math.radians(search_deg(parts)), close)
    for each in (*back, *on):
        each[held] = 0.0
    return back, on


def touching(parts: MachineParts) -> float:
    """Return the largest play, radians, that may be rounding: tangent parts separate slowly.

    It is the angle at which two circles of the rim's radius overlap by ``close``.
    """
    return math.sqrt(2.0 * parts.close / rim_lever(parts))
