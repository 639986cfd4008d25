"""The quantities of a cycle by their names, and the greatest and least of each, looked for once."""

from __future__ import annotations

from geneva_cli.analysis.loads.cycle import Cycle, Extremes, Quantity
from geneva_cli.analysis.loads.forces import Row

STRESS = "contact_stress_MPa"
MOVES = ("omega_rad_s", "alpha_rad_s2", "sliding_m_s")  # what is known without a load
PV = "pv_W_m2"  # greatest Hertz pressure times the speed of sliding
SQUARED = (STRESS, PV)  # whose squares are looked for: a root has no slope where it is 0
# What each quantity is at an instant, whose extremes are looked for.
QUANTITIES: dict[str, Quantity] = {
    "omega_rad_s": lambda i: Row(i.omega_rad_s),
    "alpha_rad_s2": lambda i: Row(i.alpha_rad_s2),
    "wheel_torque_Nm": lambda i: Row(i.wheel_torque_Nm),
    "pin_force_N": lambda i: i.pin_force,
    STRESS: lambda i: i.stress,
    "sliding_m_s": lambda i: Row(i.sliding_m_s),
    "input_torque_Nm": lambda i: i.shaft(i.input_torque_Nm),
    "wheel_bearing_N": lambda i: Row(i.wheel_bearing_N, i.grip),
    "crank_bearing_N": lambda i: Row(i.crank_bearing_N, i.grip),
    PV: lambda i: i.pressure_speed,
    "guide_force_N": lambda i: i.guide,
}


def known(cycle: Cycle) -> list[str]:
    """The quantities of which there is a value."""
    missing = set() if cycle.given.hertz is not None else {*SQUARED}
    if not any(engagement.joints for engagement in cycle.mechanism.engagements):
        missing.add("guide_force_N")
    found = QUANTITIES if cycle.is_loaded else MOVES
    return [name for name in found if name not in missing]


def ends_of(cycle: Cycle, *names: str) -> list[Extremes]:
    """Greatest and least of quantities that are known: those not asked for before, all at once."""
    lacking = [name for name in names if name not in cycle.found]
    if lacking:
        every = cycle.extremes(*[QUANTITIES[name] for name in lacking])
        cycle.found.update(zip(lacking, every, strict=True))
    return [cycle.found[name] for name in names]
