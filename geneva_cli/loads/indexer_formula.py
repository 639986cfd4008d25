"""Sizing by the formula of cam-indexer makers, for any cam curve; the standard motor.

It assumes the greatest torque on the wheel during the whole motion, and the curve's factor Qm.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from geneva_cli.motion.timing import CamFactors
from geneva_cli.numerics.angles import radians


class ShaftLoad(NamedTuple):
    """Load of the wheel's shaft: kg m², N m, and the service factor fc on all of it."""

    inertia: float
    friction: float
    work: float
    service_factor: float
    frame: float = 0.0  # turns of the wheel's frame in one turn of the input


class IndexerFormula(NamedTuple):
    """The lines of the formula: rad/s², N m at the wheel, and Tc at the input."""

    alpha: float
    Ti: float
    Tt: float
    Te: float
    Tc: float


def indexer_formula(
    factors: CamFactors, step_deg: float, motion_deg: float, n_rpm: float, load: ShaftLoad
) -> IndexerFormula:
    """The formula for a wheel's step in an input angle at a speed.

    alpha = Am step / t2², Ti = J alpha, Tt = Ti + Tf + Tw, Te = fc Tt, Tc = step/motion Qm Te. A
    carrier that turns the wheel's frame also takes fc Ti, which need not be greatest where the rest
    is.
    """
    t2 = motion_deg / (6.0 * n_rpm)
    alpha = factors.Am * radians(step_deg) / (t2 * t2)
    Ti = load.inertia * alpha
    Tt = Ti + load.friction + load.work
    Te = load.service_factor * Tt
    carried = abs(load.frame) * load.service_factor * Ti
    return IndexerFormula(alpha, Ti, Tt, Te, step_deg / motion_deg * factors.Qm * Te + carried)


# Rated outputs of motors, kW, by IEC 60072-1; 3 and 4 kW, common in catalogues, by EN 50347.
RATED_kW = (
    *(0.06, 0.09, 0.12, 0.18, 0.25, 0.37, 0.55, 0.75, 1.1, 1.5, 2.2, 3.0, 4.0, 5.5, 7.5, 11.0),
    *(15.0, 18.5, 22.0, 30.0, 37.0, 45.0, 55.0, 75.0, 90.0, 110.0, 132.0, 160.0, 200.0, 250.0),
)


class RecommendedMotor(NamedTuple):
    """A motor: the power needed from it, and the standard power that is enough."""

    formula_W: float  # by the cam-indexer formula, with the service factor and both efficiencies
    peak_W: float  # greatest over the exact cycle, behind the reducer, without the service factor
    rpm: float
    input_torque_Nm: float  # by the cam-indexer formula, with the service factor

    @property
    def needed_W(self) -> float:
        """The greater of both powers."""
        return max(self.formula_W, self.peak_W)

    @property
    def rated_kW(self) -> float | None:
        """The least standard power that is enough; None if even the greatest is not."""
        return next((rated for rated in RATED_kW if 1e3 * rated >= self.needed_W), None)

    @property
    def torque_Nm(self) -> float:
        """The torque of the needed power at the motor's speed."""
        return self.needed_W * 60.0 / (self.rpm * math.tau)

    @property
    def is_small(self) -> bool:
        """True if the needed power is below the least standard one."""
        return self.needed_W < 1e3 * RATED_kW[0]


def recommended_motor(sizing: Mapping[str, float | None]) -> RecommendedMotor | None:
    """The motor for the values of ``sizing``; None without a load, or for an unbounded one."""
    names = ("power_W", "motor_torque_max_Nm", "motor_rpm", "input_torque_Nm")
    formula_W, torque, rpm, with_factor = (sizing[name] for name in names)
    if formula_W is None or torque is None or rpm is None or with_factor is None:
        return None
    return RecommendedMotor(formula_W, torque * rpm * math.tau / 60.0, rpm, with_factor)
