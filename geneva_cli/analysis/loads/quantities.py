"""The quantities of a cycle by their names, and the greatest and least of each, looked for once."""

from __future__ import annotations

from geneva_cli.analysis.loads.cycle import Cycle, Extremes, Quantity
from geneva_cli.analysis.loads.forces import Row

STRESS = "contact_stress_MPa"
MOVES = ("omega_rad_s", "alpha_rad_s2", "sliding_m_s")  # what is known without a load
PV = "pv_W_m2"  # greatest Hertz pressure times the speed of sliding
KINETIC = "kinetic_rad2_s3"  # speed times acceleration of the wheel: the power of an inertia of 1
PRESSED = (STRESS, PV)  # what is known with a face width alone
# Whose squares are looked for: a root has no slope where it is 0, nor has the size of a vector.
SQUARED = (*PRESSED, "crank_bearing_N", "guide_force_N")
# What each quantity is at an instant, whose extremes are looked for.
QUANTITIES: dict[str, Quantity] = {
    "omega_rad_s": lambda i: Row(i.omega_rad_s),
    "alpha_rad_s2": lambda i: Row(i.alpha_rad_s2),
    "wheel_torque_Nm": lambda i: Row(i.wheel_torque_Nm),
    "pin_force_N": lambda i: i.pin_force,
    STRESS: lambda i: i.stress,
    "sliding_m_s": lambda i: Row(i.sliding_m_s),
    "input_torque_Nm": lambda i: i.shaft,
    "wheel_bearing_N": lambda i: Row(i.wheel_bearing_N, i.grip),
    "crank_bearing_N": lambda i: Row(i.crank_bearing_squared, i.grip),
    PV: lambda i: i.pressure_speed,
    "guide_force_N": lambda i: i.guide,
    KINETIC: lambda i: Row(i.omega_rad_s * i.alpha_rad_s2),
}


def known(cycle: Cycle) -> list[str]:
    """The quantities of which there is a value."""
    missing = {KINETIC} if cycle.given.hertz is not None else {KINETIC, *PRESSED}
    if not any(engagement.reactions for engagement in cycle.mechanism.engagements):
        missing.add("guide_force_N")
    found = QUANTITIES if cycle.is_loaded else MOVES
    return [name for name in found if name not in missing]


def ends_of(cycle: Cycle, *names: str) -> list[Extremes]:
    """Greatest and least of quantities that are known, over all motions."""
    return [_of_all(ends_of_each(cycle, name)) for name in names]


def ends_of_each(cycle: Cycle, name: str) -> list[Extremes]:
    """Greatest and least of a quantity that is known, a row an engagement.

    All that are known are looked for at once: a search pays for the motion, not for what is asked.
    """
    if not cycle.found:
        names = (*known(cycle), KINETIC)
        cycle.look({name: QUANTITIES[name] for name in names})
    return cycle.found[name]


def _of_all(each: list[Extremes]) -> Extremes:
    """The first that is greatest, and the first that is least."""
    most, least = max(each, key=lambda one: one.max), min(each, key=lambda one: one.min)
    return Extremes(most.max, most.max_at_deg, least.min, least.min_at_deg)
