"""How a rack moves in its plane."""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.motion.pivots import PlaneMotion
from geneva_cli.numerics.arrays import Array, N


class Sliding(PlaneMotion):
    """The travel of a rack along y, by ``radius`` a radian."""

    PERIOD = math.inf
    TURNS = 0.0

    def __init__(self, radius: float) -> None:
        self.radius = radius

    def into(self, points: Array, turn: Array) -> Array:
        """Return points, moved back along y."""
        out = np.array(points)
        out[:, 1] -= self.radius * turn
        return out

    def level(self, points: Array) -> Array:
        """Return the position across the rack, x."""
        return points[..., 0]

    def place(self, points: Array) -> Array:
        """Return the position along the rack, over the radius."""
        out: Array = points[..., 1] / self.radius
        return out

    def outwards(self, points: Array) -> Array:
        """Return the x axis."""
        out: Array = 0.0 * points + (1.0, 0.0)
        return out

    def lever(self, level: N) -> N:
        """Return the radius, at any level."""
        return 0.0 * level + self.radius

    def half_span(self, reach: float, level: float) -> float:
        """Return the disc's radius over the rack's."""
        return reach / self.radius
