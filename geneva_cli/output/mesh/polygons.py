"""Curves as chords within a tolerance, and polygons with holes as triangles."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import STRAIGHT, at
from geneva_cli.geometry.shapes import Arc, Cubic, Point, Segment
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.ezdxf_alone import earcut

Triangle: TypeAlias = tuple[int, int, int]

DECIMALS = 6  # of coordinates in mm, so that rounding of another processor is not seen
CORNERS_MAX = 200_000  # of a polygon: a file of about 40 MB

if TYPE_CHECKING:
    import numpy.typing as npt

    from geneva_cli.geometry.sphere import Vector


@dataclass(slots=True)
class Corner:
    """A corner for earcut: its coordinates and its number."""

    x: float
    y: float
    number: int


def require_few(count: int, layer: str) -> None:
    """Raise GenevaError for a polygon with more than CORNERS_MAX corners."""
    if count > CORNERS_MAX:
        raise GenevaError(
            f"--tolerance: the mesh of layer {layer} takes more than {CORNERS_MAX} chords; use a "
            "larger tolerance"
        )


def chord_points(segment: Segment, tolerance: float) -> list[Point]:
    """Return the ends of a segment's chords, both of its own included, with DECIMALS."""
    points = segment.start, *between(segment, tolerance), segment.end
    return [rounded_point(point) for point in points]


def between(segment: Segment, tolerance: float) -> list[Point]:
    """Return the ends of a segment's chords without its own."""
    count = _chords(segment, tolerance)
    require_few(count, "a part")
    return [at(segment, k / count) for k in range(1, count)]


def arc_chords(radius: float, sweep: float, tolerance: float) -> int:
    """Return the number of chords of an arc of ``sweep`` radians; lengths in mm.

    >>> arc_chords(10.0, 6.283185307179586, 0.01)
    71
    """
    # as in Polyarc.samples: 1 minus a cosine loses the digits of an arc that is nearly straight
    most = 4.0 * math.asin(math.sqrt(0.5 * min(tolerance / radius, 1.0)))
    # at least 8 chords in a whole turn
    return max(1, math.ceil(abs(sweep) / min(most, math.tau / 8)))


def _chords(segment: Segment, tolerance: float) -> int:
    if isinstance(segment, Arc) and abs(segment.bulge) >= STRAIGHT:
        return arc_chords(segment.radius, segment.sweep, tolerance)
    if isinstance(segment, Cubic):
        a, b, c, d = segment
        bend = max(_bend(a, b, c), _bend(b, c, d))
        # the second derivative is at most 6 bends, and a chord's error an eighth of it
        return max(1, math.ceil(math.sqrt(0.75 * bend / tolerance)))
    return 1


def _bend(a: Point, b: Point, c: Point) -> float:
    return math.hypot(a[0] - 2.0 * b[0] + c[0], a[1] - 2.0 * b[1] + c[1])


def rounded_point(corner: Point) -> Point:
    """Return a corner with DECIMALS, and without negative zeros."""
    return round(corner[0], DECIMALS) + 0.0, round(corner[1], DECIMALS) + 0.0


def triangles(loops: Sequence[Sequence[Point]], name: str) -> list[Triangle]:
    """Return the triangles, counterclockwise, of an outline (the first loop) with its holes.

    Their numbers count the corners of all loops, one after the other. Every side of a loop is a
    side of one triangle, and all other sides are of two. Raises GenevaError, naming the part, for
    loops that cross or touch.
    """
    starts = [0]
    for loop in loops:
        starts.append(starts[-1] + len(loop))
    # Radians by which the polygon is turned for each attempt. Corners exactly in line, which earcut
    # may leave out, are in line no more when they are turned.
    for turn in (0.0, 0.1, 0.7, 1.3):
        c, s = math.cos(turn), math.sin(turn)
        numbered = [
            [Corner(c * x - s * y, s * x + c * y, first + i) for i, (x, y) in enumerate(loop)]
            for loop, first in zip(loops, starts, strict=False)
        ]
        cut = [_left((p, q, r)) for p, q, r in earcut(numbered[0], numbered[1:])]
        if cut and _is_closed(cut, loops):
            return cut
    raise GenevaError(
        f"{name}: its outline and holes leave no wall, so it has no mesh; use a smaller --tolerance"
    )


def _left(corners: tuple[Corner, Corner, Corner]) -> Triangle:
    """Return the triangle counterclockwise."""
    p, q, r = corners
    twice = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)
    return (p.number, q.number, r.number) if twice >= 0.0 else (p.number, r.number, q.number)


def _is_closed(cut: list[Triangle], loops: Sequence[Sequence[Point]]) -> bool:
    """Return True if the sides that only one triangle has are those of the loops, in their sense.

    All triangles run counterclockwise, so then they cover the polygon once.
    """
    sides = [side for a, b, c in cut for side in ((a, b), (b, c), (c, a))]
    once = set(sides)
    if len(once) < len(sides):
        return False
    single = {(a, b) for a, b in once if (b, a) not in once}
    return single == set(edges(loops))


def edges(loops: Sequence[Sequence[Point]]) -> list[tuple[int, int]]:
    """Return the sides of all loops by the numbers of their corners."""
    pairs, first = [], 0
    for loop in loops:
        after = first + len(loop)
        pairs += [(i, i + 1 if i + 1 < after else first) for i in range(first, after)]
        first = after
    return pairs


class Surface(NamedTuple):
    """Corners in mm (n, 3), and triangles by their numbers (m, 3), counterclockwise from outside.

    Every side of a triangle is a side of one other, in the opposite sense.
    """

    corners: Array
    triangles: npt.NDArray[np.int64]


def surface(corners: Sequence[Vector], triangles: Sequence[Triangle]) -> Surface:
    """Return the surface of corners, which are rounded, and triangles."""
    return Surface(rounded(np.array(corners)), np.array(triangles, dtype=np.int64))


class Fans:
    """A surface while it is built: its corners, each once, and its triangles."""

    def __init__(self) -> None:
        self.corners: dict[Vector, int] = {}
        self.triangles: list[Triangle] = []

    def add(self, points: Sequence[Vector]) -> None:
        """Add a fan of triangles from the first of some points, without those of no area."""
        first, *rest = (self.corners.setdefault(point, len(self.corners)) for point in points)
        fan = [(first, a, b) for a, b in pairwise(rest)]
        self.triangles += [one for one in fan if len(set(one)) == 3]

    def surface(self) -> Surface:
        """Return the surface."""
        return surface(list(self.corners), self.triangles)


def rounded(corners: Array) -> Array:
    """Return corners with DECIMALS, and without negative zeros."""
    return np.round(corners, DECIMALS) + 0.0
