"""The quantities of a cycle by name, and those that a machine and its load have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np

from geneva_cli.loads.contact import QuantityValue, lesser
from geneva_cli.loads.load_case import load_case

if TYPE_CHECKING:
    from geneva_cli.loads.instant import Instant
    from geneva_cli.motion.mechanism import Mechanism
    from geneva_cli.numerics.arrays import Array
    from geneva_cli.numerics.jet import V

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
    **{name: name for name in (FORCE, TORQUE, STRESS)},
}
PARALLEL_SHAFTS = (
    "parallel shafts; on a sphere the force moves along them, and pushes along them too"
)


class Quantity(Protocol):
    """A quantity as a function of an instant, of jets or of values."""

    def __call__(self, i: Instant[V], /) -> QuantityValue[V]:
        """The quantity, and the margin that bounds it."""


def _stress(i: Instant[V]) -> QuantityValue[V]:
    """The square of the contact stress, MPa²."""
    friction, edge = i.friction_margin, i.edge
    assert i.stress_squared is not None and edge is not None  # there is a face width
    return QuantityValue(i.stress_squared, edge if friction is None else lesser(friction, edge))


def _pressure_speed(i: Instant[V]) -> QuantityValue[V]:
    """The square of p v, greatest Hertz pressure times sliding, W²/m⁴."""
    stress = _stress(i)
    return stress._replace(value=stress.value * (i.sliding_m_s * i.sliding_m_s * 1e12))


def _guide(i: Instant[V]) -> QuantityValue[V]:
    assert i.guide_squared is not None  # there is a guide
    return QuantityValue(i.guide_squared, i.grip)


QUANTITIES: dict[str, Quantity] = {
    "omega_rad_s": lambda i: QuantityValue(i.omega_rad_s),
    "alpha_rad_s2": lambda i: QuantityValue(i.alpha_rad_s2),
    "wheel_torque_Nm": lambda i: QuantityValue(i.wheel_torque_Nm),
    FORCE: lambda i: QuantityValue(i.force_N, i.grip),
    WALL_FORCE: lambda i: QuantityValue(i.pin_force_N, i.grip, i.drives),
    STRESS: _stress,
    "sliding_m_s": lambda i: QuantityValue(i.sliding_m_s),
    TORQUE: lambda i: QuantityValue(i.input_torque_Nm, i.friction_margin),
    "wheel_bearing_N": lambda i: QuantityValue(i.wheel_bearing_N, i.grip),
    "crank_bearing_N": lambda i: QuantityValue(i.crank_bearing_squared, i.grip),
    PV: _pressure_speed,
    "guide_force_N": _guide,
}


def known_quantities(mechanism: Mechanism) -> list[str]:
    """The names of the quantities that have a value for this machine and load."""
    missing = {WALL_FORCE}
    if load_case(mechanism).hertz is None:
        missing |= set(PRESSED)
    if not any(engagement.reactions for engagement in mechanism.engagements):
        missing.add("guide_force_N")
    unloaded = ("omega_rad_s", "alpha_rad_s2", "sliding_m_s")
    names = QUANTITIES if mechanism.spec.is_loaded else unloaded
    return [name for name in names if name not in missing]


def multiples(mechanism: Mechanism) -> dict[str, tuple[str, float | None, str]]:
    """Quantities that are multiples of others: the other's name, the factor, and the keys it needs.

    Of two bearings with the overhang a and the distance s, the nearer bears (a + s)/s, the other
    a/s.
    """
    shaft, turns = mechanism.spec.shaft, mechanism.output.turns
    flat = mechanism.spec.wheel.FLAT or not turns
    out: dict[str, tuple[str, float | None, str]] = {
        "power_W": (TORQUE, load_case(mechanism).speed_rad_s, "")
    }
    out |= {name: (of, ratio, "") for name, of, ratio in mechanism.output.loads}
    crank = ("crank", shaft.crank_overhang_mm, shaft.crank_span_mm)
    wheel = ("wheel", shaft.wheel_overhang_mm, shaft.wheel_span_mm)
    for name, a, s in (wheel, crank) if turns else (crank,):
        needs = f"{name}_overhang_mm and {name}_span_mm in [shaft]" if flat else PARALLEL_SHAFTS
        far = a / s if flat and a is not None and s is not None else None
        near = None if far is None else 1.0 + far
        out[f"{name}_near_bearing_N"] = (f"{name}_bearing_N", near, needs)
        out[f"{name}_far_bearing_N"] = (f"{name}_bearing_N", far, needs)
    return out


def sources(mechanism: Mechanism) -> dict[str, tuple[str, float]]:
    """Each known quantity by name: the one that is searched for it, and its ratio to that."""
    known = known_quantities(mechanism)
    out = {name: (name, 1.0) for name in known}
    for name, (source, factor, _) in multiples(mechanism).items():
        if factor is not None and source in known:
            out[name] = source, factor
    return {name: of for name, of in out.items() if name not in mechanism.output.lacks}


def plain_values(values: Array, name: str) -> Array:
    """Values of a quantity, from the values that are searched."""
    return np.sqrt(np.abs(values)) if name in SQUARED else values
