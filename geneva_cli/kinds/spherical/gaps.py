"""The gaps between wheel, crank and rollers on a sphere, by their positions.

All walls lead to the sphere's centre, and so do the rollers' cones. So gaps are angles at the
centre; they are returned as arc lengths on the sphere, mm.
"""

from __future__ import annotations

import numpy as np

from geneva_cli.geometry.sphere import Region, opposite, place
from geneva_cli.geometry.sphere_arcs import SphereArcs
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.regions import at_mid_motion, edge
from geneva_cli.kinds.spherical.stops import SphereStops, about, polar
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.pairs import Pose, Stop

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
        self._stops = SphereStops(
            self.around, 2.0 * ball.half_step, self.sectors, self._out_each, ball.roller
        )
        self.crank_frame = np.array(at_mid_motion(ball))  # rows: the crank's axes, in the wheel's
        self._rollers = np.array([place(ball.arm, azimuth) for azimuth in ball.rollers])
        corners = [
            one.at(np.arange(len(one)), fraction * one.sweep)
            for one in self.sectors
            for fraction in ARC_SAMPLES
        ]
        self._corners = np.concatenate(corners) if corners else np.zeros((0, 3))
        # The axes of the sectors' edges, opposite ones counted once: the crank's axis, and the
        # poles of their sides.
        axes = {max(a.axis, opposite(a.axis)) for region in sectors for a in region.boundary}
        self._facing = np.array(sorted(axes))

    def pose(self, input_deg: Array) -> Pose:
        """Return the positions at input angles (n,), degrees."""
        turn = np.radians(input_deg)
        pins = np.stack([self._out(one, turn) for one in self._rollers], axis=1)
        return Pose(self.assembly.wheel(input_deg), turn, pins)

    def rollers(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """Return the gap of each roller, mm (n, m), with the wheel turned on by ``lead`` radians.

        Gaps wider than ``near`` mm, by default ``self.near``, are returned as ``near``.
        """
        near = self.near if near is None else near
        columns = []
        for i in range(pose.pins.shape[1]):
            away = self.to_wheel(about(pose.pins[:, i], -(pose.wheel + lead)))
            columns.append(self.ball.radius_mm * (away - self.ball.roller))
        return np.minimum(np.column_stack(columns), near)

    def repeats(self, count: int) -> bool:
        """Return True if the parts coincide with themselves after one slot and 1/``count`` turn."""
        first, step = self.sectors[:1], 2.0 * np.pi / count
        return len(self.sectors) in (0, count) and all(
            np.abs(about(one.middle, np.full(len(one), -k * step)) - sector.middle).max()
            < SAME_ANGLE
            and np.abs(one.sweep - sector.sweep).max() < SAME_ANGLE
            for one in first
            for k, sector in enumerate(self.sectors)
        )

    def stops(self, pose: Pose, most: float, close: float) -> tuple[Stop, Stop]:
        """Return the stops of the wheel, turned back and on, as ``Clearances`` describes."""
        return self._stops.first(pose, most, close / self.ball.radius_mm)

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
        """Return the centre of a motion's roller in the wheel's frame, directions (n, 3).

        The wheel is turned on by ``lead`` radians.
        """
        pose = self.pose(input_deg)
        return about(pose.pins[:, motion], -(pose.wheel + lead))

    def to_wheel(self, points: Array) -> Array:
        """Return the distances of points in the wheel's frame from its edge, radians.

        Each is turned to the first slot's sector, whose edge is nearest.
        """
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
