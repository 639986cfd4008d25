"""A turned part as a mesh: walls over the chords of its outlines, and faces between its steps."""

from __future__ import annotations

from geneva_cli.curves.plates import Stack
from geneva_cli.curves.shapes import Point
from geneva_cli.curves.stacks import Run, Side, levels, outline_of, sides
from geneva_cli.output.mesh.polygons import Triangle, chord_points, triangles
from geneva_cli.output.mesh.surface import Surface, surface
from geneva_cli.output.solid_part import plate_contours


def stack_mesh(stack: Stack, tolerance: float) -> Surface:
    """Return a turned part's surface; its chords keep the tolerance, mm.

    Raises GenevaError for a step without thickness, and for outlines that cross.
    """
    mesh = _StackMesh(tolerance)
    for plate in stack.plates:
        plate_contours(plate)  # refuses what is no solid
        for side in sides(outline_of(plate)):
            mesh.wall(side, plate.low, plate.high)
    for level in levels(stack):
        loops = [mesh.around(runs) for runs in level.loops]
        outer_first = loops if level.up else [loop[::-1] for loop in loops]
        mesh.across(outer_first, level.z, level.up, stack.name)
    return surface(list(mesh.corners), mesh.triangles)


class _StackMesh:
    """The corners, each once, and the triangles of a turned part."""

    def __init__(self, tolerance: float) -> None:
        self.tolerance = tolerance
        self.corners: dict[tuple[float, float, float], int] = {}
        self.triangles: list[Triangle] = []
        self._chords: dict[Side, list[Point]] = {}

    def wall(self, side: Side, low: float, high: float) -> None:
        points = self._points(side)
        for p, q in zip(points, points[1:], strict=False):
            a, b = self._corner(p, low), self._corner(q, low)
            c, d = self._corner(q, high), self._corner(p, high)
            self.triangles += [(a, b, c), (a, c, d)]

    def around(self, runs: tuple[Run, ...]) -> list[Point]:
        """Return the corners of a loop of edges."""
        points: list[Point] = []
        for run in runs:
            own = self._points(run.side)
            points += (own if run.forward else own[::-1])[:-1]
        return points

    def across(self, loops: list[list[Point]], z: float, up: bool, name: str) -> None:
        numbers = [self._corner(point, z) for loop in loops for point in loop]
        for a, b, c in triangles(loops, name):
            face = (a, b, c) if up else (c, b, a)
            self.triangles.append((numbers[face[0]], numbers[face[1]], numbers[face[2]]))

    def _points(self, side: Side) -> list[Point]:
        if side not in self._chords:
            self._chords[side] = chord_points(side, self.tolerance)
        return self._chords[side]

    def _corner(self, point: Point, z: float) -> int:
        return self.corners.setdefault((*point, z), len(self.corners))
