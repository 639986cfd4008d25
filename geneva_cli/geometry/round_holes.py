"""Round holes: through shells of a sphere, and across plates."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import fraction_at
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Point, Shape, closed, two_arcs
from geneva_cli.geometry.sphere import Region, Vector, dot
from geneva_cli.geometry.sphere_arcs import SphereArcs


class RoundHole(NamedTuple):
    """A cylinder about a direction from the centre; radius in mm, less than the spheres'.

    The volume that it removes from a shell is in closed form, by c = sqrt(1 - (q/R)²), where it
    meets a sphere.

    >>> hole = RoundHole((0.0, 0.0, 1.0), 3.0)
    >>> half_rings = 2.0 / 3.0 * math.pi * 4.0**3  # the rest of half a ball: h³ for any R
    >>> halves = 2.0 / 3.0 * math.pi * (5.0**3 - 3.0**3)
    >>> round((halves - hole.volume(3.0, 5.0)) / half_rings, 12)
    1.0
    """

    axis: Vector
    radius: float

    def angle(self, sphere: float) -> float:
        """Half the angle of the hole, seen from the centre, where it meets a sphere, radians."""
        return math.asin(min(1.0, self.radius / sphere))

    def volume(self, inner: float, outer: float) -> float:
        """Volume between two spheres, mm³."""
        return self._integrals(outer)[0] - self._integrals(inner)[0]

    def first(self, inner: float, outer: float) -> float:
        """Integral of the height along its axis, mm⁴."""
        return 0.5 * math.pi * self.radius**2 * (outer - inner) * (outer + inner)

    def inertia(self, inner: float, outer: float, about: Vector) -> float:
        """The volume's moment of inertia about an axis through the centre, mm⁵."""
        (_, far, up), (_, less, below) = self._integrals(outer), self._integrals(inner)
        own, along = far - less, up - below
        square = dot(self.axis, about) ** 2
        return own * square + (0.5 * own + along) * (1.0 - square)

    def _integrals(self, R: float) -> tuple[float, float, float]:
        """Integrals of 1, and of the squares of the distance from the axis and of the height."""
        square = (self.radius / R) ** 2
        c = math.sqrt(1.0 - square)
        left = square / (1.0 + c)  # 1 - c without cancellation
        volume = math.tau / 3.0 * R**3 * left * (1.0 + c + c * c)
        off = left * left * (((3.0 * c + 6.0) * c + 4.0) * c + 2.0)
        up = left * ((((c + 1.0) * c + 1.0) * c + 1.0) * c + 1.0)
        return volume, math.tau / 15.0 * R**5 * off, math.tau / 15.0 * R**5 * up


def least_wall(within: Region, holes: Sequence[RoundHole], sphere: float) -> float:
    """Return the least wall between holes, and from holes to a boundary, on a sphere, mm."""
    angles = [hole.angle(sphere) for hole in holes]
    away = SphereArcs(within.boundary).signed(np.array([hole.axis for hole in holes]))
    least = float((-away - angles).min())
    for (one, a), (other, b) in combinations(zip(holes, angles, strict=True), 2):
        apart = 2.0 * math.asin(min(1.0, 0.5 * math.dist(one.axis, other.axis)))
        least = min(least, apart - a - b)
    return sphere * least


class Opening(NamedTuple):
    """Where a hole meets a wall: the wall's piece, and that piece in the hole's frame."""

    piece: Line | Arc
    seen: Line | Arc
    side: float  # +1 or -1: the sense of x in which an arc is beyond its centre

    def x(self, y: float) -> float:
        """Return the wall's x at a y of the hole's frame."""
        if isinstance(self.seen, Line):
            (x0, y0), (x1, y1) = self.seen
            return x0 + (y - y0) / (y1 - y0) * (x1 - x0)
        (cx, cy), radius = self.seen.centre, self.seen.radius
        return cx + self.side * math.sqrt(max(radius * radius - (y - cy) ** 2, 0.0))

    def slope(self, y: float) -> float:
        """Return dx/dy of the wall."""
        if isinstance(self.seen, Line):
            (x0, y0), (x1, y1) = self.seen
            return (x1 - x0) / (y1 - y0)
        (cx, cy), x = self.seen.centre, self.x(y)
        return (cy - y) / (x - cx)


class CrossHole(NamedTuple):
    """A round hole about a line through a point in the plate's material; mm and radians."""

    at: Point
    turn: float  # direction of the line
    height: float  # along the plate's axis
    radius: float

    def placed(self, x: float, y: float) -> Point:
        """Return a point of the hole's frame in the plate's plane."""
        c, s = math.cos(self.turn), math.sin(self.turn)
        return self.at[0] + c * x - s * y, self.at[1] + s * x + c * y

    def seen(self, point: Point) -> Point:
        """Return a point of the plate's plane in the hole's frame."""
        c, s = math.cos(self.turn), math.sin(self.turn)
        x, y = point[0] - self.at[0], point[1] - self.at[1]
        return c * x + s * y, c * y - s * x

    def openings(self, shapes: Iterable[Shape]) -> tuple[Opening, Opening]:
        """Return where the hole meets the walls on both sides of its point, that at less x first.

        Raises GenevaError where it does not lie within one piece of each.
        """
        ends: dict[bool, tuple[float, Opening]] = {}
        for shape in shapes:
            for piece in () if isinstance(shape, Circle) else shape.segments:
                if not isinstance(piece, Line | Arc):
                    continue
                for opening in self._met(piece):
                    x = opening.x(0.0)
                    if (x > 0.0) not in ends or abs(x) < abs(ends[x > 0.0][0]):
                        ends[x > 0.0] = x, opening
        if len(ends) < 2 or not all(self._within(opening) for _, opening in ends.values()):
            raise GenevaError(f"a hole of {2.0 * self.radius:.6g} mm across the axis cuts an edge")
        return ends[False][1], ends[True][1]

    def _met(self, piece: Line | Arc) -> Iterable[Opening]:
        """Return the openings at y = 0 of a piece's line or circle that are on the piece."""
        start, end = self.seen(piece.start), self.seen(piece.end)
        if isinstance(piece, Line):
            crossed = start[1] * end[1] < 0.0
            return [Opening(piece, Line(start, end), 1.0)] if crossed else []
        seen = Arc(start, end, piece.bulge)
        if abs(seen.centre[1]) >= seen.radius:
            return []
        both = (Opening(piece, seen, side) for side in (-1.0, 1.0))
        return [one for one in both if self._on(one, 0.0)]

    def _within(self, opening: Opening) -> bool:
        """Return True if the whole width of the hole is on the opening's piece."""
        seen, r = opening.seen, self.radius
        if isinstance(seen, Arc) and abs(seen.centre[1]) + r >= seen.radius:
            return False
        return self._on(opening, -r) and self._on(opening, r)

    def _on(self, opening: Opening, y: float) -> bool:
        fraction = fraction_at(opening.seen, (opening.x(y), y))
        return 0.0 < fraction < 1.0


def drilled(shapes: Sequence[Shape], holes: Sequence[CrossHole]) -> tuple[Contour | Circle, ...]:
    """Return shapes with the circles that holes meet as two arcs, whose ends are off the holes."""
    out = []
    for shape in shapes:
        if isinstance(shape, Circle):
            at, radius = shape.centre, shape.radius
            met = (h for h in holes if abs(h.seen(at)[1]) < radius + h.radius)
            if hole := next(met, None):
                shape = closed(shape.layer, two_arcs(shape, hole.turn + 0.5 * math.pi))
        out.append(shape)
    return tuple(out)
