"""A plate as a mesh: both faces cut alike, and strips of two triangles over each chord between.

A hole's corners are at some y of its frame, on both of its halves. The walls that it opens, and
both faces, have corners at these y too. So a wall is two strips beside the hole, below and above.
A chamfer is a strip from the wall to a face that is smaller all round, a rounding some of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.inset import away, inset, lines_and_arcs
from geneva_cli.geometry.measure import fraction_at
from geneva_cli.geometry.moments import oriented
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.round_holes import CrossHole, Opening
from geneva_cli.geometry.shapes import Arc, Contour, Line, Point, Segment
from geneva_cli.output.mesh.polygons import (
    Fans,
    Surface,
    arc_chords,
    between,
    require_few,
    rounded_point,
    triangles,
)
from geneva_cli.output.solid_part import plate_contours


class Corner(NamedTuple):
    """A corner of a contour, those of an edge's sections up to the face, and of a hole over it.

    The hole's are heights; there are none without an edge, or without a hole.
    """

    at: Point
    inner: tuple[Point, ...] = ()
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

    def places(self, opening: Opening) -> list[Point]:
        """Return the corners on a wall, in the order of their y."""
        return [self.hole.placed(opening.x(y), y) for y in self.ys]


def plate_mesh(plate: Plate, tolerance: float) -> Surface:
    """Return a plate's surface; its chords keep the tolerance, mm.

    Raises GenevaError for a plate without thickness, and for contours that cross.

    >>> from geneva_cli.geometry.shapes import Circle
    >>> disc = Plate("disc", "CRANK", Circle("", (0.0, 0.0), 50.0), (), 0.0, 10.0)
    >>> len(plate_mesh(disc, 0.1).triangles)  # 50 chords: 2 x 48 in the faces, 2 x 50 in the wall
    196
    """
    contours = plate_contours(plate)
    if not contours:  # its outline is rounding
        raise GenevaError(f"{plate.name}: its outline and holes leave no wall, so it has no mesh")
    outline, *holes = contours
    return _PlateMesh(plate, oriented(outline, holes), tolerance).surface()


class _PlateMesh:
    """One plate while it is meshed."""

    def __init__(self, plate: Plate, contours: list[Contour], tolerance: float) -> None:
        self.plate, self.contours, self.tolerance = plate, contours, tolerance
        self.bores = [self._bore(hole) for hole in plate.cross]
        self.fans = Fans()
        taken = plate.edge.size
        self.low, self.high = plate.low + taken, plate.high - taken  # of walls
        count = 0
        if taken:
            count = arc_chords(taken, 0.5 * math.pi, tolerance) if plate.edge.rounded else 1
        # depths and heights of an edge's sections, from the wall to the face
        self.sections = [plate.edge.at(k / count) for k in range(1, count + 1)]

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
        faces = [self._inset(loop) for loop in loops]
        flat = [point for face in faces for point in face]
        for a, b, c in triangles(faces, self.plate.name):
            for z, face in ((self.plate.low, (c, b, a)), (self.plate.high, (a, b, c))):
                self.fans.add([(*flat[number], z) for number in face])
        for bore in self.bores:
            self._hole(bore)
        return self.fans.surface()

    def _inset(self, loop: list[Corner]) -> list[Point]:
        """Return the corners of a face; around it are the strips of its edge, if it has one."""
        rings = list(zip(*((one.at, *one.inner) for one in loop), strict=True))
        steps = [height for _, height in self.sections[:-1]]
        low = [self.low, *(self.low - height for height in steps), self.plate.low]
        high = [self.high, *(self.high + height for height in steps), self.plate.high]
        for i, (outer, inner) in enumerate(pairwise(rings)):
            for k in range(len(loop)):
                a, b, c, d = outer[k - 1], outer[k], inner[k], inner[k - 1]
                self.fans.add([(*a, high[i]), (*b, high[i]), (*c, high[i + 1]), (*d, high[i + 1])])
                self.fans.add([(*d, low[i + 1]), (*c, low[i + 1]), (*b, low[i]), (*a, low[i])])
        face = rings[-1]
        return [one for k, one in enumerate(face) if one != face[k - 1]]

    def _loop(self, contour: Contour) -> list[Corner]:
        """Return the corners of a contour without those that are too near to the one before.

        Raises GenevaError where there are more than CORNERS_MAX.
        """
        apart, kept = 0.1 * self.tolerance, list[Corner]()
        for one in self._around(contour):
            near = bool(kept) and math.dist(kept[-1].at, one.at) <= apart
            if near and not kept[-1].heights:
                kept[-1] = one if one.heights else kept[-1]
            elif not near or one.heights:
                kept.append(one)
            require_few(len(kept), contour.layer)
        while len(kept) > 3 and math.dist(kept[-1].at, kept[0].at) <= apart:
            kept.pop()
        return kept

    def _around(self, contour: Contour) -> Iterator[Corner]:
        """Yield all corners along a contour."""
        pieces = contour.segments
        sections = list[tuple[Segment, ...]]()
        if self.sections:
            own = lines_and_arcs(contour)
            sections = [inset(own, "", depth).segments for depth, _ in self.sections]
        for k, piece in enumerate(pieces):
            within = [section[k] for section in sections]
            starts = tuple(rounded_point(one.start) for one in within)
            yield Corner(rounded_point(piece.start), starts)
            yield from self._along(piece, within)

    def _along(self, piece: Segment, within: Sequence[Segment]) -> Iterator[Corner]:
        """Yield the corners along a piece without its ends, with those of the holes in it."""
        own = [
            (bore, opening)
            for bore in self.bores
            for opening in bore.ends
            if opening.piece == piece
        ]
        others = [self._corner(within, point) for point in between(piece, self.tolerance)]
        if not own:
            yield from others
            return
        ((bore, opening),) = own
        span = bore.hole.radius + 0.1 * self.tolerance
        beyond = [one for one in others if abs(bore.hole.seen(one.at)[1]) > span]
        rises = bore.hole.seen(piece.end)[1] > bore.hole.seen(piece.start)[1]
        drilled = [
            self._corner(within, at)._replace(heights=bore.heights(y))
            for at, y in zip(bore.places(opening), bore.ys, strict=True)
        ]
        before = [one for one in beyond if (bore.hole.seen(one.at)[1] < 0.0) is rises]
        yield from before
        yield from drilled[:: 1 if rises else -1]
        yield from beyond[len(before) :]

    def _corner(self, within: Sequence[Segment], at: Point) -> Corner:
        """Return the corner at a place; ``within`` are the pieces of the edge's sections there."""
        pieces = (one for one in within if isinstance(one, Line | Arc))
        inner = (
            self._within(piece, at, depth)
            for piece, (depth, _) in zip(pieces, self.sections, strict=True)
        )
        return Corner(rounded_point(at), tuple(map(rounded_point, inner)))

    def _within(self, piece: Line | Arc, at: Point, depth: float) -> Point:
        """Return the point of a section's piece that is nearest to a place of the contour.

        Beside a corner of the contour the section's piece is shorter: there its end counts.
        """
        _, (x, y) = away(piece, at)
        inner = at[0] + depth * x, at[1] + depth * y
        fraction = fraction_at(piece, inner)
        for end, beyond in ((piece.start, fraction <= 0.0), (piece.end, fraction >= 1.0)):
            if beyond or math.dist(inner, end) <= 0.1 * self.tolerance:
                inner = end
        return inner

    def _wall(self, start: Corner, end: Corner) -> None:
        """Add the wall over a chord: one strip, or two beside a hole."""
        low, high = self.low, self.high
        if start.heights and end.heights:
            for z0, z1, z2, z3 in (
                (low, low, end.heights[0], start.heights[0]),
                (start.heights[-1], end.heights[-1], high, high),
            ):
                self.fans.add([(*start.at, z0), (*end.at, z1), (*end.at, z2), (*start.at, z3)])
            return
        right = [(*end.at, z) for z in (low, *end.heights, high)]
        left = [(*start.at, z) for z in (high, *start.heights, low)]
        around = [*right, *left]
        # a fan from a corner between two others on one line leaves no flat triangle
        apex = 1 if end.heights else len(right) + 1 if start.heights else 0
        self.fans.add([*around[apex:], *around[:apex]])

    def _hole(self, bore: Bore) -> None:
        """Add the hole's own wall, whose outer side is towards its axis."""
        rings = []
        for opening in bore.ends:
            places = [rounded_point(at) for at in bore.places(opening)]
            edges = [bore.heights(y) for y in bore.ys]
            both = list(zip(places, edges, strict=True))
            below = [(*at, heights[0]) for at, heights in both]
            above = [(*at, heights[-1]) for at, heights in both[-2:0:-1]]
            rings.append([*below, *above])
        entry, exit_ = rings
        for k in range(len(entry)):
            self.fans.add([entry[k - 1], exit_[k - 1], exit_[k], entry[k]])
