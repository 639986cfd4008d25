"""Do pin, horn, lock, shafts and roller hold, where the spec says what they may bear?"""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, held
from geneva_cli.verdict.strength import Strength, strength


def pin(name: str, mechanism: Mechanism) -> Check | None:
    """The pin's equivalent stress."""
    limit, of = mechanism.spec.material_roller.stress_max_MPa, strength(mechanism)
    return None if limit is None else _most(of, name, of.pin_stress_MPa, limit)


def horn(name: str, mechanism: Mechanism) -> Check | None:
    """The horn's bending stress under the roller."""
    limit, of = mechanism.spec.material_wheel.stress_max_MPa, strength(mechanism)
    if limit is None:
        return None
    found = of.horn
    return _most(of, name, found and found.stress_MPa, limit, found and found.at_deg)


def lock_horn(name: str, mechanism: Mechanism) -> Check | None:
    """The horn's bending stress under the torque that the lock holds."""
    limit, of = mechanism.spec.material_wheel.stress_max_MPa, strength(mechanism)
    if limit is None or of.lock is None:
        return None
    return held(name, of.lock.horn_stress_MPa, "at most", limit)


def lock(name: str, mechanism: Mechanism) -> Check | None:
    """The stress between disc and recess: on the recess's end, or as the arcs lie."""
    limit, of = mechanism.spec.limits.lock_stress_max_MPa, strength(mechanism)
    return None if limit is None else _most(of, name, of.lock_stress_max_MPa, limit)


def wheel_shaft(name: str, mechanism: Mechanism) -> Check | None:
    """The wheel shaft's shear stress, by the ASME code."""
    limit, of = mechanism.spec.shaft.shear_stress_max_MPa, strength(mechanism)
    if limit is None:
        return None
    found = of.wheel_shaft
    return _most(of, name, found and found.stress_MPa, limit, found and found.at_deg)


def crank_shaft(name: str, mechanism: Mechanism) -> Check | None:
    """The crank shaft's, likewise."""
    limit, of = mechanism.spec.shaft.shear_stress_max_MPa, strength(mechanism)
    if limit is None:
        return None
    found = of.crank_shaft
    return _most(of, name, found and found.stress_MPa, limit, found and found.at_deg)


def pv(name: str, mechanism: Mechanism) -> Check | None:
    """Contact stress times sliding speed."""
    limit, of = mechanism.spec.limits.pv_max_W_m2, strength(mechanism)
    return None if limit is None else _most(of, name, of.pv_max_W_m2, limit)


def roller_life(name: str, mechanism: Mechanism) -> Check | None:
    """The L10 of the roller, hours."""
    limit, of = mechanism.spec.limits.roller_life_min_h, strength(mechanism)
    if limit is None:
        return None
    hours = of.roller and of.roller.hours
    if hours is None:
        return _unknown(of, name, "at least", limit)
    return held(name, hours, "at least", limit)


def _most(
    of: Strength, name: str, value: float | None, limit: float, at_deg: float | None = None
) -> Check | None:
    """A value held to its limit."""
    if value is None:
        return _unknown(of, name, "at most", limit)
    return held(name, value, "at most", limit, at_deg)


def _unknown(of: Strength, name: str, must_be: str, limit: float) -> Check | None:
    """A check that cannot be told where a key is missing; none of what a machine has not."""
    if name not in of.needs:
        return None
    return Check(name, None, must_be, limit, None, f"not known: it needs {of.needs[name]}")
