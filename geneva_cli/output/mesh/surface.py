"""A closed surface of triangles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array
from geneva_cli.output.mesh.polygons import DECIMALS, Triangle

if TYPE_CHECKING:
    import numpy.typing as npt

    from geneva_cli.curves.sphere import Vector


class Surface(NamedTuple):
    """Corners in mm (n, 3), and triangles by their numbers (m, 3), counterclockwise from outside.

    Every side of a triangle is a side of one other, in the opposite sense.
    """

    corners: Array
    triangles: npt.NDArray[np.int64]


def surface(corners: Sequence[Vector], triangles: Sequence[Triangle]) -> Surface:
    """Return the surface of corners, which are rounded, and triangles."""
    return Surface(rounded(np.array(corners)), np.array(triangles, dtype=np.int64))


def rounded(corners: Array) -> Array:
    """Return corners with DECIMALS, and without negative zeros."""
    return np.round(corners, DECIMALS) + 0.0
