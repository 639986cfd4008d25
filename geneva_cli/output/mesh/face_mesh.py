"""The triangles of a face on a sphere, with short sides.

Long sides are halved, the longest first. After each, sides are exchanged so that the face is the
convex hull of its corners wherever its boundary allows (Delaunay, by Lawson's flips): without them
most triangles would be slivers, and there would be ten times as many.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterable

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.sphere import Vector, unit
from geneva_cli.output.mesh.polygons import CORNERS_MAX, Triangle


class SphereFace:
    """A face on the unit sphere: triangles counterclockwise from outside, with numbered corners.

    ``corners`` grows by those that are added. ``opposite`` has the third corner of the triangle on
    the left of each side.
    """

    def __init__(self, corners: list[Vector], face: Iterable[Triangle]) -> None:
        self.corners = corners
        self.opposite: dict[tuple[int, int], int] = {}
        for triangle in face:
            self._add(*triangle)

    def triangles(self, longest: float) -> list[Triangle]:
        """Return the triangles after all sides above ``longest`` are halved.

        Sides of the boundary must be shorter. Raises GenevaError for too many triangles.
        """
        self._exchange(list(self.opposite))
        long = [self._long(a, b) for a, b in self.opposite if a < b]
        self.waiting = [side for side in long if -side[0] > longest]
        heapq.heapify(self.waiting)
        while self.waiting:
            _, a, b = heapq.heappop(self.waiting)
            if (a, b) not in self.opposite or (b, a) not in self.opposite:
                continue
            if len(self.corners) > CORNERS_MAX:
                raise GenevaError(
                    f"--tolerance: the mesh takes more than {CORNERS_MAX} corners; use a larger "
                    "tolerance"
                )
            middle, around = self._halved(a, b)
            # no side at the new corner is exchanged: the hull has each of them from now on
            spokes = [(middle, other) for side in around for other in side[:1]]
            for one, two in (*spokes, *self._exchange(around)):
                length = math.dist(self.corners[one], self.corners[two])
                if length > longest:
                    heapq.heappush(self.waiting, (-length, min(one, two), max(one, two)))
        return [(a, b, c) for (a, b), c in self.opposite.items() if a < b and a < c]

    def _long(self, a: int, b: int) -> tuple[float, int, int]:
        """Return minus the length of a side and the side, which a heap sorts."""
        return -math.dist(self.corners[a], self.corners[b]), min(a, b), max(a, b)

    def _add(self, a: int, b: int, c: int) -> None:
        self.opposite[a, b] = c
        self.opposite[b, c] = a
        self.opposite[c, a] = b

    def _halved(self, a: int, b: int) -> tuple[int, list[tuple[int, int]]]:
        """Halve a side along its great circle; return the new corner, and the sides around it."""
        c, d = self.opposite.pop((a, b)), self.opposite.pop((b, a))
        p, q = self.corners[a], self.corners[b]
        middle = len(self.corners)
        self.corners.append(unit((p[0] + q[0], p[1] + q[1], p[2] + q[2])))
        for one in ((a, middle, c), (middle, b, c), (b, middle, d), (middle, a, d)):
            self._add(*one)
        return middle, [(c, a), (b, c), (d, b), (a, d)]

    def _exchange(self, sides: list[tuple[int, int]]) -> list[tuple[int, int]]:
        """Exchange sides that the hull has not; return the new ones, of which some may be gone."""
        new = []
        while sides:
            a, b = sides.pop()
            c, d = self.opposite.get((a, b)), self.opposite.get((b, a))
            if c is None or d is None or not self._is_below(a, b, c, d):
                continue
            del self.opposite[a, b], self.opposite[b, a]
            self._add(a, d, c)
            self._add(d, b, c)
            new.append((c, d))
            sides += [(c, a), (a, d), (d, b), (b, c)]
        return new

    def _is_below(self, a: int, b: int, c: int, d: int) -> bool:
        """Return True if the plane of a, b and c is below the corner d.

        Number by number, since a fine mesh asks a million times.
        """
        corners = self.corners
        px, py, pz = corners[a]
        qx, qy, qz = corners[b]
        rx, ry, rz = corners[c]
        sx, sy, sz = corners[d]
        ux, uy, uz = qx - px, qy - py, qz - pz
        vx, vy, vz = rx - px, ry - py, rz - pz
        wx, wy, wz = sx - px, sy - py, sz - pz
        volume = (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz
        if volume <= 0.0:
            return False
        # four corners within 1e-9 of the product of three sides are in one plane
        sides = math.hypot(ux, uy, uz) * math.hypot(vx, vy, vz) * math.hypot(wx, wy, wz)
        return volume > 1e-9 * sides
