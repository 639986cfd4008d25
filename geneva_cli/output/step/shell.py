"""A shell of a sphere as a closed solid: parts of two spheres, and cones between them.

A region lies to the left of its arcs, seen from outside, so that its face on the outer sphere is
bounded by them as they run. Over each arc that is the edge of one region alone stands a wall, a
cone with its apex in the centre; arcs that two regions share are edges within a sphere.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.curves.plates import Shell
from geneva_cli.curves.sphere import SphereArc, Vector, cross, opposite, unit
from geneva_cli.errors import GenevaError
from geneva_cli.output.step.entities import Entities, closed_solid, edge, face, loop, real

ANGLE = 16  # decimals of a cone's angle, radians
FLAT = 1e-12  # cosine of a cone's angle below which it is a plane
UP = (0.0, 0.0, 1.0)
AHEAD = (1.0, 0.0, 0.0)


class ShellCorner(NamedTuple):
    """Where arcs meet: a vertex on either sphere, and the edge between them."""

    low: str
    high: str
    edge: str


class ShellEdges(NamedTuple):
    """An arc's edges on both spheres, and whether it runs as they do."""

    low: str
    high: str
    along: bool


def shell_solid(file: Entities, shell: Shell) -> str:
    """The number of the shell's MANIFOLD_SOLID_BREP.

    Raises GenevaError for a shell without thickness, or one that reaches the centre.
    """
    if not 0.0 < shell.inner < shell.outer:
        raise GenevaError(
            f"{shell.name}: a shell from {shell.inner:g} to {shell.outer:g} mm is no solid"
        )
    return closed_solid(file, _Shell(file, shell).faces())


class _Shell:
    """One shell, being written."""

    def __init__(self, file: Entities, shell: Shell) -> None:
        self.file, self.shell = file, shell
        self.corners: dict[Vector, ShellCorner] = {}
        self.sides: dict[tuple[Vector, Vector, Vector], ShellEdges] = {}

    def faces(self) -> list[str]:
        arcs = {_key(arc) for region in self.shell.regions for arc in region.boundary}
        found = []
        for region in self.shell.regions:
            sides = [self._side(arc) for arc in region.boundary]
            for high, radius in ((False, self.shell.inner), (True, self.shell.outer)):
                way = [((side.low, side.high)[high], side.along is high) for side in sides]
                bound = loop(self.file, way if high else way[::-1])
                found.append(face(self.file, [bound], self._sphere(region.middle, radius), high))
            found += [
                self._wall(arc, side)
                for arc, side in zip(region.boundary, sides, strict=True)
                if _key(_back(arc)) not in arcs
            ]
        return found

    def _side(self, arc: SphereArc) -> ShellEdges:
        """The edges over an arc, which may be there already, from the region beside it."""
        back = self.sides.get(_key(_back(arc)))
        if back is not None:
            return back._replace(along=False)
        ends = self._corner(arc.start), self._corner(arc.end)
        low, high = (
            edge(self.file, ends[0][upper], ends[1][upper], self._circle(arc, radius), True)
            for upper, radius in ((0, self.shell.inner), (1, self.shell.outer))
        )
        self.sides[_key(arc)] = made = ShellEdges(low, high, True)
        return made

    def _corner(self, at: Vector) -> ShellCorner:
        if at not in self.corners:
            low, high = (self._point(at, r) for r in (self.shell.inner, self.shell.outer))
            ends = [self.file.add(f"VERTEX_POINT('',{point})") for point in (low, high)]
            way = self.file.shared(f"VECTOR('',{self.file.direction(*at)},1.)")
            rise = edge(self.file, ends[0], ends[1], f"LINE('',{low},{way})", True)
            self.corners[at] = ShellCorner(ends[0], ends[1], rise)
        return self.corners[at]

    def _wall(self, arc: SphereArc, side: ShellEdges) -> str:
        """Bounded, from outside, by the inner edge, up at its end, the outer one back, and down."""
        start, end = self.corners[arc.start], self.corners[arc.end]
        bound = loop(
            self.file,
            [
                (side.low, side.along),
                (end.edge, True),
                (side.high, not side.along),
                (start.edge, False),
            ],
        )
        # a cone's own normal leads away from its axis, which lies on the material's side or not
        inward = math.cos(arc.angle)
        if abs(inward) < FLAT:
            frame = self._frame((0.0, 0.0, 0.0), opposite(arc.axis), arc.ahead)
            return face(self.file, [bound], self.file.add(f"PLANE('',{frame})"), True)
        axis = arc.axis if inward > 0.0 else opposite(arc.axis)
        height, radius = abs(inward) * self.shell.inner, math.sin(arc.angle) * self.shell.inner
        frame = self._frame(_times(axis, height), axis, arc.ahead)
        angle = math.atan2(radius, height)
        surface = self.file.add(f"CONICAL_SURFACE('',{frame},{real(radius)},{real(angle, ANGLE)})")
        return face(self.file, [bound], surface, inward > 0.0)

    def _circle(self, arc: SphereArc, radius: float) -> str:
        centre = _times(arc.axis, radius * math.cos(arc.angle))
        frame = self._frame(centre, arc.axis, arc.ahead)
        return f"CIRCLE('',{frame},{real(radius * math.sin(arc.angle))})"

    def _sphere(self, middle: Vector, radius: float) -> str:
        """A sphere whose poles and seam are away from a region about its middle."""
        sideways = cross(UP, middle)
        axis = unit(sideways) if math.hypot(*sideways) > FLAT else AHEAD
        frame = self._frame((0.0, 0.0, 0.0), axis, unit(opposite(middle)))
        return self.file.add(f"SPHERICAL_SURFACE('',{frame},{real(radius)})")

    def _frame(self, at: Vector, axis: Vector, ahead: Vector) -> str:
        file = self.file
        return file.placement(at[:2], at[2], file.direction(*axis), file.direction(*ahead))

    def _point(self, at: Vector, radius: float) -> str:
        x, y, z = _times(at, radius)
        return self.file.point((x, y), z)


def _times(v: Vector, length: float) -> Vector:
    return v[0] * length, v[1] * length, v[2] * length


def _back(arc: SphereArc) -> SphereArc:
    return SphereArc(opposite(arc.axis), math.pi - arc.angle, arc.end, arc.start)


def _key(arc: SphereArc) -> tuple[Vector, Vector, Vector]:
    """What tells an arc: its ends, and on which side its circle's middle lies."""
    x, y, z = (round(v, 9) + 0.0 for v in arc.axis)
    return arc.start, arc.end, (x, y, z)
