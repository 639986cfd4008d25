"""Shells of a sphere as closed surfaces of triangles.

Seen from the centre, a great circle is a straight line. So a region's face is cut as a plane
polygon, and then every side that is too long is halved along its great circle.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from geneva_cli.geometry.plates import Shell
from geneva_cli.geometry.round_holes import RoundHole
from geneva_cli.geometry.sphere import Region, SphereArc, Vector, cross, dot, square_to, unit
from geneva_cli.output.mesh.face_mesh import SphereFace
from geneva_cli.output.mesh.polygons import Surface, Triangle, arc_chords, surface, triangles
from geneva_cli.output.solid_part import require_thick

DIGITS = 12  # decimals of unit vectors, so that rounding of another processor is not seen


def shell_mesh(shell: Shell, tolerance: float) -> Surface:
    """Return a shell's surface: triangles on both spheres, and walls along radii between them.

    Raises GenevaError for a shell without thickness, and for regions without a wall.
    """
    require_thick(shell)
    return _ShellMesh(shell, tolerance).surface()


class _ShellMesh:
    """One shell while it is meshed.

    ``ends`` are the corners of all boundaries as unit vectors on the inner and on the outer
    sphere; they differ at a round hole alone.
    """

    def __init__(self, shell: Shell, tolerance: float) -> None:
        self.shell, self.tolerance = shell, tolerance
        # A point of a triangle with sides up to h is h²/6R below a sphere of radius R at most.
        self.longest = math.sqrt(6.0 * tolerance / shell.outer)
        self.ends: list[tuple[Vector, Vector]] = []
        self.numbers: dict[Vector, int] = {}
        self.arcs: dict[object, list[int]] = {}

    def surface(self) -> Surface:
        """Return the whole surface; its corners are those on both spheres, and then the others."""
        loops = [self._boundary(region) for region in self.shell.regions]
        holes = [self._hole(hole) for hole in self.shell.holes]
        up = len(self.ends)  # from an inner corner's number to the outer one's
        corners = [ends[0] for ends in self.ends] + [ends[1] for ends in self.ends]
        radii = [self.shell.inner] * up + [self.shell.outer] * up
        cut: list[Triangle] = []
        for first, radius, outside in ((0, self.shell.inner, False), (up, self.shell.outer, True)):
            for region, loop in zip(self.shell.regions, loops, strict=True):
                bored = holes if region is self.shell.regions[-1] else []
                around = [[number + first for number in one] for one in (loop, *bored)]
                face = self._face(region, around, corners)
                short = SphereFace(corners, face).triangles(self.longest)
                cut += short if outside else [(c, b, a) for a, b, c in short]
            radii += [radius] * (len(corners) - len(radii))
        for a, b in self._walls(loops, holes):
            cut += [(a, b, b + up), (a, b + up, a + up)]
        points = np.array(corners) * np.array(radii)[:, None]
        return surface(points.tolist(), cut)

    def _boundary(self, region: Region) -> list[int]:
        """Return the corners of a region's boundary, with the region on their left."""
        return [number for arc in region.boundary for number in self._along(arc)[:-1]]

    def _along(self, arc: SphereArc) -> list[int]:
        """Return the corners along an arc, which an adjacent region may have in the other sense."""
        if arc.key not in self.arcs:
            flat = self.shell.outer * math.sin(arc.angle)
            count = self._chords(flat, arc.sweep)
            turns = (arc.sweep / count) * np.arange(1.0, count)
            between = [unit(_vector(p)) for p in arc.at(turns)[0].tolist()]
            line = [self._number(p) for p in (arc.start, *between, arc.end)]
            self.arcs[arc.key], self.arcs[arc.back.key] = line, line[::-1]
        return self.arcs[arc.key]

    def _number(self, at: Vector) -> int:
        """Return the number of a corner, which may end several arcs."""
        key = _vector(round(x, DIGITS) + 0.0 for x in at)
        if key not in self.numbers:
            self.numbers[key] = len(self.ends)
            self.ends.append((key, key))
        return self.numbers[key]

    def _hole(self, hole: RoundHole) -> list[int]:
        """Return the corners of a round hole, clockwise about its axis."""
        count = self._chords(hole.radius, math.tau)
        x = square_to(hole.axis)
        y = cross(hole.axis, x)
        first = len(self.ends)
        for turn in np.arange(count) * (-math.tau / count):
            c, s = math.cos(turn), math.sin(turn)
            inner, outer = (
                _vector(
                    round((high * a + hole.radius * (c * p + s * q)) / radius, DIGITS) + 0.0
                    for a, p, q in zip(hole.axis, x, y, strict=True)
                )
                for radius in (self.shell.inner, self.shell.outer)
                for high in (math.sqrt((radius - hole.radius) * (radius + hole.radius)),)
            )
            self.ends.append((inner, outer))
        return list(range(first, len(self.ends)))

    def _chords(self, radius: float, sweep: float) -> int:
        """Return the number of chords of an arc in mm, within tolerance and ``longest``."""
        long = radius * sweep / (self.longest * self.shell.outer)
        return max(arc_chords(radius, sweep, self.tolerance), math.ceil(long))

    def _face(
        self, region: Region, loops: Sequence[Sequence[int]], corners: Sequence[Vector]
    ) -> list[Triangle]:
        """Return a region's triangles between its corners alone, counterclockwise from outside."""
        x = square_to(region.middle)
        y = cross(region.middle, x)

        def seen(at: Vector) -> tuple[float, float]:
            ahead = dot(at, region.middle)
            return round(dot(at, x) / ahead, DIGITS), round(dot(at, y) / ahead, DIGITS)

        flat = [[seen(corners[number]) for number in loop] for loop in loops]
        numbers = [number for loop in loops for number in loop]
        return [
            (numbers[a], numbers[b], numbers[c]) for a, b, c in triangles(flat, self.shell.name)
        ]

    def _walls(
        self, loops: Sequence[Sequence[int]], holes: Sequence[Sequence[int]]
    ) -> Iterator[tuple[int, int]]:
        """Yield the inner sides of the walls: those that one region alone has."""
        around = [
            (a, b)
            for loop in (*loops, *holes)
            for a, b in zip(loop, (*loop[1:], loop[0]), strict=True)
        ]
        sides = set(around)
        yield from (side for side in around if side[::-1] not in sides)


def _vector(values: Iterable[float]) -> Vector:
    x, y, z = values
    return x, y, z
