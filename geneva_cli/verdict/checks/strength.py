"""Stresses and life of pin, horn, lock, shafts and roller, where the spec gives limits."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeAlias

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared

if TYPE_CHECKING:
    from geneva_cli.machine.spec import Spec
    from geneva_cli.verdict.strength import Strength

# a value, and its input angle where it is of one place; None for what is not known
Found: TypeAlias = tuple[float | None, float | None]


class Bound(NamedTuple):
    """A part's limit in the spec, and how its value is found."""

    limit: Callable[[Spec], float | None]
    found: Callable[[Strength], Found]
    must_be: str = "at most"


class _Placed(Protocol):
    """A stress at an input angle."""

    @property
    def stress_MPa(self) -> float | None: ...
    @property
    def at_deg(self) -> float | None: ...


def _placed(found: _Placed | None) -> Found:
    return (found.stress_MPa, found.at_deg) if found else (None, None)


BOUNDS = {
    # contact stress times sliding speed
    "pv_max_W_m2": Bound(lambda s: s.limits.pv_max_W_m2, lambda of: (of.pv_max_W_m2, None)),
    # L10
    "roller_life_min_h": Bound(
        lambda s: s.limits.roller_life_min_h,
        lambda of: (of.roller.hours if of.roller else None, None),
        "at least",
    ),
    # Archard's depth
    "slot_wear_max_mm_per_million": Bound(
        lambda s: s.limits.slot_wear_max_mm_per_million, lambda of: (of.wear_mm, None)
    ),
    # the pin's equivalent stress
    "pin_stress_MPa": Bound(
        lambda s: s.material_roller.stress_max_MPa, lambda of: (of.pin_stress_MPa, None)
    ),
    # the horn's bending stress under the roller
    "horn_stress_MPa": Bound(
        lambda s: s.material_wheel.stress_max_MPa, lambda of: _placed(of.horn)
    ),
    # the same under the torque that the lock holds
    "lock_horn_stress_MPa": Bound(
        lambda s: s.material_wheel.stress_max_MPa,
        lambda of: (of.lock.horn_stress_MPa if of.lock else None, None),
    ),
    # between disc and recess: on the recess's end, or as the arcs lie
    "lock_stress_max_MPa": Bound(
        lambda s: s.limits.lock_stress_max_MPa, lambda of: (of.lock_stress_max_MPa, None)
    ),
    # of the wheel: the lock's play, the contact's approach and the horn's bending
    "lock_deflection_max_deg": Bound(
        lambda s: s.limits.lock_deflection_max_deg, lambda of: (of.lock_deflection_deg, None)
    ),
    # the shafts' shear stresses, by the ASME code
    "wheel_shaft_stress_MPa": Bound(
        lambda s: s.shaft.shear_stress_max_MPa, lambda of: _placed(of.wheel_shaft)
    ),
    "crank_shaft_stress_MPa": Bound(
        lambda s: s.shaft.shear_stress_max_MPa, lambda of: _placed(of.crank_shaft)
    ),
}


def strength_limit(name: str, mechanism: Mechanism) -> Check | None:
    """A value held to its limit; none without a limit, or of what the machine has not.

    It cannot be told where a key is missing.
    """
    bound = BOUNDS[name]
    limit = bound.limit(mechanism.spec)
    if limit is None:
        return None
    # A spec that says nothing of what its parts may bear is checked without NumPy.
    from geneva_cli.verdict.strength import strength

    of = strength(mechanism)
    value, at_deg = bound.found(of)
    if value is not None:
        return compared(name, value, bound.must_be, limit, at_deg)
    if name not in of.needs:
        return None
    return Check(name, None, bound.must_be, limit, None, f"not known: it needs {of.needs[name]}")
