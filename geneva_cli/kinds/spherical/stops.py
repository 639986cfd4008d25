"""The motion and the stops of a wheel that turns about z on a sphere."""

from __future__ import annotations

import numpy as np

from geneva_cli.geometry.sphere_arcs import SphereArcs, azimuth, polar
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.regions import at_mid_motion
from geneva_cli.motion.pivots import PlaneMotion, turned_points
from geneva_cli.numerics.arrays import Array, N, within_half_turn
from geneva_cli.parts.turn.stops import CONCENTRIC, Branches, Curve, Pieces, Stops


class SphereMotion(PlaneMotion):
    """The turns of wheel and crank on a sphere; points are directions (..., 3).

    Levels and distances are arcs on the sphere, mm.
    """

    def __init__(self, ball: Ball) -> None:
        self.L = self.scale = ball.radius_mm
        self.crank_frame = np.array(at_mid_motion(ball))  # rows: the crank's axes, in the wheel's
        self.crank_axis = self.crank_frame[2:]

    def level(self, points: Array) -> Array:
        """Return the distances of directions from the wheel's axis."""
        return self.L * polar(points)

    def lever(self, level: N) -> N:
        """Return how far points at a level move a radian."""
        return self.L * np.sin(level / self.L)

    def from_crank(self, points: Array, angle: Array) -> Array:
        """Return directions (k, 3) of the crank in the fixed frame, at n angles: (n, k, 3)."""
        # the crank turns clockwise about its axis where the wheel turns counterclockwise
        return turned_points(points, -angle[..., None]) @ self.crank_frame

    def in_crank(self, points: Array, angle: Array) -> Array:
        """Return directions of the fixed frame in that of the crank, at angles."""
        return turned_points(points @ self.crank_frame.T, angle)


class ProjectedMotion(SphereMotion):
    """The same, seen from the pole opposite to the wheel's axis: circles stay circles."""

    def level(self, points: Array) -> Array:
        """Return the distances of projected points from the wheel's axis, over its diameter."""
        return np.tan(0.5 * polar(points))


class SphereStops(Stops):
    """Stops of one machine's wheel on a sphere, by the edge of one of its equal slots.

    Levels are those of a ``ProjectedMotion``. A roller is a cap, whose radius is an angle.
    """

    def circle(self, centres: Array, radius: Array | float) -> Curve:
        """Return the curves of caps of a radius, radians, about their middles."""
        far = polar(centres)
        nearest, farthest = np.tan(0.5 * (far - radius)), np.tan(0.5 * (far + radius))
        return 2.0 / (farthest - nearest), nearest, azimuth(centres)

    def pieces(self, outline: SphereArcs, angle: Array | None, inset: float) -> Pieces:
        """Return the pieces ``inset`` radians inside the edge, or a sector at n angles."""
        turns = np.array((outline.turn_start, outline.turn_end))
        trims = inset * np.tan(0.5 * np.clip(turns, 0.0, 3.0)) / np.sin(outline.angle)
        sweep, every = outline.sweep - trims.sum(axis=0), np.arange(len(outline))
        points = [outline.axis, outline.x, outline.y]
        points += [outline.at(every, trims[0] + part * sweep, inset) for part in (0.0, 0.5, 1.0)]
        axis, x, y, first, middle, last = self.fixed(points, angle)
        bend, excess, ahead = self.circle(axis, outline.angle - inset)
        level = np.hypot(axis[..., 0], axis[..., 1]) < CONCENTRIC
        ahead = np.where(level, azimuth(middle), ahead)
        ends, start = np.array((first, last)), np.arctan2(-y[..., 2], x[..., 2]) + trims[0]
        off = np.abs(within_half_turn(azimuth(ends) - ahead))
        known, span = np.array((self.moves.level(ends), off)), np.array((start, start + sweep))
        return known, span, (bend, excess, ahead), level

    def lean(self, level: Array, side: Branches, close: float) -> Array:
        """Return the sine of the pressure angle where a round side touches; projected it stays."""
        return super().lean(level, side, 0.0)
