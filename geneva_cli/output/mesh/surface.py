"""A closed surface of triangles."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array
from geneva_cli.output.mesh.polygons import DECIMALS, Triangle

if TYPE_CHECKING:
    import numpy.typing as npt

    from geneva_cli.geometry.sphere import Vector


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
