"""Solids that are drawn out of outlines along the axis, or of a sphere; parts put together of them.

The wheel's plane is z = 0..thickness, or its sphere's centre the origin; lengths in millimetres,
angles in radians.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.curves.sphere_arcs import Arcs

if TYPE_CHECKING:
    from geneva_cli.curves.round_holes import RoundHole
    from geneva_cli.curves.shapes import Circle, Contour, Point
    from geneva_cli.curves.sphere import Region, Rotation, Vector


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


class Shell(NamedTuple):
    """What lies between two spheres about the origin, over regions that touch along whole arcs.

    Round holes are all within the last of the regions, and apart from each other.
    """

    name: str
    layer: str
    regions: tuple[Region, ...]
    inner: float
    outer: float
    holes: tuple[RoundHole, ...] = ()

    @property
    def volume(self) -> float:
        """Solid angle times a third of the difference of the cubes, less the holes, mm³."""
        seen = math.fsum(r.area for r in self.regions)
        bored = math.fsum(hole.volume(self.inner, self.outer) for hole in self.holes)
        return seen * (self.outer**3 - self.inner**3) / 3.0 - bored

    @property
    def centroid(self) -> Vector:
        """Where the mass of an even shell stands, mm."""
        seen = np.sum([r.moments[0] for r in self.regions], axis=0)
        first = seen * (self.outer**4 - self.inner**4) / 4.0
        for hole in self.holes:
            first = first - hole.first(self.inner, self.outer) * np.array(hole.axis)
        x, y, z = (first / self.volume).tolist()
        return x, y, z

    def reach(self, way: Vector) -> float:
        """How far it comes in a direction, mm from the centre."""
        if any(Arcs(r.boundary).signed(np.array([way]))[0][0] < 0.0 for r in self.regions):
            return self.outer
        most = max(arc.reach(way) for region in self.regions for arc in region.boundary)
        return most * (self.outer if most > 0.0 else self.inner)

    def inertia(self, axis: Vector) -> float:
        """The volume's moment of inertia about an axis through the centre, mm⁵.

        >>> from geneva_cli.curves.sphere import Region, SphereArc, place
        >>> half = place(math.pi / 2.0, 0.0)
        >>> dome = Region((SphereArc((0.0, 0.0, 1.0), math.pi / 2.0, half, half),), (0.0, 0.0, 1.0))
        >>> ball = Shell("", "WHEEL", (dome,), 0.0, 10.0)
        >>> round(ball.inertia((0.0, 0.0, 1.0)) / ball.volume, 12)  # 2/5 r²
        40.0
        """
        seen = math.fsum(r.area - float(r.moments[1] @ axis @ axis) for r in self.regions)
        bored = math.fsum(hole.inertia(self.inner, self.outer, axis) for hole in self.holes)
        return seen * (self.outer**5 - self.inner**5) / 5.0 - bored


class Group(NamedTuple):
    """Parts put together: each turned about its own origin, and then moved."""

    name: str
    members: tuple[Member, ...]


class Member(NamedTuple):
    """One of a group's parts and where it is."""

    part: Part
    at: Point = (0.0, 0.0)
    turn: float = 0.0  # counterclockwise
    frame: Rotation | None = None  # in place of a turn: where its x, y and z point


Part: TypeAlias = Plate | Shell | Group


def solids(part: Part) -> list[Plate | Shell]:
    """All solids of a part, each as often as it is used."""
    if isinstance(part, Group):
        return [one for member in part.members for one in solids(member.part)]
    return [part]


def plates(part: Part) -> list[Plate]:
    """Those of them that are flat."""
    return [one for one in solids(part) if isinstance(one, Plate)]
