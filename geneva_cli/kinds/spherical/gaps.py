"""The gaps between wheel, crank and rollers on a sphere, and proved lower bounds of them.

All walls lead to the sphere's centre: gaps are angles there, returned as arc lengths on the sphere,
mm. A point at an angle r from an axis moves at most sin r times the angle by which its part turns
about it. A roller's path is exact: an arc about the crank's axis while the wheel rests, and a piece
of the meridian in its own slot.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from geneva_cli.geometry.sphere import POLE, Region, opposite, place
from geneva_cli.geometry.sphere_arcs import Circle, SphereArcs, farthest, from_circle, short_arcs
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.regions import QUARTER, at_mid_motion, edge
from geneva_cli.kinds.spherical.stops import SphereStops, about, polar
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.stops import Pose
from geneva_cli.parts.turn.turned_parts import Intervals, Window

STEP = math.radians(1.0)  # greatest turn of a piece of the crank, tested for being in the wheel
# Fractions of an arc at which it is sampled: its start and middle, and points next to its corners.
# A corner itself may lie on an edge where all else overlaps.
ARC_SAMPLES = (0.0, 1e-6, 0.5, 1.0 - 1e-6)


class BallGaps:
    """The gaps between one machine's wheel, crank and rollers at any positions."""

    def __init__(self, assembly: Assembly, ball: Ball, sectors: list[Region]) -> None:
        self.assembly, self.ball = assembly, ball
        self.near = 0.02 * ball.radius_mm  # wider gaps are returned as this
        edges = [arc for k in range(ball.z) for arc in edge(ball, 2 * k * ball.half_step)]
        self.wheel = SphereArcs(edges)
        self.around = SphereArcs(edge(ball), closed=False)  # one slot; all others are equal
        self.sectors = [SphereArcs(region.boundary) for region in sectors]
        self.stops = SphereStops(self.around, self.sectors, self._out_each, ball)
        self.crank_frame = np.array(at_mid_motion(ball))  # rows: the crank's axes, in the wheel's
        self._rollers = np.array([place(ball.arm, azimuth) for azimuth in ball.rollers])
        corners = [np.zeros((0, 3))]
        for one in self.sectors:
            corners += [one.at(np.arange(len(one)), share * one.sweep) for share in ARC_SAMPLES]
        self._corners = np.concatenate(corners)
        # The axes of the sectors' edges, opposite ones counted once: the crank's axis, and the
        # poles of their sides.
        axes = {max(a.axis, opposite(a.axis)) for region in sectors for a in region.boundary}
        self._facing = np.array(sorted(axes))

    def pose(self, input_deg: Array) -> Pose:
        """Return the positions at input angles (n,), degrees."""
        turn = np.radians(input_deg)
        return Pose(self.assembly.wheel(input_deg), turn, self._out_each(self._rollers, turn))

    def rollers(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """Return the gap of each roller, mm (n, m), at most ``near``."""
        near = self.near if near is None else near
        columns = []
        for i in range(pose.pins.shape[1]):
            away = self.to_wheel(about(pose.pins[:, i], -(pose.wheel + lead)))
            columns.append(self.ball.radius_mm * (away - self.ball.roller))
        return np.minimum(np.column_stack(columns), near)

    def locking(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """Return the gap between the locking sectors and the wheel, mm (n,); see ``rollers``."""
        near = self.near if near is None else near
        least = np.full(len(pose.wheel), near / self.ball.radius_mm)
        if not len(self._facing):
            return near + 0.0 * pose.wheel
        turn = pose.wheel + lead
        # The wheel's edge against the sectors: its corners, and points facing their edges' axes ...
        axis = about(np.tile(self.crank_frame[2], (len(turn), 1)), -turn)
        far = np.arccos(np.clip(axis @ self.wheel.middle.T, -1.0, 1.0)) - self.wheel.size
        # an angle computed from its cosine is wrong by up to 1e-7 radians
        owner, piece = np.nonzero(far <= self.ball.lock + least[0] + 1e-7)
        owners, sweep = [owner] * len(ARC_SAMPLES), self.wheel.sweep[piece]
        points = [self.wheel.at(piece, fraction * sweep) for fraction in ARC_SAMPLES]
        for one in self._facing:
            towards = about(self._out(one, pose.crank[owner]), -turn[owner])
            which, at = self.wheel.facing(piece, towards)
            owners.append(owner[which])
            points.append(at)
        which_ = np.concatenate(owners)
        on_crank = self.in_crank(about(np.concatenate(points), turn[which_]), pose.crank[which_])
        close = polar(on_crank) < self.ball.lock + least[0]
        which_, on_crank = which_[close], on_crank[close]
        for sector in self.sectors if len(on_crank) else ():
            np.minimum.at(least, which_, sector.signed(on_crank))
        # ... and the sectors' corners against the wheel.
        owner = np.repeat(np.arange(len(turn)), len(self._corners))
        corner = np.tile(self._corners, (len(turn), 1))
        at = about(self._out(corner, pose.crank[owner]), -turn[owner])
        here = np.flatnonzero(polar(at) - self.ball.rim < least[owner])
        if len(here):
            np.minimum.at(least, owner[here], self.to_wheel(at[here]))
        return self.ball.radius_mm * least

    def in_wheel(self, motion: int, input_deg: Array, lead: Array | float = 0.0) -> Array:
        """Return the centre of a motion's roller in the wheel's frame, mm, (n, 3)."""
        pose = self.pose(input_deg)
        return self.ball.radius_mm * about(pose.pins[:, motion], -(pose.wheel + lead))

    def to_wheel(self, points: Array) -> Array:
        """Return the distances of points in the wheel's frame from its edge, radians."""
        step = 2.0 * self.ball.half_step
        back = step * np.round(np.arctan2(points[:, 1], points[:, 0]) / step)
        return self.around.signed(about(points, -back))

    def _out(self, of_crank: Array, turn: Array) -> Array:
        """Return one or n directions of the crank's frame in the wheel's, at n crank angles."""
        # the crank turns clockwise about its axis where the wheel turns counterclockwise
        return about(np.broadcast_to(of_crank, (len(turn), 3)), -turn) @ self.crank_frame

    def _out_each(self, of_crank: Array, turn: Array) -> Array:
        """Return k directions of the crank's frame in the wheel's frame, at n angles, (n, k, 3)."""
        many = [self._out(one, turn) for one in of_crank]
        return np.stack(many, axis=1) if many else np.zeros((len(turn), 0, 3))

    def in_crank(self, points: Array, turn: Array) -> Array:
        """Return directions in the crank's frame at crank angles."""
        return about(points @ self.crank_frame.T, turn)


class SpherePairs:
    """Pairs of parts on a sphere, with gaps bounded up to ``target`` mm."""

    def __init__(self, gaps: BallGaps, crank: Sequence[Region], target: float) -> None:
        self.gaps, self.target, self.ball = gaps, target, gaps.ball
        self.apart = max(target, 0.0) / self.ball.radius_mm  # up to which parts matter, radians
        self.pieces = short_arcs(crank, STEP) if crank else None

    def lock(self, window: Window, on: Intervals) -> tuple[Array, Array]:
        """Return the gap of locking sectors and wheel: bounds up to ``apart``.

        The wheel leaves a cap free about the middle of each recess. In the dwell and beside it, the
        part of the sectors that is within the wheel's rim lies in that cap.
        """
        ball, gaps, pieces, gap = self.ball, self.gaps, self.pieces, self.gaps.locking(on.at_middle)
        # how far points of the sectors move, and points as near to them; no point of a sphere moves
        # farther than it turns
        sectors_travel = math.sin(min(ball.lock + self.apart, QUARTER)) * on.crank
        least = gap - ball.radius_mm * (on.wheel + sectors_travel)
        which = np.flatnonzero(least < self.target)
        if pieces is not None and len(which):
            wheel, crank = on.at_middle.wheel[which], on.at_middle.crank[which]
            # the middles of the recesses at both ends of the window, in the wheel's frame
            turn = gaps.assembly.wheel(np.array((window.start, window.end)))
            recesses = about(np.tile(gaps.crank_frame[2], (2, 1)), -turn)
            at = 0.5 * (on.start[which] + on.end[which])
            nearer = (at - window.start >= window.end - at).astype(int)
            offset = gaps.in_crank(about(recesses[nearer], wheel), crank)
            # the pieces of the sectors that may come within the rim; an angle computed from its
            # cosine is wrong by up to 1e-7 radians
            height = gaps.in_crank(np.tile(POLE, (len(crank), 1)), crank) @ pieces.middle.T
            beyond = np.arccos(np.clip(height, -1.0, 1.0)) - pieces.size - ball.rim
            inside = beyond <= sectors_travel[which][:, None] + self.apart + 1e-7
            far = np.where(inside, farthest(pieces, offset), 0.0)
            moved = math.sin(ball.axes) * on.wheel[which]
            moved = moved + np.hypot(*offset[:, :2].T) * on.crank[which]
            # how far the sectors stay within the cap of the nearer recess
            free = gaps.to_wheel(recesses)[nearer] - far.max(axis=1) - moved
            least[which] = np.maximum(least[which], ball.radius_mm * free)
        return gap, np.minimum(least, ball.radius_mm * self.apart)

    def roller(
        self, number: int, window: Window, span: tuple[float, float] | None, on: Intervals
    ) -> tuple[Array, Array]:
        """Return the gap of a roller in its slot between two angles, or outside the one it drives.

        Outside, the gap is that in the middle, less the roller's travel in the wheel's frame.
        """
        ball, gaps, pose, pins = self.ball, self.gaps, on.at_middle, on.at_middle.pins[:, number]
        centre, gap = about(pins, -pose.wheel), gaps.rollers(pose)[:, number]
        if span:
            middle = gaps.pose(np.array([0.5 * (span[0] + span[1])]))
            x, y, _ = about(middle.pins[:, number], -middle.wheel)[0]
            out = np.array((x, y, 0.0)) / math.hypot(x, y)
            circle = Circle(np.array((-out[1], out[0], 0.0)), np.array(POLE), out, QUARTER)
            # the distance from the wheel's axis changes by no more than the roller moves
            return gap, self._along(circle, centre, math.sin(ball.arm) * on.crank, gap)
        away = polar(centre)
        # the wheel is within its rim's circle
        beyond = ball.radius_mm * (away - ball.rim - ball.roller)
        gap = np.maximum(gap, beyond)
        travel = math.sin(ball.arm) * on.crank + np.sin(away) * on.wheel
        least = gap - ball.radius_mm * travel
        which = np.flatnonzero(least < self.target)
        if window.rests and len(which):
            # the crank's axes in the frame of the resting wheel
            lead = np.full(3, gaps.assembly.wheel(np.array([window.start]))[0])
            x, y, axis = about(gaps.crank_frame, -lead)
            circle = Circle(axis, x, y, ball.arm)
            closer = self._along(circle, centre[which], on.crank[which], gap[which])
            least[which] = np.maximum(least[which], closer)
        return gap, least

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
