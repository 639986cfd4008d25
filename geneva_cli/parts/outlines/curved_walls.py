"""The boundary of a curved slot: the outer boundary of all positions of its roller.

Of the walls of the roller's path only those stretches remain that no other position covers, and of
these the chain from one corner of the mouth round the bottom to the other.
"""

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from operator import itemgetter
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import fit
from geneva_cli.geometry.shapes import Contour, Segment, about, joined, mirrored
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import Array
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

# a part of a wall between two parameters, in either direction
WallPiece: TypeAlias = tuple[Wall, float, float]


class WallPlace(NamedTuple):
    """A sample on a wall, and the direction of travel: 1 with rising index, or -1."""

    wall: Wall
    i: int
    sense: int

    @property
    def t(self) -> float:
        """The parameter of the sample."""
        return float(self.wall.t[self.i])

    @property
    def run(self) -> tuple[int, int]:
        """First and last sample of the stretch of free samples that it is on."""
        return next((a, b) for a, b in _runs(self.wall) if a <= self.i <= b)

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


@dataclass(frozen=True)
class _CurvedSlot:
    """A curved slot; two are equal if what their walls depend on is equal."""

    engagement: Engagement
    lengths: tuple[float, ...]
    form: tuple[float, str]
    assembly: Assembly = field(compare=False)
    sizes: Sizes = field(compare=False)


def curved_walls(
    assembly: Assembly, sizes: Sizes, engagement: Engagement, tolerance: float, curves: str = "arcs"
) -> Contour:
    """Return a curved slot's walls, counterclockwise from one corner of its mouth to the other.

    They are within ``tolerance`` mm of the true walls, and never inside them: the slot of a roller
    larger by half the tolerance is fitted. Raises GenevaError where the walls do not close.
    """
    lengths = assembly.L, assembly.sign, sizes.roller, sizes.half_width, sizes.rim
    return _fitted(_CurvedSlot(engagement, lengths, (tolerance, curves), assembly, sizes))


# drawings, sheet and solids of one machine have the same walls, and so do machines of other locks
@lru_cache(maxsize=16)
def _fitted(slot: _CurvedSlot) -> Contour:
    assembly, engagement, (tolerance, curves) = slot.assembly, slot.engagement, slot.form
    half = 0.5 * tolerance
    larger = slot.sizes._replace(half_width=slot.sizes.half_width + half)
    pieces = chain(assembly, larger, walls(assembly, larger, engagement))
    own = pieces[: (len(pieces) + 1) // 2] if engagement.mirrored else pieces
    runs = [_segments(piece, half, curves) for piece in own]
    # of a mirrored slot, the second half is the image of the first in the slot's axis
    back = [mirrored(run) for run in runs[: len(pieces) - len(own)]][::-1]
    return Contour("WHEEL", joined(itertools.chain(*runs, *back)), closed=False)


def chain(assembly: Assembly, sizes: Sizes, around: list[Wall]) -> list[WallPiece]:
    """Return the pieces of walls that bound a slot, from its mouth's lower corner to its upper."""
    close = 1e-9 * assembly.L  # on the rim counts as inside

    def depth(points: Array) -> Array:
        """Return how far points lie inside the wheel."""
        return assembly.sign * (sizes.rim - np.hypot(points[..., 0], points[..., 1]))

    def rim(wall: Wall, i: int, sense: int) -> float | None:
        """Return the parameter at which a wall leaves the wheel after a sample; None inside."""
        after = i + sense
        if not 0 <= after < len(wall.t):
            return float(wall.t[i]) if depth(wall.points[i]) < close else None
        if depth(wall.points[after]) > -close:
            return None
        inside, outside = float(wall.t[i]), float(wall.t[after])
        return boundary_by_sections(lambda t: depth(wall.curve(t)[0]), inside, outside)

    around = [one._replace(free=one.free & (depth(one.points) > -close)) for one in around]
    # where walls enter the wheel: their first samples inside, and the parameters
    entries: list[tuple[WallPlace, float]] = []
    for wall in around:
        for start, end in _runs(wall):
            for i, sense in ((start, 1), (end, -1)):
                enters = rim(wall, i, -sense)
                entries += [] if enters is None else [(WallPlace(wall, i, sense), enters)]
    if not entries:
        raise _lost()
    place, t = min(entries, key=lambda c: math.atan2(*points_at(c[0].wall, c[1])[0][::-1]))
    pieces: list[WallPiece] = []
    for _ in range(64):  # many times the walls of any slot
        # on to the last free sample of the wall, or to the rim
        last = place._replace(i=place.run[1 if place.sense > 0 else 0])
        leaves = rim(*last)
        if leaves is not None and leaves != t:
            pieces.append((last.wall, t, leaves))
            # shorter pieces are rounding
            kept = [p for p in pieces if math.dist(*points_at(*p)) > 1e-7 * assembly.L]
            if not kept:
                raise _lost()
            return kept
        place = _next(around, last)
        leaves, begin = _joint(last, place)
        pieces.append((last.wall, t, leaves))
        t = begin
    raise _lost()


def _lost() -> GenevaError:
    text = "the walls of a slot do not close: reduce roller_radius_mm or increase wheel_radius_mm"
    return GenevaError(text, ("size", "roller_radius_mm"))


def _next(around: list[Wall], last: WallPlace) -> WallPlace:
    """Return the place where the next wall continues: on the nearest free wall but this one."""
    here, travel = last.wall.points[last.i], last.sense * last.wall.tangents[last.i]
    ahead = list[tuple[float, int, WallPlace]]()
    for wall in around:
        for start, end in _runs(wall):
            if wall is last.wall and start <= last.i <= end:
                continue
            away = np.hypot(*(wall.points[start : end + 1] - here).T)
            i = start + int(np.argmin(away))
            along = float((wall.tangents[i] * travel).sum())
            sense = 1 if i == start else -1 if i == end else (1 if along > 0.0 else -1)
            rest_of_run = end - i if sense > 0 else i - start
            # Never turn back: walls that merge end in one point, in opposite directions.
            if rest_of_run and sense * along >= -0.999:
                ahead.append((float(away.min()), -rest_of_run, WallPlace(wall, i, sense)))
    if not ahead:
        raise _lost()
    return min(ahead, key=itemgetter(0, 1))[2]


def _joint(last: WallPlace, following: WallPlace) -> tuple[float, float]:
    """Return the parameters on both walls of the point where they meet."""
    a, b = last.t, following.t
    met = _crossing(last, following)
    if met is not None:
        return met
    # They merge: continue from the point of the one to the nearest free point of the other.
    p, (low, high) = last.wall.points[last.i], following.wall.t[[*following.run]].tolist()
    for _ in range(8):
        q, v, speed = following.course(b)
        step = (p[0] - q[0]) * v[0] + (p[1] - q[1]) * v[1]
        b = min(max(following.within(b + step / speed), low), high)
    return a, b


def _crossing(last: WallPlace, following: WallPlace) -> tuple[float, float] | None:
    """Return the parameters on both walls of their crossing near two samples; None if none."""
    samples = []  # around both, in the direction of travel
    for place, behind, ahead in ((last, -FAR, REACH), (following, -REACH, FAR)):
        i = place.i + place.sense * np.arange(behind, ahead + 1)
        samples.append(i[(i >= 0) & (i < len(place.wall.t))])
    one, two = samples
    off = last.wall.points[one][:, None] - following.wall.points[two]
    near = np.unravel_index(np.argmin((off * off).sum(axis=-1)), off.shape[:2])
    last = last._replace(i=int(one[near[0]]))
    following = following._replace(i=int(two[near[1]]))
    a, b = last.t, following.t
    for _ in range(16):  # Newton's steps; walls that do not cross use them all
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


def points_at(wall: Wall, *t: float) -> list[list[float]]:
    """Return the points of a wall at some parameters."""
    return wall.curve(np.array(t))[0].tolist()


def _runs(wall: Wall) -> Iterator[tuple[int, int]]:
    """Yield first and last index of every stretch of free samples."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], wall.free, [False])).astype(int)))
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        yield int(start), int(end) - 1


def _segments(piece: WallPiece, tolerance: float, curves: str) -> list[Segment]:
    wall, *ends = piece
    step = STEP if wall.centre is None else ARC_STEP
    a, b = (round(end / step) * step for end in ends)
    if wall.centre is not None:
        return [about(wall.centre, wall.radius, a, b - a)]
    fitted = fit.KINDS[curves]
    if a == b:
        if math.dist(*points_at(wall, *ends)) > tolerance:
            text = "walls of a slot change within the last digits of the input angle"
            raise GenevaError(f"{text}: make the drive more even")
        return []
    if a < b:
        return [*fitted(wall.curve, a, b, tolerance)]

    def back(t: Array) -> tuple[Array, Array]:
        points, tangents = wall.curve(-t)
        return points, -tangents

    return [*fitted(back, -a, -b, tolerance)]
