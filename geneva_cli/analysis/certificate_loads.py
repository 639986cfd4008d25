"""Certificates of loads without friction: the wheel's torque, the input's torque, the pin force.

The wheel needs the torque T = I epsilon + M. The input gives T velocity / efficiency, and the pin
presses with T / lever. In a straight slot the lever is the roller's coordinate along the slot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.analysis.forces import LoadCase, load_case
from geneva_cli.analysis.quantities import FORCE, TORQUE
from geneva_cli.numerics.jet import Jet, Number

if TYPE_CHECKING:
    from geneva_cli.analysis.certificate_decimals import Formula
    from geneva_cli.kinematics.engagement import Engagement
    from geneva_cli.machine.mechanism import Mechanism

WHEEL_TORQUE = "wheel_torque_Nm"
LOADS = (WHEEL_TORQUE, FORCE, TORQUE)


def not_proved(mechanism: Mechanism, quantity: str) -> str:
    """The reason why a load has no certificate; empty if it has one."""
    spec, first = mechanism.spec, mechanism.engagements[0]
    if not spec.is_loaded:
        return "no load: set inertia_kgm2 or torque_Nm in [load]"
    if quantity == WHEEL_TORQUE:
        return ""
    if load_case(mechanism).rubs:
        return "friction: its force changes direction where the roller does"
    if not first.slot.walls_flat:
        return "the slot is curved, or gears drive for part of the motion"
    if quantity == TORQUE and spec.load.efficiency != 1.0:
        return "an efficiency below 1 counts only where the input drives"
    return ""


def load_formula(mechanism: Mechanism, engagement: Engagement, quantity: str) -> Formula:
    """A load as a jet by the input angle, at one angle in degrees from mid-motion."""
    case = load_case(mechanism)

    def formula(input_deg: Number, order: int) -> Jet:
        rates = engagement.motion.rate(input_deg, order + 1)
        torque = _torque(case, rates)
        if quantity == WHEEL_TORQUE:
            return torque
        if quantity == TORQUE:
            return torque * Jet(rates.c[:-1])
        axis = engagement.slot.axis(input_deg, order)
        assert axis is not None  # the slot is straight
        return torque / (axis.lever * case.L)

    return formula


def _torque(case: LoadCase, rates: Jet) -> Jet:
    return rates.derivative() * case.inertia_Nm + case.resists_Nm
