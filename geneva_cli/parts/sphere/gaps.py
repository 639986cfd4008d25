"""The gaps between wheel, crank and rollers on a sphere, at given positions.

All walls lead to the sphere's centre, and so do the rollers' cones: gaps are angles seen from
there, given as arcs of the sphere, mm.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.curves.sphere import Region, opposite, place
from geneva_cli.curves.sphere_arcs import Arcs
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.sphere.crank import at_mid_motion
from geneva_cli.parts.sphere.sizes import Ball
from geneva_cli.parts.sphere.stops import WheelCaps, about, caps, polar, round_cap
from geneva_cli.parts.sphere.wheel import edge
from geneva_cli.parts.turn.touch import stopped
from geneva_cli.parts.turn.turned import Pose, Stopped

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

NEAR = 0.02  # radians: wider gaps are not told apart
BESIDE = 1e-6  # of an arc: beside a corner, which may lie on an edge where all else overlaps
SHARES = (0.0, BESIDE, 0.5, 1.0 - BESIDE)  # of an arc: where it is looked at
ROUNDING = 1e-7  # radians, of a cosine's angle


class BallGaps:
    """The gaps between one machine's wheel, crank and rollers at any positions."""

    def __init__(self, assembly: Assembly, found: Ball, sectors: list[Region]) -> None:
        self.assembly, self.found = assembly, found
        self.near = NEAR * found.radius_mm
        every = [arc for k in range(found.z) for arc in edge(found, 2 * k * found.half_step)]
        self.wheel = Arcs(every)
        self.around = Arcs(edge(found), closed=False)  # one slot, which is as all others are
        self.sectors = [Arcs(region.boundary) for region in sectors]
        self._turning = WheelCaps(self.around, 2.0 * found.half_step)
        self._roller = round_cap(found.roller)
        self._sides = caps(self.sectors) if self.sectors else None
        self._frame = np.array(at_mid_motion(found))  # rows: its axes in the wheel's frame
        self._rollers = np.array([place(found.arm, azimuth) for azimuth in found.rollers])
        corners = [
            one.at(np.arange(len(one)), share * one.sweep)
            for one in self.sectors
            for share in SHARES
        ]
        self._corners = np.concatenate(corners) if corners else np.zeros((0, 3))
        # What the sectors' edges are about, opposite ways alike: the crank's axis, and the poles
        # of their sides.
        axes = {max(a.axis, opposite(a.axis)) for region in sectors for a in region.boundary}
        self._facing = np.array(sorted(axes))

    def begin(self) -> None:
        """Nothing is counted: a sphere's edges are few."""

    def pose(self, input_deg: Array) -> Pose:
        """The positions at input angles (n,), degrees."""
        turn = np.radians(input_deg)
        pins = np.stack([self._out(one, turn) for one in self._rollers], axis=1)
        return Pose(self.assembly.wheel(input_deg), turn, pins)

    def gap(self, pose: Pose, lead: Array, near: float) -> Array:
        """The smallest gap, mm (n,), the wheel turned by ``lead``, radians; see ``rollers``."""
        rolling = self.rollers(pose, lead, near).min(axis=1)
        out: Array = np.minimum(self.locking(pose, lead, near), rolling)
        return out

    def rollers(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """The gap of each roller, (n, m), in n poses with the wheel turned on by ``lead``.

        ``lead`` is in radians; gaps wider than ``near`` mm, of ``self.near`` as a rule, are given
        as that.
        """
        near = self.near if near is None else near
        columns = []
        for i in range(pose.pins.shape[1]):
            away, _ = self._to_wheel(about(pose.pins[:, i], -(pose.wheel + lead)))
            columns.append(self.found.radius_mm * (away - self.found.roller))
        out: Array = np.minimum(np.column_stack(columns), near)
        return out

    def repeats(self, count: int) -> bool:
        """Whether wheel and crank are as before after a slot and a turn over ``count``."""
        first, step = self.sectors[:1], 2.0 * np.pi / count
        return len(self.sectors) in (0, count) and all(
            np.abs(about(one.middle, np.full(len(one), -k * step)) - sector.middle).max()
            < SAME_ANGLE
            and np.abs(one.sweep - sector.sweep).max() < SAME_ANGLE
            for one in first
            for k, sector in enumerate(self.sectors)
        )

    def stops(self, pose: Pose, most: float, close: float) -> tuple[Stopped, Stopped]:
        """How far the wheel can be turned until parts overlap by ``close`` mm; see ``Gapped``."""
        deep, wheel, rolling, locking = close / self.found.radius_mm, pose.wheel, [], []
        for i in range(pose.pins.shape[1]):
            one, axis = self._roller, pose.pins[:, i : i + 1]
            rolling.append(self._turning.touches(one, axis, _same, wheel, most, deep))
        if self._sides:
            axes = [self._out(axis, pose.crank) for axis in self._sides.axis]

            def on_crank(points: Array, n: NDArray[np.intp]) -> Array:
                return self._in_crank(points, pose.crank[n])

            axis = np.stack(axes, axis=1)
            locking.append(self._turning.touches(self._sides, axis, on_crank, wheel, most, deep))
        return stopped(rolling, locking, len(wheel), most)

    def locking(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """The gap between the locking sectors and the wheel, (n,); see ``rollers``."""
        near = self.near if near is None else near
        least = np.full(len(pose.wheel), near / self.found.radius_mm)
        if not len(self._facing):
            return near + 0.0 * pose.wheel
        turn = pose.wheel + lead
        # The wheel's edge against the sectors: its corners, and what faces their edges' axes ...
        axis = about(np.tile(self._frame[2], (len(turn), 1)), -turn)
        far = np.arccos(np.clip(axis @ self.wheel.middle.T, -1.0, 1.0)) - self.wheel.size
        owner, piece = np.nonzero(far <= self.found.lock + least[0] + ROUNDING)
        owners: list[NDArray[np.intp]] = []
        points: list[Array] = []
        for share in SHARES:
            owners.append(owner)
            points.append(self.wheel.at(piece, share * self.wheel.sweep[piece]))
        for one in self._facing:
            towards = about(self._out(one, pose.crank[owner]), -turn[owner])
            which, at = self.wheel.facing(piece, towards)
            owners.append(owner[which])
            points.append(at)
        which_ = np.concatenate(owners)
        seen = self._in_crank(about(np.concatenate(points), turn[which_]), pose.crank[which_])
        close = polar(seen) < self.found.lock + least[0]
        which_, seen = which_[close], seen[close]
        for sector in self.sectors if len(seen) else ():
            np.minimum.at(least, which_, sector.signed(seen)[0])
        # ... and the sectors' corners against the wheel.
        owner = np.repeat(np.arange(len(turn)), len(self._corners))
        corner = np.tile(self._corners, (len(turn), 1))
        at = about(self._out(corner, pose.crank[owner]), -turn[owner])
        here = np.flatnonzero(polar(at) - self.found.rim < least[owner])
        if len(here):
            np.minimum.at(least, owner[here], self._to_wheel(at[here])[0])
        return self.found.radius_mm * least

    def in_wheel(self, motion: int, input_deg: Array) -> Array:
        """The centre of a motion's roller in the wheel's frame, directions (n, 3)."""
        pose = self.pose(input_deg)
        return about(pose.pins[:, motion], -pose.wheel)

    def _to_wheel(self, points: Array) -> tuple[Array, Array]:
        """Distance of points in the wheel's frame from its edge, radians, and where it is nearest.

        Each is turned to the first slot, which is half of all that is as near.
        """
        step = 2.0 * self.found.half_step
        back = step * np.round(np.arctan2(points[:, 1], points[:, 0]) / step)
        away, foot = self.around.signed(about(points, -back))
        return away, about(foot, back)

    def _out(self, of_crank: Array, turn: Array) -> Array:
        """A direction in the crank's frame, or one for each, (n, 3), as it stands at crank angles.

        The crank turns clockwise about its axis where the wheel turns counterclockwise.
        """
        found: Array = about(np.broadcast_to(of_crank, (len(turn), 3)), -turn) @ self._frame
        return found

    def _in_crank(self, points: Array, turn: Array) -> Array:
        """Directions that stand still in the crank's frame."""
        return about(points @ self._frame.T, turn)


def _same(points: Array, _: NDArray[np.intp]) -> Array:
    return points
