"""The names of the quantities of a cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array

FORCE = "pin_force_N"  # a size; samples have the sign of the wall that bears
WALL_FORCE = "wall_force_N"  # with that sign
STRESS = "contact_stress_MPa"
TORQUE = "input_torque_Nm"
PV = "pv_W_m2"  # greatest Hertz pressure times the speed of sliding
PRESSED = (STRESS, PV)  # known only with a face width
# Searched by their squares: a root has no slope where it is 0, nor has the size of a vector.
SQUARED = (*PRESSED, "crank_bearing_N", "guide_force_N")
# Quantities that are never negative.
NEVER_NEGATIVE = (*SQUARED, FORCE, "wheel_bearing_N")
# Loads whose greatest size a report shows, and their names in the cycle.
REPORTED_PEAKS = {
    "torque_Nm": "wheel_torque_Nm",
    "rack_force_N": "rack_force_N",
    FORCE: FORCE,
    TORQUE: TORQUE,
    STRESS: STRESS,
}
# The names of all quantities that are searched.
QUANTITIES = (
    *("omega_rad_s", "alpha_rad_s2", "wheel_torque_Nm", FORCE, WALL_FORCE, STRESS, "sliding_m_s"),
    *(TORQUE, "wheel_bearing_N", "crank_bearing_N", PV, "guide_force_N"),
)


def plain_values(values: Array, name: str) -> Array:
    """Values of a quantity, from the values that are searched."""
    return np.sqrt(np.abs(values)) if name in SQUARED else values
