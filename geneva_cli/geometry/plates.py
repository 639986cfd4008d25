"""Solids extruded from outlines along the axis, or cut out of a sphere, and groups of them.

The wheel's plane is z = 0..thickness, or its sphere's centre is the origin. Lengths are in
millimetres, angles in radians.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry.measure import GAUSS, S, mapped, turned
from geneva_cli.geometry.shapes import Circle, Contour, Layer, Point

if TYPE_CHECKING:
    from geneva_cli.geometry.round_holes import RoundHole
    from geneva_cli.geometry.sphere import Region, Rotation, Vector


class Edge(NamedTuple):
    """The edge of a face: its size, mm, 0 for a sharp one, and whether it is rounded.

    An edge takes as much of the face as of the wall. A section at a height above the wall is the
    outline at a depth inside the material (``inset``): as deep as high for a chamfer of 45 degrees,
    and on a quarter of a circle for a rounding.
    """

    size: float = 0.0
    rounded: bool = False

    @property
    def key(self) -> str:
        """The key of ``[size]`` that sets it."""
        return "edge_fillet_mm" if self.rounded else "edge_chamfer_mm"

    def at(self, fraction: float) -> tuple[float, float]:
        """Return depth and height at a fraction of the way from the wall to the face.

        >>> [round(x, 12) for x in Edge(2.0, rounded=True).at(1.0 / 3.0)]  # 30 degrees
        [0.267949192431, 1.0]
        """
        if not self.rounded:
            return self.size * fraction, self.size * fraction
        angle = 0.5 * math.pi * fraction
        # 1 - cos, without losing digits
        return 2.0 * self.size * math.sin(0.5 * angle) ** 2, self.size * math.sin(angle)

    def slope(self, fraction: float) -> tuple[float, float]:
        """Return the derivatives of depth and height by the fraction."""
        if not self.rounded:
            return self.size, self.size
        angle = 0.5 * math.pi * fraction
        speed = 0.5 * math.pi * self.size
        return speed * math.sin(angle), speed * math.cos(angle)

    def layers(self) -> Iterator[tuple[float, float]]:
        """Yield depths and thicknesses of layers that stand for the edge, at Gauss's points."""
        for fraction, weight in GAUSS:
            yield self.at(fraction)[0], weight * self.slope(fraction)[1]


class Plate(NamedTuple):
    """A flat part: the inside of an outline without its holes, from ``low`` to ``high``.

    The edge is around both faces.
    """

    name: str
    layer: Layer
    outline: Contour | Circle
    holes: tuple[Contour | Circle, ...]
    low: float
    high: float
    edge: Edge = Edge()

    @property
    def thickness(self) -> float:
        """Thickness along the axis."""
        return self.high - self.low


class Shell(NamedTuple):
    """A solid between two spheres about the origin, over regions that touch along whole arcs.

    Round holes are all within the last of the regions, and separate from each other.
    """

    name: str
    layer: Layer
    regions: tuple[Region, ...]
    inner: float
    outer: float
    holes: tuple[RoundHole, ...] = ()

    @property
    def volume(self) -> float:
        """Solid angle times a third of the difference of the cubes, minus the holes, mm³."""
        covered = math.fsum(r.area for r in self.regions)
        bored = math.fsum(hole.volume(self.inner, self.outer) for hole in self.holes)
        return covered * (self.outer**3 - self.inner**3) / 3.0 - bored

    @property
    def centroid(self) -> Vector:
        """Centre of mass of a uniform shell, mm."""
        covered = np.sum([r.moments[0] for r in self.regions], axis=0)
        first = covered * (self.outer**4 - self.inner**4) / 4.0
        for hole in self.holes:
            first = first - hole.first(self.inner, self.outer) * np.array(hole.axis)
        x, y, z = (first / self.volume).tolist()
        return x, y, z

    def reach(self, direction: Vector) -> float:
        """Greatest coordinate of the shell along a direction, mm from the centre."""
        from geneva_cli.geometry.sphere_arcs import SphereArcs

        if any(SphereArcs(r.boundary).signed(np.array([direction]))[0] < 0.0 for r in self.regions):
            return self.outer
        most = max(arc.reach(direction) for region in self.regions for arc in region.boundary)
        return most * (self.outer if most > 0.0 else self.inner)

    def inertia(self, axis: Vector) -> float:
        """The volume's moment of inertia about an axis through the centre, mm⁵.

        >>> from geneva_cli.geometry.sphere import Region, SphereArc, place
        >>> half = place(math.pi / 2.0, 0.0)
        >>> dome = Region((SphereArc((0.0, 0.0, 1.0), math.pi / 2.0, half, half),), (0.0, 0.0, 1.0))
        >>> ball = Shell("", "WHEEL", (dome,), 0.0, 10.0)
        >>> round(ball.inertia((0.0, 0.0, 1.0)) / ball.volume, 12)  # 2/5 r²
        40.0
        """
        covered = math.fsum(r.area - float(r.moments[1] @ axis @ axis) for r in self.regions)
        bored = math.fsum(hole.inertia(self.inner, self.outer, axis) for hole in self.holes)
        return covered * (self.outer**5 - self.inner**5) / 5.0 - bored


class Group(NamedTuple):
    """An assembly of parts, each turned about its own origin and then moved."""

    name: str
    members: tuple[Member, ...]


class Member(NamedTuple):
    """One of a group's parts, and its position."""

    part: Part
    at: Point = (0.0, 0.0)
    turn: float = 0.0  # counterclockwise
    frame: Rotation | None = None  # in place of a turn: the directions of its x, y and z


Solid: TypeAlias = Plate | Shell
Part: TypeAlias = Solid | Group


def edged(member: Member, edge: Edge) -> Member:
    """A member with an edge around the faces of all its flat solids."""
    part = member.part
    if isinstance(part, Plate):
        part = part._replace(edge=edge)
    elif isinstance(part, Group):
        part = part._replace(members=tuple(edged(one, edge) for one in part.members))
    return member._replace(part=part)


def solids(part: Part) -> list[Solid]:
    """All solids of a part, each as often as it is used."""
    if isinstance(part, Group):
        return [one for member in part.members for one in solids(member.part)]
    return [part]


def plates(part: Part) -> list[Plate]:
    """The flat solids of a part."""
    return [one for one in solids(part) if isinstance(one, Plate)]


def inwards(plate: Plate, outside: float) -> Plate:
    """A plate whose heights count inwards from ``outside``, by distances instead."""
    return plate._replace(low=outside - plate.high, high=outside - plate.low)


def lowered(plate: Plate) -> Plate:
    """A plate with its lower face at z = 0."""
    return plate._replace(low=0.0, high=plate.high - plate.low)


def placed(shape: S, at: Point, turn: float) -> S:
    """Return a shape turned about its own origin, and then moved."""
    if at == (0.0, 0.0) and not turn:
        return shape
    return mapped(turned(shape, turn), lambda p: (p[0] + at[0], p[1] + at[1]))


def in_place(members: Iterable[Member]) -> Iterator[tuple[Plate, Plate]]:
    """Yield each plate in its own frame and at its position."""
    for one in members:
        if isinstance(one.part, Group):
            inner = in_place(one.part.members)
        else:
            assert isinstance(one.part, Plate)
            inner = iter([(one.part, one.part)])
        for own, plate in inner:
            outline, *holes = (
                placed(shape, one.at, one.turn) for shape in (plate.outline, *plate.holes)
            )
            yield own, plate._replace(outline=outline, holes=tuple(holes))
