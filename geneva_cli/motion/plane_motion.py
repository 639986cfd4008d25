"""The motion of a wheel in its plane: it turns about its axis, or slides as a rack does.

It changes one of two coordinates of a point, the place (radians; of a rack over its pinion's
radius), and leaves the other, the level: distance from the axis, or position across the rack.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.numerics.arrays import Array, N


class PlaneMotion:
    """The motion of a body in its plane: here a wheel that turns about the origin.

    Angles are in radians; arrays of points are (n, 2).
    """

    # change of the place after which a body meets itself, radians; infinite for a rack
    PERIOD = math.tau
    # rate at which the body's x axis turns; 0 for a rack
    TURNS = 1.0

    def into(self, points: Array, turn: Array) -> Array:
        """Return points in the frame of the body, which has moved by n angles."""
        return turned_points(points, -turn)

    def level(self, points: Array) -> Array:
        """Return the coordinate of points that the motion leaves as it is, (n,)."""
        out: Array = np.hypot(points[..., 0], points[..., 1])
        return out

    def place(self, points: Array) -> Array:
        """Return the coordinate of points that the motion changes, radians (n,)."""
        out: Array = np.arctan2(points[..., 1], points[..., 0])
        return out

    def outwards(self, points: Array) -> Array:
        """Return directions (n, 2) out of the body at points: those in which the level rises."""
        return points

    def lever(self, level: N) -> N:
        """Return how far points at a level move a radian."""
        return level

    def half_span(self, reach: float, level: float) -> float:
        """Return half of the range of places that a disc of radius ``reach`` covers."""
        return math.asin(reach / level) if reach < level else math.pi


def turned_points(points: Array, angle: Array) -> Array:
    """Return points (n, 2), each turned about the origin by its own angle, radians."""
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack(
        (points[:, 0] * c - points[:, 1] * s, points[:, 0] * s + points[:, 1] * c)
    )
