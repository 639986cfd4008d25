"""A plate with holes across its axis as a mesh.

A hole's corners are at some y of its frame, on both of its halves. The walls that it opens, and
both faces, have corners at these y too. So a wall is two strips beside the hole, below and above.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.curves.cross_holes import CrossHole, Opening
from geneva_cli.curves.measure import with_material_left
from geneva_cli.curves.plates import Plate
from geneva_cli.curves.shapes import Arc, Circle, Contour, Line, Point, closed, two_arcs
from geneva_cli.output.mesh.polygons import (
    Triangle,
    arc_chords,
    chord_points,
    rounded_point,
    triangles,
)
from geneva_cli.output.mesh.surface import Surface, surface
from geneva_cli.output.solid_part import plate_contours


class Corner(NamedTuple):
    """A corner of a contour, and the heights of the hole's edge over it, if there are any."""

    at: Point
    heights: tuple[float, ...] = ()


class Bore(NamedTuple):
    """A hole, where it opens, and the y of its corners."""

    hole: CrossHole
    ends: tuple[Opening, Opening]
    ys: list[float]

    def heights(self, y: float) -> tuple[float, ...]:
        """Return the heights of the hole's edge at a y: one at its ends, otherwise two."""
        half = math.sqrt(max(self.hole.radius**2 - y * y, 0.0))
        both = self.hole.height - half, self.hole.height + half
        return both if abs(y) < self.ys[-1] else (self.hole.height,)

    def corners(self, opening: Opening) -> list[Corner]:
        """Return the corners on a wall, in the order of their y."""
        return [
            Corner(rounded_point(self.hole.placed(opening.x(y), y)), self.heights(y))
            for y in self.ys
        ]


def drilled_mesh(plate: Plate, tolerance: float) -> Surface:
    """Return the surface of a plate with cross holes; its chords keep the tolerance, mm.

    Raises GenevaError for a plate without thickness, and for contours that cross.
    """
    contours = [
        with_material_left(_contour(shape), i == 0) for i, shape in enumerate(plate_contours(plate))
    ]
    return _DrilledMesh(plate, contours, tolerance).surface()


def _contour(shape: Contour | Circle) -> Contour:
    return closed(shape.layer, two_arcs(shape)) if isinstance(shape, Circle) else shape


class _DrilledMesh:
    """The corners, each once, and the triangles of one plate."""

    def __init__(self, plate: Plate, contours: list[Contour], tolerance: float) -> None:
        self.plate, self.contours, self.tolerance = plate, contours, tolerance
        self.bores = [self._bore(hole) for hole in plate.cross]
        self.corners: dict[tuple[float, float, float], int] = {}
        self.triangles: list[Triangle] = []

    def _bore(self, hole: CrossHole) -> Bore:
        ends = hole.openings(self.contours)
        count = arc_chords(hole.radius, math.pi, self.tolerance)
        for end in ends:
            if isinstance(end.seen, Arc):
                count = max(count, arc_chords(end.seen.radius, math.pi, self.tolerance))
        ys = [-hole.radius * math.cos(math.pi * k / count) for k in range(count + 1)]
        return Bore(hole, ends, ys)

    def surface(self) -> Surface:
        loops = [self._loop(contour) for contour in self.contours]
        for loop in loops:
            for start, end in zip(loop, [*loop[1:], loop[0]], strict=True):
                self._wall(start, end)
        flat = [corner.at for loop in loops for corner in loop]
        for a, b, c in triangles([[one.at for one in loop] for loop in loops], self.plate.name):
            for z, face in ((self.plate.low, (c, b, a)), (self.plate.high, (a, b, c))):
                self._face([(*flat[number], z) for number in face])
        for bore in self.bores:
            self._hole(bore)
        return surface(list(self.corners), self.triangles)

    def _loop(self, contour: Contour) -> list[Corner]:
        return [corner for piece in contour.segments for corner in self._along(piece)]

    def _along(self, piece: object) -> Iterator[Corner]:
        """Yield the corners along a piece without its end, with those of the holes in it."""
        assert isinstance(piece, Line | Arc)
        own = [
            (bore, opening)
            for bore in self.bores
            for opening in bore.ends
            if opening.piece == piece
        ]
        plain, *others = [Corner(point) for point in chord_points(piece, self.tolerance)[:-1]]
        yield plain
        if not own:
            yield from others
            return
        ((bore, opening),) = own
        span = bore.hole.radius + 0.1 * self.tolerance
        beyond = [one for one in others if abs(bore.hole.seen(one.at)[1]) > span]
        rises = bore.hole.seen(piece.end)[1] > bore.hole.seen(piece.start)[1]
        drilled = bore.corners(opening)[:: 1 if rises else -1]
        before = [one for one in beyond if (bore.hole.seen(one.at)[1] < 0.0) is rises]
        yield from before
        yield from drilled
        yield from beyond[len(before) :]

    def _wall(self, start: Corner, end: Corner) -> None:
        """Add the wall over a chord: one strip, or two beside a hole."""
        low, high = self.plate.low, self.plate.high
        if start.heights and end.heights:
            for z0, z1, z2, z3 in (
                (low, low, end.heights[0], start.heights[0]),
                (start.heights[-1], end.heights[-1], high, high),
            ):
                self._face([(*start.at, z0), (*end.at, z1), (*end.at, z2), (*start.at, z3)])
            return
        right = [(*end.at, z) for z in (low, *end.heights, high)]
        left = [(*start.at, z) for z in (high, *start.heights, low)]
        around = [*right, *left]
        # a fan from a corner between two others on one line leaves no flat triangle
        apex = 1 if end.heights else len(right) + 1 if start.heights else 0
        self._face([*around[apex:], *around[:apex]])

    def _hole(self, bore: Bore) -> None:
        """Add the hole's own wall, whose outer side is towards its axis."""
        rings = []
        for opening in bore.ends:
            corners = bore.corners(opening)
            below = [(*corner.at, corner.heights[0]) for corner in corners]
            above = [(*corner.at, corner.heights[-1]) for corner in corners[-2:0:-1]]
            rings.append([*below, *above])
        entry, exit_ = rings
        for k in range(len(entry)):
            self._face([entry[k - 1], exit_[k - 1], exit_[k], entry[k]])

    def _face(self, points: list[tuple[float, float, float]]) -> None:
        """Add a fan of triangles from the first of some points."""
        first, *rest = (self.corners.setdefault(point, len(self.corners)) for point in points)
        self.triangles += [(first, a, b) for a, b in zip(rest, rest[1:], strict=False)]
