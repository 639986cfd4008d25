"""Mass, centroid and moment of inertia of plates and of their faces."""

from __future__ import annotations

import math
from functools import reduce
from typing import NamedTuple

from geneva_cli.geometry.moments import Moments, moments, total
from geneva_cli.geometry.plates import Plate, Stack
from geneva_cli.geometry.shapes import Point

MM = 1e-3  # metres


class MassProperties(NamedTuple):
    """A plate's mass, centroid, and moment of inertia about its own origin along the axis."""

    mass_kg: float
    centroid_mm: Point
    inertia_kgm2: float


def mass_properties(plate: Plate, density_kgm3: float) -> MassProperties:
    """Mass, centroid and inertia J = rho h Ip of a plate.

    >>> from geneva_cli.geometry.shapes import Circle
    >>> disc = Plate("disc", "CRANK", Circle("", (0, 0), 50.0), (), 0.0, 10.0)
    >>> steel = mass_properties(disc, 7850.0)
    >>> round(steel.inertia_kgm2 / steel.mass_kg / 0.05**2, 12)  # m r²/2
    0.5
    """
    whole, per = face(plate).times(plate.thickness), density_kgm3 * MM**3
    return MassProperties(per * whole.area, whole.centroid, per * MM**2 * whole.polar)


def solid_properties(solid: Plate | Stack, density_kgm3: float) -> MassProperties:
    """Mass, centroid and inertia of a flat or a turned part."""
    return reduce(added, (mass_properties(one, density_kgm3) for one in solid.plates))


def added(one: MassProperties, other: MassProperties) -> MassProperties:
    """Mass, centroid and inertia of two bodies with one origin."""
    mass = one.mass_kg + other.mass_kg
    x, y = (
        (one.mass_kg * a + other.mass_kg * b) / mass
        for a, b in zip(one.centroid_mm, other.centroid_mm, strict=True)
    )
    return MassProperties(mass, (x, y), one.inertia_kgm2 + other.inertia_kgm2)


def face(plate: Plate) -> Moments:
    """Area, first moments and polar moment of a plate's face about the origin.

    >>> from geneva_cli.geometry.shapes import Circle
    >>> washer = Plate(
    ...     "washer", "CRANK", Circle("", (0, 0), 5.0), (Circle("", (0, 0), 3.0),), 0.0, 2.0
    ... )
    >>> face(washer).area / 3.141592653589793
    16.0
    """
    out, *holes = (moments(shape) for shape in (plate.outline, *plate.holes))
    cut = (hole.times(-math.copysign(1.0, hole.area)) for hole in holes)
    return total((out.times(math.copysign(1.0, out.area)), *cut))
