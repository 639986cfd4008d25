"""The standard motor for a machine."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

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
    needed_W: float  # the greater of both powers
    rated_kW: float | None  # the least standard power that is enough; None if none is


def recommended_motor(sizing: Mapping[str, float | None]) -> RecommendedMotor | None:
    """The motor for the values of ``sizing``; None without a load, or for an unbounded one."""
    names = ("power_W", "motor_torque_max_Nm", "motor_rpm", "input_torque_Nm")
    formula_W, torque, rpm, with_factor = (sizing[name] for name in names)
    if formula_W is None or torque is None or rpm is None or with_factor is None:
        return None
    peak_W = torque * rpm * math.tau / 60.0
    needed = max(formula_W, peak_W)
    rated = next((rated for rated in RATED_kW if 1e3 * rated >= needed), None)
    return RecommendedMotor(formula_W, peak_W, rpm, with_factor, needed, rated)
