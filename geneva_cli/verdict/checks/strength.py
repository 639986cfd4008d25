"""Stresses and life of pin, horn, lock, shafts and roller, if the spec gives limits."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared


class Bound(NamedTuple):
    """A limit of the spec, and the whole name of the limited quantity."""

    limit: str  # table.key
    quantity: str
    place: str = ""  # the quantity with its input angle
    must_be: str = "at most"


BOUNDS = {
    "pv_max_W_m2": Bound("limits.pv_max_W_m2", "life.pv_max_W_m2"),
    # L10
    "roller_life_min_h": Bound(
        "limits.roller_life_min_h", "life.roller_life_h", must_be="at least"
    ),
    # Archard's depth
    "slot_wear_max_mm_per_million": Bound(
        "limits.slot_wear_max_mm_per_million", "life.slot_wear_mm_per_million"
    ),
    "pin_stress_MPa": Bound("material.roller.stress_max_MPa", "strength.pin.stress_MPa"),
    # under the roller
    "horn_stress_MPa": Bound(
        "material.wheel.stress_max_MPa", "strength.horn.stress_MPa", "strength.horn.at_deg"
    ),
    # under the torque that the lock holds
    "lock_horn_stress_MPa": Bound("material.wheel.stress_max_MPa", "strength.lock.horn_stress_MPa"),
    # between disc and recess: on the recess's end, or between the arcs
    "lock_stress_max_MPa": Bound("limits.lock_stress_max_MPa", "strength.lock.greatest_MPa"),
    # the wheel turns by the lock's play, the contact's approach and the horn's bending
    "lock_deflection_max_deg": Bound(
        "limits.lock_deflection_max_deg", "strength.lock.deflection_deg"
    ),
    # shear stresses, by the ASME code
    "wheel_shaft_stress_MPa": Bound(
        "shaft.shear_stress_max_MPa",
        "strength.wheel_shaft.stress_MPa",
        "strength.wheel_shaft.at_deg",
    ),
    "crank_shaft_stress_MPa": Bound(
        "shaft.shear_stress_max_MPa",
        "strength.crank_shaft.stress_MPa",
        "strength.crank_shaft.at_deg",
    ),
}


def strength_limit(name: str, mechanism: Mechanism) -> Check | None:
    """A limited value of strength or life; None without a limit, or without the part.

    It is not proved if a key is missing.
    """
    bound = BOUNDS[name]
    table, _, key = bound.limit.rpartition(".")
    limit = mechanism.spec.table(table)[key]
    if limit is None:
        return None
    # A spec without such limits is checked without NumPy.
    from geneva_cli.verdict.strength import strength

    of = strength(mechanism)
    value = of[bound.quantity]
    if value is not None:
        at_deg = of[bound.place] if bound.place else None
        return compared(name, value, bound.must_be, limit, at_deg)
    reason = of.reason(name)
    if reason is None:
        return None
    return Check(name, None, bound.must_be, limit, None, f"not known: it needs {reason}")
