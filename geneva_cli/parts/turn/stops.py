"""How far a wheel can turn until its outline meets others: exact intervals of its angle.

A wheel's motion leaves the level of its points, their distance from the axis, and changes their
place, the polar angle. Each piece of an outline is cut where its level is least or greatest, so
that each branch has one place at a level. A branch of the wheel and one of another outline meet at
the differences of their places at common levels: an interval of the wheel's angle. Its ends are at
an end of the common levels, where a corner touches, or where both are tangent, in closed form. The
wheel is free up to the first interval on either side. On a sphere levels are angles from the axis,
for a rack positions across it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.motion.plane_motion import turned_points
from geneva_cli.numerics.arrays import Array, Mask, Which, Whole
from geneva_cli.parts.turn.pairs import Pose, Stop

BLOCK = 1 << 18  # pairs of branches that are compared together
CONCENTRIC = 1e-9  # of the radius: an arc about the axis has one level


class Branches(NamedTuple):
    """Pieces with one place at each level, an array (k,) of each quantity.

    ``size`` and ``excess`` describe the curve, as the motion needs it. ``ahead`` is the place of
    its centre, or of a line's foot. The branch is on the side ``sign`` of it, ``at_low`` and
    ``at_high`` away at its ends. A piece at one level has places up to ``half`` from ``ahead``.
    """

    row: Whole  # the pose
    low: Array
    high: Array
    at_low: Array
    at_high: Array
    size: Array
    excess: Array
    ahead: Array
    sign: Array
    half: Array

    def at(self, which: Which) -> Branches:
        """Return some of the branches."""
        row, *columns = self
        return Branches(row[which], *(each[which] for each in columns))


class Meetings(NamedTuple):
    """Intervals of the wheel's angle, radians, where branches meet, and levels at both ends."""

    row: Whole  # the pose
    start: Array
    end: Array
    start_level: Array
    end_level: Array
    other: Branches
    wheel: Branches


def spread(branches: Branches) -> tuple[Array, Array]:
    """Return middles of the places of branches, radians, and bounds of their distance from them."""
    ends = branches.at_low, branches.at_high
    middle = branches.ahead + 0.5 * branches.sign * (ends[0] + ends[1])
    # an arc may be widest between its ends; 1 + size * excess is its centre's distance over radius
    far = np.maximum(1.0 + branches.size * branches.excess, 1.0)
    widest = np.arcsin(1.0 / far)
    wide = np.where(branches.size > 0.0, widest, 0.0)
    return middle, 0.5 * np.abs(ends[1] - ends[0]) + branches.half + wide


def cut(
    start: Array, end: Array, known: Array, extremes: Array
) -> Iterator[tuple[Mask, Array, Array, float]]:
    """Yield arcs cut at their nearest and farthest points: which, both ends, and the side.

    ``start`` and ``end`` are angles about an arc's centre, from the farthest point on. ``known``
    has the levels (2, n, k) of these ends, and their angles from the place of the centre.
    ``extremes`` has level and angle of the nearest point and of the farthest.
    """
    least, most = extremes
    for k in (-2, -1, 0, 1, 2):
        sign = 1.0 if k % 2 == 0 else -1.0
        first, last = (most, least) if sign > 0.0 else (least, most)
        low, high = k * np.pi, (k + 1) * np.pi
        a, b = np.where(start > low, known[:, 0], first), np.where(end < high, known[:, 1], last)
        there, rises = np.maximum(start, low) < np.minimum(end, high), a[0] <= b[0]
        yield there, np.where(rises, a, b), np.where(rises, b, a), sign


def masked(mask: Mask, *columns: Array) -> Branches:
    """Return branches where a mask (n, k) is True; their rows are the poses."""
    return Branches(np.nonzero(mask)[0], *(each[mask] for each in columns))


def merged(parts: Iterable[Branches]) -> Branches:
    """Return all branches of some parts."""
    return Branches(*(np.concatenate(each) for each in zip(*parts, strict=True)))


class Stops:
    """Stops of a wheel about the origin, of its ``outline`` or of a sector that repeats.

    The crank is in its own frame, with its axis at (L, 0). Of a branch, ``size`` is the curvature,
    and ``excess`` how much farther from the origin the centre is than the radius; of a line the
    distance of its foot.
    """

    def __init__(
        self, outline: Polyarc, pitch: float, crank: Polyarc | None, L: float, roller: float
    ) -> None:
        self.outline, self.pitch, self.crank, self.L = outline, pitch, crank, L
        self.roller = roller

    def first(self, pose: Pose, most: float, close: float) -> tuple[Stop, Stop]:
        """Return the stops of the wheel, turned back and turned on from n poses.

        It turns until some parts overlap by more than ``close``, or by ``most`` radians.
        """
        count = pose.pins.shape[1]
        wheel, inset = self.wheel(0.0), self.wheel(close)
        rollers = self.rollers(pose.pins.reshape(-1, pose.pins.shape[2]), close)
        leads, levels = self._blocked(rollers, wheel, np.repeat(pose.wheel, count), most)
        lock = np.full((2, len(pose.wheel)), most)
        for sides, corners in self.locking(pose.crank, close):
            for others, own in ((sides, wheel), (corners, inset)):
                lock = np.minimum(lock, self._blocked(others, own, pose.wheel, most)[0])
        leads, levels = leads.reshape(2, -1, count), levels.reshape(2, -1, count)
        which = np.argmin(leads, axis=2)[..., None]
        lead = np.take_along_axis(leads, which, axis=2)[..., 0]
        level = np.take_along_axis(levels, which, axis=2)[..., 0]
        pins = np.take_along_axis(pose.pins[None], which[..., None], axis=2)[:, :, 0]
        with np.errstate(all="ignore"):
            lean = np.arcsin(np.minimum(np.abs(self.lean(level, pins, close)), 1.0))
        pressure = np.where((lead < most) & (lead <= lock), lean, 0.0)
        back, on = (Stop(*each) for each in zip(np.minimum(lead, lock), pressure, strict=True))
        return back, on

    def _blocked(
        self, others: Branches, wheel: Branches, turn: Array, most: float
    ) -> tuple[Array, Array]:
        """Return how far the wheel turns back and on until branches meet, and their level there."""
        leads, levels = np.full((2, len(turn)), most), np.zeros((2, len(turn)))
        for met in self.meetings(others, wheel):
            start, end = met.start - turn[met.row], met.end - turn[met.row]
            shift = self.pitch * np.round(0.5 * (start + end) / self.pitch)
            start, end = start - shift, end - shift
            for k, (near, far, level) in enumerate(
                ((-end, -start, met.end_level), (start, end, met.start_level))
            ):
                lead = np.where(far < 0.0, near + self.pitch, np.maximum(near, 0.0))
                hit = np.flatnonzero(lead < most)
                np.minimum.at(leads[k], met.row[hit], lead[hit])
                hit = hit[lead[hit] == leads[k, met.row[hit]]]
                levels[k, met.row[hit]] = level[hit]
        return leads, levels

    def meetings(
        self, others: Branches, wheel: Branches, window: tuple[float, float] | None = None
    ) -> Iterator[Meetings]:
        """Yield the intervals of the wheel's angle at which other branches meet the wheel's.

        The others are in the fixed frame, in n poses, and the wheel's in its own. An interval
        may be whole pitches away, and must reach into a ``window``: angle and half width, radians.
        """
        step = max(1, BLOCK // max(1, len(wheel.low)))
        for block in range(0, len(others.low), step):
            some = others.at(slice(block, block + step))
            common = (some.low[:, None] <= wheel.high) & (some.high[:, None] >= wheel.low)
            if window is not None:
                (one_at, one_half), (two_at, two_half) = spread(some), spread(wheel)
                away = one_at[:, None] - two_at - window[0]
                away -= self.pitch * np.round(away / self.pitch)
                common &= np.abs(away) <= one_half[:, None] + two_half + window[1]
            i, j = np.nonzero(common)
            one, two = some.at(i), wheel.at(j)
            ends = np.maximum(one.low, two.low), np.minimum(one.high, two.high)
            place = [self.place(one, level) - self.place(two, level) for level in ends]
            second = place[1] > place[0]
            low, high = np.minimum(*place), np.maximum(*place)
            at_low, at_high = np.where(second, *ends), np.where(second, *ends[::-1])
            bent = np.flatnonzero((one.size != 0.0) | (two.size != 0.0))
            first, other = one.at(bent), two.at(bent)
            with np.errstate(all="ignore"):
                for tangent in self.tangents(first, other):
                    level = np.clip(np.nan_to_num(tangent), ends[0][bent], ends[1][bent])
                    here = self.place(first, level) - self.place(other, level)
                    for least, at, less in (
                        (low, at_low, here < low[bent]),
                        (high, at_high, here > high[bent]),
                    ):
                        least[bent[less]], at[bent[less]] = here[less], level[less]
            spare = one.half + two.half
            yield Meetings(one.row, low - spare, high + spare, at_low, at_high, one, two)

    def wheel(self, inset: float) -> Branches:
        """Return the branches of the wheel, ``inset`` mm within its outline, in its own frame."""
        return self.branches(self.outline, np.zeros((1, 2)), np.zeros(1), inset)

    def rollers(self, centres: Array, inset: float) -> Branches:
        """Return the branches of rollers about n centres, in the fixed frame."""
        far, ahead = np.hypot(*centres.T), np.arctan2(centres[:, 1], centres[:, 0])
        radius = self.roller - inset
        excess, zero = far - radius, 0.0 * far
        ends = np.abs(excess), far + radius, np.where(excess < 0.0, np.pi, 0.0), zero
        row, bend = np.arange(len(far)), zero + 1.0 / radius
        return merged(
            Branches(row, *ends, bend, excess, ahead, zero + sign, zero) for sign in (1.0, -1.0)
        )

    def locking(self, crank: Array, inset: float) -> Iterator[tuple[Branches, Branches]]:
        """Yield the branches of the crank at n angles: its sides and its convex corners."""
        if self.crank is None:
            return
        origin = np.tile((self.L, 0.0), (len(crank), 1))
        corners = np.column_stack((self.crank.x0, self.crank.y0))[self.crank.turn_start > 0.0]
        points = (origin[:, None] + rotated(corners, crank)).reshape(-1, 2)
        row = np.repeat(np.arange(len(crank)), len(corners))
        yield self.branches(self.crank, origin, crank, inset), self.points(row, points)

    def points(self, row: Whole, points: Array) -> Branches:
        """Return the branches of points (n, 2)."""
        level, zero = np.hypot(*points.T), np.zeros(len(points))
        ahead = np.arctan2(points[:, 1], points[:, 0])
        return Branches(row, level, level, zero, zero, zero, level, ahead, zero, zero)

    def branches(self, outline: Polyarc, origin: Array, angle: Array, inset: float) -> Branches:
        """Return the branches ``inset`` mm inside an outline at n places, turned by n angles."""
        axis = turned_points(-origin, -angle)
        side = outline.distances(axis[:, :1], axis[:, 1:]).side - inset
        towards = np.arctan2(outline.my, outline.mx) + angle[:, None]
        ends = inset_ends(outline, inset)
        seen = ends.points - axis[:, None]  # (2, n, k, 2)
        px, py = seen[..., 0], seen[..., 1]
        parts = []
        i = np.flatnonzero(outline.arc)
        left, radius, zero = outline.sense[i] > 0.0, ends.radius[i], 0.0 * side[:, i]
        x, y = outline.cx[i] - axis[:, :1], outline.cy[i] - axis[:, 1:]
        far, mx, my = np.hypot(x, y), outline.mx[i], outline.my[i]
        same = far < CONCENTRIC * radius
        excess, bend = np.where(left, -side[:, i], side[:, i]), zero + 1.0 / radius
        middle = np.arctan2(x * my - y * mx, x * mx + y * my)
        half, at = np.arctan2(outline.sin_half[i], outline.cos_half[i]), zero + radius
        own = zero, zero, bend, excess, towards[:, i], zero
        parts.append(masked(same, at, at, *own, zero + half))
        level, off = np.hypot(px, py)[..., i], np.abs(x * py[..., i] - y * px[..., i])
        known = np.stack((level, np.arctan2(off, x * px[..., i] + y * py[..., i])))
        extremes = np.array(
            ((np.abs(excess), np.where(excess < 0.0, np.pi, 0.0)), (far + radius, zero))
        )
        known = np.where(left, known, known[:, ::-1])
        trims = np.where(left, ends.trims[:, i], ends.trims[::-1, i]) / radius
        span = middle - half + trims[0], middle + half - trims[1]
        for there, low, high, sign in cut(*span, known, extremes):
            levels, angles = zip(low, high, strict=True)
            ahead = towards[:, i] - middle
            arc = *levels, *angles, bend, excess, ahead, zero + sign, zero
            parts.append(masked(there & ~same, *arc))
        i = np.flatnonzero(~outline.arc)
        foot, zero, inside = np.abs(side[:, i]), 0.0 * side[:, i], side[:, i] >= 0.0
        ahead = towards[:, i] + np.where(inside, 0.0, np.pi)
        along = outline.mx[i] * py[..., i] - outline.my[i] * px[..., i]
        along, level = np.where(inside, along, -along), np.hypot(px, py)[..., i]
        for sign in (1.0, -1.0):
            near, beyond = np.sort(sign * along, axis=0)
            low = np.where(near > 0.0, level.min(axis=0), foot)
            high = np.where(sign * along[0] > sign * along[1], level[0], level[1])
            angles = np.arctan2(np.maximum(near, 0.0), foot), np.arctan2(beyond, foot)
            line = low, high, *angles, zero, foot, ahead, zero + sign, zero
            parts.append(masked(beyond > 0.0, *line))
        return merged(parts)

    def place(self, branch: Branches, level: Array) -> Array:
        """Return the places of branches at levels."""
        bend, excess = branch.size, branch.excess
        twice = 2.0 + bend * excess
        sine = (twice - bend * level) * (level - excess)
        cosine = (twice + bend * level) * (level + excess)
        angle = 2.0 * np.arctan2(np.sqrt(np.maximum(sine, 0.0)), np.sqrt(np.maximum(cosine, 0.0)))
        # near its nearest or farthest point a piece's level tells little of its place
        angle = np.where(level <= branch.low, branch.at_low, angle)
        return branch.ahead + branch.sign * np.where(level >= branch.high, branch.at_high, angle)

    def tangents(self, one: Branches, two: Branches) -> Iterator[Array]:
        """Yield the levels at which branches may be tangent."""
        p, q = (each.excess * (2.0 + each.size * each.excess) for each in (one, two))
        yield np.sqrt((p + q) / (one.size + two.size))
        yield np.sqrt((p - q) / (one.size - two.size))

    def lean(self, level: Array, pins: Array, close: float) -> Array:
        """Return the sine of the pressure angle where rollers touch, ``close`` mm inside them."""
        radius, square = self.roller - close, (pins * pins).sum(axis=-1)
        out = (level * level + radius * radius - square) / (2.0 * radius)  # along the normal
        lean: Array = (out + close) / np.sqrt(level * level + close * (2.0 * out + close))
        return lean


class Ends(NamedTuple):
    """Pieces inside an outline: both ends of each, how much shorter they are there, and radii."""

    points: Array  # (2, 1, k, 2)
    trims: Array  # (2, k), mm
    radius: Array


def inset_ends(outline: Polyarc, inset: float) -> Ends:
    """Return the ends of pieces ``inset`` mm inside an outline."""
    turns = np.array((outline.turn_start, outline.turn_end))
    trims = inset * np.tan(0.5 * np.clip(turns, 0.0, 3.0))
    sense = np.where(outline.sense < 0.0, -1.0, 1.0)
    nx, ny, c = sense * outline.mx, sense * outline.my, outline.cos_half
    points = []
    for way, x, y, trim in (
        (-1.0, outline.x0, outline.y0, trims[0]),
        (1.0, outline.x1, outline.y1, -trims[1]),
    ):
        s = way * sense * outline.sin_half
        ux, uy = c * nx - s * ny, s * nx + c * ny  # out of the material
        points.append(np.column_stack((x - inset * ux - trim * uy, y - inset * uy + trim * ux)))
    return Ends(np.array(points)[:, None], trims, outline.radius - outline.sense * inset)


def rotated(points: Array, angle: Array) -> Array:
    """Return points (k, 2), turned by n angles, (n, k, 2)."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y = points.T
    return np.stack((c * x - s * y, s * x + c * y), axis=-1)
