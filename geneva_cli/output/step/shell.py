"""A shell of a sphere as a closed solid: parts of two spheres, cones between them, round holes.

A region lies to the left of its arcs, seen from outside, so they bound its face on the outer sphere
in their own direction. An arc of one region only is the edge of a wall, a cone with its apex in the
centre. Common arcs of two regions are edges within a sphere. A round hole is a cylinder about a
line through the centre, which meets both spheres in circles.
"""

from __future__ import annotations

import math

from geneva_cli.geometry.sphere import SphereArc, Vector, combined, cross, opposite, square_to, unit
from geneva_cli.geometry.sphere_arcs import RoundHole
from geneva_cli.geometry.sphere_shell import Shell
from geneva_cli.output.solid_part import require_thick
from geneva_cli.output.step.entities import Entities, real

FLAT = 1e-12  # cosine of a cone's angle below which it is a plane


class ShellWriter:
    """One shell while it is written."""

    def __init__(self, file: Entities, shell: Shell) -> None:
        self.file, self.shell = file, shell
        self.corners: dict[Vector, list[str]] = {}  # a vertex on each sphere
        self.rises: dict[Vector, str] = {}
        # edges over an arc on both spheres, and whether they run along it
        self.sides: dict[tuple[Vector, Vector, Vector], tuple[str, str, bool]] = {}

    def solid(self) -> str:
        """Write the shell, and return its MANIFOLD_SOLID_BREP."""
        require_thick(self.shell)
        file, shell = self.file, self.shell
        arcs = {arc.key for region in shell.regions for arc in region.boundary}
        bored, faces = [self._hole(hole) for hole in shell.holes], list[str]()
        for region in shell.regions:
            sides = [self._side(arc) for arc in region.boundary]
            holes = bored if region is shell.regions[-1] else []
            # a sphere whose poles and seam are away from the region
            sideways = cross((0.0, 0.0, 1.0), region.middle)
            axis = unit(sideways) if math.hypot(*sideways) > FLAT else (1.0, 0.0, 0.0)
            for high, radius in ((False, shell.inner), (True, shell.outer)):
                edges = [(side[1] if high else side[0], side[2] is high) for side in sides]
                bounds = [file.loop(edges if high else edges[::-1])]
                bounds += [file.loop([(hole[high], high)]) for hole in holes]
                frame = self._frame((0.0, 0.0, 0.0), axis, unit(opposite(region.middle)))
                sphere = file.add(f"SPHERICAL_SURFACE('',{frame},{real(radius)})")
                faces.append(file.face(bounds, sphere, high))
            faces += [
                self._wall(arc, side)
                for arc, side in zip(region.boundary, sides, strict=True)
                if arc.back.key not in arcs
            ]
        return file.closed_solid([*faces, *(face for _, _, face in bored)])

    def _hole(self, hole: RoundHole) -> tuple[str, str, str]:
        """Write a hole's edges, clockwise about its axis, and its wall."""
        file, q, axis = self.file, hole.radius, hole.axis
        back, ahead = opposite(axis), square_to(axis)
        heights = [math.sqrt((r - q) * (r + q)) for r in (self.shell.inner, self.shell.outer)]
        points = [self._point(combined(axis, h, ahead, q), 1.0) for h in heights]
        ends = [file.vertex(point) for point in points]
        vector = file.shared(f"VECTOR('',{file.direction(*axis)},1.)")
        rise = file.edge(ends[0], ends[1], f"LINE('',{points[0]},{vector})")
        low, high = (
            file.edge(end, end, f"CIRCLE('',{self._frame(_times(axis, h), back, ahead)},{real(q)})")
            for end, h in zip(ends, heights, strict=True)
        )
        bound = file.loop([(low, True), (rise, True), (high, False), (rise, False)])
        frame = self._frame(_times(axis, heights[0]), axis, ahead)
        surface = file.add(f"CYLINDRICAL_SURFACE('',{frame},{real(q)})")
        return low, high, file.face([bound], surface, False)

    def _side(self, arc: SphereArc) -> tuple[str, str, bool]:
        back = self.sides.get(arc.back.key)
        if back is not None:
            return *back[:2], False
        radii = self.shell.inner, self.shell.outer
        for at in (arc.start, arc.end):
            if at not in self.corners:
                points = [self._point(at, radius) for radius in radii]
                self.corners[at] = [self.file.vertex(point) for point in points]
        ends = self.corners[arc.start], self.corners[arc.end]
        axis, angle = _cone(arc)
        edges = []
        for k, radius in enumerate(radii):
            frame = self._frame(_times(axis, radius * math.cos(angle)), axis, arc.ahead)
            circle = f"CIRCLE('',{frame},{real(radius * math.sin(angle))})"
            edges.append(self.file.edge(ends[0][k], ends[1][k], circle, not _wide(arc)))
        self.sides[arc.key] = edges[0], edges[1], True
        return self.sides[arc.key]

    def _rise(self, at: Vector) -> str:
        if at not in self.rises:
            low, high = self.corners[at]
            point = self._point(at, self.shell.inner)
            vector = self.file.shared(f"VECTOR('',{self.file.direction(*at)},1.)")
            self.rises[at] = self.file.edge(low, high, f"LINE('',{point},{vector})")
        return self.rises[at]

    def _wall(self, arc: SphereArc, side: tuple[str, str, bool]) -> str:
        """Write the wall over an arc."""
        low, high, along = side
        ends = self._rise(arc.end), self._rise(arc.start)
        bound = self.file.loop([(low, along), (ends[0], True), (high, not along), (ends[1], False)])
        # a cone's own normal points away from its axis, which may be on the material's side
        axis, angle = _cone(arc)
        if math.cos(angle) < FLAT:
            frame = self._frame((0.0, 0.0, 0.0), opposite(arc.axis), arc.ahead)
            return self.file.face([bound], self.file.add(f"PLANE('',{frame})"), True)
        height, radius = math.cos(angle) * self.shell.inner, math.sin(angle) * self.shell.inner
        frame = self._frame(_times(axis, height), axis, arc.ahead)
        # the angle is in radians, with 16 decimals
        cone = f"CONICAL_SURFACE('',{frame},{real(radius)},{real(angle, 16)})"
        return self.file.face([bound], self.file.add(cone), not _wide(arc))

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


def _cone(arc: SphereArc) -> tuple[Vector, float]:
    """Return axis and angle of the cone through an arc, at most a right one."""
    return (opposite(arc.axis), math.pi - arc.angle) if _wide(arc) else arc[:2]
