"""The quantities of a cycle by their names, and the extremes of each, which are searched once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.loads.cycle import Cycle, Extremes, Quantity
from geneva_cli.analysis.loads.forces import Row
from geneva_cli.numerics.ties import first_greatest

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array

FORCE = "pin_force_N"
STRESS = "contact_stress_MPa"
MOVES = ("omega_rad_s", "alpha_rad_s2", "sliding_m_s")  # known without a load
PV = "pv_W_m2"  # greatest Hertz pressure times the speed of sliding
KINETIC = "kinetic_rad2_s3"  # speed times acceleration of the wheel: the power of an inertia of 1
PRESSED = (STRESS, PV)  # known only with a face width
# Searched by their squares: a root has no slope where it is 0, nor has the size of a vector.
SQUARED = (*PRESSED, "crank_bearing_N", "guide_force_N")
# Those that are never negative.
SIZES = (*SQUARED, "wheel_bearing_N")
# Each quantity at an instant.
QUANTITIES: dict[str, Quantity] = {
    "omega_rad_s": lambda i: Row(i.omega_rad_s),
    "alpha_rad_s2": lambda i: Row(i.alpha_rad_s2),
    "wheel_torque_Nm": lambda i: Row(i.wheel_torque_Nm),
    FORCE: lambda i: i.pin_force,
    STRESS: lambda i: i.stress,
    "sliding_m_s": lambda i: Row(i.sliding_m_s),
    "input_torque_Nm": lambda i: i.shaft,
    "wheel_bearing_N": lambda i: Row(i.wheel_bearing_N, i.grip),
    "crank_bearing_N": lambda i: Row(i.crank_bearing_squared, i.grip),
    PV: lambda i: i.pressure_speed,
    "guide_force_N": lambda i: i.guide,
    KINETIC: lambda i: Row(i.omega_rad_s * i.alpha_rad_s2),
}


def known_quantities(cycle: Cycle) -> list[str]:
    """The names of the quantities that have a value for this machine and load."""
    missing = {KINETIC} if cycle.given.hertz is not None else {KINETIC, *PRESSED}
    if not any(engagement.reactions for engagement in cycle.mechanism.engagements):
        missing.add("guide_force_N")
    found = QUANTITIES if cycle.is_loaded else MOVES
    return [name for name in found if name not in missing]


def ends_of(cycle: Cycle, *names: str) -> list[Extremes]:
    """The extremes of known quantities over all motions."""
    return [_of_all(ends_of_each(cycle, name)) for name in names]


def ends_of_each(cycle: Cycle, name: str) -> list[Extremes]:
    """The extremes of a known quantity, one for each engagement.

    All known quantities are searched at once, as nearly all of the cost is the motion's.
    """
    if not cycle.found:
        names = (*known_quantities(cycle), KINETIC)
        cycle.look({name: QUANTITIES[name] for name in names})
    return cycle.found[name]


def _of_all(each: list[Extremes]) -> Extremes:
    """The greatest maximum and the least minimum, of equal ones the first."""
    return Extremes(*map(float, outermost(np.array(each))))


def outermost(each: Array) -> Array:
    """The extremes of all engagements of those of each, (engagements, 4, ...): of equal ones the
    first.
    """
    most, most_at_deg, least, least_at_deg = np.moveaxis(each, 1, 0)
    both = np.concatenate((most, least))
    size = np.where(np.isfinite(both), np.abs(both), 0.0).max(axis=0)
    sides = first_greatest(most, most_at_deg, size), first_greatest(-least, least_at_deg, size)
    (most, most_at_deg), (least, least_at_deg) = sides
    return np.stack((most, most_at_deg, -least, least_at_deg))
