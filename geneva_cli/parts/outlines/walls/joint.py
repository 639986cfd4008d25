"""The joint of two walls of a slot: their crossing, or the point where they merge."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Whole

Curve: TypeAlias = "Callable[[Array], tuple[Array, Array]]"  # parameters -> points and tangents
REACH = 3  # samples within which two walls meet


class Wall(NamedTuple):
    """One wall: points and tangents by a parameter, and samples in the order of the parameter."""

    curve: Curve
    t: Array
    points: Array
    tangents: Array
    free: Mask  # samples that no other position of the roller covers
    centre: tuple[float, float] | None = None  # where the wall is an arc, by its angle
    radius: float = 0.0


class WallPlace(NamedTuple):
    """A sample on a wall, and the direction of travel: 1 with rising index, or -1."""

    wall: Wall
    i: int
    sense: int


def joint(last: WallPlace, following: WallPlace) -> tuple[float, float]:
    """Return the parameters on both walls of the point where they meet."""
    a, b = float(last.wall.t[last.i]), float(following.wall.t[following.i])
    p, q = last.wall.points[last.i].tolist(), following.wall.points[following.i].tolist()
    at_ends = all(p.i in (0, len(p.wall.t) - 1) for p in (last, following))
    if at_ends and math.dist(p, q) < 1e-6 * max(1.0, math.hypot(*p)):
        return a, b
    met = _crossing(last, following)
    if met is not None:
        return met
    # They merge: continue from the point of the one to the nearest free point of the other.
    low, high = _free_run(following)
    for _ in range(8):
        q, v, speed = _course(following, b)
        step = (p[0] - q[0]) * v[0] + (p[1] - q[1]) * v[1]
        b = min(max(_within(following, b + step / speed), low), high)
    return a, b


def _free_run(place: WallPlace) -> tuple[float, float]:
    """Return the parameters of both ends of the free stretch that contains a sample."""
    start, end = next((a, b) for a, b in runs(place.wall) if a <= place.i <= b)
    return float(place.wall.t[start]), float(place.wall.t[end])


def _crossing(last: WallPlace, following: WallPlace) -> tuple[float, float] | None:
    """Return the parameters on both walls of their crossing near two samples; None if none."""
    start = _polylines_cross(last, following)
    if start is None:
        return None
    last, following = start
    a, b = float(last.wall.t[last.i]), float(following.wall.t[following.i])
    for _ in range(50):
        p, u, p_speed = _course(last, a)
        q, v, q_speed = _course(following, b)
        x, y = q[0] - p[0], q[1] - p[1]
        cross = u[0] * v[1] - u[1] * v[0]
        # walls at an angle below 1e-7 radians merge and do not cross
        if math.hypot(x, y) < 1e-12 * math.hypot(*p) or abs(cross) < 1e-7:
            break
        a = _within(last, a + (x * v[1] - y * v[0]) / cross / p_speed)
        b = _within(following, b + (x * u[1] - y * u[0]) / cross / q_speed)
    # the points are one to 1e-7 of their distance from the wheel's axis
    return (a, b) if math.hypot(x, y) < 1e-7 * math.hypot(*p) else None


def _polylines_cross(last: WallPlace, following: WallPlace) -> tuple[WallPlace, WallPlace] | None:
    """Return the samples before the crossing of two walls: the last one and the first one."""
    far = 80  # samples in which the crossing is searched
    one = _window(last, -far, REACH)
    two = _window(following, -REACH, far)
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
    return last._replace(i=int(one[i[best]])), following._replace(i=int(two[j[best]]))


def _window(place: WallPlace, behind: int, ahead: int) -> Whole:
    """Return the indices of samples around one, in the direction of travel."""
    indices = place.i + place.sense * np.arange(behind, ahead + 1)
    return indices[(indices >= 0) & (indices < len(place.wall.t))]


def _within(place: WallPlace, t: float) -> float:
    """Return a parameter limited to the neighbourhood of a sample."""
    grid, i = place.wall.t, place.i
    return min(max(t, float(grid[max(i - REACH, 0)])), float(grid[min(i + REACH, len(grid) - 1)]))


def points_at(wall: Wall, *t: float) -> list[list[float]]:
    """Return the points of a wall at some parameters."""
    return wall.curve(np.array(t))[0].tolist()


def _course(place: WallPlace, t: float) -> tuple[list[float], list[float], float]:
    """Return a wall's point and tangent at a parameter, and the point's speed with it."""
    step = 1e-6 * float(place.wall.t[-1] - place.wall.t[0])
    low, high = _within(place, t - step), _within(place, t + step)
    points, tangents = place.wall.curve(np.array([low, t, high]))
    before, here, after = points.tolist()
    speed = max(math.dist(before, after) / (high - low), 1e-12)
    return here, tangents[1].tolist(), speed


def runs(wall: Wall) -> Iterator[tuple[int, int]]:
    """Yield first and last index of every stretch of free samples."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], wall.free, [False])).astype(int)))
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        yield int(start), int(end) - 1
