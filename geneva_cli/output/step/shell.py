"""A shell of a sphere as a closed solid: parts of two spheres, cones between them, round holes.

A region lies to the left of its arcs, seen from outside, so they bound its face on the outer sphere
in their own direction. An arc of one region only is the edge of a wall, a cone with its apex in the
centre. Common arcs of two regions are edges within a sphere. A round hole is a cylinder about a
line through the centre, which meets both spheres in circles.
"""

from __future__ import annotations

import math

from geneva_cli.geometry.plates import Shell
from geneva_cli.geometry.sphere import SphereArc, Vector, combined, cross, opposite, square_to, unit
from geneva_cli.geometry.sphere_arcs import RoundHole
from geneva_cli.output.solid_part import require_thick
from geneva_cli.output.step.entities import Entities, WallFace, closed_solid, edge, face, loop, real

FLAT = 1e-12  # cosine of a cone's angle below which it is a plane


def shell_solid(file: Entities, shell: Shell) -> str:
    """The number of the shell's MANIFOLD_SOLID_BREP.

    Raises GenevaError for a shell without thickness, or one that reaches the centre.
    """
    require_thick(shell)
    return closed_solid(file, _ShellWriter(file, shell).faces())


class _ShellWriter:
    """One shell while it is written."""

    def __init__(self, file: Entities, shell: Shell) -> None:
        self.file, self.shell = file, shell
        self.corners: dict[Vector, tuple[str, str]] = {}  # a vertex on each sphere
        self.rises: dict[Vector, str] = {}
        # edges over an arc on both spheres, and whether they run along it
        self.sides: dict[tuple[Vector, Vector, Vector], tuple[str, str, bool]] = {}

    def faces(self) -> list[str]:
        arcs = {arc.key for region in self.shell.regions for arc in region.boundary}
        bored, faces = [self._hole(hole) for hole in self.shell.holes], []
        for region in self.shell.regions:
            sides = [self._side(arc) for arc in region.boundary]
            holes = bored if region is self.shell.regions[-1] else []
            for high, radius in ((False, self.shell.inner), (True, self.shell.outer)):
                edges = [(side[1] if high else side[0], side[2] is high) for side in sides]
                bounds = [loop(self.file, edges if high else edges[::-1])]
                bounds += [loop(self.file, [((h.low, h.high)[high], high)]) for h in holes]
                faces.append(face(self.file, bounds, self._sphere(region.middle, radius), high))
            faces += [
                self._wall(arc, side)
                for arc, side in zip(region.boundary, sides, strict=True)
                if arc.back.key not in arcs
            ]
        return [*faces, *(hole.face for hole in bored)]

    def _hole(self, hole: RoundHole) -> WallFace:
        """A hole's wall and its edges, clockwise about its axis with the material on the left."""
        file, q, axis = self.file, hole.radius, hole.axis
        back, ahead = opposite(axis), square_to(axis)
        heights = [math.sqrt((r - q) * (r + q)) for r in (self.shell.inner, self.shell.outer)]
        points = [self._point(combined(axis, h, ahead, q), 1.0) for h in heights]
        ends = [file.add(f"VERTEX_POINT('',{point})") for point in points]
        vector = file.shared(f"VECTOR('',{file.direction(*axis)},1.)")
        rise = edge(file, ends[0], ends[1], f"LINE('',{points[0]},{vector})", True)
        low, high = (
            edge(
                file,
                end,
                end,
                f"CIRCLE('',{self._frame(_times(axis, h), back, ahead)},{real(q)})",
                True,
            )
            for end, h in zip(ends, heights, strict=True)
        )
        bound = loop(file, [(low, True), (rise, True), (high, False), (rise, False)])
        frame = self._frame(_times(axis, heights[0]), axis, ahead)
        surface = file.add(f"CYLINDRICAL_SURFACE('',{frame},{real(q)})")
        return WallFace(face(file, [bound], surface, False), low, high, True)

    def _side(self, arc: SphereArc) -> tuple[str, str, bool]:
        back = self.sides.get(arc.back.key)
        if back is not None:
            return *back[:2], False
        ends = self._corner(arc.start), self._corner(arc.end)
        low, high = (
            edge(
                self.file, ends[0][upper], ends[1][upper], self._circle(arc, radius), not _wide(arc)
            )
            for upper, radius in ((0, self.shell.inner), (1, self.shell.outer))
        )
        self.sides[arc.key] = low, high, True
        return self.sides[arc.key]

    def _corner(self, at: Vector) -> tuple[str, str]:
        if at not in self.corners:
            low, high = (self._point(at, r) for r in (self.shell.inner, self.shell.outer))
            vertices = [self.file.add(f"VERTEX_POINT('',{point})") for point in (low, high)]
            self.corners[at] = vertices[0], vertices[1]
        return self.corners[at]

    def _rise(self, at: Vector) -> str:
        if at not in self.rises:
            corner, low = self.corners[at], self._point(at, self.shell.inner)
            vector = self.file.shared(f"VECTOR('',{self.file.direction(*at)},1.)")
            self.rises[at] = edge(self.file, *corner, f"LINE('',{low},{vector})", True)
        return self.rises[at]

    def _wall(self, arc: SphereArc, side: tuple[str, str, bool]) -> str:
        """The wall over an arc."""
        bound = loop(
            self.file,
            [
                (side[0], side[2]),
                (self._rise(arc.end), True),
                (side[1], not side[2]),
                (self._rise(arc.start), False),
            ],
        )
        # a cone's own normal points away from its axis, which may be on the material's side
        axis, angle = (opposite(arc.axis), math.pi - arc.angle) if _wide(arc) else arc[:2]
        if math.cos(angle) < FLAT:
            frame = self._frame((0.0, 0.0, 0.0), opposite(arc.axis), arc.ahead)
            return face(self.file, [bound], self.file.add(f"PLANE('',{frame})"), True)
        height, radius = math.cos(angle) * self.shell.inner, math.sin(angle) * self.shell.inner
        frame = self._frame(_times(axis, height), axis, arc.ahead)
        # the angle is in radians, with 16 decimals
        surface = f"CONICAL_SURFACE('',{frame},{real(radius)},{real(angle, 16)})"
        return face(self.file, [bound], self.file.add(surface), not _wide(arc))

    def _circle(self, arc: SphereArc, radius: float) -> str:
        axis, angle = (opposite(arc.axis), math.pi - arc.angle) if _wide(arc) else arc[:2]
        frame = self._frame(_times(axis, radius * math.cos(angle)), axis, arc.ahead)
        return f"CIRCLE('',{frame},{real(radius * math.sin(angle))})"

    def _sphere(self, middle: Vector, radius: float) -> str:
        """A sphere whose poles and seam are away from a region about ``middle``."""
        sideways = cross((0.0, 0.0, 1.0), middle)
        axis = unit(sideways) if math.hypot(*sideways) > FLAT else (1.0, 0.0, 0.0)
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


def _wide(arc: SphereArc) -> bool:
    """Return True if the circle's middle is nearer to the other end of its axis."""
    return math.cos(arc.angle) < 0.0
