"""The gaps between wheel, crank and rollers at given positions.

Two boundaries are nearest to each other at a corner of one of them, or where their normals
coincide: on an arc in the direction of the other arc's centre, or of the other line's normal; on a
line at the foot of the perpendicular from the other arc's centre. If they overlap, one of these
points lies inside the other outline. So no contact between two samples is missed.
"""

from __future__ import annotations

import copy
import math
from functools import partial
from typing import ClassVar

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.shapes import Contour, backwards
from geneva_cli.motion.pivots import turned_points
from geneva_cli.numerics.arrays import Array, Whole, blocks
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.stops import Lengths, Outline, Pose, Stops

NEAR = 0.02  # of the centre distance: wider gaps are returned as this
BLOCK = 1 << 17  # positions times pieces at a time: they stay in the processor's cache


class Gaps:
    """The gaps between one machine's wheel, crank and rollers at any positions.

    Of the sizes it needs ``roller``, ``rim`` and ``lock``. Of a wheel whose slots are all equal, a
    ``pitch`` apart, only one slot is compared with points ``around`` it, and with a crank whose
    axis is ``beside`` it.
    """

    STOPS: ClassVar[type[Stops]] = Stops
    wheel: Outline
    around: Outline
    beside: Outline
    crank: Outline  # None without locking surfaces

    def __init__(self, assembly: Assembly, sizes: Lengths, wheel: Contour, crank: list[Contour]):
        self.assembly, self.sizes, self.plane_motion = assembly, sizes, assembly.plane_motion
        self.wheel = Polyarc([wheel if assembly.sign > 0.0 else backwards(wheel)])
        self.near, self.rim = NEAR * assembly.L, sizes.rim
        self.crank = Polyarc(crank) if crank else None
        self.around = self.beside = one = self.wheel
        self.pitch, which, away = self.sector()
        if which is not None:
            moves, middles, one = self.plane_motion, self.wheel.middles, self.wheel.subset(which)
            place = moves.place(middles)
            self.around = self.wheel.subset(np.flatnonzero(np.abs(place) <= away))
            turn = np.clip(place, -0.5 * self.pitch, 0.5 * self.pitch)
            axis = moves.into(np.tile((moves.L, 0.0), (len(turn), 1)), -turn)
            near = np.hypot(*(middles - axis).T) - self.wheel.size <= sizes.lock + self.near
            self.beside = self.wheel.subset(np.flatnonzero(near))
        own = one, self.pitch or math.tau, self.crank, sizes.roller, self.plane_motion
        self.stops = self.STOPS(*own)

    def sector(self) -> tuple[float, Whole | None, float]:
        """Return the pitch of equal slots, the pieces of one, and places around it, radians.

        Of other slots there are none.
        """
        pitch = math.tau / len(self.assembly.slots)
        which = self.wheel.one_sector(pitch, SAME_LENGTH * self.assembly.L)
        reach = math.asin(min(1.0, (self.near + self.sizes.roller) / self.rim))
        return 0.0 if which is None else pitch, which, 1.5 * pitch + 2.0 * reach

    def with_crank(self, crank: list[Contour]) -> Gaps:
        """Return the gaps of this wheel and these rollers with another crank's outline."""
        out = copy.copy(self)
        out.stops = copy.copy(self.stops)
        out.crank = out.stops.crank = Polyarc(crank) if crank else None
        return out

    def pose(self, input_deg: Array) -> Pose:
        """Return the positions at input angles (n,), degrees."""
        assembly = self.assembly
        rollers = range(len(assembly.rollers))
        pins = np.stack([*map(partial(assembly.pin, input_deg=input_deg), rollers)], axis=1)
        crank = assembly.crank(input_deg, pins[:, 0])
        return Pose(assembly.wheel(input_deg), crank, pins)

    def to_wheel(self, points: Array) -> Array:
        """Return the distance of points in the wheel's frame from its outline, as ``signed``."""
        if self.pitch:
            slot = np.round(self.plane_motion.place(points) / self.pitch)
            points = self.plane_motion.into(points, self.pitch * slot)
        return self.around.signed(points)

    def rollers(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """Return the gap of each roller to the wheel, mm (n, m), negative where they overlap.

        The wheel is turned on by ``lead`` radians; wider gaps are returned as ``near`` mm.
        """
        near, r = self.near if near is None else near, self.sizes.roller
        centres = self.plane_motion.into(pose.pins, (pose.wheel + lead)[:, None])
        away = self.assembly.sign * (self.plane_motion.level(centres) - self.rim) - r
        out, close = np.full(away.shape, near), away < near
        out[close] = np.minimum(self.to_wheel(centres[close]) - r, near)
        return out

    def locking(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """Return the gap between the outlines of crank and wheel, mm (n,); see ``rollers``."""
        near = self.near if near is None else near
        out, turns, moves = np.full(len(pose.wheel), near), pose.wheel + lead, self.plane_motion
        reach = self.sizes.lock + near
        if self.crank is None:
            return out
        if self.pitch:
            turns = turns - self.pitch * np.round(turns / self.pitch)
        centres, probes = self.crank.centres, self.crank.probes
        for some in blocks(len(turns), max(1, BLOCK // len(self.beside))):
            turn, crank, gaps = turns[some], pose.crank[some], out[some]
            # Points of the wheel against the crank ...
            away = self.beside.middles - moves.into(moves.crank_axis, turn)[:, None]
            away = moves.scale * np.sqrt((away * away).sum(axis=-1))
            owner, piece = np.nonzero(away <= self.beside.size + reach)
            facing = moves.into(moves.from_crank(centres, crank), turn[:, None])
            row, points = self.beside.touching(piece, facing[owner])
            owner = owner[row]
            seen = moves.in_crank(moves.into(points, -turn[owner]), crank[owner])
            close = np.flatnonzero(moves.scale * np.hypot(seen[:, 0], seen[:, 1]) < reach)
            np.minimum.at(gaps, owner[close], self.crank.signed(seen[close]))
            # ... and corners of the crank against the wheel.
            corners = moves.into(moves.from_crank(probes, crank), turn[:, None])
            away = self.assembly.sign * (moves.level(corners) - self.rim)
            owner, which = np.nonzero(away < near)
            np.minimum.at(gaps, owner, self.to_wheel(corners[owner, which]))
        return out

    def swept(self, number: int, step_deg: float) -> tuple[Array, Array]:
        """Return the wheel's points, x and y on the crank, that enter its disc in a motion.

        The wheel is placed at steps of ``step_deg`` of the input: up to the middle of a mirrored
        motion of one roller.
        """
        engagement, behind = self.assembly.motions[number]
        count = max(2, math.ceil(engagement.motion_deg / step_deg)) + 1
        at = behind + np.linspace(engagement.entry_deg, engagement.exit_deg, count)
        if self.pitch and engagement.mirrored and len(self.assembly.motions) == 1:
            at = at[: (count + 1) // 2]
        L, lock, moves = self.assembly.L, self.sizes.lock, self.plane_motion
        # chords of arcs within 2e-6 of the centre distance, and samples of lines 0.02 of it apart
        points = self.wheel.samples(2e-6 * L, 0.02 * L)
        points = points[np.hypot(*points.T) >= L - lock]
        turns, angles = self.assembly.wheel(at), self.assembly.crank(at)
        # only points that come near the direction of the crank's axis
        middle, half = 0.5 * (turns.min() + turns.max()), 0.5 * np.ptp(turns)
        place = np.abs(moves.place(moves.into(points, -middle)))
        points = points[place <= half + moves.half_span(lock, L)]
        reach, out = lock * (1.0 - 1e-7), [np.zeros((0, 2))]  # a smaller overlap counts as touching
        for some in blocks(len(at), max(1, BLOCK // max(1, len(points)))):
            off = points - moves.into(moves.crank_axis, turns[some])[:, None]
            owner, which = np.nonzero((off * off).sum(axis=-1) < reach * reach)
            out.append(turned_points(off[owner, which], (turns - angles)[some][owner]))
        x, y = np.concatenate(out).T
        return x, y
