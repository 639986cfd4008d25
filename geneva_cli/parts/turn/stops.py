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

from collections.abc import Iterator, Sequence
from functools import cache, partial
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.motion.pivots import turned_points
from geneva_cli.numerics.arrays import Array, Mask, Whole

BLOCK = 1 << 18  # pairs of branches that are compared together
CONCENTRIC = 1e-9  # of the radius: an arc about the axis has one level

# What turns on a plane or on a sphere, whose own classes are those of a kind:
Outline: TypeAlias = Any  # Polyarc or SphereArcs
Region: TypeAlias = Any  # Contour, or a region of a sphere
Shape: TypeAlias = Any  # wheel and crank with their sizes and gaps: Outlines or TurnedShape
Lengths: TypeAlias = Any  # their sizes, mm; on a sphere arc lengths, except ``rim``
Clearances: TypeAlias = Any  # Gaps or BallGaps
Pairs: TypeAlias = Any  # FlatPairs or SpherePairs


class Pose(NamedTuple):
    """The positions of a machine's parts at n input angles."""

    wheel: Array  # (n,) radians
    crank: Array  # (n,) radians
    pins: Array  # (n, m, 2) of the m rollers, mm, or (n, m, 3), directions from a sphere's centre


class Branches(NamedTuple):
    """The rows of k branches, (10, k): pieces with one place at each level.

    ``size`` and ``excess`` describe the curve, as the motion needs it. ``ahead`` is the place of
    its centre, or of a line's foot. The branch is on the side ``sign`` of it, ``at_low`` and
    ``at_high`` away at its ends. A piece at one level has places up to ``half`` from ``ahead``.
    """

    row: Array  # the pose
    low: Array
    high: Array
    at_low: Array
    at_high: Array
    size: Array
    excess: Array
    ahead: Array
    sign: Array
    half: Array


# The poses of pairs of branches, the intervals of the wheel's angle, radians, at which they meet,
# levels at both ends, and the branches of the crank and of the wheel.
Meetings: TypeAlias = tuple[Whole, Array, Array, Array, Array, Array, Array]


class Stops:
    """Stops of a wheel about the origin, of its ``outline`` or of a sector that repeats.

    The outlines of the crank are in its own frame, with its axis at (L, 0). Of a branch, ``size``
    is the curvature, and ``excess`` how much farther from the origin the centre is than the radius;
    of a line the distance of its foot.
    """

    def __init__(
        self, outline: Outline, pitch: float, crank: Sequence[Outline], L: float, roller: float
    ) -> None:
        self.outline, self.pitch, self.crank, self.L = outline, pitch, crank, L
        self.roller = roller
        # branches of the wheel by how far they are inset: equal for all poses
        self.own = cache(partial(self.branches, outline, None))

    def first(self, pose: Pose, most: float, close: float) -> tuple[Array, Array]:
        """Return the stops of the wheel, turned back and turned on from n poses: (2, n) both.

        It turns until some parts overlap by more than ``close``, or by ``most`` radians. Besides
        this angle the pressure angle of a roller that stops it is returned, 0 for anything else.
        """
        n, count, size = pose.pins.shape
        wheel, inset = self.own(0.0), self.own(close)
        # both sides of each roller: those on the other one follow
        sides = np.tile(self.rollers(pose.pins.reshape(-1, size), close), 2)
        Branches(*sides).sign[n * count :] = -1.0
        each, levels = self._blocked(sides, wheel, np.repeat(pose.wheel, count), most)
        lock = np.full((2, n), most)
        for outline in self.crank:
            sides, corners = self.branches(outline, pose.crank, close), self.corners(outline, pose)
            lock = np.minimum(lock, self._blocked(sides, wheel, pose.wheel, most)[0])
            lock = np.minimum(lock, self._blocked(corners, inset, pose.wheel, most)[0])
        each, levels = each.reshape(2, n, count), levels.reshape(2, n, count)
        which = np.argmin(each, axis=2)[..., None]
        lead = np.take_along_axis(each, which, axis=2)[..., 0]
        level = np.take_along_axis(levels, which, axis=2)[..., 0]
        pins = np.take_along_axis(pose.pins[None], which[..., None], axis=2)[:, :, 0]
        with np.errstate(all="ignore"):
            lean = np.arcsin(np.minimum(np.abs(self.lean(level, pins, close)), 1.0))
        return np.minimum(lead, lock), np.where((lead < most) & (lead <= lock), lean, 0.0)

    def _blocked(
        self, others: Array, wheel: Array, turn: Array, most: float
    ) -> tuple[Array, Array]:
        """Return how far the wheel turns back and on until branches meet, and their level there."""
        leads, levels = np.full((2, len(turn)), most), np.zeros((2, len(turn)))
        for row, start, end, start_level, end_level, *_ in self.meetings(others, wheel):
            start, end = start - turn[row], end - turn[row]
            shift = self.pitch * np.round(0.5 * (start + end) / self.pitch)
            start, end = start - shift, end - shift
            for k, (near, far, level) in enumerate(
                ((-end, -start, end_level), (start, end, start_level))
            ):
                lead = np.where(far < 0.0, near + self.pitch, np.maximum(near, 0.0))
                hit = np.flatnonzero(lead < most)
                np.minimum.at(leads[k], row[hit], lead[hit])
                hit = hit[lead[hit] == leads[k, row[hit]]]
                levels[k, row[hit]] = level[hit]
        return leads, levels

    def meetings(self, others: Array, wheel: Array) -> Iterator[Meetings]:
        """Yield the intervals of the wheel's angle at which other branches meet the wheel's.

        The others are in the fixed frame, in n poses, and the wheel's in its own. An interval
        may be whole pitches away.
        """
        own, step = Branches(*wheel), max(1, BLOCK // max(1, wheel.shape[1]))
        for block in range(0, others.shape[1], step):
            some = others[:, block : block + step]
            one = Branches(*some)
            common = (one.low[:, None] <= own.high) & (one.high[:, None] >= own.low)
            i, j = np.nonzero(common)
            # take() keeps each row in one piece of memory
            crank_side, wheel_side = some.take(i, axis=1), wheel.take(j, axis=1)
            one, two = Branches(*crank_side), Branches(*wheel_side)
            ends = np.maximum(one.low, two.low), np.minimum(one.high, two.high)
            first = self.place(one, ends[0]) - self.place(two, ends[0])
            last = self.place(one, ends[1]) - self.place(two, ends[1])
            second = last > first
            low, high = np.minimum(first, last), np.maximum(first, last)
            at_low, at_high = np.where(second, *ends), np.where(second, *ends[::-1])
            bent = np.flatnonzero((one.size != 0.0) | (two.size != 0.0))
            arc = Branches(*crank_side.take(bent, axis=1))
            other = Branches(*wheel_side.take(bent, axis=1))
            with np.errstate(all="ignore"):
                for tangent in self.tangents(arc, other):
                    level = np.clip(np.nan_to_num(tangent), ends[0][bent], ends[1][bent])
                    here = self.place(arc, level) - self.place(other, level)
                    for least, at, less in (
                        (low, at_low, here < low[bent]),
                        (high, at_high, here > high[bent]),
                    ):
                        least[bent[less]], at[bent[less]] = here[less], level[less]
            row, spare = one.row.astype(int), one.half + two.half
            yield row, low - spare, high + spare, at_low, at_high, crank_side, wheel_side

    def rollers(self, centres: Array, inset: float) -> Array:
        """Return rollers about n centres in the fixed frame, as branches on one side of them."""
        far, ahead = np.hypot(*centres.T), np.arctan2(centres[:, 1], centres[:, 0])
        radius = self.roller - inset
        excess, zero = far - radius, 0.0 * far
        ends = np.abs(excess), far + radius, np.where(excess < 0.0, np.pi, 0.0), zero
        one = np.arange(len(far)), *ends, zero + 1.0 / radius, excess, ahead, zero + 1.0, zero
        return np.array(one)

    def corners(self, outline: Outline, pose: Pose) -> Array:
        """Return the convex corners of the crank in n poses, as branches of one level."""
        corners = np.column_stack((outline.x0, outline.y0))[outline.turn_start > 0.0]
        n, k = len(pose.crank), len(corners)
        x, y = turned_points(np.tile(corners, (n, 1)), np.repeat(pose.crank, k)).T
        level, zero = np.hypot(self.L + x, y), np.zeros(n * k)
        ahead, row = np.arctan2(y, self.L + x), np.repeat(np.arange(n), k)
        return np.array((row, level, level, zero, zero, zero, level, ahead, zero, zero))

    def branches(self, outline: Outline, angle: Array | None, inset: float) -> Array:
        """Return the branches ``inset`` mm inside an outline of the crank at n angles.

        Without ``angle`` it is that of the wheel, in its own frame.
        """
        axis, turn = np.zeros((1, 2)), np.zeros(1)
        if angle is not None:  # the wheel's axis as seen from the crank
            axis, turn = turned_points(np.tile((-self.L, 0.0), (len(angle), 1)), -angle), angle
        *_, side, _, _ = outline.distances(axis[:, :1], axis[:, 1:])
        side = side - inset
        towards = np.arctan2(outline.my, outline.mx) + turn[:, None]
        points, trims, radii = inset_ends(outline, inset)
        seen = points - axis[:, None]  # (2, n, k, 2)
        px, py = seen[..., 0], seen[..., 1]
        i = np.flatnonzero(outline.arc)
        left, radius, zero = outline.sense[i] > 0.0, radii[i], 0.0 * side[:, i]
        x, y = outline.cx[i] - axis[:, :1], outline.cy[i] - axis[:, 1:]
        far, mx, my = np.hypot(x, y), outline.mx[i], outline.my[i]
        same = far < CONCENTRIC * radius
        excess, bend = np.where(left, -side[:, i], side[:, i]), zero + 1.0 / radius
        middle = np.arctan2(x * my - y * mx, x * mx + y * my)
        half, at = np.arctan2(outline.sin_half[i], outline.cos_half[i]), zero + radius
        own = zero, zero, bend, excess, towards[:, i], zero
        parts = [masked(same, at, at, *own, zero + half)]
        level, off = np.hypot(px, py)[..., i], np.abs(x * py[..., i] - y * px[..., i])
        known = np.stack((level, np.arctan2(off, x * px[..., i] + y * py[..., i])))
        nearest = np.abs(excess), np.where(excess < 0.0, np.pi, 0.0)
        known = np.where(left, known, known[:, ::-1])
        trim = np.where(left, trims[:, i], trims[::-1, i]) / radius
        span = middle - half + trim[0], middle + half - trim[1]
        curve = bend, excess, towards[:, i] - middle
        parts += cut(~same, span, known, np.array((nearest, (far + radius, zero))), curve)
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
        return np.concatenate(parts, axis=1)

    def place(self, branch: Branches, level: Array) -> Array:
        """Return the places of branches at levels."""
        away = np.where(level <= branch.low, branch.at_low, self.away(branch, level))
        # near its nearest or farthest point a piece's level tells little of its place
        return branch.ahead + branch.sign * np.where(level >= branch.high, branch.at_high, away)

    def away(self, branch: Branches, level: Array) -> Array:
        """Return how far places of branches are from those of their centres, at levels inside."""
        bend, excess = branch.size, branch.excess
        twice = 2.0 + bend * excess
        sine = (twice - bend * level) * (level - excess)
        cosine = (twice + bend * level) * (level + excess)
        return 2.0 * np.arctan2(np.sqrt(np.maximum(sine, 0.0)), np.sqrt(np.maximum(cosine, 0.0)))

    def tangents(self, one: Branches, two: Branches) -> tuple[Array, Array]:
        """Return the levels at which branches may be tangent."""
        p = one.excess * (2.0 + one.size * one.excess)
        q = two.excess * (2.0 + two.size * two.excess)
        return np.sqrt((p + q) / (one.size + two.size)), np.sqrt((p - q) / (one.size - two.size))

    def lean(self, level: Array, pins: Array, close: float) -> Array:
        """Return the sine of the pressure angle where rollers touch, ``close`` mm inside them."""
        radius, square = self.roller - close, (pins * pins).sum(axis=-1)
        out = (level * level + radius * radius - square) / (2.0 * radius)  # along the normal
        return (out + close) / np.sqrt(level * level + close * (2.0 * out + close))


def cut(
    mask: Mask, span: Sequence[Array], known: Array, extremes: Array, curve: Sequence[Array]
) -> list[Array]:
    """Return branches of the arcs of a mask (n, k), cut at their nearest and farthest points.

    ``span`` has the angles of both ends about an arc's centre, from the farthest point on. There
    ``known`` (2, 2, n, k) has the levels, and their angles from the place of the centre, and
    ``extremes`` has both at the nearest point and at the farthest. ``curve`` has size, excess and
    place of the centre.
    """
    (start, end), (least, most), zero, parts = span, extremes, 0.0 * curve[2], []
    for k in (-2, -1, 0, 1, 2):
        sign = 1.0 if k % 2 == 0 else -1.0
        first, last = (most, least) if sign > 0.0 else (least, most)
        low, high = k * np.pi, (k + 1) * np.pi
        a, b = np.where(start > low, known[:, 0], first), np.where(end < high, known[:, 1], last)
        there, rises = np.maximum(start, low) < np.minimum(end, high), a[0] <= b[0]
        (below, at_low), (above, at_high) = np.where(rises, a, b), np.where(rises, b, a)
        arc = below, above, at_low, at_high, *curve, zero + sign, zero
        parts.append(masked(mask & there, *arc))
    return parts


def masked(mask: Mask, *columns: Array) -> Array:
    """Return branches where a mask (n, k) is True; their rows are the poses."""
    rows = np.nonzero(mask)[0]
    out = np.empty((1 + len(columns), len(rows)))
    out[0] = rows
    for line, column in zip(out[1:], columns, strict=True):
        line[:] = column[mask]
    return out


def inset_ends(outline: Polyarc, inset: float) -> tuple[Array, Array, Array]:
    """Return both ends of the k pieces ``inset`` mm inside an outline, (2, 1, k, 2), mm.

    With them go the lengths by which they are shorter there, (2, k), and the radii.
    """
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
    return np.array(points)[:, None], trims, outline.radius - outline.sense * inset
