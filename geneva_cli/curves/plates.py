"""Solids that are drawn out of outlines along the axis, or of a sphere; parts put together of them.

The wheel's plane is z = 0..thickness, or its sphere's centre the origin; lengths in millimetres,
angles in radians.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from geneva_cli.curves.shapes import Circle, Contour, Point
    from geneva_cli.curves.sphere import Region, Vector


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

        >>> from geneva_cli.curves.sphere import Region, SphereArc, place
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
