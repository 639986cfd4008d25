"""The gaps between wheel, crank and rollers on a sphere, and proved lower bounds of them.

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
from geneva_cli.geometry.sphere_arcs import SphereArcs, polar, short_arcs
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.regions import QUARTER, edge
from geneva_cli.kinds.spherical.stops import ProjectedMotion, SphereMotion, SphereStops
from geneva_cli.motion.pivots import turned_points
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.gaps import NEAR, Gaps
from geneva_cli.parts.turn.stops import Pose
from geneva_cli.parts.turn.turn_certificate import FlatPairs
from geneva_cli.parts.turn.turned_parts import Intervals, Window

STEP = math.radians(1.0)  # greatest turn of a piece of the crank, tested for being in the wheel


class BallGaps(Gaps):
    """The gaps between one machine's wheel, crank and rollers at any positions."""

    def __init__(self, assembly: Assembly, ball: Ball, sectors: list[Region]) -> None:
        self.assembly, self.ball, self.plane_motion = assembly, ball, SphereMotion(ball)
        self.sizes, L, self.pitch = ball.lengths, ball.radius_mm, 2.0 * ball.half_step
        self.near, self.rim = NEAR * L, L * ball.rim
        slots = [arc for k in range(ball.z) for arc in edge(ball, k * self.pitch)]
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
