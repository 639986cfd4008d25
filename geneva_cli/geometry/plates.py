"""Solids extruded along the axis from z = 0, or cut out of a sphere, and groups of them; in mm."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.measure import S, mapped, turned
from geneva_cli.geometry.moments import Moments, moments, total, with_material_left
from geneva_cli.geometry.shapes import Circle, Contour, Layer, Point, Shape

if TYPE_CHECKING:
    from geneva_cli.geometry.sphere import Region, Rotation, Vector
    from geneva_cli.geometry.sphere_arcs import RoundHole


MM = 1e-3  # metres
SAMPLED = 1e-4, 0.5  # mm: sagitta and length of samples of a hole that is not a circle


class Plate(NamedTuple):
    """A flat part: the inside of an outline without its holes, from ``low`` to ``high``."""

    name: str
    layer: Layer
    outline: Contour | Circle
    holes: tuple[Contour | Circle, ...]
    low: float
    high: float

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
        """The volume's moment of inertia about an axis through the centre, mm⁵."""
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


class MassProperties(NamedTuple):
    """A plate's mass, centroid, and moment of inertia about its own origin along the axis."""

    mass_kg: float
    centroid_mm: Point
    inertia_kgm2: float


def mass_properties(plate: Plate, density_kgm3: float) -> MassProperties:
    """Mass, centroid and inertia J = rho h Ip of a plate."""
    thick, per = plate.high - plate.low, density_kgm3 * MM**3
    area, x, y, polar = face(plate)
    volume = thick * area
    return MassProperties(
        per * volume, (thick * x / volume, thick * y / volume), per * MM**2 * (thick * polar)
    )


def added(one: MassProperties, other: MassProperties) -> MassProperties:
    """Mass, centroid and inertia of two bodies with one origin."""
    mass, (x, y), (u, v) = one.mass_kg + other.mass_kg, one.centroid_mm, other.centroid_mm
    centroid = (
        (one.mass_kg * x + other.mass_kg * u) / mass,
        (one.mass_kg * y + other.mass_kg * v) / mass,
    )
    return MassProperties(mass, centroid, one.inertia_kgm2 + other.inertia_kgm2)


def face(plate: Plate) -> Moments:
    """Area, first moments and polar moment of a plate's face about the origin."""
    rows, sign = [], 1.0
    for shape in (plate.outline, *plate.holes):
        area, x, y, polar = moments(shape)
        factor = sign * math.copysign(1.0, area)
        rows.append((factor * area, factor * x, factor * y, factor * polar))
        sign = -1.0  # the outline is the first
    return total(rows)


def least_wall(holes: Sequence[Shape], outline: Sequence[Shape] = ()) -> float:
    """Return the least wall between holes, and to an outline; negative where they overlap."""
    least = math.inf
    whole = Polyarc([with_material_left(one, True) for one in outline]) if outline else None
    for i, hole in enumerate(holes):
        for other in holes[:i]:
            least = min(least, apart(other, hole))
        if whole:
            least = min(least, -beyond(whole, hole))
    return least


def plate_wall(plate: Plate) -> float:
    """Return the least wall between the holes of a plate, and around them."""
    return least_wall(plate.holes, [plate.outline])


def beyond(outline: Polyarc, hole: Shape) -> float:
    """Return how far a hole's edge reaches past an outline, mm; negative inside."""
    if isinstance(hole, Circle):
        return float(outline.signed(np.array([hole.centre]))[0]) + hole.radius
    return float(outline.signed(Polyarc([hole]).samples(*SAMPLED)).max())


def apart(one: Shape, two: Shape) -> float:
    """Return the wall between two holes, mm; negative where they overlap."""
    if isinstance(one, Circle):
        if isinstance(two, Circle):
            return math.dist(one.centre, two.centre) - one.radius - two.radius
        one, two = two, one
    away = Polyarc([with_material_left(one, True)])
    if isinstance(two, Circle):
        return float(away.signed(np.array([two.centre]))[0]) - two.radius
    return float(away.signed(Polyarc([two]).samples(*SAMPLED)).min())
