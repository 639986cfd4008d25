"""Solids that are drawn out of outlines along the axis, or of a sphere; parts put together of them.

The wheel's plane is z = 0..thickness, or its sphere's centre the origin; lengths in millimetres,
angles in radians.
"""

from __future__ import annotations

import math
from typing import NamedTuple, TypeAlias

from geneva_cli.curves.measure import area
from geneva_cli.curves.moments import Moments, moments, total
from geneva_cli.curves.shapes import Circle, Contour, Point, backwards
from geneva_cli.curves.sphere import Region, Vector

MM = 1e-3  # metres


class Plate(NamedTuple):
    """What is inside an outline and in no hole, from ``low`` to ``high`` along the axis."""

    name: str
    layer: str
    outline: Contour | Circle
    holes: tuple[Contour | Circle, ...]
    low: float
    high: float

    @property
    def thickness(self) -> float:
        """Along the axis."""
        return self.high - self.low

    @property
    def moments(self) -> Moments:
        """Of its face: area, first moments and polar moment about the origin.

        >>> from geneva_cli.curves.shapes import Circle
        >>> washer = Plate(
        ...     "washer", "CRANK", Circle("", (0, 0), 5.0), (Circle("", (0, 0), 3.0),), 0.0, 2.0
        ... )
        >>> washer.moments.area / 3.141592653589793
        16.0
        """
        return _counterclockwise(self.outline).less(total(map(_counterclockwise, self.holes)))


class Shell(NamedTuple):
    """What lies between two spheres about the origin, over regions that touch along whole arcs."""

    name: str
    layer: str
    regions: tuple[Region, ...]
    inner: float
    outer: float

    @property
    def volume(self) -> float:
        """Solid angle times a third of the difference of the cubes, mm³."""
        return math.fsum(r.area for r in self.regions) * (self.outer**3 - self.inner**3) / 3.0

    def inertia(self, axis: Vector) -> float:
        """The volume's moment of inertia about an axis through the centre, mm⁵.

        >>> from geneva_cli.curves.sphere import SphereArc, place
        >>> half = place(math.pi / 2.0, 0.0)
        >>> dome = Region((SphereArc((0.0, 0.0, 1.0), math.pi / 2.0, half, half),), (0.0, 0.0, 1.0))
        >>> ball = Shell("", "WHEEL", (dome,), 0.0, 10.0)
        >>> round(ball.inertia((0.0, 0.0, 1.0)) / ball.volume, 12)  # 2/5 r²
        40.0
        """
        seen = math.fsum(r.area - float(r.moments[1] @ axis @ axis) for r in self.regions)
        return seen * (self.outer**5 - self.inner**5) / 5.0


class Group(NamedTuple):
    """Parts put together: each turned about its own origin, and then moved."""

    name: str
    members: tuple[Member, ...]


class Member(NamedTuple):
    """One of a group's parts and where it is."""

    part: Part
    at: Point = (0.0, 0.0)
    turn: float = 0.0  # counterclockwise


Part: TypeAlias = Plate | Shell | Group


def solids(part: Part) -> list[Plate | Shell]:
    """All solids of a part, each as often as it is used."""
    if isinstance(part, Group):
        return [one for member in part.members for one in solids(member.part)]
    return [part]


def plates(part: Part) -> list[Plate]:
    """Those of them that are flat."""
    return [one for one in solids(part) if isinstance(one, Plate)]


class MassProperties(NamedTuple):
    """A plate's mass, centroid, and moment of inertia about its own origin along the axis."""

    mass_kg: float
    centroid_mm: Point
    inertia_kgm2: float


def mass_properties(plate: Plate, density_kgm3: float) -> MassProperties:
    """Mass, centroid and inertia J = rho h Ip of a plate.

    >>> from geneva_cli.curves.shapes import Circle
    >>> disc = Plate("disc", "CRANK", Circle("", (0, 0), 50.0), (), 0.0, 10.0)
    >>> steel = mass_properties(disc, 7850.0)
    >>> round(steel.inertia_kgm2 / steel.mass_kg / 0.05**2, 12)  # m r²/2
    0.5
    """
    return face_properties(plate.moments, plate.thickness, density_kgm3)


def face_properties(face: Moments, thickness_mm: float, density_kgm3: float) -> MassProperties:
    """The same from the moments of a plate's face."""
    per = density_kgm3 * thickness_mm * MM
    return MassProperties(per * face.area * MM**2, face.centroid, per * face.polar * MM**4)


def added(one: MassProperties, other: MassProperties) -> MassProperties:
    """Of two bodies with one origin."""
    mass = one.mass_kg + other.mass_kg
    x, y = (
        (one.mass_kg * a + other.mass_kg * b) / mass
        for a, b in zip(one.centroid_mm, other.centroid_mm, strict=True)
    )
    return MassProperties(mass, (x, y), one.inertia_kgm2 + other.inertia_kgm2)


def with_material_left(shape: Contour, outside: bool) -> Contour:
    """A contour that runs counterclockwise as an outline, and clockwise as a hole."""
    return shape if (area(shape) > 0.0) is outside else backwards(shape)


def _counterclockwise(shape: Contour | Circle) -> Moments:
    return moments(shape if isinstance(shape, Circle) else with_material_left(shape, True))
