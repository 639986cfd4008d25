"""The gaps between wheel, crank and rollers at given positions.

Two boundaries are nearest to each other at a corner of one of them, or where their normals
coincide: on an arc in the direction of the other arc's centre, or of the other line's normal; on a
line at the foot of the perpendicular from the other arc's centre. If they overlap, one of these
points lies inside the other outline. So no contact between two samples is missed.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Sequence

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.shapes import Contour, backwards
from geneva_cli.motion.pivots import turned_points
from geneva_cli.numerics.arrays import Array, Whole, blocks
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.stops import Lengths, Pose, Stops

NEAR = 0.02  # of the centre distance: wider gaps are returned as this


class Gaps:
    """The gaps between one machine's wheel, crank and rollers at any positions.

    Of the sizes it needs ``roller``, ``rim`` and ``lock``.
    """

    def __init__(self, assembly: Assembly, sizes: Lengths, wheel: Contour, crank: list[Contour]):
        self.assembly, self.sizes, self.plane_motion = assembly, sizes, assembly.plane_motion
        self.wheel = Polyarc([wheel if assembly.sign > 0.0 else backwards(wheel)])
        self.near = NEAR * assembly.L
        self.places = self.plane_motion.place(np.column_stack((self.wheel.ox, self.wheel.oy)))
        self.crank = Polyarc(crank) if crank else None
        # a wheel whose slots are all equal is reduced to one slot, and to it and its neighbours
        self.pitch, self.one, self.around = 0.0, self.wheel, self.wheel
        outline, pitch = self.wheel, math.tau / len(assembly.slots)
        which = outline.one_sector(pitch, SAME_LENGTH * assembly.L)
        if which is not None:
            self.pitch = pitch
            middle = np.arctan2(outline.y0 + outline.y1, outline.x0 + outline.x1)
            reach = math.asin(min(1.0, (self.near + sizes.roller) / sizes.rim))
            keep = np.flatnonzero(np.abs(middle) <= 1.5 * self.pitch + 2.0 * reach)
            self.one, self.around = outline.subset(which), outline.subset(keep)
        cranks = [] if self.crank is None else [self.crank]
        self.stops = Stops(self.one, self.pitch or math.tau, cranks, assembly.L, sizes.roller)

    def with_crank(self, crank: list[Contour]) -> Gaps:
        """Return the gaps of this wheel and these rollers with another crank's outline."""
        out = copy.copy(self)
        out.crank, out.stops = Polyarc(crank) if crank else None, copy.copy(self.stops)
        out.stops.crank = [] if out.crank is None else [out.crank]
        return out

    def pose(self, input_deg: Array) -> Pose:
        """Return the positions at input angles (n,), degrees."""
        assembly = self.assembly
        pins = np.empty((len(input_deg), len(assembly.rollers), 2))
        for i in range(len(assembly.rollers)):
            pins[:, i] = assembly.pin(i, input_deg)
        crank = assembly.crank(input_deg, pins[:, 0])
        return Pose(assembly.wheel(input_deg), crank, pins)

    def in_wheel(self, motion: int, input_deg: Array, lead: Array | float = 0.0) -> Array:
        """Return the centre of a motion's roller in the frame of the wheel, mm, (n, 2).

        The wheel is turned on by ``lead`` radians.
        """
        turn = self.assembly.wheel(input_deg) + lead
        return self.plane_motion.into(self.assembly.pin(motion, input_deg, drives=True), turn)

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
        near = self.near if near is None else near
        count, r = pose.pins.shape[1], self.sizes.roller
        out = np.full((len(pose.wheel), count), near)
        for i in range(count):
            centres = self.plane_motion.into(pose.pins[:, i], pose.wheel + lead)
            level = self.plane_motion.level(centres)
            far = self.assembly.sign * (level - self.sizes.rim) - r
            close = np.flatnonzero(far < near)
            out[close, i] = np.minimum(self.to_wheel(centres[close]) - r, near)
        return out

    def locking(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """Return the gap between the outlines of crank and wheel, mm (n,); see ``rollers``."""
        near = self.near if near is None else near
        out = np.full(len(pose.wheel), near)
        if self.crank is None:
            return out
        turns, moves, reach = pose.wheel + lead, self.plane_motion, self.sizes.lock + near
        half = moves.half_span(reach + float(self.wheel.size.max()), self.assembly.L)
        # pieces at so many positions at a time stay in the processor's cache
        for some in blocks(len(turns), max(1, (1 << 17) // len(self.wheel))):
            turn, gaps = turns[some], out[some]
            # Points of the wheel against the crank ...
            axis = moves.into(np.tile((self.assembly.L, 0.0), (len(turn), 1)), turn)
            nearby = _places_within(self.places, moves.PERIOD, -turn, half)
            angle = pose.crank[some] - moves.TURNS * turn
            owner, points = _candidates(self.wheel, nearby, self.crank, (axis, angle), reach)
            seen = turned_points(points - axis[owner], -angle[owner])
            np.minimum.at(gaps, owner, self.crank.signed(seen))
            # ... and corners of the crank against the wheel.
            x, y = self.crank.x0, self.crank.y0
            c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
            corners = np.stack((axis[:, :1] + x * c - y * s, axis[:, 1:] + x * s + y * c), axis=-1)
            inward = self.assembly.sign * (moves.level(corners) - self.sizes.rim)
            owner, which = np.nonzero(inward < near)
            if len(owner):
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
        places = moves.place(points)
        reach = lock * (1.0 - 1e-7)  # a smaller overlap counts as touching
        # only points near the direction of the crank's axis can be within reach of it
        half = moves.half_span(reach, L)
        step = max(1, (1 << 20) // len(points))  # 2^20 points at a time bound the memory
        xs, ys = [], []
        for begin in range(0, len(at), step):
            some = at[begin : begin + step]
            turn = self.assembly.wheel(some)
            owner, which = _places_within(places, moves.PERIOD, -turn, half)
            axis = moves.into(np.tile((L, 0.0), (len(turn), 1)), turn)
            x, y = (points[which] - axis[owner]).T
            inside = np.flatnonzero(x * x + y * y < reach * reach)
            x, y, owner = x[inside], y[inside], owner[inside]
            off = turn - self.assembly.crank(some)
            c, s = np.cos(off)[owner], np.sin(off)[owner]
            xs.append(x * c - y * s)
            ys.append(x * s + y * c)
        return np.concatenate(xs), np.concatenate(ys)


def _places_within(place: Array, period: float, middle: Array, half: float) -> tuple[Whole, Whole]:
    """Return the middles (n,) and places (k,), by index, that are within ``half`` of each other.

    The middles ascend. With a finite ``period``, a whole turn, places are directions.
    """
    turns = math.isfinite(period)
    if turns:
        place, middle, half = place % period, middle % period, min(half, 0.5 * period)
    order, known = np.argsort(place), np.sort(place)
    if turns:  # places a turn before and after, for spans across 0
        known = np.concatenate((known - period, known, known + period))
    start = np.searchsorted(known, middle - half - 1e-12)  # radians: rounding
    count = np.searchsorted(known, middle + half + 1e-12, "right") - start
    count = np.minimum(count, len(place))
    owner = np.repeat(np.arange(len(middle)), count)
    first = np.repeat(start - np.cumsum(count) + count, count)
    return owner, order[(first + np.arange(len(owner))) % len(place)]


def _candidates(
    own: Polyarc, near: tuple[Whole, Whole], other: Polyarc, placed: Sequence[Array], reach: float
) -> tuple[Whole, Array]:
    """Return points of ``own`` that may touch ``other``, within ``reach`` of its origin.

    ``placed`` has the n points of that origin and the n angles of ``other``; ``near`` selects
    pieces of ``own``, each after the index of its position. Returns that index of each point, and
    the points in the frame of ``own``.
    """
    (owner, piece), (origin, angle) = near, placed
    dx, dy = own.ox[piece] - origin[owner, 0], own.oy[piece] - origin[owner, 1]
    close = dx * dx + dy * dy <= (own.size[piece] + reach) ** 2
    owner, piece = owner[close], piece[close]
    c, s = np.cos(angle)[owner], np.sin(angle)[owner]
    # one row for each of the other's pieces, which are few: centres of arcs, normals of lines
    arcs, lines = np.flatnonzero(other.arc)[:, None], np.flatnonzero(~other.arc)[:, None]
    x, y = other.cx[arcs], other.cy[arcs]
    cx, cy = origin[owner, 0] + (c * x - s * y), origin[owner, 1] + (s * x + c * y)
    x, y = other.dy[lines], -other.dx[lines]
    nx, ny = c * x - s * y, s * x + c * y
    # the feet of perpendiculars from centres on lines
    flat = np.flatnonzero(~own.arc[piece])
    i = piece[flat]
    ax, ay = cx[:, flat] - own.x0[i], cy[:, flat] - own.y0[i]
    fraction = (ax * own.dx[i] + ay * own.dy[i]) / own.square[i]
    which, pair = np.nonzero((fraction > 0.0) & (fraction < 1.0))
    t, i = fraction[which, pair], i[pair]
    feet = own.x0[i] + t * own.dx[i], own.y0[i] + t * own.dy[i]
    owners, xs, ys = [owner, owner[flat[pair]]], [own.x0[piece], feet[0]], [own.y0[piece], feet[1]]
    # Points of arcs in the directions of centres and normals. Coordinates are from each arc's
    # centre, along its chord and outwards, over its radius. They are computed from the chord's
    # middle: the centre of a nearly straight arc is too far away.
    bent = np.flatnonzero(own.arc[piece])
    i = piece[bent]
    mx, my, half, bend = own.mx[i], own.my[i], 0.5 * own.length[i], 1.0 / own.radius[i]
    px, py, nx, ny = cx[:, bent] - own.ox[i], cy[:, bent] - own.oy[i], nx[:, bent], ny[:, bent]
    aside = np.concatenate((bend * (mx * py - my * px), mx * ny - my * nx))
    ahead = np.concatenate((bend * (mx * px + my * py) + own.cos_half[i], mx * nx + my * ny))
    size = np.maximum(np.sqrt(aside * aside + ahead * ahead), 1e-300)
    aside, ahead = aside / size, ahead / size
    for side in (1.0, -1.0):
        within = side * own.sin_half[i] * ahead >= own.cos_half[i] * np.abs(aside)
        which, pair = np.nonzero(within)
        k = i[pair]
        along = side * own.radius[k] * aside[which, pair]
        # the arc's height above its chord there: its middle's, less that by which it falls off
        falls = along**2 / (1.0 + side * ahead[which, pair])
        out = bend[pair] * (half[pair] ** 2 / (1.0 + own.cos_half[k]) - falls)
        owners.append(owner[bent[pair]])
        xs.append(own.ox[k] + out * own.mx[k] - along * own.my[k])
        ys.append(own.oy[k] + out * own.my[k] + along * own.mx[k])
    owner = np.concatenate(owners)
    points = np.column_stack((np.concatenate(xs), np.concatenate(ys)))
    inside = ((points - origin[owner]) ** 2).sum(axis=1) < reach * reach
    return owner[inside], points[inside]
