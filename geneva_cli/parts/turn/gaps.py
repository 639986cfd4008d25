"""The gaps between wheel, crank and rollers at given positions."""

from __future__ import annotations

import copy
import math
from typing import Protocol

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.shapes import Contour, backwards
from geneva_cli.kept import cached_property
from geneva_cli.motion.plane_motion import turned_points
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.contacts import candidates, places_within
from geneva_cli.parts.turn.machine_parts import Lengths, WorkLimit
from geneva_cli.parts.turn.pairs import Pose, Stop
from geneva_cli.parts.turn.stops import Stops
from geneva_cli.parts.turn.turning_stops import TurningStops

NEAR = 0.02  # of the centre distance: wider gaps are returned as this
WORK = 1e8  # greatest number of distances between points and pieces in a full turn: about 5 s


class PlaneLengths(Lengths, Protocol):
    """Lengths of the parts of a machine in the plane, mm."""

    @property
    def lock(self) -> float:
        """Radius of the locking disc."""


class Gaps:
    """The gaps between one machine's wheel, crank and rollers at any positions."""

    def __init__(
        self, assembly: Assembly, sizes: PlaneLengths, wheel: Contour, crank: list[Contour]
    ):
        self.assembly, self.sizes, self.plane_motion = assembly, sizes, assembly.plane_motion
        self.wheel = Polyarc([wheel if assembly.sign > 0.0 else backwards(wheel)])
        self.near = NEAR * assembly.L
        self.left = math.inf
        self._sector()
        self.crank = Polyarc(crank) if crank else None

    def with_crank(self, crank: list[Contour]) -> Gaps:
        """Return the gaps of this wheel and these rollers with another crank's outline."""
        out = copy.copy(self)
        vars(out).pop("_stops", None)
        out.crank = Polyarc(crank) if crank else None
        return out

    def begin(self) -> None:
        """Count work from here on; raise WorkLimit when it exceeds WORK."""
        self.left = WORK

    def _work(self, count: int) -> None:
        self.left -= count
        if self.left < 0.0:
            raise WorkLimit(
                f"the full turn is not proved: it takes more than {WORK:.0e} distances between "
                "parts of so many pieces; a larger roller or horn takes less"
            )

    def _sector(self) -> None:
        """Reduce a wheel whose slots are all equal to one slot and its neighbours."""
        # the outline of an internal wheel runs clockwise
        count, sense = len(self.assembly.slots), self.assembly.sign
        repeats = _repeats(self.wheel, count, SAME_LENGTH * self.assembly.L, sense)
        self.pitch = math.tau / count if repeats else 0.0
        middle = np.arctan2(self.wheel.y0 + self.wheel.y1, self.wheel.x0 + self.wheel.x1)
        reach = math.asin(min(1.0, (self.near + self.sizes.roller) / self.sizes.rim))
        keep = np.flatnonzero(np.abs(middle) <= 1.5 * self.pitch + 2.0 * reach)
        self.around = self.wheel.subset(keep) if self.pitch else self.wheel

    def repeats(self, count: int) -> bool:
        """Return True if the parts coincide with themselves after one slot and 1/``count`` turn."""
        alike = self.crank is None or _repeats(self.crank, count, SAME_LENGTH * self.assembly.L)
        return bool(self.pitch) and alike

    def _to_wheel(self, points: Array) -> Array:
        """Return the distance of points in the wheel's frame from its outline, as ``signed``."""
        whole, at = self.wheel, points
        if self.pitch:
            slot = np.round(self.plane_motion.place(points) / self.pitch)
            whole, at = self.around, self.plane_motion.into(points, self.pitch * slot)
        self._work(len(at) * len(whole))
        return whole.signed(at)

    def pose(self, input_deg: Array) -> Pose:
        """Return the positions at input angles (n,), degrees."""
        pins = [self.assembly.pin(i, input_deg) for i in range(len(self.assembly.rollers))]
        crank = self.assembly.crank(input_deg, pins[0])
        return Pose(self.assembly.wheel(input_deg), crank, np.stack(pins, axis=1))

    def rollers(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """Return the gap of each roller, mm (n, m), with the wheel turned on by ``lead`` radians.

        Gaps wider than ``near``, by default NEAR * L, are returned as ``near``.
        """
        near = self.near if near is None else near
        turn = pose.wheel + lead
        columns: list[Array] = [
            self._roller(self.plane_motion.into(pose.pins[:, i], turn), near)
            for i in range(len(self.assembly.rollers))
        ]
        return np.column_stack(columns)

    def _roller(self, centres: Array, near: float) -> Array:
        """Return the gap of a roller centred at points in the wheel's frame."""
        r, sign = self.sizes.roller, self.assembly.sign
        far = sign * (self.plane_motion.level(centres) - self.sizes.rim) - r
        out: Array = np.minimum(far, near)
        close = far < near
        if close.any():
            out[close] = np.minimum(self._to_wheel(centres[close]) - r, near)
        return out

    def stops(self, pose: Pose, most: float, close: float) -> tuple[Stop, Stop]:
        """Return the stops of the wheel, turned back and on; see ``Stops.first``."""
        self._work(2 * len(pose.wheel) * len(self.wheel) * (1 + len(self.crank or ())))
        return self._stops.first(pose, most, close)

    @cached_property
    def _stops(self) -> Stops:
        each = len(self.wheel) // len(self.assembly.slots)
        one = self.wheel.subset(np.arange(each)) if self.pitch else self.wheel
        return TurningStops(
            one, self.pitch or math.tau, self.crank, self.assembly.L, self.sizes.roller
        )

    def locking(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """Return the gap between the outlines of crank and wheel, mm (n,); see ``rollers``."""
        near = self.near if near is None else near
        if self.crank is None:
            return np.full(len(pose.wheel), near)
        turn = pose.wheel + lead
        # Points of the wheel against the crank ...
        axis = self._axis(turn)
        self._work(len(axis) * len(self.wheel))
        reach, moves = self.sizes.lock + near, self.plane_motion
        half = moves.half_span(reach + float(self.wheel.size.max()), self.assembly.L)
        nearby = places_within(self._places, moves.PERIOD, -turn, half)
        angle = pose.crank - self.plane_motion.angle(turn)
        owner, points = candidates(self.wheel, nearby, self.crank, axis, angle, reach)
        seen = turned_points(points - axis[owner], -angle[owner])
        self._work(len(seen) * len(self.crank))
        out = _least(len(turn), owner, self.crank.signed(seen), near)
        # ... and corners of the crank against the wheel.
        x, y = self.crank.x0, self.crank.y0
        c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
        qx, qy = axis[:, :1] + x * c - y * s, axis[:, 1:] + x * s + y * c
        level = self.plane_motion.level(np.stack((qx, qy), axis=-1))
        inward = self.assembly.sign * (level - self.sizes.rim)
        owner, which = np.nonzero(inward < near)
        points = np.column_stack((qx[owner, which], qy[owner, which]))
        if len(points):
            signed = self._to_wheel(points)
            out = np.minimum(out, _least(len(turn), owner, signed, near))
        return out

    def swept(self, number: int, step_deg: float) -> tuple[Array, Array]:
        """Return the wheel's points that enter the locking disc during one motion, as x and y, mm.

        They are in the crank's frame. The wheel is placed at steps of ``step_deg`` degrees of the
        input. If the second half of a crank's only motion mirrors the first, only the first is
        returned.
        """
        engagement, behind = self.assembly.motions[number]
        count = max(2, math.ceil(engagement.motion_deg / step_deg)) + 1
        at = behind + np.linspace(engagement.entry_deg, engagement.exit_deg, count)
        if self.pitch and engagement.mirrored and len(self.assembly.motions) == 1:
            at = at[: (count + 1) // 2]
        turn, pose = self.assembly.wheel(at), self.assembly.crank(at)
        # 2^19 points of the wheel at a time fit into the cache
        step = max(1, (1 << 19) // len(self._wheel_points[0]))
        blocks = [
            self._within_disc(turn[i : i + step], pose[i : i + step])
            for i in range(0, len(at), step)
        ]
        x, y = zip(*blocks, strict=True)
        return np.concatenate(x), np.concatenate(y)

    def _within_disc(self, turn: Array, pose: Array) -> tuple[Array, Array]:
        """Return the wheel's points inside the locking disc, in the crank's frame, as x and y."""
        # an overlap below 1e-7 of the locking disc counts as touching
        reach = self.sizes.lock * (1.0 - 1e-7)
        # Only points near the direction of the crank's axis can be within reach of it.
        (points, places), moves = self._wheel_points, self.plane_motion
        half = moves.half_span(reach, self.assembly.L)
        owner, which = places_within(places, moves.PERIOD, -turn, half)
        px, py = points.T
        ax, ay = self._axis(turn).T
        x, y = px[which] - ax[owner], py[which] - ay[owner]
        inside = np.flatnonzero(x * x + y * y < reach * reach)
        x, y, owner = x[inside], y[inside], owner[inside]
        c, s = np.cos(turn - pose)[owner], np.sin(turn - pose)[owner]
        return x * c - y * s, x * s + y * c

    @cached_property
    def _wheel_points(self) -> tuple[Array, Array]:
        """Points along the wheel's outline that come near the locking disc, (n, 2), and places."""
        L = self.assembly.L
        # arcs: chords within 2e-6 of the centre distance
        # lines: samples at most 0.02 of it apart
        points = self.wheel.samples(2e-6 * L, 0.02 * L)
        points = points[np.hypot(*points.T) >= L - self.sizes.lock]
        return points, self.plane_motion.place(points)

    @cached_property
    def _places(self) -> Array:
        """Places of the pieces of the wheel's outline."""
        return self.plane_motion.place(np.column_stack((self.wheel.ox, self.wheel.oy)))

    def _axis(self, turn: Array) -> Array:
        """Return the crank's axis in the wheel's frame, (n, 2)."""
        return self.plane_motion.into(np.tile((self.assembly.L, 0.0), (len(turn), 1)), turn)


def _repeats(outline: Polyarc, count: int, near: float, sense: float = 1.0) -> bool:
    """Return True if the outline coincides with itself when turned by 1/``count`` turn."""
    each, rest = divmod(len(outline), count)
    if rest:
        return False
    corners = np.column_stack((outline.x0, outline.y0))
    angle = np.full(len(outline), math.tau / count * sense)
    same = np.abs(turned_points(np.roll(corners, each, axis=0), angle) - corners).max() < near
    bends = np.column_stack((outline.sense, outline.cos_half))
    return bool(same and np.abs(np.roll(bends, each, axis=0) - bends).max() < SAME_LENGTH)


def _least(count: int, owner: Whole, values: Array, most: float) -> Array:
    out = np.full(count, most)
    np.minimum.at(out, owner, values)
    return out
