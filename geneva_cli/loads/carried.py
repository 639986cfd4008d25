"""Inertia and resisting torque of everything that the wheel turns, at the wheel's shaft."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geneva_cli.spec.tables import Mass

if TYPE_CHECKING:
    from geneva_cli.motion.machine_spec import Spec

G = 9.80665  # standard gravity, m/s²
MM = 1e-3  # metres


def weight_kg(mass: Mass) -> float:
    """The mass of one body of a ``[[mass]]``, kg."""
    if mass.mass_kg is not None:
        return mass.mass_kg
    assert mass.density_kgm3 is not None and mass.thickness_mm is not None  # Mass has checked this
    D, d, a, c = _face_m(mass)
    face = a * c if a else 0.25 * math.pi * (D - d) * (D + d)
    return mass.density_kgm3 * face * mass.thickness_mm * MM


def _face_m(mass: Mass) -> list[float]:
    """Diameter and bore of a body's face, perpendicular to the wheel's axis, or its sides; m."""
    sizes = mass.diameter_mm, mass.bore_mm, mass.length_mm, mass.width_mm
    return [(size or 0.0) * MM for size in sizes]


def mass_inertia_kgm2(mass: Mass) -> float:
    """Inertia of all bodies of a ``[[mass]]`` about the table's axis, by Steiner's theorem."""
    (D, d, a, c), e, weight = _face_m(mass), mass.radius_mm * MM, weight_kg(mass)
    # about its own axis: m (D² + d²)/8, of a block m (a² + c²)/12
    own = weight * ((D * D + d * d) / 8.0 + (a * a + c * c) / 12.0)
    return mass.count * (own + weight * e * e)


def inertia_kgm2(spec: Spec) -> float:
    """Inertia of everything the wheel turns, at the wheel's shaft."""
    ratio, lever = spec.support.gear_ratio, spec.given_distance_mm * MM
    own = spec.load.inertia_kgm2 + spec.load.mass_kg * (lever * lever)
    return own + ratio * ratio * sum(map(mass_inertia_kgm2, spec.mass))


def carried_kg(spec: Spec) -> float:
    """The mass of all bodies on the table, kg."""
    total = 0.0
    for mass in spec.mass:
        total += mass.count * weight_kg(mass)
    return total


def farthest_mm(spec: Spec) -> float:
    """Radius about the wheel's axis that contains all bodies on the table; 0 without bodies."""
    reaches = [0.0]
    for one in spec.mass:
        sides = one.length_mm or 0.0, one.width_mm or 0.0
        reaches.append(one.radius_mm + 0.5 * max(one.diameter_mm or 0.0, math.hypot(*sides)))
    return max(reaches)


def resisting_torques_Nm(spec: Spec) -> tuple[float, float]:
    """Torques that resist at the wheel's shaft while it turns, N m: of the work and of the support.

    The support's friction is mu (m g + F) r, through the gears.
    """
    load, support = spec.load, spec.support
    pressed = carried_kg(spec) * G + support.force_N
    rubbed = support.gear_ratio * support.friction * pressed * support.radius_mm * MM
    return load.torque_Nm + load.force_N * (spec.given_distance_mm * MM), rubbed
