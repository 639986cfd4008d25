"""What must be bought: the index-drive makers' form beside the exact cycle, motor and flywheel."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geneva_cli.analysis.loads.cycle import Cycle

NAMES = (
    "inertia_kgm2",
    "acceleration_rad_s2",
    "inertia_torque_Nm",
    "friction_torque_Nm",
    "total_torque_Nm",
    "design_torque_Nm",
    "input_torque_Nm",
    "power_W",
    "Am",
    "Vm",
    "Qm",
    "energy_fluctuation_J",
    "flywheel_kgm2",
    "motor_rpm",
    "motor_torque_max_Nm",
    "motor_torque_rms_Nm",
    "inertia_ratio",
)


def sizing(cycle: Cycle) -> tuple[dict[str, float | None], list[str]]:
    """The values of ``sizing`` by their names, and what would give those that are None.

    ``cycle`` has the machine (``cycle.mechanism``, whose ``spec`` has [motor], [support] and the
    masses), ``cycle.given`` (inertia, resistance and input speed, at the wheel's shaft), exact
    ``extremes`` and ``integrals`` of anything made of an ``Instant``, and ``stretches`` with
    ``moving`` for what needs the way between.
    """
    return dict.fromkeys(NAMES), []
