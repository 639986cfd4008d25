"""The factors Am, Vm and Qm of a motion, for the cam-indexer formula."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.numerics.angles import radians


class CamFactors(NamedTuple):
    """Peaks of a motion that is scaled to a step of 1 in a time of 1.

    The greatest inertia torque times Qm is the greatest torque on the input.
    """

    Am: float  # peak acceleration
    Vm: float  # peak velocity
    Qm: float  # peak of velocity times acceleration, over Am


def cam_factors(
    velocity: float, acceleration: float, power: float, motion_deg: float, step_deg: float
) -> CamFactors:
    """The factors of a motion, from its invariant peaks, its input angle and the wheel's step.

    An external Geneva of four slots, whose motion angle and step are both a right angle:

    >>> cam_factors(2.414213562373095, 5.406981034551926, 10.015265915566939, 90.0, 90.0).Am
    8.4932659...
    """
    motion, step = radians(motion_deg), radians(step_deg)
    return CamFactors(
        acceleration * motion * motion / step,
        velocity * motion / step,
        power * motion / (step * acceleration),
    )
