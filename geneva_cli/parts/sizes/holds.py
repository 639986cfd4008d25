"""Whether a part of some dimensions holds its load, for default sizes on a plane and a sphere."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.loads.impacts.shock_force import forces_N
from geneva_cli.loads.strength.arm_strength import arm_stress_MPa
from geneva_cli.loads.strength.key_strength import KeyDimensions, key_stress, shear_allowed_MPa
from geneva_cli.loads.strength.pin import PinSize, pin
from geneva_cli.loads.strength.shaft_stress import shear_MPa
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.preferred import rounded_from
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.spec.default_sizes import value_or
from geneva_cli.spec.materials import roller_material, wheel_material
from geneva_cli.spec.tables import Size

if TYPE_CHECKING:
    from geneva_cli.loads.strength.part_loads import PartLoads
    from geneva_cli.motion.mechanism import Mechanism
    from geneva_cli.parts.sizes.stressed import ShaftSize, Stressed


class PinSpace(NamedTuple):
    """The dimensions that limit a roller's pin, mm."""

    thickness: float  # of the wheel
    roller: float  # radius of the roller, of a cone where it is thinnest
    eye: float  # the largest radius of the arm about the pin


def pin_that_holds(mechanism: Mechanism, usual: float, space: PinSpace, loads: PartLoads) -> float:
    """Return the radius of the first pin from the usual one on that holds, or the largest.

    It holds the greatest force of the cycle, and the impact at a change of sides. The largest
    leaves a wall of the roller about its hole, and one of the arm. With friction on the pin it
    stays the usual one, on which the loads depend.
    """
    spec, size = mechanism.spec, mechanism.spec.size
    rubs = spec.load.friction and not spec.load.rubs_in_slot
    if size.pin_mm is not None or rubs or not usual:
        return usual
    contact = value_or(size.face_width_mm, space.thickness)
    # the roller keeps three tenths of its radius as a wall about the hole for its pin
    most = min(0.7 * space.roller - 0.5 * size.allowances.shaft_fit_mm, space.eye)
    allowed = roller_material(spec).allowed_MPa
    rubbed, jump = math.hypot(1.0, spec.load.friction), np.array([[loads.pin_jump]])
    for d in rounded_from(2.0 * usual, 2.0 * most):
        struck_N = forces_N(mechanism, jump, PinSize(d, contact)).item() if jump else 0.0
        whole_N = max(loads.pin_N, struck_N) * rubbed  # with friction along the wall
        stress = float(pin(spec.size, contact, d).under(whole_N).equivalent)
        if keeps(stress, "at most", allowed):
            break
    return 0.5 * d


def shaft_holds_both(
    spec: Spec, part: str, shaft: ShaftSize, force_N: float, torque_Nm: float
) -> bool:
    """Return True if the shaft of wheel or crank holds force and torque, greatest at once."""
    factors = spec.shaft
    bending = factors.bending_factor * force_N * shaft.overhang / 1000.0
    moment = math.hypot(bending, factors.torsion_factor * torque_Nm)
    return shaft_holds(spec, part, shaft.diameter, moment)


def shaft_holds(spec: Spec, part: str, diameter: float, moment_Nm: float) -> bool:
    """Return True if the shaft of wheel or crank holds an equivalent torque."""
    keyway = vars(spec.size)[f"{part}_keyway"] is not None
    allowed = float(shear_allowed_MPa(spec.shaft, keyway))
    return keeps(shear_MPa(moment_Nm, diameter), "at most", allowed)


def key_holds(spec: Spec, key: KeyDimensions, torque_Nm: float) -> bool:
    """Return True if a key holds a torque, or where there is none."""
    sides, shear = wheel_material(spec).allowed_MPa, shear_allowed_MPa(spec.shaft)
    turned = np.asarray(spec.shaft.torsion_factor * torque_Nm)
    stress = key_stress(key, turned, np.asarray(sides), np.asarray(shear))
    least = float(stress.least_length_mm)
    return math.isnan(least) or keeps(float(key.length), "at least", least)


def arm_trials(size: Size, wheel: float) -> Iterator[tuple[bool, float]]:
    """Yield in their order whether the crank's bore is sized by its key, and the arm's thickness.

    A thicker arm, up to twice the thickness of the wheel, is better for a key than a thicker shaft.
    """
    for keyed in (False, True) if size.crank_keyway else (True,):
        for thick in rounded_from(wheel, 2.0 * wheel):
            yield keyed, thick


def arm_holds(spec: Spec, parts: Stressed, loads: PartLoads) -> bool:
    """Return True if the arm and its key hold; a shaft that does not needs no thicker arm."""
    stress = float(arm_stress_MPa(parts.arm, np.asarray(loads.wheel_N)))
    key = key_holds(spec, parts.crank_key, loads.crank_Nm)
    return key and keeps(stress, "at most", wheel_material(spec).allowed_MPa)
