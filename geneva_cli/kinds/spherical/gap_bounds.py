"""Proved lower bounds of the gaps on a sphere, on intervals of the input angle.

As on a plane (``parts.turn.bounds``). A point at an angle r from an axis moves at most sin r times
the angle by which its part turns about it. A roller's path is exact: an arc about the crank's axis
while the wheel rests, and a piece of the meridian in its own slot.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.geometry.sphere import POLE, Region
from geneva_cli.geometry.sphere_arcs import Circle, farthest, from_circle, short_arcs
from geneva_cli.kinds.spherical.regions import QUARTER
from geneva_cli.kinds.spherical.stops import about, polar
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.parts.turn.pairs import Bounds, Intervals, Pose, Window, raised

if TYPE_CHECKING:
    from geneva_cli.kinds.spherical.gaps import BallGaps

STEP = math.radians(1.0)  # greatest turn of a piece of the crank, tested for being in the wheel


class SpherePairs:
    """Pairs of parts on a sphere, with gaps bounded up to ``target`` mm."""

    def __init__(self, gaps: BallGaps, crank: Sequence[Region], target: float) -> None:
        self.gaps, self.target, self.ball = gaps, target, gaps.ball
        self.apart = max(target, 0.0) / self.ball.radius_mm  # up to which parts matter, radians
        self.pieces = short_arcs(crank, STEP) if crank else None

    def lock(self, window: Window, on: Intervals) -> Bounds:
        """Return the gap of locking sectors and wheel: bounds up to ``apart``.

        The wheel leaves a cap free about the middle of each recess. In the dwell and beside it, the
        part of the sectors that is within the wheel's rim lies in that cap.
        """
        ball, gaps, pieces, gap = self.ball, self.gaps, self.pieces, self.gaps.locking(on.at_middle)
        # how far points of the sectors move, and points as near to them; no point of a sphere moves
        # farther than it turns
        sectors_travel = math.sin(min(ball.lock + self.apart, QUARTER)) * on.crank
        least = gap - ball.radius_mm * (on.wheel + sectors_travel)

        def in_recess(which: Whole) -> Array:
            """Return how far the sectors stay within the cap of the nearer recess, mm."""
            some, (wheel, crank, _) = on.at(which), on.at_middle.at(which)
            # the middles of the recesses at both ends of the window, in the wheel's frame
            turn = gaps.assembly.wheel(np.array((window.start, window.end)))
            recesses = about(np.tile(gaps.crank_frame[2], (2, 1)), -turn)
            nearer = (some.middle - window.start >= window.end - some.middle).astype(int)
            offset = gaps.in_crank(about(recesses[nearer], wheel), crank)
            # the pieces of the sectors that may come within the rim; an angle computed from its
            # cosine is wrong by up to 1e-7 radians
            height = gaps.in_crank(np.tile(POLE, (len(crank), 1)), crank) @ pieces.middle.T
            beyond = np.arccos(np.clip(height, -1.0, 1.0)) - pieces.size - ball.rim
            inside = beyond <= sectors_travel[which][:, None] + self.apart + 1e-7
            far = np.where(inside, farthest(pieces, offset), 0.0)
            moved = math.sin(ball.axes) * some.wheel + np.hypot(*offset[:, :2].T) * some.crank
            free = gaps.to_wheel(recesses)[nearer]
            return ball.radius_mm * (free - far.max(axis=1) - moved)

        least = raised(least, least < self.target, in_recess)
        return Bounds(gap, np.minimum(least, ball.radius_mm * self.apart))

    def free(self, roller: int, window: Window, on: Intervals) -> Bounds:
        """Return the gap of a roller outside the slot that it drives.

        It is the gap in the middle, less the roller's travel in the wheel's frame. While the wheel
        rests, the centre is also on its circle about the crank's axis.
        """
        centre, ball = self._centre(roller, on.at_middle), self.ball
        away = polar(centre)
        # the wheel is within its rim's circle
        beyond = ball.radius_mm * (away - ball.rim - ball.roller)
        gap = np.maximum(self.gaps.rollers(on.at_middle)[:, roller], beyond)
        travel = math.sin(ball.arm) * on.crank + np.sin(away) * on.wheel
        least = gap - ball.radius_mm * travel

        def on_circle(which: Whole) -> Array:
            # the crank's axes in the frame of the resting wheel
            lead = np.full(3, self.gaps.assembly.wheel(np.array([window.start]))[0])
            x, y, axis = about(self.gaps.crank_frame, -lead)
            circle = Circle(axis, x, y, ball.arm)
            return self._along(circle, centre[which], on.crank[which], gap[which])

        return Bounds(gap, raised(least, window.rests & (least < self.target), on_circle))

    def driving(self, roller: int, span: tuple[float, float], on: Intervals) -> Bounds:
        """Return the gap of a roller in its slot between two input angles: on its meridian."""
        middle = self.gaps.pose(np.array([0.5 * (span[0] + span[1])]))
        x, y, _ = self._centre(roller, middle)[0]
        out = np.array((x, y, 0.0)) / math.hypot(x, y)
        across = np.array((-out[1], out[0], 0.0))
        circle = Circle(across, np.array(POLE), out, QUARTER)
        gap = self.gaps.rollers(on.at_middle)[:, roller]
        # the distance from the wheel's axis changes by no more than the roller moves
        half = math.sin(self.ball.arm) * on.crank
        return Bounds(gap, self._along(circle, self._centre(roller, on.at_middle), half, gap))

    def _centre(self, roller: int, pose: Pose) -> Array:
        """Return a roller's centre in the wheel's frame, (n, 3)."""
        return about(pose.pins[:, roller], -pose.wheel)

    def _along(self, circle: Circle, centre: Array, half: Array, gap: Array) -> Array:
        """Return the gap of a roller whose centre moves along a circle, mm."""
        off, middle = circle.seen(centre)
        aside = np.abs(off - circle.angle)
        from_wheel = self.ball.roller + gap / self.ball.radius_mm
        # An arc that is shorter than its middle's distance from the edge does not cross it.
        short = math.sin(circle.angle) * half + aside < from_wheel
        least = np.full(len(gap), -math.inf)
        away = from_circle(self.gaps.wheel, circle, middle[short], half[short])
        least[short] = self.ball.radius_mm * (away - aside[short] - self.ball.roller)
        return least
