"""Proved lower bounds of the gaps on a sphere, on intervals of the input angle.

As on a plane (``parts.turn.bounds``), a gap is at least the gap in the middle of an interval, less
how far the parts move from there. A point at an angle r from an axis moves at most sin r times the
angle by which its part turns about it. The crank turns evenly, so that a roller's path is exact: an
arc about the crank's axis while the wheel rests, and a piece of the meridian in its own slot.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.geometry.sphere import POLE, Region
from geneva_cli.geometry.sphere_arcs import SphereArcs
from geneva_cli.geometry.sphere_hull import Circle, FromCircle, farthest, short_arcs
from geneva_cli.kept import cached_property
from geneva_cli.kinds.spherical.stops import about, polar
from geneva_cli.kinds.spherical.wheel import QUARTER
from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.parts.turn.pairs import Bounds, Intervals, Pair, Pose, Window, raised

if TYPE_CHECKING:
    from geneva_cli.kinds.spherical.gaps import BallGaps

STEP = math.radians(1.0)  # greatest turn of a piece of the crank


class SpherePairs:
    """Pairs of parts on a sphere."""

    def __init__(self, gaps: BallGaps, crank: Sequence[Region], target: float) -> None:
        self.gaps, self.crank, self.target = gaps, crank, target
        self.ball = gaps.ball

    def lock(self, window: Window) -> Pair:
        """Return the crank's locking sectors and the wheel, in a motion or dwell."""
        return Lock(self, window)

    def free(self, roller: int, window: Window) -> Pair:
        """Return a roller and the wheel, outside the slot that the roller drives."""
        return FreeRoller(self, roller, window)

    def driving(self, roller: int, span: tuple[float, float]) -> Pair:
        """Return a roller and the wheel, while it is in its slot between two input angles."""
        return DrivingRoller(self, roller, span)

    @cached_property
    def pieces(self) -> SphereArcs:
        """The crank in arcs of a degree, each of which is tested for being in the wheel."""
        return short_arcs(self.crank, STEP)

    @property
    def apart(self) -> float:
        """The distance up to which parts matter, radians."""
        return max(self.target, 0.0) / self.ball.radius_mm


class Roller:
    """A roller and the wheel."""

    def __init__(self, pairs: SpherePairs, number: int) -> None:
        self.pairs, self.number = pairs, number
        self.ball, self.gaps = pairs.ball, pairs.gaps

    def centre(self, pose: Pose) -> Array:
        """Return the centre in the wheel's frame, (n, 3)."""
        return about(pose.pins[:, self.number], -pose.wheel)

    def gap(self, on: Intervals) -> Array:
        """Return the gap to the wheel in the middle of intervals, mm."""
        return self.gaps.rollers(on.at_middle)[:, self.number]

    def travel(self, on: Intervals) -> Array:
        """Return how far the centre moves on the fixed sphere from the middle, radians."""
        return math.sin(self.ball.arm) * on.crank

    def along(self, path: FromCircle, centre: Array, half: Array, gap: Array) -> Array:
        """Return the gap of a roller whose centre moves along a circle, mm.

        In the middle of an interval it is at ``centre`` and has the gap ``gap``. On either side it
        moves by the azimuth ``half``.
        """
        off, middle = path.circle.seen(centre)
        aside = np.abs(off - path.circle.angle)
        from_wheel = self.ball.roller + gap / self.ball.radius_mm
        # An arc that is shorter than its middle's distance from the edge does not cross it.
        short = math.sin(path.circle.angle) * half + aside < from_wheel
        least = np.full(len(gap), -math.inf)
        free = path(middle[short], half[short]) - aside[short] - self.ball.roller
        least[short] = self.ball.radius_mm * free
        return least


class FreeRoller(Roller):
    """A roller outside the slot that it drives: the wheel's edge may be anywhere about it."""

    def __init__(self, pairs: SpherePairs, number: int, window: Window) -> None:
        super().__init__(pairs, number)
        self.rests = window.rests
        # the crank's axes in the frame of the resting wheel
        lead = np.full(3, self.gaps.assembly.wheel(np.array([window.start]))[0])
        x, y, axis = about(self.gaps.crank_frame, -lead)
        self.path = FromCircle(self.gaps.wheel, Circle(axis, x, y, self.ball.arm))

    def __call__(self, on: Intervals) -> Bounds:
        """Return the gap in the middle, less the roller's travel in the wheel's frame.

        While the wheel rests, the centre is also on its circle about the crank's axis.
        """
        centre, ball = self.centre(on.at_middle), self.ball
        away = polar(centre)
        # the wheel is within its rim's circle
        gap = np.maximum(self.gap(on), ball.radius_mm * (away - ball.rim - ball.roller))
        moved = self.travel(on) + np.sin(away) * on.wheel
        least = gap - ball.radius_mm * moved

        def on_circle(which: Whole) -> Array:
            return self.along(self.path, centre[which], on.crank[which], gap[which])

        return Bounds(gap, raised(least, self.rests & (least < self.pairs.target), on_circle))


class DrivingRoller(Roller):
    """A roller in its own slot: its centre is on the slot's meridian."""

    def __init__(self, pairs: SpherePairs, number: int, span: tuple[float, float]) -> None:
        super().__init__(pairs, number)
        middle = self.gaps.pose(np.array([0.5 * (span[0] + span[1])]))
        x, y, _ = self.centre(middle)[0]
        out = np.array((x, y, 0.0)) / math.hypot(x, y)
        across = np.array((-out[1], out[0], 0.0))
        self.path = FromCircle(self.gaps.wheel, Circle(across, np.array(POLE), out, QUARTER))

    def __call__(self, on: Intervals) -> Bounds:
        """Return the gap along the piece of the meridian that the centre may reach."""
        gap = self.gap(on)
        # the distance from the wheel's axis changes by no more than the roller moves
        along = self.along(self.path, self.centre(on.at_middle), self.travel(on), gap)
        return Bounds(gap, along)


class Lock:
    """The crank's locking sectors and the wheel: bounds up to ``SpherePairs.apart``.

    The wheel leaves a cap free about the middle of each recess. In the dwell and beside it, the
    part of the sectors that is within the wheel's rim lies in that cap.
    """

    def __init__(self, pairs: SpherePairs, window: Window) -> None:
        self.pairs, self.window = pairs, window
        self.ball, self.gaps = pairs.ball, pairs.gaps
        self.pieces = pairs.pieces
        # the middles of the recesses at both ends of the window, in the wheel's frame
        turn = self.gaps.assembly.wheel(np.array((window.start, window.end)))
        self.recesses = about(np.tile(self.gaps.crank_frame[2], (2, 1)), -turn)
        self.free, _ = self.gaps.to_wheel(self.recesses)

    def __call__(self, on: Intervals) -> Bounds:
        """Return the better of two bounds: from the gap, and from the recess's cap."""
        pairs, R = self.pairs, self.ball.radius_mm
        gap = self.gaps.locking(on.at_middle)
        # no point of a sphere moves farther than it turns
        least = gap - R * (on.wheel + self._travel(on))

        def in_recess(which: Whole) -> Array:
            return self._in_recess(on.at(which))

        least = raised(least, least < pairs.target, in_recess)
        return Bounds(gap, np.minimum(least, R * pairs.apart))

    def _travel(self, on: Intervals) -> Array:
        """Return how far points of the sectors move, and points as near to them, radians."""
        return math.sin(min(self.ball.lock + self.pairs.apart, QUARTER)) * on.crank

    def _in_recess(self, on: Intervals) -> Array:
        """Return how far the sectors stay within the cap of the nearer recess, mm."""
        ball, gaps = self.ball, self.gaps
        wheel, crank, _ = on.at_middle
        nearer = (on.middle - self.window.start >= self.window.end - on.middle).astype(int)
        offset = gaps.in_crank(about(self.recesses[nearer], wheel), crank)
        far = np.where(self._within_rim(on, crank), farthest(self.pieces, offset), 0.0)
        moved = math.sin(ball.axes) * on.wheel + np.hypot(*offset[:, :2].T) * on.crank
        return ball.radius_mm * (self.free[nearer] - far.max(axis=1) - moved)

    def _within_rim(self, on: Intervals, crank: Array) -> Mask:
        """Return a mask (n, k) of the pieces of the sectors that may come within the rim."""
        pole = np.tile(POLE, (len(crank), 1))
        height = self.gaps.in_crank(pole, crank) @ self.pieces.middle.T
        beyond = np.arccos(np.clip(height, -1.0, 1.0)) - self.pieces.size - self.ball.rim
        # an angle computed from its cosine is wrong by up to 1e-7 radians
        moved = self._travel(on)[:, None] + self.pairs.apart + 1e-7
        return beyond <= moved
