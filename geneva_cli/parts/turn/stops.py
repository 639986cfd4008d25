"""How far a wheel can turn until its outline meets others: exact intervals of its angle.

A wheel's motion leaves the level of its points, their distance from the axis, and changes their
place, the polar angle. Each piece of an outline is cut where its level is least or greatest, so
that each branch has one place at a level. A branch of the wheel and one of another outline meet at
the differences of their places at common levels: an interval of the wheel's angle. Its ends are at
an end of the common levels, where a corner touches, or where both are tangent, in closed form. The
wheel is free up to the first interval on either side. For a rack levels are positions across it.
A sphere is projected on a plane: circles stay circles, and places stay.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache, partial
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.motion.pivots import PlaneMotion
from geneva_cli.numerics.arrays import Array, Mask, Whole, blocks

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


# size, excess and ahead of k ``Branches`` in n poses, (n, k) each
Curve: TypeAlias = tuple[Array, Array, Array]
# The k pieces of an outline in n poses, run counterclockwise about their centres: levels of both
# ends, and how far their places are from that of the centre, (2, 2, n, k); angles of the ends about
# the centre, from the nearest point on; the curves; and a mask of those that have one level only,
# whose ``ahead`` is the place of the middle.
Pieces: TypeAlias = tuple[Array, Array, Curve, Mask]
# The poses of pairs of branches, the intervals of the wheel's angle, radians, at which they meet,
# levels at both ends, and the branches of the crank and of the wheel.
Meetings: TypeAlias = tuple[Whole, Array, Array, Array, Array, Array, Array]


class Stops:
    """Stops of a wheel about the origin, of its ``outline`` or of a sector that repeats.

    The outline of the crank, or None, is in its own frame. Of a branch, ``size`` is the curvature,
    and ``excess`` how much farther from the origin the centre is than the radius; of a line the
    distance of its foot.
    """

    def __init__(
        self, outline: Outline, pitch: float, crank: Outline, roller: float, moves: PlaneMotion
    ) -> None:
        self.outline, self.pitch, self.crank = outline, pitch, crank
        self.roller, self.moves = roller, moves
        # branches of the wheel by how far they are inset: equal for all poses
        self.own = cache(partial(self.branches, outline, None))

    def first(self, pose: Pose, most: float, close: float) -> tuple[Array, Array]:
        """Return the stops of the wheel, turned back and turned on from n poses: (2, n) both.

        It turns until some parts overlap by more than ``close`` mm, or by ``most`` radians. Besides
        this angle the pressure angle of a roller that stops it is returned, 0 for anything else.
        """
        (n, _, size), close = pose.pins.shape, close / self.moves.scale
        wheel, inset = self.own(0.0), self.own(close)
        lead, lean = self._blocked(self.rollers(pose.pins, close), wheel, pose.wheel, most, close)
        lock = np.full((2, n), most)
        if self.crank is not None:
            # convex corners are branches of one level
            corners = self.crank.starts[self.crank.turn_start > 0.0]
            points = self.moves.from_crank(corners, pose.crank).reshape(-1, size)
            level, at = self.moves.level(points), self.moves.place(points)
            row, zero = np.repeat(np.arange(n), len(corners)), 0.0 * level
            corners = np.array((row, level, level, zero, zero, zero, level, at, zero, zero))
            sides = self.branches(self.crank, pose.crank, close)
            for others, own in ((sides, wheel), (corners, inset)):
                lock = np.minimum(lock, self._blocked(others, own, pose.wheel, most, close)[0])
        return np.minimum(lead, lock), np.where((lead < most) & (lead <= lock), lean, 0.0)

    def _blocked(
        self, others: Array, wheel: Array, turn: Array, most: float, close: float
    ) -> tuple[Array, Array]:
        """Return how far the wheel turns back and on until branches meet, and how much they lean.

        That is the pressure angle of other branches, as of rollers ``close`` mm inside them.
        """
        leads, leans = np.full((2, len(turn)), most), np.zeros((2, len(turn)))
        for row, start, end, start_level, end_level, crank_side, _ in self.meetings(others, wheel):
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
                with np.errstate(all="ignore"):
                    lean = self.lean(level[hit], Branches(*crank_side.take(hit, axis=1)), close)
                leans[k, row[hit]] = np.arcsin(np.clip(np.abs(lean), 0.0, 1.0))
        return leads, leans

    def meetings(self, others: Array, wheel: Array) -> Iterator[Meetings]:
        """Yield the intervals of the wheel's angle at which other branches meet the wheel's.

        The others are in the fixed frame, in n poses, and the wheel's in its own. An interval
        may be whole pitches away.
        """
        own = Branches(*wheel)
        for block in blocks(others.shape[1], max(1, BLOCK // max(1, wheel.shape[1]))):
            some = others[:, block]
            one = Branches(*some)
            i, j = np.nonzero((one.low[:, None] <= own.high) & (one.high[:, None] >= own.low))
            # take() keeps each row in one piece of memory
            crank_side, wheel_side = some.take(i, axis=1), wheel.take(j, axis=1)
            one, two = Branches(*crank_side), Branches(*wheel_side)
            low, high = np.maximum(one.low, two.low), np.minimum(one.high, two.high)
            with np.errstate(all="ignore"):
                tangents = np.clip(np.nan_to_num(self.tangents(one, two)), low, high)
                levels = np.array((low, high, *tangents))
                turns = self.place(one, levels) - self.place(two, levels)
            levels = np.take_along_axis(levels, np.array((turns.argmin(0), turns.argmax(0))), 0)
            spare = one.half + two.half
            start, end = turns.min(axis=0) - spare, turns.max(axis=0) + spare
            yield one.row.astype(int), start, end, *levels, crank_side, wheel_side

    def rollers(self, pins: Array, inset: float) -> Array:
        """Return m rollers in n poses, (n, m, 2) in the fixed frame, as branches of both sides."""
        curve = self.circle(pins.reshape(-1, pins.shape[-1]), self.roller - inset)
        levels, away = self.extremes(curve)
        row = np.repeat(np.arange(len(pins)), pins.shape[1])
        sides = np.tile((row, *levels, *away, *curve), 2)
        sign = np.repeat((1.0, -1.0), len(row))
        return np.array((*sides, sign, 0.0 * sign))

    def branches(self, outline: Outline, angle: Array | None, inset: float) -> Array:
        """Return the branches ``inset`` mm inside an outline of the crank at n angles.

        Without ``angle`` it is that of the wheel, in its own frame.
        """
        known, span, curve, level = self.pieces(outline, angle, inset)
        half, known[1] = np.where(level, known[1, 0], 0.0), np.where(level, 0.0, known[1])
        # cut where they are nearest to the axis, or farthest: after half turns about the centre
        half_turns = np.arange(-2.0, 3.0)[:, None, None]
        start, end = np.where(level, 1.0, span[0]), np.where(level, 2.0, span[1])
        low, high = np.pi * half_turns, np.pi * (half_turns + 1.0)
        there, sign = np.maximum(start, low) < np.minimum(end, high), -((-1.0) ** half_turns)
        least, most = self.extremes(curve).swapaxes(0, 1)[:, :, None]
        first = np.where(start > low, known[:, 0, None], np.where(sign < 0.0, least, most))
        last = np.where(end < high, known[:, 1, None], np.where(sign < 0.0, most, least))
        rises = first[0] <= last[0]
        low, high = np.where(rises, (first, last), (last, first))
        rows = np.arange(there.shape[1])[:, None]
        columns = rows, low[0], high[0], low[1], high[1], *curve, sign, half
        out = np.empty((len(columns), np.count_nonzero(there)))
        for line, column in zip(out, columns, strict=True):
            line[:] = np.broadcast_to(column, there.shape)[there]
        return out

    def fixed(self, points: Sequence[Array], angle: Array | None) -> list[Array]:
        """Return points of the crank in the fixed frame at n angles, or the wheel's in its own."""
        if angle is None:
            return [each[None] for each in points]
        return [self.moves.from_crank(each, angle) for each in points]

    def circle(self, centres: Array, radius: float) -> Curve:
        """Return the curves of circles about n centres."""
        far = self.moves.level(centres)
        return 0.0 * far + 1.0 / radius, far - radius, self.moves.place(centres)

    def pieces(self, outline: Outline, angle: Array | None, inset: float) -> Pieces:
        """Return the pieces ``inset`` mm inside an outline; see ``branches``."""
        axis, turn = np.zeros((1, 2)), np.zeros(1)
        if angle is not None:  # the wheel's axis as seen from the crank
            axis, turn = self.moves.in_crank(axis, angle), angle
        *_, side, _, _ = outline.distances(axis[:, :1], axis[:, 1:])
        points, sweep, radius = inset_ends(outline, inset)
        seen = points[:, None] - axis[:, None]
        x, y = (outline.centres - axis[:, None]).transpose(2, 0, 1)
        level = outline.arc & (np.hypot(x, y) < CONCENTRIC * radius)
        # lines, and arcs about the axis, are on the ray through their feet or middles
        on_ray = ~outline.arc | level
        x, y = np.where(on_ray, 1e12 * outline.mx, x), np.where(on_ray, 1e12 * outline.my, y)
        u, v = seen[..., 0], seen[..., 1]
        across, along = x * v - y * u, x * u + y * v
        off, ahead = np.arctan2(np.abs(across), along), np.arctan2(y, x) + turn[:, None]
        first, last = np.arctan2(-across, x * x + y * y - along)
        span = np.array((first, np.where(outline.arc, first + sweep, last)))
        excess = np.where(outline.sense > 0.0, inset - side, side - inset)
        curve = 0.0 * side + 1.0 / radius, excess, ahead
        return np.array((self.moves.level(seen), off)), span, curve, level

    def extremes(self, curve: Curve) -> Array:
        """Return levels of nearest and farthest points, and how far they are from the centre's."""
        size, excess, _ = curve
        with np.errstate(divide="ignore"):
            ends = np.array((excess, excess + 2.0 / size))
        return np.array((np.abs(ends), np.where(ends < 0.0, np.pi, 0.0)))

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

    def lean(self, level: Array, side: Branches, close: float) -> Array:
        """Return the sine of the pressure angle where a round side touches, ``close`` mm inside."""
        radius = 1.0 / side.size
        far = side.excess + radius  # of the centre
        out = (level * level + radius * radius - far * far) / (2.0 * radius)  # along the normal
        return (out + close) / np.sqrt(level * level + close * (2.0 * out + close))


def inset_ends(outline: Polyarc, inset: float) -> tuple[Array, Array, Array]:
    """Return both ends of the k pieces ``inset`` mm inside an outline, (2, k, 2), mm.

    Arcs run counterclockwise about their centres, and lines about theirs, which are on their right.
    With them go the angles that they sweep, and the radii, infinite for lines.
    """
    turns = np.array((outline.turn_start, outline.turn_end))
    trims = inset * np.tan(0.5 * np.clip(turns, 0.0, 3.0))  # by which pieces are shorter there
    way, sense = np.array(((-1.0,), (1.0,))), np.where(outline.sense < 0.0, -1.0, 1.0)
    sine, cosine = way * outline.sin_half, sense * outline.cos_half
    # directions out of the material
    ux, uy = cosine * outline.mx - sine * outline.my, sine * outline.mx + cosine * outline.my
    x = np.array((outline.x0, outline.x1)) - inset * ux + way * trims * uy
    y = np.array((outline.y0, outline.y1)) - inset * uy - way * trims * ux
    ends = np.stack((x, y), axis=-1)
    ends = np.where(outline.sense[:, None] > 0.0, ends, ends[::-1])
    radius = np.where(outline.arc, outline.radius - outline.sense * inset, np.inf)
    sweep = 2.0 * np.arctan2(outline.sin_half, outline.cos_half) - trims.sum(axis=0) / radius
    return ends, sweep, radius
