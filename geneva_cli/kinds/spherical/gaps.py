"""The motion of a spherical wheel, its stops, and the gaps between wheel, crank and rollers.

All walls lead to the sphere's centre: gaps are angles there, returned as arc lengths on the sphere,
mm. A point at an angle r from an axis moves at most sin r times the angle by which its part turns
about it. In its own slot a roller moves along the meridian in the middle, and the feet of the
perpendiculars from there to both walls are on them: the gap is the slot's clearance.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from geneva_cli.geometry.sphere import Region, place
from geneva_cli.geometry.sphere_arcs import SphereArcs, azimuth, polar, short_arcs
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.regions import QUARTER, at_mid_motion, edge
from geneva_cli.motion.pivots import PlaneMotion, turned_points
from geneva_cli.numerics.arrays import Array, N, within_half_turn
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.gaps import NEAR, Gaps
from geneva_cli.parts.turn.stops import CONCENTRIC, Branches, Curve, Pieces, Pose, Stops
from geneva_cli.parts.turn.turn_certificate import FlatPairs
from geneva_cli.parts.turn.turned_parts import Intervals, Window

STEP = math.radians(1.0)  # greatest turn of a piece of the crank, tested for being in the wheel


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


class BallGaps(Gaps):
    """The gaps between one machine's wheel, crank and rollers at any positions."""

    def __init__(self, assembly: Assembly, ball: Ball, sectors: list[Region]) -> None:
        self.assembly, self.ball, self.plane_motion = assembly, ball, SphereMotion(ball)
        self.sizes, L, self.pitch = ball.lengths, ball.radius_mm, 2.0 * ball.half_step
        self.near, self.rim = NEAR * L, L * ball.rim
        slots = [arc for k in range(ball.z) for arc in edge(ball, k)]
        self.wheel = self.beside = SphereArcs(slots, radius=L)
        self.around = SphereArcs(edge(ball), radius=L, closed=False)  # one slot; all are equal
        edges = (sector.boundary for sector in sectors)
        self.crank = SphereArcs(*edges, radius=L) if sectors else None
        own = self.around, self.pitch, self.crank, ball.roller, ProjectedMotion(ball)
        self.stops = SphereStops(*own)
        self._rollers = np.array([place(ball.arm, azimuth) for azimuth in ball.rollers])

    def pose(self, input_deg: Array) -> Pose:
        """Return the positions at input angles (n,), degrees."""
        turn = np.radians(input_deg)
        pins = self.plane_motion.from_crank(self._rollers, turn)
        return Pose(self.assembly.wheel(input_deg), turn, pins)


class SpherePairs(FlatPairs):
    """Pairs of parts on a sphere, with gaps bounded up to ``target`` mm."""

    def __init__(self, gaps: BallGaps, crank: Sequence[Region], target: float) -> None:
        self.gaps, self.target, self.rim, self.ball = gaps, target, gaps.rim, gaps.ball
        self.apart, L = max(target, 0.0), self.ball.radius_mm
        self.pieces = short_arcs(crank, STEP, L) if crank else None
        # no point of a sphere moves farther than it turns
        self.levers = L, L * math.sin(min(self.ball.lock + self.apart / L, QUARTER))

    def roller(
        self, number: int, window: Window, span: tuple[float, float] | None, on: Intervals
    ) -> tuple[Array, Array]:
        """Return the gap of a roller in its slot between two angles, or outside the one it drives.

        Outside, the gap is that in the middle, less the roller's travel in the wheel's frame.
        """
        ball, gaps, pose, pins = self.ball, self.gaps, on.at_middle, on.at_middle.pins[:, number]
        L, centre, gap = ball.radius_mm, turned_points(pins, -pose.wheel), gaps.rollers(pose)
        gap = gap[:, number]
        if span:
            # it runs along the slot's middle, from which both walls are equally far up to the mouth
            return gap, np.full(len(gap), L * (ball.half_width - ball.roller))
        away = polar(centre)
        # the wheel is within its rim's circle
        gap = np.maximum(gap, L * (away - ball.rim - ball.roller))
        least = gap - L * (math.sin(ball.arm) * on.crank + np.sin(away) * on.wheel)
        return gap, least
