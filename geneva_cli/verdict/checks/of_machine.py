"""The checks of a machine, and of its spec's ``[limits]``: one line each, in the order shown."""

from __future__ import annotations

from geneva_cli.verdict.checks import (
    convexity,
    dwell,
    forwards,
    groove,
    invariants,
    load_limits,
    pressure,
    shocks,
    strength,
    undercut,
)
from geneva_cli.verdict.checks.check import OfMachine

# What every machine of its kind must pass.
MOTION: dict[str, OfMachine] = {
    "dwell_deg": dwell.shortest,
    "driver_gear_convexity": convexity.of_gear,
    "driven_gear_convexity": convexity.of_gear,
    "velocity_min": forwards.least_velocity,
    "groove_pressure_deg": groove.greatest,
    "pressure_angle_deg": pressure.of_curved_slots,
    "undercut_mm": undercut.deepest,
    "entry_shock_N": shocks.of_entry,
    "reversal_shock_N": shocks.of_reversal,
}

# What the spec asks for.
LIMITS: dict[str, OfMachine] = {
    "velocity_max": invariants.greatest,
    "acceleration_max": invariants.greatest,
    "acceleration_entry_max": invariants.greatest,
    "jerk_max": invariants.greatest,
    "pin_force_max_N": load_limits.greatest,
    "input_torque_max_Nm": load_limits.greatest,
    "pressure_angle_deg": pressure.as_asked,
    "contact_stress_max_MPa": load_limits.greatest,
    "pv_max_W_m2": strength.pv,
    "roller_life_min_h": strength.roller_life,
    "pin_stress_MPa": strength.pin,
    "horn_stress_MPa": strength.horn,
    "lock_horn_stress_MPa": strength.lock_horn,
    "lock_stress_max_MPa": strength.lock,
    "wheel_shaft_stress_MPa": strength.wheel_shaft,
    "crank_shaft_stress_MPa": strength.crank_shaft,
}
