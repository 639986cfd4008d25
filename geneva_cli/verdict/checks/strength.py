"""Do pin, horn, lock, shafts and roller hold, where the spec says what they may bear?"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol, TypeAlias

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, held

if TYPE_CHECKING:
    from geneva_cli.verdict.strength import Strength

# a value, and its input angle where it is of one place; None for what is not known
Found: TypeAlias = tuple[float | None, float | None]


def pin(name: str, mechanism: Mechanism) -> Check | None:
    """The pin's equivalent stress."""
    limit = mechanism.spec.material_roller.stress_max_MPa
    return _checked(name, mechanism, limit, lambda of: (of.pin_stress_MPa, None))


def horn(name: str, mechanism: Mechanism) -> Check | None:
    """The horn's bending stress under the roller."""
    limit = mechanism.spec.material_wheel.stress_max_MPa
    return _checked(name, mechanism, limit, lambda of: _placed(of.horn))


def lock_horn(name: str, mechanism: Mechanism) -> Check | None:
    """The horn's bending stress under the torque that the lock holds."""
    limit = mechanism.spec.material_wheel.stress_max_MPa
    return _checked(
        name, mechanism, limit, lambda of: (of.lock.horn_stress_MPa if of.lock else None, None)
    )


def lock(name: str, mechanism: Mechanism) -> Check | None:
    """The stress between disc and recess: on the recess's end, or as the arcs lie."""
    limit = mechanism.spec.limits.lock_stress_max_MPa
    return _checked(name, mechanism, limit, lambda of: (of.lock_stress_max_MPa, None))


def wheel_shaft(name: str, mechanism: Mechanism) -> Check | None:
    """The wheel shaft's shear stress, by the ASME code."""
    limit = mechanism.spec.shaft.shear_stress_max_MPa
    return _checked(name, mechanism, limit, lambda of: _placed(of.wheel_shaft))


def crank_shaft(name: str, mechanism: Mechanism) -> Check | None:
    """The crank shaft's, likewise."""
    limit = mechanism.spec.shaft.shear_stress_max_MPa
    return _checked(name, mechanism, limit, lambda of: _placed(of.crank_shaft))


def pv(name: str, mechanism: Mechanism) -> Check | None:
    """Contact stress times sliding speed."""
    limit = mechanism.spec.limits.pv_max_W_m2
    return _checked(name, mechanism, limit, lambda of: (of.pv_max_W_m2, None))


def roller_life(name: str, mechanism: Mechanism) -> Check | None:
    """The L10 of the roller, hours."""
    limit = mechanism.spec.limits.roller_life_min_h
    return _checked(
        name,
        mechanism,
        limit,
        lambda of: (of.roller.hours if of.roller else None, None),
        "at least",
    )


class _Placed(Protocol):
    """A stress at an input angle."""

    @property
    def stress_MPa(self) -> float | None: ...
    @property
    def at_deg(self) -> float | None: ...


def _placed(found: _Placed | None) -> Found:
    return (found.stress_MPa, found.at_deg) if found else (None, None)


def _checked(
    name: str,
    mechanism: Mechanism,
    limit: float | None,
    found: Callable[[Strength], Found],
    must_be: str = "at most",
) -> Check | None:
    """A value held to its limit; none without a limit, or of what the machine has not.

    It cannot be told where a key is missing.
    """
    if limit is None:
        return None
    # A spec that says nothing of what its parts may bear is checked without NumPy.
    from geneva_cli.verdict.strength import strength

    of = strength(mechanism)
    value, at_deg = found(of)
    if value is not None:
        return held(name, value, must_be, limit, at_deg)
    if name not in of.needs:
        return None
    return Check(name, None, must_be, limit, None, f"not known: it needs {of.needs[name]}")
