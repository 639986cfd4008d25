"""The motor that a machine needs, from the standard powers."""

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

    form_W: float  # by the makers' form, with the service factor and both efficiencies
    peak_W: float  # greatest over the exact cycle, behind the reducer, without the service factor
    rpm: float
    input_torque_Nm: float  # by the makers' form, with the service factor

    @property
    def needed_W(self) -> float:
        """The greater of both powers.

        >>> RecommendedMotor(118.3, 88.5, 1400.0, 22.8).needed_W
        118.3
        """
        return max(self.form_W, self.peak_W)

    @property
    def rated_kW(self) -> float | None:
        """The least standard power that is enough; None if even the greatest is not.

        >>> RecommendedMotor(118.3, 88.5, 1400.0, 22.8).rated_kW
        0.12
        """
        return next((rated for rated in RATED_kW if 1e3 * rated >= self.needed_W), None)


def recommended_motor(sizing: Mapping[str, float | None]) -> RecommendedMotor | None:
    """The motor for the values of ``sizing``; None without a load, or for an unbounded one."""
    names = ("power_W", "motor_torque_max_Nm", "motor_rpm", "input_torque_Nm")
    form, torque, rpm, with_factor = (sizing[name] for name in names)
    if form is None or torque is None or rpm is None or with_factor is None:
        return None
    return RecommendedMotor(form, torque * rpm * math.tau / 60.0, rpm, with_factor)
