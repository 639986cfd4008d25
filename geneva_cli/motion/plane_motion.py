"""The motion of a wheel in its plane: it turns about its axis, or slides as a rack does.

A body has two coordinates, of which its motion changes one: the place. That is the polar angle of a
wheel's points, and of a rack's points their position along the travel. The other coordinate is the
level: the distance from a wheel's axis, or the position across a rack. Places are radians: a rack
slides by its pinion's radius a radian. Lengths are in the unit of the points.
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

    def into(self, points: Array, turn: Array) -> Array:
        """Return points in the frame of the body, which has moved by n angles."""
        return turned_points(points, -turn)

    def angle(self, turn: Array) -> Array:
        """Return the direction of the body's x axis."""
        return turn

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
