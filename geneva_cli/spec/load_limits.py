"""The quantities that keys of ``[limits]`` bound. Commands ask for names alone, without numbers."""

from __future__ import annotations

from geneva_cli.spec.tables import Limits

# Keys, which name their checks too, and what they bound: from below if the key has _min in it.
LIMITED = {
    "velocity_max": "velocity.max",
    "acceleration_max": "acceleration.max",
    "acceleration_entry_max": "acceleration.entry",
    "jerk_max": "jerk.max",
    "pin_force_max_N": "loads.pin_force_N.max",
    "input_torque_max_Nm": "loads.input_torque_Nm.max",
    "contact_stress_max_MPa": "loads.contact_stress_MPa.max",
    "pv_max_W_m2": "life.pv_max_W_m2",
    "roller_life_min_h": "life.roller_life_h",
    "dwell_min_s": "timing.dwell_s",
    "motion_max_s": "timing.motion_s",
    "cycle_max_s": "timing.cycle_s",
}


def limited_loads(limits: Limits) -> list[str]:
    """The whole names of the loads that a spec limits."""
    values = limits.as_dict()
    return [name for key, name in LIMITED.items() if name.startswith("loads.") and values[key]]


def limited_load(key: str) -> str:
    """The load that a key bounds.

    >>> limited_load("pin_force_max_N")
    'pin_force_N'
    """
    return LIMITED[key].split(".")[1]
