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
from geneva_cli.geometry.sphere_arcs import Circle, SphereArcs, farthest, from_circle, short_arcs
from geneva_cli.kept import cached_property
from geneva_cli.kinds.spherical.regions import QUARTER
from geneva_cli.kinds.spherical.stops import about, polar
from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.parts.turn.pairs import Bounds, Intervals, Pose, Window, raised

if TYPE_CHECKING:
    from geneva_cli.kinds.spherical.gaps import BallGaps

STEP = math.radians(1.0)  # greatest turn of a piece of the crank


class SpherePairs:
    """Pairs of parts on a sphere, with gaps bounded up to ``target`` mm."""

    def __init__(self, gaps: BallGaps, crank: Sequence[Region], target: float) -> None:
        self.gaps, self.crank, self.target, self.ball = gaps, crank, target, gaps.ball
        self.apart = max(target, 0.0) / self.ball.radius_mm  # up to which parts matter, radians

    def lock(self, window: Window, on: Intervals) -> Bounds:
        """Return the gap of locking sectors and wheel: bounds up to ``apart``.

        The wheel leaves a cap free about the middle of each recess. In the dwell and beside it, the
        part of the sectors that is within the wheel's rim lies in that cap.
        """
        R, gap = self.ball.radius_mm, self.gaps.locking(on.at_middle)
        # no point of a sphere moves farther than it turns
        least = gap - R * (on.wheel + self._sectors_travel(on))
        doubtful = least < self.target
        least = raised(least, doubtful, lambda which: self._in_recess(window, on.at(which)))
        return Bounds(gap, np.minimum(least, R * self.apart))

    def free(self, roller: int, window: Window, on: Intervals) -> Bounds:
        """Return the gap of a roller outside the slot that it drives.

        It is the gap in the middle, less the roller's travel in the wheel's frame. While the wheel
        rests, the centre is also on its circle about the crank's axis.
        """
        centre, ball = self._centre(roller, on.at_middle), self.ball
        away = polar(centre)
        # the wheel is within its rim's circle
        beyond = ball.radius_mm * (away - ball.rim - ball.roller)
        gap = np.maximum(self._gap(roller, on), beyond)
        least = gap - ball.radius_mm * (self._travel(on) + np.sin(away) * on.wheel)

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
        circle, gap = Circle(across, np.array(POLE), out, QUARTER), self._gap(roller, on)
        # the distance from the wheel's axis changes by no more than the roller moves
        centre, half = self._centre(roller, on.at_middle), self._travel(on)
        return Bounds(gap, self._along(circle, centre, half, gap))

    @cached_property
    def pieces(self) -> SphereArcs:
        """The crank in arcs of a degree, each of which is tested for being in the wheel."""
        return short_arcs(self.crank, STEP)

    def _centre(self, roller: int, pose: Pose) -> Array:
        """Return a roller's centre in the wheel's frame, (n, 3)."""
        return about(pose.pins[:, roller], -pose.wheel)

    def _gap(self, roller: int, on: Intervals) -> Array:
        """Return a roller's gap to the wheel in the middle of intervals, mm."""
        return self.gaps.rollers(on.at_middle)[:, roller]

    def _travel(self, on: Intervals) -> Array:
        """Return how far a roller's centre moves on the fixed sphere from the middle, radians."""
        return math.sin(self.ball.arm) * on.crank

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

    def _sectors_travel(self, on: Intervals) -> Array:
        """Return how far points of the sectors move, and points as near to them, radians."""
        return math.sin(min(self.ball.lock + self.apart, QUARTER)) * on.crank

    def _in_recess(self, window: Window, on: Intervals) -> Array:
        """Return how far the sectors stay within the cap of the nearer recess, mm."""
        ball, gaps, (wheel, crank, _) = self.ball, self.gaps, on.at_middle
        # the middles of the recesses at both ends of the window, in the wheel's frame
        turn = gaps.assembly.wheel(np.array((window.start, window.end)))
        recesses = about(np.tile(gaps.crank_frame[2], (2, 1)), -turn)
        nearer = (on.middle - window.start >= window.end - on.middle).astype(int)
        offset = gaps.in_crank(about(recesses[nearer], wheel), crank)
        far = np.where(self._within_rim(on, crank), farthest(self.pieces, offset), 0.0)
        moved = math.sin(ball.axes) * on.wheel + np.hypot(*offset[:, :2].T) * on.crank
        free = gaps.to_wheel(recesses)[nearer]
        return ball.radius_mm * (free - far.max(axis=1) - moved)

    def _within_rim(self, on: Intervals, crank: Array) -> Mask:
        """Return a mask (n, k) of the pieces of the sectors that may come within the rim."""
        pole = np.tile(POLE, (len(crank), 1))
        height = self.gaps.in_crank(pole, crank) @ self.pieces.middle.T
        beyond = np.arccos(np.clip(height, -1.0, 1.0)) - self.pieces.size - self.ball.rim
        # an angle computed from its cosine is wrong by up to 1e-7 radians
        moved = self._sectors_travel(on)[:, None] + self.apart + 1e-7
        return beyond <= moved
