"""Plates, shells of a sphere, and groups of them; the mass and the walls of plates; in mm."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import chain, combinations, repeat, starmap
from operator import lt, mul
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry import shapes
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Cubic, Layer, Point, Shape

if TYPE_CHECKING:
    from geneva_cli.geometry.sphere import Region, Rotation, Vector
    from geneva_cli.geometry.sphere_arcs import RoundHole

MM = 1e-3  # metres
SAMPLED = 1e-4, 0.5  # mm: sagitta and length of samples of a hole that is not a circle
GAUSS = np.transpose(np.polynomial.legendre.leggauss(8)).tolist()  # nodes on -1..1 with weights
OVER_A_RADIAN = partial(lt, math.tan(0.25))  # is the bulge of an arc above that of a radian?


class Plate(NamedTuple):
    """A flat part: the inside of an outline without its holes, from ``low`` to ``high``."""

    name: str
    layer: Layer
    outline: Contour | Circle
    holes: tuple[Contour | Circle, ...]
    low: float
    high: float
    bore: Any = None  # of the parts on a shaft

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

    def reach(self, direction: Vector) -> float:
        """Greatest coordinate of the shell along a direction, mm from the centre."""
        from geneva_cli.geometry.sphere_arcs import SphereArcs

        off = (SphereArcs(r.boundary).signed(np.array([direction])).item() for r in self.regions)
        most = math.cos(max(0.0, min(off)))  # of the nearest point
        return most * (self.outer if most > 0.0 else self.inner)

    @property
    def inertia(self) -> float:
        """The volume's moment of inertia about z, mm⁵."""
        covered = math.fsum(region.polar_moment for region in self.regions)
        bored = math.fsum(hole.inertia(self.inner, self.outer) for hole in self.holes)
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

    @property
    def plate(self) -> Plate:
        """The part of a member that is a plate."""
        assert isinstance(self.part, Plate)
        return self.part


Solid: TypeAlias = "Plate | Shell"
Part: TypeAlias = "Plate | Shell | Group"


def solids(part: Part) -> list[Solid]:
    """All solids of a part, each as often as it is used."""
    if isinstance(part, Group):
        return [one for member in part.members for one in solids(member.part)]
    return [part]


def plates(part: Part) -> list[Plate]:
    """The flat solids of a part."""
    return [one for one in solids(part) if isinstance(one, Plate)]


def in_place(members: Iterable[Member]) -> Iterator[tuple[Plate, Plate]]:
    """Yield each plate in its own frame and at its position."""
    for one in members:
        if isinstance(one.part, Group):
            inner = [*in_place(one.part.members)]
        else:
            inner = [(one.plate, one.plate)]
        for own, plate in inner:
            outline, *holes = (
                shapes.placed(shape, one.at, one.turn) for shape in (plate.outline, *plate.holes)
            )
            yield own, plate._replace(outline=outline, holes=tuple(holes))


class Moments(NamedTuple):
    """Integrals of 1, x, y and x² + y² over the inside, about the origin; below 0 if clockwise."""

    area: float
    x: float
    y: float
    polar: float

    @property
    def centroid(self) -> Point:
        """Centre of mass of a uniform plate."""
        return self.x / self.area, self.y / self.area


def moments(shape: Shape) -> Moments:
    """Moments of a closed contour, or of a circle, by Green's theorem.

    They are those of the areas that the ray from the origin to a point of the outline sweeps.
    Gauss's eight points are exact for cubics, and to rounding for arcs of a radian or less.
    """
    if isinstance(shape, Circle):
        (x, y), square = shape.centre, shape.radius * shape.radius
        area = math.pi * square
        return Moments(area, area * x, area * y, area * (x * x + y * y + 0.5 * square))
    rows: list[tuple[float, float, float, float]] = []
    for piece in chain.from_iterable(map(shapes.halved, shape.segments, repeat(OVER_A_RADIAN))):
        half = 0.5 * piece.sweep if isinstance(piece, Arc) else 0.0
        chord = complex(*piece.end) - complex(*piece.start)
        chord *= half / math.sin(half) if half else 1.0  # as long as the arc
        for away, weight in GAUSS:  # from the middle
            t = 0.5 + 0.5 * away
            x, y = shapes.at(piece, t)
            if isinstance(piece, Cubic):
                a, b, c, d = (complex(*pole) for pole in piece)
                u = 1.0 - t
                rate = 3.0 * (u * u * (b - a) + 2.0 * u * t * (c - b) + t * t * (d - c))
            else:
                rate = chord * cmath.rect(1.0, away * half)
            swept = 0.5 * weight * (x * rate.imag - y * rate.real)
            polar = 0.25 * (x * x + y * y)
            rows.append((swept * 0.5, swept * (x / 3.0), swept * (y / 3.0), swept * polar))
    return total(rows)


def total(rows: Iterable[Iterable[float]]) -> Moments:
    """Sum of the moments of several shapes."""
    return Moments(*map(math.fsum, zip((0.0, 0.0, 0.0, 0.0), *rows, strict=True)))


class MassProperties(NamedTuple):
    """A body's mass, centroid, and moment of inertia about its origin along the axis."""

    mass_kg: float
    centroid_mm: Point
    inertia_kgm2: float


def mass_properties(bodies: Iterable[Solid], density_kgm3: float) -> MassProperties:
    """Mass, centroid and inertia J = rho h Ip of solids with one origin, as one body.

    A shell's centroid is on its axis, z.
    """
    rows = list[Iterable[float]]()
    for one in bodies:
        if isinstance(one, Shell):
            rows.append((one.volume, 0.0, 0.0, one.inertia))
        else:
            rows.append(map(mul, face(one), repeat(one.thickness)))
    volume, x, y, polar = total(rows)
    centroid, per = (x / volume, y / volume), density_kgm3 * MM**3
    return MassProperties(per * volume, centroid, per * MM**2 * polar)


def face(plate: Plate) -> Moments:
    """Area, first moments and polar moment of a plate's face about the origin."""
    rows, sign = [], 1.0
    for row in map(moments, (plate.outline, *plate.holes)):
        rows.append(map(mul, row, repeat(math.copysign(sign, sign * row.area))))
        sign = -1.0  # of the holes
    return total(rows)


def least_wall(holes: Sequence[Shape], outline: Sequence[Contour] = ()) -> float:
    """Return the least wall between holes, and to an outline; negative where they overlap.

    The outline has its material on the left.
    """
    walls = [*starmap(apart, combinations(holes, 2))]
    if outline:
        walls += map(_wall, repeat(Polyarc(outline)), holes, repeat(-1.0))
    return min(walls, default=math.inf)


def plate_wall(plate: Plate) -> float:
    """Return the least wall between the holes of a plate, and around them."""
    return least_wall(plate.holes, [shapes.as_contour(plate.outline)])


def apart(one: Shape, two: Shape) -> float:
    """Return the wall between two holes, mm; negative where they overlap."""
    if isinstance(one, Circle) and isinstance(two, Circle):
        return math.dist(one.centre, two.centre) - one.radius - two.radius
    if isinstance(one, Circle):
        one, two = two, one
    return _wall(Polyarc([with_material_left(one, True)]), two, 1.0)


def _wall(boundary: Polyarc, hole: Shape, side: float) -> float:
    """Return the least distance of a hole from a boundary, outside of it (1) or inside (-1)."""
    if isinstance(hole, Circle):
        return side * float(boundary.signed(np.array([hole.centre]))[0]) - hole.radius
    return float((side * boundary.signed(Polyarc([hole]).samples(*SAMPLED))).min())


def with_material_left(shape: Shape, outside: bool) -> Contour:
    """Contour that runs counterclockwise as an outline, and clockwise as a hole."""
    contour = shapes.as_contour(shape)
    return contour if (moments(contour).area > 0.0) is outside else shapes.backwards(contour)


def oriented(outline: Shape, holes: Iterable[Shape]) -> list[Contour]:
    """A face's outline and holes as contours with the material on their left."""
    return [with_material_left(outline, True), *(with_material_left(h, False) for h in holes)]
