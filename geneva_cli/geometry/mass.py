"""Mass, centroid and moment of inertia of plates and of their faces."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.geometry.moments import Moments, moments, oriented, total
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import Point
from geneva_cli.geometry.stacks import require_faces

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
    rows = [face(plate).times(plate.thickness - 2.0 * plate.edge.size)]
    if plate.edge.size:
        rows.append(_between(plate).times(2.0))
    whole, per = total(rows), density_kgm3 * MM**3
    return MassProperties(per * whole.area, whole.centroid, per * MM**2 * whole.polar)


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


def _between(plate: Plate) -> Moments:
    """Return the moments of the layer in one edge, added up along the axis."""
    from geneva_cli.geometry.inset import inset, lines_and_arcs

    require_faces(plate)
    pieces = [lines_and_arcs(one) for one in oriented(plate.outline, plate.holes)]
    return total(
        moments(inset(one, "", depth)).times(thickness)
        for depth, thickness in plate.edge.layers()
        for one in pieces
    )
