"""The boundary of a curved slot: the outer boundary of all positions of its roller.

The roller comes along its circle while the wheel still rests. It runs into the slot and out again,
and leaves along its circle. Each of these paths has a wall on either side. Where the roller turns
back, its own outline is a wall too. Of all walls only those stretches remain that no other position
of the roller covers. Of these only the chain from one corner of the mouth round the bottom to the
other remains. An island between the paths in and out falls out of the wheel.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import fit
from geneva_cli.geometry.measure import mirrored
from geneva_cli.geometry.shapes import Contour, Segment, about, joined
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.numerics.roots import boundary_by_sections
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.path_walls import Wall, walls
from geneva_cli.parts.sizes import Sizes

# A wall ends at an intersection, whose last bits differ between processors, and many bits where two
# walls nearly touch. Ends are rounded: of curves in degrees of input, of arcs in radians. That is
# some 1e-7 mm of 100 mm.
STEP, ARC_STEP = 2.0**-24, 2.0**-30
REACH = 3  # samples within which two walls meet
FAR = 80  # samples in which their crossing is searched


class WallPiece(NamedTuple):
    """A part of a wall between two parameters, in either direction."""

    wall: Wall
    start: float
    end: float


class WallPlace(NamedTuple):
    """A sample on a wall, and the direction of travel: 1 with rising index, or -1."""

    wall: Wall
    i: int
    sense: int

    @property
    def t(self) -> float:
        """The parameter of the sample."""
        return float(self.wall.t[self.i])

    def within(self, t: float) -> float:
        """Return a parameter limited to the neighbourhood of the sample."""
        grid, i = self.wall.t, self.i
        low, high = grid[max(i - REACH, 0)], grid[min(i + REACH, len(grid) - 1)]
        return min(max(t, float(low)), float(high))

    def course(self, t: float) -> tuple[list[float], list[float], float]:
        """Return the wall's point and tangent at a parameter, and the point's speed with it."""
        step = 1e-6 * float(self.wall.t[-1] - self.wall.t[0])
        low, high = self.within(t - step), self.within(t + step)
        points, tangents = self.wall.curve(np.array([low, t, high]))
        before, here, after = points.tolist()
        speed = max(math.dist(before, after) / (high - low), 1e-12)
        return here, tangents[1].tolist(), speed


def curved_walls(
    assembly: Assembly, sizes: Sizes, engagement: Engagement, tolerance: float, curves: str = "arcs"
) -> Contour:
    """Return a curved slot's walls, counterclockwise from one corner of its mouth to the other.

    They are within ``tolerance`` mm of the true walls, and never inside them: the slot of a roller
    larger by half the tolerance is fitted. Raises GenevaError where the walls do not close.
    """
    half = 0.5 * tolerance
    runs: list[list[Segment]] = []
    larger = sizes._replace(half_width=sizes.half_width + half)
    pieces = chain(assembly, larger, walls(assembly, larger, engagement))
    for i, piece in enumerate(pieces):
        other = len(pieces) - 1 - i
        both = other < i and engagement.mirrored
        # walls count as mirror images within 1e-10 of the centre distance
        if both and _mirrors(pieces[other], piece, 1e-10 * assembly.L):
            runs.append(mirrored(runs[other]))
        else:
            runs.append(_segments(piece, half, curves))
    return Contour("WHEEL", joined(itertools.chain(*runs)), closed=False)


def chain(assembly: Assembly, sizes: Sizes, around: list[Wall]) -> list[WallPiece]:
    """Return the pieces of walls that bound a slot, from its mouth's lower corner to its upper."""
    rim = _Rim(assembly, sizes)
    crossings = [c for wall in around for c in rim.crossings(wall)]
    if not crossings:
        raise _lost()
    place, t = min(crossings, key=lambda c: math.atan2(*points_at(c[0].wall, c[1])[0][::-1]))
    pieces: list[WallPiece] = []
    for _ in range(64):  # many times the walls of any slot
        last, leaves = rim.run(place)
        if leaves is not None:
            pieces.append(WallPiece(place.wall, t, leaves))
            # shorter pieces are rounding
            return [p for p in pieces if math.dist(*points_at(*p)) > 1e-7 * assembly.L]
        following = _next(around, last)
        end, begin = _joint(last, following)
        pieces.append(WallPiece(place.wall, t, end))
        place, t = following, begin
    raise _lost()


def _lost() -> GenevaError:
    return GenevaError(
        "the walls of this slot do not close: the roller is too large, or the rim too small; "
        "reduce roller_radius_mm or increase wheel_radius_mm",
        ("size", "roller_radius_mm"),
    )


class _Rim:
    """The wheel's rim, as a test of the side on which points lie; on the rim counts as inside."""

    def __init__(self, assembly: Assembly, sizes: Sizes) -> None:
        self.sign, self.radius, self.close = assembly.sign, sizes.rim, 1e-9 * assembly.L

    def depth(self, points: Array) -> Array:
        """Return how far points lie inside the wheel."""
        return self.sign * (self.radius - np.hypot(points[..., 0], points[..., 1]))

    def crossings(self, wall: Wall) -> Iterator[tuple[WallPlace, float]]:
        """Yield where a wall enters the wheel: its first sample inside, and the parameter."""
        depth = self.depth(wall.points)
        inside = (depth > -self.close) & wall.free
        outside, last = depth <= -self.close, len(depth) - 1
        rises = np.flatnonzero(outside[:-1] & inside[1:]) + 1
        falls = np.flatnonzero(inside[:-1] & outside[1:])[::-1]
        for sense, first, entries in ((1, 0, rises), (-1, last, falls)):
            if inside[first] and depth[first] < self.close < depth[first + sense]:
                yield WallPlace(wall, first, sense), float(wall.t[first])
            for i in entries.tolist():
                yield WallPlace(wall, i, sense), self.crossing(wall, wall.t[i - sense], wall.t[i])

    def crossing(self, wall: Wall, outside: float, inside: float) -> float:
        """Return the parameter at which a wall crosses the rim."""
        return boundary_by_sections(
            lambda t: self.depth(wall.curve(t)[0]), float(inside), float(outside)
        )

    def run(self, place: WallPlace) -> tuple[WallPlace, float | None]:
        """Return the last free sample from a place on, and the parameter of leaving the rim."""
        wall, i, sense = place
        depth, free = self.depth(wall.points).tolist(), wall.free.tolist()
        while True:
            here, after = WallPlace(wall, i, sense), i + sense
            if not 0 <= after < len(wall.t):
                return here, here.t if depth[i] < self.close and i != place.i else None
            if depth[after] <= -self.close:
                return here, self.crossing(wall, wall.t[after], wall.t[i])
            if not free[after]:
                return here, None
            i = after


def _next(around: list[Wall], last: WallPlace) -> WallPlace:
    """Return the place where the next wall continues: on the nearest free wall but this one."""
    here = last.wall.points[last.i]
    travel = last.sense * last.wall.tangents[last.i]
    ahead = []
    for wall in around:
        for start, end in _runs(wall):
            if wall is last.wall and start <= last.i <= end:
                continue
            away = np.hypot(*(wall.points[start : end + 1] - here).T)
            i = int(np.argmin(away))
            ahead.append((float(away[i]), wall, start, start + i, end))
    best: tuple[float, int] | None = None
    place = None
    for far, wall, start, i, end in sorted(ahead, key=lambda one: one[0]):
        if best is not None and far > best[0]:
            break
        along = float((wall.tangents[i] * travel).sum())
        sense = 1 if i == start else -1 if i == end else (1 if along > 0.0 else -1)
        rest_of_run = end - i if sense > 0 else i - start
        score = (far, -rest_of_run)
        # Never turn back: walls that merge end in one point, in opposite directions.
        back = sense * along < -0.999
        if rest_of_run and not back and (best is None or score < best):
            best, place = score, WallPlace(wall, i, sense)
    if place is None:
        raise _lost()
    return place


def _joint(last: WallPlace, following: WallPlace) -> tuple[float, float]:
    """Return the parameters on both walls of the point where they meet."""
    a, b = last.t, following.t
    p, q = last.wall.points[last.i].tolist(), following.wall.points[following.i].tolist()
    at_ends = all(p.i in (0, len(p.wall.t) - 1) for p in (last, following))
    if at_ends and math.dist(p, q) < 1e-6 * max(1.0, math.hypot(*p)):
        return a, b
    met = _crossing(last, following)
    if met is not None:
        return met
    # They merge: continue from the point of the one to the nearest free point of the other.
    run = next((a, b) for a, b in _runs(following.wall) if a <= following.i <= b)
    low, high = (float(following.wall.t[i]) for i in run)
    for _ in range(8):
        q, v, speed = following.course(b)
        step = (p[0] - q[0]) * v[0] + (p[1] - q[1]) * v[1]
        b = min(max(following.within(b + step / speed), low), high)
    return a, b


def _crossing(last: WallPlace, following: WallPlace) -> tuple[float, float] | None:
    """Return the parameters on both walls of their crossing near two samples; None if none."""
    one, two = _window(last, -FAR, REACH), _window(following, -REACH, FAR)
    p, q = last.wall.points[one], following.wall.points[two]
    d, e = np.diff(p, axis=0), np.diff(q, axis=0)
    off = q[None, :-1] - p[:-1, None]
    cross = d[:, None, 0] * e[None, :, 1] - d[:, None, 1] * e[None, :, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (off[..., 0] * e[None, :, 1] - off[..., 1] * e[None, :, 0]) / cross
        t = (off[..., 0] * d[:, None, 1] - off[..., 1] * d[:, None, 0]) / cross
    i, j = np.nonzero((s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0))
    if not len(i):
        return None
    best = int(np.argmax(i))
    last = last._replace(i=int(one[i[best]]))
    following = following._replace(i=int(two[j[best]]))
    a, b = last.t, following.t
    for _ in range(50):
        (px, py), u, p_speed = last.course(a)
        (qx, qy), v, q_speed = following.course(b)
        x, y = qx - px, qy - py
        sine = u[0] * v[1] - u[1] * v[0]
        # walls at an angle below 1e-7 radians merge and do not cross
        if math.hypot(x, y) < 1e-12 * math.hypot(px, py) or abs(sine) < 1e-7:
            break
        a = last.within(a + (x * v[1] - y * v[0]) / sine / p_speed)
        b = following.within(b + (x * u[1] - y * u[0]) / sine / q_speed)
    # the points are one to 1e-7 of their distance from the wheel's axis
    return (a, b) if math.hypot(x, y) < 1e-7 * math.hypot(px, py) else None


def _window(place: WallPlace, behind: int, ahead: int) -> Whole:
    """Return the indices of samples around one, in the direction of travel."""
    indices = place.i + place.sense * np.arange(behind, ahead + 1)
    return indices[(indices >= 0) & (indices < len(place.wall.t))]


def points_at(wall: Wall, *t: float) -> list[list[float]]:
    """Return the points of a wall at some parameters."""
    return wall.curve(np.array(t))[0].tolist()


def _runs(wall: Wall) -> Iterator[tuple[int, int]]:
    """Yield first and last index of every stretch of free samples."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], wall.free, [False])).astype(int)))
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        yield int(start), int(end) - 1


def _mirrors(one: WallPiece, other: WallPiece, near: float) -> bool:
    """Return True if a piece is the other's mirror image in the slot's axis, run backwards."""
    there = points_at(one.wall, one.start, one.end, 0.5 * (one.start + one.end))
    back = points_at(other.wall, other.end, other.start, 0.5 * (other.start + other.end))
    pairs = zip(there, back, strict=True)
    return all(math.hypot(v - x, w + y) <= near for (x, y), (v, w) in pairs)


def _segments(piece: WallPiece, tolerance: float, curves: str) -> list[Segment]:
    wall, *ends = piece
    step = STEP if wall.centre is None else ARC_STEP
    a, b = (round(end / step) * step for end in ends)
    if wall.centre is not None:
        return [about(wall.centre, wall.radius, a, b - a)]
    fitted = fit.KINDS[curves]
    if a == b:
        if math.dist(*points_at(wall, *ends)) > tolerance:
            raise GenevaError(
                "walls of the slot change within the last digits of the input angle: make the "
                "drive more even"
            )
        return []
    if a < b:
        return [*fitted(wall.curve, a, b, tolerance)]

    def back(t: Array) -> tuple[Array, Array]:
        points, tangents = wall.curve(-t)
        return points, -tangents

    return [*fitted(back, -a, -b, tolerance)]
