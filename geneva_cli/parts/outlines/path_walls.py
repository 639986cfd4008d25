"""The walls on both sides of a roller's path through a curved slot, and which of them are free.

Before and after the path in and out there is the roller's circle while the wheel rests. Where the
roller turns back, its own outline is a wall too.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry.shapes import Point
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.path_and_slot import Pitch, retraces
from geneva_cli.numerics.arrays import Array, Mask, array, blocks
from geneva_cli.numerics.roots import boundary_by_sections
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots.roller_paths import rest
from geneva_cli.parts.slots.slot_profile import nodes, pitch_at

Curve: TypeAlias = "Callable[[Array], tuple[Array, Array]]"  # parameters -> points and tangents

# Of the centre distance, the greatest deviation of the sampled path from the true one: less than
# half of the overlap that does not count as covered.
FINE = 4e-7
CIRCLE_SAMPLES = 97  # of the roller's circle, at least, and of its own outline


class Wall(NamedTuple):
    """One wall: points and tangents by a parameter, and samples in the order of the parameter."""

    curve: Curve
    t: Array
    points: Array
    tangents: Array
    free: Mask  # samples that no other position of the roller covers
    centre: Point | None = None  # where the wall is an arc, by its angle
    radius: float = 0.0


def walls(assembly: Assembly, sizes: Sizes, engagement: Engagement) -> list[Wall]:
    """Return every wall of the roller's path, with its free samples."""
    w, L, back = sizes.half_width, assembly.L, retraces(engagement)
    t = nodes(assembly.mechanism, FINE * L, few=False)
    near = w - 1e-6 * L  # a smaller overlap does not count as covered
    circles = [_circle(assembly, sizes, engagement, end) for end in (-1.0, 1.0)]
    path = np.concatenate([circles[0][1][::-1], _pitch(L, engagement, t), circles[1][1]])
    arcs: list[Wall] = []
    for centre, points in circles:
        radius = math.dist(centre, points[0])
        angles = np.unwrap(np.arctan2(points[:, 1] - centre[1], points[:, 0] - centre[0]))
        for side in (-w, w):
            arcs.append(_arc(path, near, centre, radius + side, np.sort(angles)))
    flanks: list[Wall] = []
    middle = int(np.searchsorted(t, 0.0))
    for part in (t[: middle + 1], t[middle:]):
        outward = bool(part[-1] > 0.0)
        for side in (-w, w):
            curve = partial(parallel, L, engagement, side, outward)
            t = _unfolded(curve, part, pitch_at(engagement, part), L, side) if back else part
            points, tangents = curve(t)
            flanks.append(Wall(curve, t, points, tangents, _free(points, path, near)))
    if not back:
        return [*arcs, *flanks]
    # the roller's own outline where it stops in the wheel, between the flanks that leave it
    x, y = _pitch(L, engagement, np.zeros(1))[0]
    at = pitch_at(engagement, np.zeros(1))
    ahead = math.atan2(float(array(at.tangent_y)[0]), float(array(at.tangent_x)[0]))
    ends = [flank.points[-1 if flank.t[-1] <= 0.0 else 0] for flank in flanks]
    turns = [math.atan2(v - y, u - x) - ahead for u, v in ends]
    turns = [math.remainder(turn, math.tau) for turn in turns]
    low = max(turn for turn in turns if turn < 0.0)
    high = min(turn for turn in turns if turn > 0.0)
    round_ = ahead + np.linspace(low, high, CIRCLE_SAMPLES)
    return [*arcs, *flanks, _arc(path, near, (float(x), float(y)), w, round_)]


def _circle(
    assembly: Assembly, sizes: Sizes, engagement: Engagement, end: float
) -> tuple[Point, Array]:
    """Return the roller's path before entry (-1) or after exit (1): centre, and points outwards."""
    centre = rest(assembly, engagement, end)
    x, y = _pitch(assembly.L, engagement, np.array([engagement.end_deg(end)]))[0]
    radius, start = math.dist((x, y), centre), math.atan2(y - centre[1], x - centre[0])
    # As far as the middle of the dwell, where the path of the next slot begins.
    ahead = math.atan2(-assembly.sign * centre[1], -assembly.sign * centre[0])
    rest_of_turn = math.pi - abs(math.remainder(start - ahead, math.tau))

    def path(turn: Array) -> Array:
        x, y = radius * np.cos(start + turn), radius * np.sin(start + turn)
        return np.column_stack((centre[0] + x, centre[1] + y))

    # Seen from the resting wheel the crank turns against an external wheel, with an internal one.
    turn = -end * assembly.sign * np.linspace(0.0, rest_of_turn, 4 * CIRCLE_SAMPLES)
    outside = assembly.sign * (np.hypot(*path(turn).T) - sizes.rim) > 2.0 * sizes.half_width
    whole = float(turn[np.argmax(outside)] if outside.any() else turn[-1])
    # As dense as the path in the slot: chords lie inside the circle, where one of its walls is.
    many = math.ceil(abs(whole) / math.sqrt(8.0 * FINE * assembly.L / radius)) + 1
    return centre, path(np.linspace(0.0, whole, max(CIRCLE_SAMPLES, many)))


def _arc(path: Array, near: float, centre: Point, radius: float, angles: Array) -> Wall:
    def curve(t: Array) -> tuple[Array, Array]:
        c, s = np.cos(t), np.sin(t)
        points = np.column_stack((centre[0] + radius * c, centre[1] + radius * s))
        return points, np.column_stack((-s, c))

    points, tangents = curve(angles)
    return Wall(curve, angles, points, tangents, _free(points, path, near), centre, radius)


def parallel(
    L: float, engagement: Engagement, side: float, outward: bool, t: Array
) -> tuple[Array, Array]:
    """Return points, ``side`` mm to the left of the roller's path in, or out, and unit tangents."""
    at = pitch_at(engagement, t)
    tangent = np.column_stack((at.tangent_x, at.tangent_y))
    if outward and retraces(engagement):  # at mid-motion the tangent is the limit from the entry
        tangent[t == 0.0] *= -1.0
    x, y = L * at.x - side * tangent[:, 1], L * at.y + side * tangent[:, 0]
    return np.column_stack((x, y)), tangent


def _unfolded(curve: Curve, t: Array, at: Pitch, L: float, side: float) -> Array:
    """Return a flank's samples without the fold at mid-motion."""
    order = np.argsort(np.abs(t))
    # a smaller fold is ignored
    folded = L * array(at.speed)[order] < side * array(at.turning)[order] - 1e-7 * L
    if not folded[0]:
        return t
    first = int(np.argmin(folded))
    centre = L * np.array((array(at.x)[order[0]], array(at.y)[order[0]]))

    def outside(x: Array) -> Array:
        return np.hypot(*(curve(x)[0] - centre).T) - abs(side)

    while first < len(t) - 1 and not outside(t[order[first : first + 1]])[0] > 0.0:
        first += 1
    b = boundary_by_sections(outside, float(t[order[first]]), float(t[order[first - 1]]))
    kept = np.sort(t[order[first:]])
    return np.append(kept, b) if b < 0.0 else np.insert(kept, 0, b)


def _pitch(L: float, engagement: Engagement, t: Array) -> Array:
    x, y = engagement.slot(t, 0)
    return L * np.column_stack((x.c[0], y.c[0]))


def _free(points: Array, path: Array, least: float) -> Mask:
    """Return a mask of the points that no position of the roller covers."""
    out = np.ones(len(points), dtype=bool)
    start, steps = path[:-1], np.diff(path, axis=0)
    square = np.maximum((steps * steps).sum(axis=1), 1e-300)
    half, middle = 0.5 * np.sqrt(square), start + 0.5 * steps
    for block in blocks(len(points), 64):
        here = points[block]
        centre = 0.5 * (here.min(axis=0) + here.max(axis=0))
        reach = least + float(np.hypot(*(here - centre).T).max())
        near = np.flatnonzero(np.hypot(*(middle - centre).T) <= reach + half)
        if not len(near):
            continue
        x, y = steps[near].T
        off_x, off_y = here[:, :1] - start[near, 0], here[:, 1:] - start[near, 1]
        fraction = np.clip((off_x * x + off_y * y) / square[near], 0.0, 1.0)
        off_x -= fraction * x
        off_y -= fraction * y
        nearest = (off_x * off_x + off_y * off_y).min(axis=1)
        out[block] = nearest > least * least
    return out
